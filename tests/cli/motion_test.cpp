// SPDX-License-Identifier: MIT
//
// --animate, and the scene that it moves: absolute, exact at frame 0, the same every time.
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>

#include "motion.hpp"

namespace gnomon::cli {
namespace {

Shot shot_of(const RenderOptions& options) {
    auto shot = make_shot(options);
    if (!shot) throw std::runtime_error(shot.error().message);
    return std::move(*shot);
}

std::vector<glm::dmat4> poses(const Shot& shot) {
    std::vector<glm::dmat4> result;
    shot.scene.registry.each<scene::WorldTransform>(
        [&](scene::Entity, const scene::WorldTransform& t) {
            result.push_back(t.world_from_local);
        });
    result.push_back(shot.world_from_camera);
    return result;
}

std::size_t differing(const std::vector<glm::dmat4>& a, const std::vector<glm::dmat4>& b) {
    EXPECT_EQ(a.size(), b.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i] ? 1U : 0U;
    return count;
}

template <class Tag>
glm::dvec3 place_of_first(const Shot& shot) {
    std::optional<glm::dvec3> place;
    shot.scene.registry.each<Tag, scene::WorldTransform>(
        [&](scene::Entity, const Tag&, const scene::WorldTransform& t) {
            if (!place) place = glm::dvec3(t.world_from_local[3]);
        });
    return place.value();
}

class MotionTest : public testing::TestWithParam<Motion> {};

TEST_P(MotionTest, frame_0_is_the_start_bit_for_bit) {
    Shot shot = shot_of({.scene = "builtin:still-life"});
    const auto start = poses(shot);
    const Animator animator(shot, GetParam());
    ASSERT_TRUE(animator.apply(0, shot));
    EXPECT_EQ(differing(poses(shot), start), 0U);
}

TEST_P(MotionTest, frames_may_be_skipped_and_repeated) {
    Shot stepped = shot_of({.scene = "builtin:still-life"});
    Shot jumped = shot_of({.scene = "builtin:still-life"});
    const Animator a(stepped, GetParam());
    const Animator b(jumped, GetParam());
    for (const std::uint32_t frame : {0U, 1U, 2U, 7U, 5U}) ASSERT_TRUE(a.apply(frame, stepped));
    ASSERT_TRUE(b.apply(5, jumped));
    EXPECT_EQ(differing(poses(stepped), poses(jumped)), 0U);
}

TEST_P(MotionTest, poses_stay_finite) {
    Shot shot = shot_of({.scene = "builtin:still-life"});
    const Animator animator(shot, GetParam());
    ASSERT_TRUE(animator.apply(999'999, shot));
    for (const glm::dmat4& pose : poses(shot)) {
        for (int i = 0; i < 4; ++i) EXPECT_TRUE(std::isfinite(glm::length(pose[i])));
    }
}

std::string motion_name(const testing::TestParamInfo<Motion>& param) {
    static const std::array names{"still", "camera", "light", "light_many_turns", "casters"};
    return names.at(param.index);
}

INSTANTIATE_TEST_SUITE_P(All, MotionTest,
                         testing::Values(Motion{}, Motion{.kind = MotionKind::Camera},
                                         Motion{.kind = MotionKind::Light, .degrees = -12.5},
                                         Motion{.kind = MotionKind::Light, .degrees = 1e300},
                                         Motion{.kind = MotionKind::Casters, .casters = 2}),
                         motion_name);

TEST(MotionOf, casters_turn_where_they_stand_and_only_as_many_as_asked) {
    Shot shot = shot_of({.scene = "builtin:still-life"});
    const auto start = poses(shot);
    for (const std::uint32_t casters : {0U, 1U, 3U}) {
        const Animator animator(shot, {.kind = MotionKind::Casters, .casters = casters});
        ASSERT_TRUE(animator.apply(10, shot));
        const auto moved = poses(shot);
        EXPECT_EQ(differing(moved, start), casters);
        for (std::size_t i = 0; i < start.size(); ++i)
            EXPECT_LT(glm::length(moved[i][3] - start[i][3]), 1e-12);
        ASSERT_TRUE(animator.apply(0, shot));
    }
    const Animator all(shot, {.kind = MotionKind::Casters, .casters = 1000});
    ASSERT_TRUE(all.apply(10, shot));
    EXPECT_EQ(differing(poses(shot), start), shot.scene.registry.count<scene::Caster>());
}

TEST(MotionOf, lights_go_round_the_centre_of_the_scene) {
    Shot shot = shot_of({.scene = "builtin:still-life"});
    const glm::dvec3 before = place_of_first<scene::PointLight>(shot) - shot.bounds.center();
    const Animator animator(shot, {.kind = MotionKind::Light, .degrees = 90.0});
    ASSERT_TRUE(animator.apply(1, shot));
    const glm::dvec3 after = place_of_first<scene::PointLight>(shot) - shot.bounds.center();
    EXPECT_LT(glm::length(after - glm::dvec3(before.z, before.y, -before.x)), 1e-9);
}

TEST(MotionOf, the_camera_goes_round_and_nothing_else) {
    Shot shot = shot_of({.scene = "builtin:still-life"});
    const auto start = poses(shot);
    const glm::dvec3 before = glm::dvec3(shot.world_from_camera[3]) - shot.bounds.center();
    const Animator animator(shot, {.kind = MotionKind::Camera});
    ASSERT_TRUE(animator.apply(180, shot));
    EXPECT_EQ(differing(poses(shot), start), 1U);
    const glm::dvec3 after = glm::dvec3(shot.world_from_camera[3]) - shot.bounds.center();
    EXPECT_LT(glm::length(after - glm::dvec3(-before.x, before.y, -before.z)), 1e-9);
}

TEST(ShotOf, the_near_plane_is_a_part_of_the_diagonal) {
    const Shot shot = shot_of({.scene = "builtin:still-life"});
    EXPECT_DOUBLE_EQ(shot.near_m, 1e-5 * shot.bounds.diagonal());
    EXPECT_DOUBLE_EQ(shot_of({.scene = "builtin:still-life", .near_m = 0.5}).near_m, 0.5);
}

TEST(ShotOf, lights_of_the_command_line_replace_those_of_the_file) {
    const auto lights = [](const Shot& shot) {
        const auto& registry = shot.scene.registry;
        return std::array{registry.count<scene::PointLight>(),
                          registry.count<scene::DirectionalLight>(),
                          registry.count<scene::SpotLight>()};
    };
    EXPECT_EQ(lights(shot_of({.scene = "builtin:still-life"})),
              (std::array<std::size_t, 3>{3, 0, 0}));
    const Shot shot = shot_of({.scene = "builtin:still-life",
                               .lights = {{.directional = true, .value = {0.0, -2.0, 0.0}}}});
    EXPECT_EQ(lights(shot), (std::array<std::size_t, 3>{0, 1, 0}));
    shot.scene.registry.each<scene::DirectionalLight, scene::WorldTransform>(
        [](scene::Entity, const scene::DirectionalLight&, const scene::WorldTransform& t) {
            // A light looks along its own -Z.
            EXPECT_LT(glm::length(glm::dvec3(t.world_from_local[2]) - glm::dvec3(0.0, 1.0, 0.0)),
                      1e-12);
        });
}

TEST(ShotOf, globs_choose_by_name) {
    const auto chosen = [](const std::optional<std::string>& casters,
                           const std::optional<std::string>& receivers) {
        const Shot shot =
            shot_of({.scene = "builtin:room", .casters = casters, .receivers = receivers});
        return std::pair(shot.scene.registry.count<scene::Caster>(),
                         shot.scene.registry.count<scene::Receiver>());
    };
    const auto all = chosen(std::nullopt, std::nullopt);
    EXPECT_EQ(chosen("*", "*"), all);
    EXPECT_EQ(chosen("vase", std::nullopt), std::pair(std::size_t{1}, all.second));
    EXPECT_EQ(chosen(std::nullopt, "*board [12]"), std::pair(all.first, std::size_t{2}));
    EXPECT_EQ(chosen("no such node", "Vase").first, 0U);
    EXPECT_EQ(chosen("no such node", "Vase").second, 0U);
    EXPECT_EQ(chosen("", std::nullopt).first, 0U) << "an empty glob matches no name";
}

}  // namespace
}  // namespace gnomon::cli
