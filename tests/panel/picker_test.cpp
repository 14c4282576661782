// SPDX-License-Identifier: MIT
#include <gnomon/panel/picker.hpp>

#include <gtest/gtest.h>

#include <gnomon/render/camera.hpp>
#include <gnomon/scene/primitives.hpp>
#include <gnomon/scene/transforms.hpp>

#include <glm/gtc/matrix_transform.hpp>

namespace gnomon::panel {
namespace {

constexpr glm::uvec2 size{640, 480};

class Picking : public testing::Test {
protected:
    scene::Entity add(scene::Mesh mesh, const scene::LocalTransform& local) {
        const scene::Entity node = scene.create_node("node", local);
        scene.registry.emplace<scene::MeshInstance>(
            node, std::make_shared<const scene::Mesh>(std::move(mesh)));
        scene.registry.emplace<scene::Receiver>(node);
        scene::update_world_transforms(scene.registry);
        return node;
    }
    scene::Scene scene;
    Picker picker;
};

TEST(Ray, through_a_pixel_comes_back_to_it) {
    for (const bool orthographic : {false, true}) {
        scene::Camera camera;
        if (orthographic) camera.projection = scene::OrthographicCamera{2.0, 2.0, -5.0, 50.0};
        shadows::View view = render::make_view(
            camera, render::camera_pose({3.0, 2.0, 5.0}, {0.0, 0.5, 0.0}, {0.0, 1.0, 0.0}),
            4.0 / 3.0);
        // Off the middle, as beside a panel.
        view.clip_from_view =
            glm::translate(glm::dmat4(1.0), glm::dvec3(0.25, 0.0, 0.0)) * view.clip_from_view;
        for (const glm::dvec2 pixel :
             {glm::dvec2(0.0, 0.0), glm::dvec2(320.5, 17.25), glm::dvec2(639.0, 479.0)}) {
            const Ray ray = ray_through(view, pixel, size);
            EXPECT_NEAR(glm::length(ray.direction_world), 1.0, 1e-12);
            for (const double t : {0.5, 7.0}) {
                const auto back = pixel_of(view, ray.origin_world + ray.direction_world * t, size);
                ASSERT_TRUE(back);
                EXPECT_NEAR(back->x, pixel.x, 1e-6);
                EXPECT_NEAR(back->y, pixel.y, 1e-6);
            }
            EXPECT_FALSE(pixel_of(view, ray.origin_world - ray.direction_world * 0.1, size));
        }
    }
}

// Where a ray runs within the plane of a box's side, parallel to others: a corner's edge is hit.
TEST_F(Picking, finds_what_a_ray_grazes_along_either_side) {
    const scene::Entity square = add(scene::make_plane(2.0F, 2.0F), {});
    for (const double x : {-1.0, 1.0}) {
        for (const double z : {-1.0, 1.0}) {
            const auto hit = picker.pick(scene, {{x, 2.0, z}, {0.0, -1.0, 0.0}});
            ASSERT_TRUE(hit) << x << ' ' << z;
            EXPECT_EQ(hit->entity, square);
            EXPECT_DOUBLE_EQ(hit->distance_m, 2.0);
        }
    }
    EXPECT_FALSE(picker.pick(scene, {{1.0 + 1e-9, 2.0, 0.0}, {0.0, -1.0, 0.0}}));
}

TEST_F(Picking, finds_the_nearest_whatever_its_pose) {
    add(scene::make_plane(20.0F, 20.0F), {});
    const scene::Entity near = add(scene::make_box({1.0F, 1.0F, 1.0F}),
                                   {.translation = {0.0, 3.0, 0.0},
                                    .rotation = glm::angleAxis(0.4, glm::dvec3(0, 1, 0)),
                                    .scale = {-2.0, 0.5, 1.0}});
    const Ray down{{0.1, 10.0, 0.05}, {0.0, -1.0, 0.0}};
    const auto hit = picker.pick(scene, down);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->entity, near);
    EXPECT_NEAR(hit->point_world.y, 3.25, 1e-9);
    EXPECT_NEAR(hit->distance_m, 6.75, 1e-9);
    EXPECT_NEAR(hit->normal_world.y, 1.0, 1e-9);
    // From below its other side, towards the ray.
    const auto below = picker.pick(scene, {{0.1, 1.0, 0.05}, {0.0, 1.0, 0.0}});
    ASSERT_TRUE(below);
    EXPECT_NEAR(below->point_world.y, 2.75, 1e-9);
    EXPECT_NEAR(below->normal_world.y, -1.0, 1e-9);
    EXPECT_FALSE(picker.pick(scene, {{0.0, 10.0, 0.0}, {0.0, 1.0, 0.0}}));
}

TEST_F(Picking, follows_what_moves_and_skips_what_has_no_inverse) {
    const scene::Entity box = add(scene::make_box({1.0F, 1.0F, 1.0F}), {});
    add(scene::make_box({4.0F, 4.0F, 4.0F}), {.scale = {1.0, 0.0, 1.0}});
    const Ray down{{0.0, 10.0, 0.0}, {0.0, -1.0, 0.0}};
    EXPECT_NEAR(picker.pick(scene, down)->distance_m, 9.5, 1e-9);
    scene.registry.get<scene::LocalTransform>(box).translation.y = 4.0;
    scene::update_world_transforms(scene.registry);
    EXPECT_NEAR(picker.pick(scene, down)->distance_m, 5.5, 1e-9);
    scene.registry.get<scene::LocalTransform>(box).translation.x = 4.0;
    scene::update_world_transforms(scene.registry);
    EXPECT_FALSE(picker.pick(scene, down));
}

TEST_F(Picking, what_is_not_drawn_is_not_there) {
    const scene::Entity box = add(scene::make_box({1.0F, 1.0F, 1.0F}), {});
    scene.registry.remove<scene::Receiver>(box);
    EXPECT_FALSE(picker.pick(scene, {{0.0, 10.0, 0.0}, {0.0, -1.0, 0.0}}));
}

}  // namespace
}  // namespace gnomon::panel
