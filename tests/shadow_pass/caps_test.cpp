// SPDX-License-Identifier: MIT
//
// What caps cost: bytes and draw calls, on a device that draws nothing. A mesh's caps are uploaded
// once; a volume's ranges of them are draws, of which there is a bounded number.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <gnomon/gpu/null_backend.hpp>
#include <gnomon/shadow_pass/shadow_pass.hpp>

namespace gnomon::shadow_pass {
namespace {

using shadows::CapOptions;
using shadows::Technique;

// A ball of 2 n^2 quads in two halves, as a cube's sides are, along a Hilbert curve each: so that
// what lies together has numbers that lie together.
glm::uvec2 on_hilbert_curve(std::uint32_t n, std::uint32_t at) {
    glm::uvec2 p(0);
    for (std::uint32_t s = 1; s < n; s *= 2) {
        const std::uint32_t x = 1U & (at / 2);
        const std::uint32_t y = 1U & (at ^ x);
        if (y == 0) {
            if (x == 1) p = glm::uvec2(s - 1) - p;
            std::swap(p.x, p.y);
        }
        p += glm::uvec2(s * x, s * y);
        at /= 4;
    }
    return p;
}

std::shared_ptr<const shadows::ShadowMesh> ball(std::uint32_t n) {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    // Longitude goes round 2 n columns; the poles are rows of vertices at one place each.
    for (std::uint32_t row = 0; row <= n; ++row) {
        for (std::uint32_t column = 0; column < 2 * n; ++column) {
            const double latitude = std::numbers::pi * row / n;
            const double longitude = std::numbers::pi * column / n;
            const bool pole = row == 0 || row == n;
            const double r = pole ? 0.0 : std::sin(latitude);
            positions.emplace_back(r * std::cos(longitude), std::cos(latitude),
                                   r * std::sin(longitude));
        }
    }
    for (std::uint32_t half = 0; half < 2; ++half) {
        for (std::uint32_t at = 0; at < n * n; ++at) {
            const glm::uvec2 p = on_hilbert_curve(n, at);
            const std::uint32_t left = half * n + p.x;
            const std::uint32_t right = (left + 1) % (2 * n);
            const std::uint32_t above = p.y * 2 * n;
            const std::uint32_t below = above + 2 * n;
            if (p.y > 0) {
                indices.insert(indices.end(), {above + left, above + right, below + left});
            }
            if (p.y + 1 < n) {
                indices.insert(indices.end(), {above + right, below + right, below + left});
            }
        }
    }
    return *shadows::ShadowMesh::build(
        {.positions = reinterpret_cast<const std::byte*>(positions.data()),
         .vertex_count = positions.size(),
         .indices = indices});
}

shadows::View view_of_all() {
    shadows::View view;
    view.view_from_world = shadows::look_at({0, 1, 6}, {0, 0, 0}, {0, 1, 0});
    view.clip_from_view = shadows::infinite_perspective(0.8, 1.5, 0.01);
    return view;
}

// One caster and one light, and what a pass of it costs.
class Scene {
public:
    Scene(std::shared_ptr<const shadows::ShadowMesh> mesh, const CapOptions& caps,
          Technique technique = Technique::DepthFail, const ShadowPassDesc& desc = {})
        : mesh_(std::move(mesh)),
          system_(*shadows::ShadowSystem::create(
              {.force_technique = technique, .caps = caps, .fill = shadows::FillOptions::none()})),
          device_(gpu::create_null_backend()),
          pass_(*ShadowPass::create(device_, desc)) {}

