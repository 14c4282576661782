// SPDX-License-Identifier: MIT
#include <gnomon/render/camera.hpp>

#include <gtest/gtest.h>

namespace gnomon::render {
namespace {

TEST(Camera, framing_holds_every_corner_whatever_the_shape) {
    for (const glm::dvec3 size :
         {glm::dvec3(1, 1, 1), {100, 1, 1}, {1, 100, 1}, {0.001, 0.001, 5}, {1e6, 10, 1e6}}) {
        for (const double aspect : {0.3, 1.0, 2.5}) {
            scene::Bounds bounds;
            bounds.include(glm::dvec3(1e5, -3, 7));
            bounds.include(glm::dvec3(1e5, -3, 7) + size);
            scene::Camera camera;
            camera.projection =
                scene::PerspectiveCamera{.fovy_rad = 0.7, .near_m = 1e-5 * bounds.diagonal()};
            const shadows::View view = make_view(camera, frame_bounds(bounds, 0.7, aspect), aspect);
            for (unsigned i = 0; i < 8; ++i) {
                const glm::dvec3 corner((i & 1U) != 0 ? bounds.max.x : bounds.min.x,
                                        (i & 2U) != 0 ? bounds.max.y : bounds.min.y,
                                        (i & 4U) != 0 ? bounds.max.z : bounds.min.z);
                const glm::dvec4 clip = view.clip_from_world() * glm::dvec4(corner, 1.0);
                EXPECT_GT(clip.w, 0.0);
                EXPECT_LE(std::abs(clip.x), clip.w);
                EXPECT_LE(std::abs(clip.y), clip.w);
            }
        }
    }
}

TEST(Camera, a_scaled_pose_gives_a_rigid_view) {
    glm::dmat4 pose = camera_pose({1, 2, 3}, {0, 0, 0}, {0, 1, 0});
    for (int i = 0; i < 3; ++i) pose[i] *= 5.0;
    const shadows::View view = make_view(scene::Camera{}, pose, 1.0);
    const glm::dmat3 linear(view.view_from_world);
    EXPECT_NEAR(glm::determinant(linear), 1.0, 1e-12);
    EXPECT_NEAR(glm::length(glm::dvec3(view.view_from_world * glm::dvec4(1, 2, 3, 1))), 0.0, 1e-12);
}

TEST(Camera, looking_straight_along_up_has_a_pose_all_the_same) {
    for (const glm::dvec3 target : {glm::dvec3(0, -1, 0), {0, 1, 0}}) {
        const glm::dmat4 pose = camera_pose({0, 0, 0}, target, {0, 1, 0});
        EXPECT_NEAR(glm::determinant(glm::dmat3(pose)), 1.0, 1e-12);
        EXPECT_NEAR(glm::dot(-glm::dvec3(pose[2]), target), 1.0, 1e-12);
    }
}

TEST(Camera, an_orthographic_camera_takes_its_height_from_the_file_and_its_width_from_the_picture) {
    scene::Camera camera;
    camera.projection =
        scene::OrthographicCamera{.half_width_m = 99, .half_height_m = 2, .near_m = 1, .far_m = 9};
    const shadows::View view = make_view(camera, glm::dmat4(1.0), 3.0);
    EXPECT_EQ(view.projection, shadows::ProjectionKind::Orthographic);
    const glm::dvec4 near_corner = view.clip_from_world() * glm::dvec4(6, 2, -1, 1);
    EXPECT_NEAR(near_corner.x, 1.0, 1e-12);
    EXPECT_NEAR(near_corner.y, 1.0, 1e-12);
    EXPECT_NEAR(near_corner.z, 1.0, 1e-12);
    EXPECT_NEAR((view.clip_from_world() * glm::dvec4(0, 0, -9, 1)).z, 0.0, 1e-12);
}

}  // namespace
}  // namespace gnomon::render
