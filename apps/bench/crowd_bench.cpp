// SPDX-License-Identifier: MIT
//
// What a crowd of casters costs the processor and what a second thread saves of it: 256 casters of
// 1 to 5 thousand triangles and 4 point lights, everything moving, detected, built, handed over and
// recorded on a device that draws nothing. Names end in the threads.
#include <benchmark/benchmark.h>

#include <array>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/gpu/null_backend.hpp>
#include <gnomon/scene/primitives.hpp>
#include <gnomon/shadow_pass/shadow_pass.hpp>

namespace gnomon::bench {
namespace {

constexpr shadow_pass::TargetSize target_size{1280, 720};

std::shared_ptr<const shadows::ShadowMesh> shadow_mesh(const scene::Mesh& mesh) {
    return *shadows::ShadowMesh::build(
        {.positions = reinterpret_cast<const std::byte*>(mesh.positions.data()),
         .vertex_count = mesh.positions.size(),
         .indices = mesh.indices});
}

// Rows of casters on a ground that receives, with lights above that go round.
class Crowd {
public:
    explicit Crowd(unsigned threads)
        : system_(*shadows::ShadowSystem::create(
              {.jobs = threads > 1 ? shadows::thread_jobs(threads) : shadows::Jobs{},
               .receivers = shadows::Receivers::Submitted})),
          device_(gpu::create_null_backend()),
          pass_(*shadow_pass::ShadowPass::create(device_, {})),
          target_(*device_.create_texture({.width = target_size.width,
                                           .height = target_size.height,
                                           .format = gpu::Format::Depth32FloatStencil8,
                                           .usage = gpu::TextureUsage::RenderAttachment})) {
        const std::array meshes{shadow_mesh(scene::make_sphere(0.9F, 32, 17)),
                                shadow_mesh(scene::make_torus(0.8F, 0.3F, 50, 20)),
                                shadow_mesh(scene::make_torus_knot(0.6F, 0.18F, 2, 3, 100, 15)),
                                shadow_mesh(scene::make_torus_knot(0.6F, 0.15F, 3, 4, 125, 20))};
        for (std::uint64_t i = 0; i < 256; ++i) {
            const glm::dvec3 place(3.0 * static_cast<double>(i % 16) - 22.5, 1.3,
                                   3.0 * static_cast<double>(i / 16) - 22.5);
            casters_.push_back({.key = i,
                                .mesh = meshes[(i + i / 16) % meshes.size()],
                                .world_from_local = glm::translate(glm::dmat4(1.0), place)});
        }
        view_.clip_from_view = shadows::infinite_perspective(0.8, 16.0 / 9.0, 0.1);
        view_.view_from_world = shadows::look_at({0, 17, 36}, {0, 0, 2}, {0, 1, 0});
    }

    void move() {
        ++step_;
        for (shadows::Caster& caster : casters_) {
            caster.world_from_local = glm::rotate(caster.world_from_local, 0.02, {0, 1, 0});
        }
        for (std::uint64_t i = 0; i < lights_.size(); ++i) {
            const double turn =
                glm::radians(90.0 * static_cast<double>(i) + 20.0 + static_cast<double>(step_));
            lights_[i] = {.key = i,
                          .position_world = {14.0 * std::cos(turn), 9.0, 14.0 * std::sin(turn), 1}};
        }
    }

    const shadows::DrawList& detect_and_build() {
        auto frame = system_.begin_frame();
        for (const shadows::Caster& caster : casters_) frame.caster(caster);
        for (const shadows::Caster& caster : casters_) {
            frame.receiver({.key = caster.key,
                            .bounds = {caster.world_from_local, caster.mesh->bounds_min(),
                                       caster.mesh->bounds_max()}});
        }
        frame.receiver({.key = casters_.size(),
                        .bounds = {.min = {-80.0, 0.0, -80.0}, .max = {80.0, 0.0, 80.0}}});
        for (const shadows::Light& light : lights_) frame.light(light);
        return std::move(frame).finish(view_);
    }

    void record(const shadows::DrawList& list) {
        if (!pass_.prepare(list, view_, target_size)) return;
        auto commands = device_.create_command_encoder("crowd");
        for (std::size_t i = 0; i < list.lights.size(); ++i) {
            auto encoder = commands.begin_render_pass(
                {.depth_stencil = gpu::DepthStencilAttachment{
                     .texture = target_,
                     .depth_load_op = i == 0 ? gpu::LoadOp::Clear : gpu::LoadOp::Load,
                     .stencil_load_op = gpu::LoadOp::Clear}});
            pass_.record(encoder, i);
        }
        const auto recorded = commands.finish();
        if (recorded) (void)device_.submit(*recorded);
    }

private:
    std::vector<shadows::Caster> casters_;
    std::array<shadows::Light, 4> lights_;
    shadows::View view_;
    shadows::ShadowSystem system_;
    gpu::Device device_;
    shadow_pass::ShadowPass pass_;
    gpu::Texture target_;
    std::uint64_t step_ = 0;
};

void all_move(benchmark::State& state, unsigned threads) {
    using Clock = std::chrono::steady_clock;
    Crowd crowd(threads);
    Clock::duration built{}, recorded{};
    const auto frame = [&] {
        crowd.move();
        const auto start = Clock::now();
        const shadows::DrawList& list = crowd.detect_and_build();
        const auto between = Clock::now();
        crowd.record(list);
        built += between - start;
        recorded += Clock::now() - between;
    };
    for (int i = 0; i < 10; ++i) frame();
    built = recorded = {};
    for (auto _ : state) frame();
    const auto per_frame = [](Clock::duration time) {
        return benchmark::Counter(std::chrono::duration<double>(time).count(),
                                  benchmark::Counter::kAvgIterations);
    };
    state.counters["detect+build"] = per_frame(built);
    state.counters["hand_over+record"] = per_frame(recorded);
}

[[maybe_unused]] const bool registered = [] {
    for (const unsigned threads : {1U, 2U}) {
        benchmark::RegisterBenchmark(("crowd/all_move/threads:" + std::to_string(threads)).c_str(),
                                     all_move, threads)
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
    }
    return true;
}();

}  // namespace
}  // namespace gnomon::bench