    const PassStats& frame(double angle, bool present = true) {
        auto frame = system_.begin_frame();
        if (present) frame.caster({.key = 1, .mesh = mesh_});
        frame.light(
            {.key = 1, .position_world = {3.0 * std::cos(angle), 2.0, 3.0 * std::sin(angle), 1.0}});
        // The camera never rests: for the same list and view the pass would do nothing.
        view_.view_from_world[3].x += 1e-6;
        list_ = std::move(frame).finish(view_);
        EXPECT_TRUE(pass_.prepare(list_, view_));
        return pass_.stats();
    }
    [[nodiscard]] const shadows::Volume& volume() const { return *list_.draws[0].volume; }
    [[nodiscard]] const shadows::ShadowMesh& mesh() const { return *mesh_; }

private:
    std::shared_ptr<const shadows::ShadowMesh> mesh_;
    shadows::View view_ = view_of_all();
    shadows::ShadowSystem system_;
    gpu::Device device_;
    ShadowPass pass_;
    shadows::DrawList list_;
};

constexpr std::uint64_t matrices = 148;

TEST(Caps, of_a_mesh_are_uploaded_once) {
    Scene scene(ball(32), {.draw_worth_faces = 64});
    const std::uint64_t of_mesh = scene.mesh().faces().size() * 12;
    const std::uint64_t vertices = scene.mesh().positions().size() * 24;
    const std::uint64_t first = scene.frame(0.1).uploaded_bytes;
    EXPECT_EQ(first, matrices + vertices + of_mesh + scene.volume().indices.size() * 4);
    EXPECT_GT(scene.volume().ranges.size(), 2U);
    EXPECT_EQ(scene.frame(0.1).uploaded_bytes, matrices);
    const PassStats& turned = scene.frame(0.4);
    EXPECT_EQ(turned.uploaded_bytes, matrices + scene.volume().indices.size() * 4);
    EXPECT_EQ(turned.index_bytes_held, of_mesh + scene.volume().indices.size() * 4);
}

TEST(Caps, of_a_mesh_are_freed_when_it_has_been_gone_for_a_while) {
    Scene scene(ball(32), {.draw_worth_faces = 64});
    scene.frame(0.1);
    const std::uint64_t of_mesh = scene.mesh().faces().size() * 12;
    EXPECT_EQ(scene.frame(0.1, false).index_bytes_held, of_mesh) << "it may come back";
    for (int i = 0; i < 301; ++i) scene.frame(0.1, false);
    EXPECT_EQ(scene.frame(0.1, false).index_bytes_held, 0U);
    EXPECT_GT(scene.frame(0.1).uploaded_bytes, of_mesh);
}

TEST(Caps, of_a_mesh_wait_until_a_volume_draws_them) {
    const auto mesh = ball(32);
    const std::uint64_t of_mesh = mesh->faces().size() * 12;
    Scene sides(mesh, {.draw_worth_faces = 64}, Technique::DepthPass);
    EXPECT_LT(sides.frame(0.1).index_bytes_held, of_mesh);
    Scene parts(mesh, {.draw_worth_faces = 64}, Technique::DepthPass, {.cap_parts = true});
    EXPECT_GT(parts.frame(0.1).index_bytes_held, of_mesh) << "a debug view may want them";
}

TEST(Caps, take_a_bounded_number_of_draws) {
    const auto mesh = ball(64);
    for (const std::uint32_t most : {0U, 1U, 5U, 40U}) {
        Scene scene(mesh, {.draw_worth_faces = 1, .max_ranges = most});
        const PassStats& stats = scene.frame(0.1);
        EXPECT_LE(scene.volume().ranges.size(), most);
        EXPECT_GE(2 * scene.volume().ranges.size(), most);
        // Sides with near caps, what is undone, and the far caps of both; near and far of ranges.
        EXPECT_LE(stats.draw_calls, 4U + 2U * scene.volume().ranges.size());
        EXPECT_GE(stats.draw_calls, 1U + 2U * scene.volume().ranges.size());
    }
    Scene plain(mesh, CapOptions::plain());
    EXPECT_EQ(plain.frame(0.1).draw_calls, 1U);
}

// Of a million triangles. The bounds are what this order of faces allows; the mesh's own caps and
// vertices came with the first frame.
TEST(Caps, of_a_million_triangles_upload_kilobytes) {
    const auto mesh = ball(512);
    ASSERT_GT(mesh->faces().size(), 1'000'000U);
    std::array<std::uint64_t, 2> bytes{};
    std::size_t which = 0;
    for (const CapOptions& caps : {CapOptions::plain(), CapOptions{}}) {
        Scene scene(mesh, caps);
        scene.frame(0.1);
        const PassStats& stats = scene.frame(0.4);
        bytes[which++] = stats.uploaded_bytes;
        std::printf(
            "%zu triangles, %u cast, %u silhouette edges, %zu ranges: %.0f kB in %llu "
            "draws\n",
            mesh->faces().size(), scene.volume().cap_faces(), scene.volume().silhouette_edges,
            scene.volume().ranges.size(), static_cast<double>(stats.uploaded_bytes) / 1000.0,
            static_cast<unsigned long long>(stats.draw_calls));
    }
    EXPECT_GT(bytes[0], 9'000'000U) << "written out";
    EXPECT_LT(bytes[1], 300'000U);
}

}  // namespace
}  // namespace gnomon::shadow_pass
