// SPDX-License-Identifier: MIT
//
// The pure functions of the CPU core: building a mesh, facing, silhouettes, volumes. The light
// jumps every time.
#include <benchmark/benchmark.h>

#include <gnomon/shadows/facing.hpp>
#include <gnomon/shadows/layer_bound.hpp>
#include <gnomon/shadows/silhouette.hpp>
#include <gnomon/shadows/volume.hpp>

#include "meshes.hpp"

namespace gnomon::bench {
namespace {

void per_triangle(benchmark::State& state, const shadows::ShadowMesh& mesh) {
    const auto triangles = static_cast<double>(mesh.faces().size());
    state.counters["triangles"] = triangles;
    state.counters["time/triangle"] = benchmark::Counter(
        triangles, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void build_mesh(benchmark::State& state) {
    const scene::Mesh source = [&] {
        const auto tube =
            static_cast<std::uint32_t>(std::sqrt(static_cast<double>(state.range(0)) / 16.0));
        return scene::make_torus_knot(1.0F, 0.3F, 2, 3, tube * 8, tube);
    }();
    const shadows::MeshView view{
        .positions = reinterpret_cast<const std::byte*>(source.positions.data()),
        .vertex_count = source.positions.size(),
        .indices = source.indices};
    std::shared_ptr<const shadows::ShadowMesh> mesh;
    for (auto _ : state) {
        mesh = *shadows::ShadowMesh::build(view);
        benchmark::DoNotOptimize(mesh);
    }
    per_triangle(state, *mesh);
}

void classify(benchmark::State& state, shadows::FacingFilter filter) {
    const auto mesh = torus_knot(state.range(0));
    shadows::Facing facing;
    std::int64_t step = 0;
    for (auto _ : state) {
        shadows::classify_faces(*mesh, light_at(step++), facing, shadows::NearCaps::Facing, filter);
        benchmark::DoNotOptimize(facing.weights.data());
    }
    per_triangle(state, *mesh);
}

void silhouette_brute_force(benchmark::State& state) {
    const auto mesh = torus_knot(state.range(0));
    std::vector<shadows::Facing> facings(8);
    for (std::size_t i = 0; i < facings.size(); ++i) {
        shadows::classify_faces(*mesh, light_at(static_cast<std::int64_t>(i)), facings[i]);
    }
    std::vector<shadows::SilhouetteEdge> silhouette;
    std::size_t step = 0;
    for (auto _ : state) {
        shadows::find_silhouette(*mesh, facings[step++ % facings.size()].weights, silhouette);
        benchmark::DoNotOptimize(silhouette.data());
    }
    state.counters["edges"] = static_cast<double>(silhouette.size());
    per_triangle(state, *mesh);
}

void volume(benchmark::State& state, const shadows::CapOptions& caps) {
    const auto mesh = torus_knot(state.range(0));
    shadows::Facing facing;
    shadows::classify_faces(*mesh, light_at(1), facing);
    std::vector<shadows::SilhouetteEdge> silhouette;
    shadows::find_silhouette(*mesh, facing.weights, silhouette);
    std::vector<shadows::FaceRun> casting;
    shadows::runs_of(facing.weights, casting);
    shadows::Volume result;
    for (auto _ : state) {
        shadows::build_volume(*mesh, casting, silhouette, {.caps = caps}, result);
        benchmark::DoNotOptimize(result.indices.data());
    }
    state.counters["index bytes"] = 4.0 * static_cast<double>(result.indices.size());
    state.counters["ranges"] = static_cast<double>(result.ranges.size());
    per_triangle(state, *mesh);
}

void layer_bound(benchmark::State& state) {
    const auto mesh = torus_knot(state.range(0));
    const shadows::LightLocal light = light_at(1);
    shadows::Facing facing;
    shadows::classify_faces(*mesh, light, facing);
    std::vector<shadows::SilhouetteEdge> silhouette;
    shadows::find_silhouette(*mesh, facing.weights, silhouette);
    shadows::Volume cast;
    shadows::build_volume(*mesh, facing.weights, silhouette, light.is_directional(),
                          shadows::FarVertices::AtInfinity, cast);
    const shadows::LayerSpace space{.light = glm::dvec4(light.position)};
    std::uint32_t layers = 0;
    for (auto _ : state) {
        layers = shadows::layer_bound(*mesh, cast, space);
        benchmark::DoNotOptimize(layers);
    }
    state.counters["layers"] = layers;
    per_triangle(state, *mesh);
}

BENCHMARK(build_mesh)->RangeMultiplier(10)->Range(1000, 1000000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(classify, simd, shadows::FacingFilter::Simd)
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(classify, scalar, shadows::FacingFilter::Scalar)
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(silhouette_brute_force)
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(layer_bound)->RangeMultiplier(10)->Range(1000, 1000000)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(volume, written_out, shadows::CapOptions::plain())
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(volume, ranges, shadows::CapOptions{})
    ->RangeMultiplier(10)
    ->Range(1000, 1000000)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace gnomon::bench
