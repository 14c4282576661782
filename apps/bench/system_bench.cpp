// SPDX-License-Identifier: MIT
//
// Frames of the ShadowSystem: what a frame costs in which nothing, some things or everything moved,
// for 10,000 casters and 4 lights. Names end in mesh and threads.
#include <benchmark/benchmark.h>

#include <cmath>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/shadows/shadow_system.hpp>

#include "meshes.hpp"

namespace gnomon::bench {
namespace {

using shadows::Submission;

enum class Moving { Nothing, Camera, OneLight, OnePercent, All };
enum class Kind { Box, Torus };

std::shared_ptr<const shadows::ShadowMesh> mesh_of(Kind kind) {
    if (kind == Kind::Torus) return torus_knot(1'000);
    const scene::Mesh box = scene::make_box(glm::vec3(1.0F));
    return *shadows::ShadowMesh::build(
        {.positions = reinterpret_cast<const std::byte*>(box.positions.data()),
         .vertex_count = box.positions.size(),
         .indices = box.indices});
}

// A host that keeps its casters, in rows on a field, and tells all or what moved.
class Field {
public:
    Field(std::uint64_t casters, std::uint64_t lights, Kind kind, unsigned threads)
        : system_(*shadows::ShadowSystem::create(
              {.jobs = threads > 1 ? shadows::thread_jobs(threads) : shadows::Jobs{}})) {
        const auto mesh = mesh_of(kind);
        for (std::uint64_t i = 0; i < casters; ++i) {
            const glm::dvec3 place(static_cast<double>(i % 100) * 4.0 - 200.0, 0.0,
                                   static_cast<double>(i / 100) * 4.0 - 200.0);
            casters_.push_back({.key = i,
                                .mesh = mesh,
                                .world_from_local = glm::translate(glm::dmat4(1.0), place)});
        }
        for (std::uint64_t i = 0; i < lights; ++i) {
            const double angle = 1.5 * static_cast<double>(i);
            lights_.push_back(
                {.key = i,
                 .position_world = {90.0 * std::sin(angle), 80.0, 90.0 * std::cos(angle), 1.0}});
        }
        view_.clip_from_view = shadows::infinite_perspective(0.8, 1.5, 0.01);
        view_.view_from_world = shadows::look_at({0, 60, 240}, {0, 0, 0}, {0, 1, 0});
    }

    void move(Moving moving) {
        moved_casters_.clear();
        moved_lights_.clear();
        ++step_;
        const double phase = 0.05 * static_cast<double>(step_);
        if (moving == Moving::Camera) {
            view_.view_from_world =
                shadows::look_at({20.0 * std::sin(phase), 60, 240}, {0, 0, 0}, {0, 1, 0});
        }
        if (moving == Moving::OneLight) {
            lights_[0].position_world = {90.0 * std::sin(phase), 80.0, 90.0 * std::cos(phase), 1.0};
            moved_lights_.push_back(0);
        }
        const std::size_t stride = moving == Moving::All ? 1 : 100;
        if (moving != Moving::All && moving != Moving::OnePercent) return;
        for (std::size_t i = step_ % stride; i < casters_.size(); i += stride) {
            glm::dmat4& pose = casters_[i].world_from_local;
            pose = glm::rotate(pose, 0.3, glm::dvec3(0, 1, 0));
            moved_casters_.push_back(i);
        }
    }

    const shadows::DrawList& submit(Submission submission) {
        auto frame = system_.begin_frame(submission);
        if (submission == Submission::Full) {
            for (const shadows::Caster& caster : casters_) frame.caster(caster);
            for (const shadows::Light& light : lights_) frame.light(light);
        } else {
            for (const std::size_t i : moved_casters_) frame.caster(casters_[i]);
            for (const std::size_t i : moved_lights_) frame.light(lights_[i]);
        }
        return std::move(frame).finish(view_);
    }

    // As a host does that makes its casters' descriptions on the way.
    const shadows::DrawList& submit_made_anew() {
        auto frame = system_.begin_frame();
        for (const shadows::Caster& known : casters_) {
            frame.caster(
                {.key = known.key, .mesh = known.mesh, .world_from_local = known.world_from_local});
        }
        for (const shadows::Light& light : lights_) frame.light(light);
        return std::move(frame).finish(view_);
    }

    [[nodiscard]] std::size_t casters() const { return casters_.size(); }
    [[nodiscard]] std::size_t pairs() const { return casters_.size() * lights_.size(); }
    [[nodiscard]] shadows::SystemMemory memory() const { return system_.memory(); }

private:
    std::vector<shadows::Caster> casters_;
    std::vector<shadows::Light> lights_;
    std::vector<std::size_t> moved_casters_, moved_lights_;
    shadows::View view_;
    shadows::ShadowSystem system_;
    std::uint64_t step_ = 0;
};

void report(benchmark::State& state, const Field& field, const shadows::DrawList& list) {
    const auto pairs = static_cast<double>(field.pairs());
    const shadows::SystemMemory memory = field.memory();
    state.counters["redetected"] = static_cast<double>(list.stats.pairs_redetected);
    state.counters["bytes/pair"] = static_cast<double>(memory.pairs + memory.extras) / pairs;
    state.counters["time/caster"] = benchmark::Counter(
        static_cast<double>(field.casters()),
        benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void frames(benchmark::State& state, Moving moving, Submission submission, Kind kind,
            unsigned threads) {
    Field field(10'000, 4, kind, threads);
    (void)field.submit(Submission::Full);
    (void)field.submit(Submission::Full);
    const shadows::DrawList* list = nullptr;
    for (auto _ : state) {
        field.move(moving);
        list = &field.submit(submission);
        benchmark::DoNotOptimize(list->draws.data());
    }
    report(state, field, *list);
}

void nothing_moves_made_anew(benchmark::State& state) {
    Field field(10'000, 4, Kind::Box, 1);
    (void)field.submit(Submission::Full);
    const shadows::DrawList* list = nullptr;
    for (auto _ : state) {
        list = &field.submit_made_anew();
        benchmark::DoNotOptimize(list->draws.data());
    }
    report(state, field, *list);
}
BENCHMARK(nothing_moves_made_anew)
    ->Name("frames/nothing_moves/full_made_anew/box")
    ->Unit(benchmark::kMicrosecond);

[[maybe_unused]] const bool registered = [] {
    const auto add = [](const std::string& name, Moving moving, Submission submission, Kind kind,
                        unsigned threads) {
        benchmark::RegisterBenchmark(("frames/" + name).c_str(), frames, moving, submission, kind,
                                     threads)
            ->Unit(benchmark::kMicrosecond)
            ->UseRealTime();
    };
    for (const Kind kind : {Kind::Box, Kind::Torus}) {
        const std::string mesh = kind == Kind::Box ? "/box" : "/torus";
        add("nothing_moves/full" + mesh, Moving::Nothing, Submission::Full, kind, 1);
        add("nothing_moves/delta" + mesh, Moving::Nothing, Submission::Delta, kind, 1);
        for (const unsigned threads : {1U, 2U}) {
            const std::string end = mesh + "/threads:" + std::to_string(threads);
            add("camera_moves" + end, Moving::Camera, Submission::Delta, kind, threads);
            add("one_light_moves" + end, Moving::OneLight, Submission::Delta, kind, threads);
            add("one_percent_moves" + end, Moving::OnePercent, Submission::Delta, kind, threads);
            add("all_move" + end, Moving::All, Submission::Full, kind, threads);
        }
    }
    return true;
}();

}  // namespace
}  // namespace gnomon::bench
