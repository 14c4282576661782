// SPDX-License-Identifier: MIT
//
// A square caster, a sun, an eye in the plane of one of the volume's sides.
#include "internal/edge_on.hpp"

#include <utility>

#include <gtest/gtest.h>

namespace gnomon::report::internal {
namespace {

class EdgeOn : public ::testing::Test {
protected:
    // A square about the origin, the sun straight above: its sides stand upright at x = -1, 1 and
    // z = -1, 1.
    EdgeOn() {
        static const glm::vec3 corners[]{{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
        static const std::uint32_t indices[]{0, 3, 2, 0, 2, 1};
        auto mesh =
            shadows::ShadowMesh::build({.positions = reinterpret_cast<const std::byte*>(corners),
                                        .vertex_count = 4,
                                        .indices = indices});
        caster_.mesh = std::move(*mesh);
        caster_.key = 1;
    }
    // Asked where the place (x, y, 1) of the world is seen from `eye`.
    bool asked_at(const glm::dvec3& eye, const glm::dvec3& place, std::uint64_t light = 7) {
        auto frame = system_.begin_frame();
        frame.caster(caster_);
        frame.light({.key = 7, .position_world = {0.0, 1.0, 0.0, 0.0}});
        // The picture's middle column, whose middle is the view's own axis, looks straight on.
        const shadows::View view{shadows::look_at(eye, eye - glm::dvec3(0, 0, 1), {0.0, 1.0, 0.0}),
                                 shadows::infinite_perspective(1.0, 1.0, 0.1)};
        const shadows::DrawList& list = std::move(frame).finish(view);
        const glm::dvec4 clip = view.clip_from_world() * glm::dvec4(place, 1.0);
        const PictureSize size{101, 101};
        const Pixel pixel{static_cast<std::uint32_t>((clip.x / clip.w + 1.0) * 0.5 * 101.0),
                          static_cast<std::uint32_t>((1.0 - clip.y / clip.w) * 0.5 * 101.0)};
        return is_on_a_side_seen_edge_on(list, light, view, size, pixel);
    }
    shadows::Caster caster_;
    shadows::ShadowSystem system_ =
        std::move(shadows::ShadowSystem::create({.fill = shadows::FillOptions::none()})).value();
};

TEST_F(EdgeOn, IsFoundFromWithinTheSidesPlane) {
    // The side at x = 1 is seen as the middle column.
    EXPECT_TRUE(asked_at({1.0, -3.0, 10.0}, {1.0, -4.0, 0.0}));
    // Another light has no such side.
    EXPECT_FALSE(asked_at({1.0, -3.0, 10.0}, {1.0, -4.0, 0.0}, 8));
}

TEST_F(EdgeOn, IsNotFoundBesideIt) {
    EXPECT_FALSE(asked_at({1.0, -3.0, 10.0}, {1.3, -4.0, 0.0}));  // some pixels to the right
    EXPECT_FALSE(asked_at({1.05, -3.0, 10.0}, {1.05, -4.0, 0.0}));
    EXPECT_FALSE(asked_at({0.0, -3.0, 10.0}, {0.0, -4.0, 0.0}));  // amid a side seen broadly
}

}  // namespace
}  // namespace gnomon::report::internal
