// SPDX-License-Identifier: MIT
//
// Frames of the ShadowSystem: what a frame costs in which nothing, one thing or everything moved.
#include <benchmark/benchmark.h>

#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/shadows/shadow_system.hpp>

#include "meshes.hpp"

namespace gnomon::bench {
namespace {

enum class Moving { Nothing, Camera, OneCaster, Light };

void frames(benchmark::State& state, Moving moving) {
    const auto mesh = torus_knot(1000);
    const auto casters = static_cast<std::uint64_t>(state.range(0));
    auto system = *shadows::ShadowSystem::create();
    shadows::View view;
    view.clip_from_view = shadows::infinite_perspective(0.8, 1.5, 0.01);
    view.view_from_world = shadows::look_at({0, 10, 40}, {0, 0, 0}, {0, 1, 0});
    double step = 0.0;
    std::uint64_t redetected = 0;
    for (auto _ : state) {
        step += 0.05;
        if (moving == Moving::Camera) {
            view.view_from_world = shadows::look_at({std::sin(step), 10, 40}, {0, 0, 0}, {0, 1, 0});
        }
        auto frame = system.begin_frame();
        for (std::uint64_t i = 0; i < casters; ++i) {
            const glm::dvec3 place(static_cast<double>(i % 32) * 3.0, 0.0,
                                   static_cast<double>(i / 32) * 3.0);
            glm::dmat4 pose = glm::translate(glm::dmat4(1.0), place);
            if (moving == Moving::OneCaster && i == 0)
                pose = glm::rotate(pose, step, glm::dvec3(0, 1, 0));
            frame.caster({.key = i, .mesh = mesh, .world_from_local = pose});
        }
        const double light = moving == Moving::Light ? step : 0.0;
        frame.light(
            {.key = 0,
             .position_world = {20.0 * std::sin(light), 30.0, 20.0 * std::cos(light), 1.0}});
        const shadows::DrawList list = std::move(frame).finish(view);
        redetected = list.stats.pairs_redetected;
        benchmark::DoNotOptimize(list.draws.data());
    }
    state.counters["redetected"] = static_cast<double>(redetected);
    state.counters["time/caster"] = benchmark::Counter(
        static_cast<double>(casters),
        benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(frames, nothing_moves, Moving::Nothing)
    ->Arg(10)
    ->Arg(1000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(frames, camera_moves, Moving::Camera)
    ->Arg(10)
    ->Arg(1000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(frames, one_caster_turns, Moving::OneCaster)
    ->Arg(10)
    ->Arg(1000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(frames, light_moves, Moving::Light)
    ->Arg(10)
    ->Arg(1000)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace gnomon::bench
