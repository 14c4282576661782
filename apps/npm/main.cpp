// SPDX-License-Identifier: MIT
//
// What index.js calls: functions of numbers and of places in memory. An answer below zero is a
// failure, whose sentence and code stand until the next one. Matrices and vectors come and go by
// one block of doubles, so that a moved caster costs a copy and a call.
#include <array>
#include <new>
#include <string>
#include <utility>

#include <emscripten/emscripten.h>

#include "shadows.hpp"

namespace {

using namespace gnomon;
using npm::Shadows;

std::unique_ptr<Shadows> shadows_made;
Error last_error;
// index.js knows its size: two matrices, or what report() and stats() answer.
std::array<double, 32> doubles;

constexpr std::int32_t failed = -1;
constexpr std::uint32_t visible_bit = 1;
constexpr std::uint32_t in_depth_bit = 2;
constexpr std::uint32_t averted_bit = 4;

Shadows::Manner manner_of(std::uint32_t bits) {
    return {.visible = (bits & visible_bit) != 0,
            .in_depth = (bits & in_depth_bit) != 0,
            .averted_caps = (bits & averted_bit) != 0};
}

glm::dmat4 matrix(std::size_t first) {
    glm::dmat4 m;
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) m[c][r] = doubles[first + static_cast<std::size_t>(4 * c + r)];
    }
    return m;
}

std::int32_t refuse(Error error) {
    last_error = std::move(error);
    return failed;
}

std::int32_t answer(const Status& status) { return status ? 0 : refuse(status.error()); }
std::int32_t answer(const Result<std::uint32_t>& number) {
    return number ? static_cast<std::int32_t>(*number) : refuse(number.error());
}

// Memory ends where the browser says so.
template <class Call>
std::int32_t guarded(Call call) {
    try {
        return answer(call());
    } catch (const std::bad_alloc&) {
        return refuse(
            {ErrorCode::OutOfMemory, "The memory of gnomon's WebAssembly module is full."});
    }
}

// Values in the order in which index.js names them.
template <class... Value>
void put(Value... values) {
    std::size_t at = 0;
    ((doubles[at++] = static_cast<double>(values)), ...);
}

}  // namespace

extern "C" {

EMSCRIPTEN_KEEPALIVE double* gnomon_doubles() { return doubles.data(); }
EMSCRIPTEN_KEEPALIVE const char* gnomon_sentence() { return last_error.message.c_str(); }
EMSCRIPTEN_KEEPALIVE std::uint32_t gnomon_code() {
    return static_cast<std::uint32_t>(last_error.code);
}

EMSCRIPTEN_KEEPALIVE std::int32_t gnomon_start(std::int32_t constant, float slope_scale) {
    return guarded([&]() -> Status {
        auto made = Shadows::create({constant, slope_scale});
        if (!made) return forward_error(made);
        shadows_made = std::move(*made);
        return {};
    });
}

EMSCRIPTEN_KEEPALIVE void gnomon_stop() { shadows_made.reset(); }

EMSCRIPTEN_KEEPALIVE std::int32_t gnomon_add_mesh(const float* positions,
                                                  std::uint32_t vertex_count,
                                                  const std::uint32_t* indices,
                                                  std::uint32_t index_count,
                                                  const std::uint32_t* identities) {
    return guarded([&] {
        shadows::MeshView view{.positions = reinterpret_cast<const std::byte*>(positions),
                               .vertex_count = vertex_count,
                               .indices = {indices, index_count}};
        if (identities != nullptr) view.identities = {identities, vertex_count};
        return shadows_made->add_mesh(view);
    });
}

EMSCRIPTEN_KEEPALIVE std::int32_t gnomon_add_deformed(std::uint32_t mesh,
                                                      const glm::vec3* positions,
                                                      std::uint32_t vertex_count) {
    return guarded([&] { return shadows_made->add_deformed(mesh, {positions, vertex_count}); });
}

EMSCRIPTEN_KEEPALIVE void gnomon_report(std::uint32_t mesh) {
    const shadows::MeshReport& r = shadows_made->mesh(mesh).report();
    put(r.triangles, r.vertices, r.welded_vertices, r.edges, r.components, r.closed_components,
        r.boundary_edges, r.non_manifold_edges, r.inconsistent_edges, r.unbalanced_edges,
        r.degenerate_faces);
}

EMSCRIPTEN_KEEPALIVE void gnomon_remove_mesh(std::uint32_t mesh) {
    shadows_made->remove_mesh(mesh);
}

EMSCRIPTEN_KEEPALIVE std::int32_t gnomon_add_caster(std::uint32_t mesh, std::uint32_t bits) {
    return guarded([&]() -> Result<std::uint32_t> {
        return shadows_made->add_caster(mesh, matrix(0), manner_of(bits));
    });
}

EMSCRIPTEN_KEEPALIVE void gnomon_place(std::uint32_t caster) {
    shadows_made->place(caster, matrix(0));
}
EMSCRIPTEN_KEEPALIVE void gnomon_change(std::uint32_t caster, std::uint32_t bits) {
    shadows_made->change(caster, manner_of(bits));
}
EMSCRIPTEN_KEEPALIVE void gnomon_change_mesh(std::uint32_t caster, std::uint32_t mesh) {
    shadows_made->change_mesh(caster, mesh);
}
EMSCRIPTEN_KEEPALIVE void gnomon_remove_caster(std::uint32_t caster) {
    shadows_made->remove_caster(caster);
}

EMSCRIPTEN_KEEPALIVE void gnomon_set_light(std::uint32_t bit, double x, double y, double z,
                                           double w, double range_m) {
    shadows_made->set_light(bit, {x, y, z, w},
                            range_m >= 0.0 ? std::optional(range_m) : std::nullopt);
}
EMSCRIPTEN_KEEPALIVE void gnomon_remove_light(std::uint32_t bit) {
    shadows_made->remove_light(bit);
}

EMSCRIPTEN_KEEPALIVE std::int32_t gnomon_add_view(std::uint32_t depth, std::uint32_t width,
                                                  std::uint32_t height, std::uint32_t sample_count,
                                                  bool reversed, bool bits,
                                                  const std::uint32_t* masks,
                                                  std::uint32_t mask_count) {
    return guarded([&] {
        return shadows_made->add_view({.depth = depth,
                                       .size = {width, height},
                                       .sample_count = sample_count,
                                       .reversed = reversed,
                                       .bits = bits,
                                       .masks = {masks, mask_count}});
    });
}
EMSCRIPTEN_KEEPALIVE void gnomon_remove_view(std::uint32_t view) {
    shadows_made->remove_view(view);
}

EMSCRIPTEN_KEEPALIVE std::int32_t gnomon_render(std::uint32_t view) {
    return guarded([&] { return shadows_made->render(view, matrix(0), matrix(16)); });
}

EMSCRIPTEN_KEEPALIVE void gnomon_stats() {
    const shadows::FrameStats& f = shadows_made->frame_stats();
    const shadow_pass::PassStats& p = shadows_made->pass_stats();
    put(f.casters, f.pairs, f.pairs_culled, f.pairs_hidden, f.pairs_redetected, f.pairs_reused,
        f.zpass_pairs, f.zfail_pairs, f.silhouette_edges, f.detect_ms, f.build_ms, p.draw_calls,
        p.uploaded_bytes);
}
}
