// SPDX-License-Identifier: MIT
#include "view/orbit_camera.hpp"

#include <gtest/gtest.h>

#include <gnomon/render/camera.hpp>

#include <gnomon/panel/picker.hpp>

namespace gnomon::cli {
namespace {

constexpr Canvas plain{.size_px = {800, 600}};
const scene::Bounds box{{-1.0, 0.0, -2.0}, {3.0, 2.0, 4.0}};

OrbitCamera camera_at(const glm::dvec3& eye) {
    return {scene::Camera{}, render::camera_pose(eye, box.center(), {0.0, 1.0, 0.0}), 0.001, box};
}

void expect_rigid(const glm::dmat4& pose) {
    const glm::dmat3 axes(pose);
    const glm::dmat3 product = glm::transpose(axes) * axes;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) EXPECT_NEAR(product[i][j], i == j ? 1.0 : 0.0, 1e-12);
    }
    EXPECT_NEAR(glm::determinant(axes), 1.0, 1e-12);
}

TEST(OrbitCamera, goes_round_the_middle) {
    OrbitCamera camera = camera_at({9.0, 6.0, 11.0});
    const double distance = glm::distance(camera.eye(), box.center());
    for (int i = 0; i < 1000; ++i) camera.orbit(0.07, i % 2 == 0 ? 0.03 : -0.02);
    EXPECT_NEAR(glm::distance(camera.eye(), box.center()), distance, 1e-9);
    EXPECT_NEAR(glm::distance(camera.pivot(), box.center()), 0.0, 1e-9);
    expect_rigid(camera.world_from_camera());
}

TEST(OrbitCamera, stops_before_the_poles_and_stays_upright) {
    OrbitCamera camera = camera_at({9.0, 6.0, 11.0});
    for (int i = 0; i < 100; ++i) camera.orbit(0.0, 0.2);
    EXPECT_LT(glm::dot(camera.forward(), {0.0, 1.0, 0.0}), 1.0);
    EXPECT_GT(camera.world_from_camera()[1].y, 0.0);
    EXPECT_NEAR(camera.world_from_camera()[0].y, 0.0, 1e-9) << "no roll";
    for (int i = 0; i < 100; ++i) camera.orbit(0.0, -0.2);
    EXPECT_GT(camera.world_from_camera()[1].y, 0.0);
    expect_rigid(camera.world_from_camera());
}

TEST(OrbitCamera, what_is_panned_follows_the_mouse) {
    OrbitCamera camera = camera_at({9.0, 6.0, 11.0});
    const auto before = panel::pixel_of(camera.view(plain), box.center(), plain.size_px);
    camera.pan({37.0, -21.0}, plain);
    const auto after = panel::pixel_of(camera.view(plain), box.center(), plain.size_px);
    ASSERT_TRUE(before && after);
    EXPECT_NEAR(after->x - before->x, 37.0, 1e-6);
    EXPECT_NEAR(after->y - before->y, -21.0, 1e-6);
}

TEST(OrbitCamera, zooms_by_a_tenth_a_notch_and_never_arrives) {
    OrbitCamera camera = camera_at({9.0, 6.0, 11.0});
    const double before = glm::distance(camera.eye(), box.center());
    camera.zoom(1.0);
    EXPECT_NEAR(glm::distance(camera.eye(), box.center()), 0.9 * before, 1e-9);
    camera.zoom(-1.0);
    EXPECT_NEAR(glm::distance(camera.eye(), box.center()), before, 1e-9);
    camera.zoom(1000.0);
    EXPECT_GT(glm::distance(camera.eye(), box.center()), 0.0);
    EXPECT_TRUE(panel::pixel_of(camera.view(plain), box.center(), plain.size_px));
}

TEST(OrbitCamera, an_orthographic_picture_stays_one_however_far_one_zooms) {
    scene::Camera lens;
    lens.projection =
        scene::OrthographicCamera{.half_width_m = 4.0, .half_height_m = 3.0, .far_m = 1000.0};
    OrbitCamera camera(lens, render::camera_pose({9.0, 6.0, 11.0}, box.center(), {0.0, 1.0, 0.0}),
                       0.001, box);
    const auto metres_of_60_px = [&] {
        const panel::Ray left =
            panel::ray_through(camera.view(plain), {370.0, 300.0}, plain.size_px);
        const panel::Ray right =
            panel::ray_through(camera.view(plain), {430.0, 300.0}, plain.size_px);
        return glm::distance(left.origin_world, right.origin_world);
    };
    const double before = metres_of_60_px();
    EXPECT_NEAR(before, 0.6, 1e-9);
    for (int i = 0; i < 20; ++i) camera.zoom(1000.0);
    EXPECT_GT(metres_of_60_px(), 1e-5 * before);
    for (int i = 0; i < 20; ++i) camera.zoom(-1000.0);
    EXPECT_GT(metres_of_60_px(), before);
    EXPECT_LT(metres_of_60_px(), 1e5 * before);
    camera.zoom(1.0);
    EXPECT_LT(metres_of_60_px(), 1e5 * before);
}

TEST(OrbitCamera, frames_the_scene_in_what_the_panel_leaves_free) {
    for (const double covered : {0.0, 324.0}) {
        for (const bool orthographic : {false, true}) {
            const Canvas canvas{.size_px = {1280, 720}, .covered_left_px = covered};
            scene::Camera lens;
            if (orthographic) lens.projection = scene::OrthographicCamera{.far_m = 1000.0};
            OrbitCamera camera(lens,
                               render::camera_pose({9.0, 6.0, 11.0}, {0, 0, 0}, {0.0, 1.0, 0.0}),
                               0.001, box);
            camera.frame(box, canvas, false);
            glm::dvec2 min(1e9);
            glm::dvec2 max(-1e9);
            for (unsigned i = 0; i < 8; ++i) {
                const auto pixel = panel::pixel_of(
                    camera.view(canvas),
                    {(i & 1U) != 0 ? box.min.x : box.max.x, (i & 2U) != 0 ? box.min.y : box.max.y,
                     (i & 4U) != 0 ? box.min.z : box.max.z},
                    canvas.size_px);
                ASSERT_TRUE(pixel);
                min = glm::min(min, *pixel);
                max = glm::max(max, *pixel);
            }
            EXPECT_GE(min.x, covered);
            EXPECT_LE(max.x, 1280.0);
            EXPECT_GE(min.y, 0.0);
            EXPECT_LE(max.y, 720.0);
            // and fills it
            EXPECT_GT(std::max((max.x - min.x) / (1280.0 - covered), (max.y - min.y) / 720.0),
                      0.65);
            const auto middle = panel::pixel_of(camera.view(canvas), box.center(), canvas.size_px);
            EXPECT_NEAR(middle->x, (1280.0 + covered) / 2.0 - 0.5, 1e-6);
            EXPECT_NEAR(middle->y, 359.5, 1e-6);
        }
    }
}

}  // namespace
}  // namespace gnomon::cli
