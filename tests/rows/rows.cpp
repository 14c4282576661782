// SPDX-License-Identifier: MIT
#include "tests/rows/rows.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include <gnomon/scene/primitives.hpp>
#include <gnomon/scene/scene_description.hpp>
#include <gnomon/scene/transforms.hpp>

#include "tests/rows/stage.hpp"

namespace gnomon::test {

namespace {

MeshPointer knot() { return shared(scene::make_torus_knot(1.0F, 0.32F, 2, 3, 96, 16)); }
MeshPointer torus() { return shared(scene::make_torus(1.0F, 0.4F, 40, 20)); }
MeshPointer box(float size) { return shared(scene::make_box(glm::vec3(size))); }

// The same triangles in another order, or only some of them.
template <class Keep>
scene::Mesh with_faces(scene::Mesh mesh, const char* name, Keep keep) {
    std::vector<std::uint32_t> indices;
    for (std::size_t f = 0; f < mesh.indices.size() / 3; ++f)
        keep(f, &mesh.indices[3 * f], indices);
    mesh.indices = std::move(indices);
    mesh.sub_meshes = {{0, static_cast<std::uint32_t>(mesh.indices.size()), 0}};
    mesh.name = name;
    return mesh;
}

MeshPointer open_torus() {
    return shared(
        with_faces(scene::make_torus(1.0F, 0.4F, 40, 20), "open torus",
                   [](std::size_t f, const std::uint32_t* i, std::vector<std::uint32_t>& out) {
                       if (f % 1600 < 1000) out.insert(out.end(), i, i + 3);
                   }));
}

MeshPointer flipped_third_torus() {
    return shared(
        with_faces(scene::make_torus(1.0F, 0.4F, 40, 20), "torus with every third face flipped",
                   [](std::size_t f, const std::uint32_t* i, std::vector<std::uint32_t>& out) {
                       if (f % 3 == 0) {
                           out.insert(out.end(), {i[0], i[2], i[1]});
                       } else {
                           out.insert(out.end(), i, i + 3);
                       }
                   }));
}

MeshPointer inside_out_sphere() {
    return shared(
        with_faces(scene::make_sphere(1.0F, 32, 16), "inside-out sphere",
                   [](std::size_t, const std::uint32_t* i, std::vector<std::uint32_t>& out) {
                       out.insert(out.end(), {i[0], i[2], i[1]});
                   }));
}

// Five pages on one spine.
MeshPointer book() {
    scene::Mesh mesh;
    mesh.name = "book";
    for (int page = 0; page < 5; ++page) {
        const float angle = 0.35F + 0.6F * static_cast<float>(page);
        const glm::vec3 out(std::cos(angle), 0.0F, std::sin(angle));
        const auto base = static_cast<std::uint32_t>(mesh.positions.size());
        const std::array<glm::vec3, 4> corners{glm::vec3(0.0F, 0.0F, 0.0F), out,
                                               out + glm::vec3(0.0F, 1.5F, 0.0F),
                                               glm::vec3(0.0F, 1.5F, 0.0F)};
        for (const glm::vec3& corner : corners) {
            mesh.positions.push_back(corner);
            mesh.normals.emplace_back(-out.z, 0.0F, out.x);
        }
        for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(base + i);
    }
    mesh.sub_meshes = {{0, static_cast<std::uint32_t>(mesh.indices.size()), 0}};
    return shared(std::move(mesh));
}

Setting builtin(const char* name) {
    auto scene = scene::make_builtin_scene(name);
    Stage stage;
    stage.look({0, 2, 6}, {0, 0.5, 0});
    Setting setting = stage.finish();
    setting.scene = std::move(*scene);
    scene::update_world_transforms(setting.scene.registry);
    setting.scene.registry.each<scene::Camera, scene::WorldTransform>(
        [&](scene::Entity, const scene::Camera& camera, const scene::WorldTransform& at) {
            const auto& perspective = std::get<scene::PerspectiveCamera>(camera.projection);
            setting.view.view_from_world = glm::inverse(at.world_from_local);
            setting.view.clip_from_view = shadows::infinite_perspective(
                perspective.fovy_rad, static_cast<double>(row_width) / row_height, 0.01);
        });
    return setting;
}

Setting eye_inside_a_volume() {
    Stage s;
    s.ground();
    s.place(knot(), moved({0, 1.6, 0}));
    s.place(box(4.0F), moved({-1.0, 5.2, 3.0}));  // its volume holds the eye
    s.lamp({-1.2, 9.0, 3.2});
    s.lamp({3.0, 5.0, 2.0});
    s.look({-1.0, 1.5, 4.0}, {0.2, 1.0, 0.0}, 60.0);
    return s.finish();
}

Setting near_plane_cuts_a_volume() {
    Stage s;
    s.ground();
    s.place(knot(), moved({0, 1.6, 0}));
    s.place(box(0.5F), moved({0.45, 2.5, 4.2}) *
                           turned(30, {1, 1, 0}));  // its volume's side crosses the near rectangle
    s.sun({-0.15, -1.0, 0.05});
    s.look({0.2, 1.3, 4.3}, {0.0, 0.9, 0.0}, 55.0, 0.2);
    return s.finish();
}

Setting mirrored_and_sheared() {
    Stage s;
    s.ground();
    s.place(knot(), moved({-1.9, 1.7, 0}) * scaled({-1, 1, 1}));
    glm::dmat4 shear(1.0);
    shear[1][0] = 0.6;
    s.place(knot(), moved({1.9, 1.3, 0}) * shear * scaled({0.7, 0.9, -1.2}));
    s.lamp({0.5, 4.5, 3.0});
    s.look({0, 3.0, 6.5}, {0, 0.9, 0});
    return s.finish();
}

// A wall with things behind it as seen from the sun, one of them flush with its edge, one beyond
// it, and a box with one in it, as seen from the lamp.
Setting casters_behind_others() {
    Stage s;
    s.ground();
    s.place(box(1.0F), moved({0.8, 1.5, 0}) * turned(8, {0, 1, 0}) * scaled({0.15, 3, 4}));
    s.place(knot(), moved({-0.8, 1.0, -0.6}) * scaled(glm::dvec3(0.5)));
    s.place(box(0.6F), moved({-0.2, 0.9, 0.9}) * turned(30, {1, 1, 0}));
    s.place(box(0.5F), moved({-0.6, 0.25, 1.75}) * turned(8, {0, 1, 0}));
    s.place(box(0.8F), moved({-2.4, 1.8, 1.2}));
    s.place(box(1.2F), moved({2.4, 0.6, 1.4}));
    s.place(knot(), moved({2.4, 0.6, 1.4}) * scaled(glm::dvec3(0.3)));
    s.sun({-1.0, -0.7, 0.1});
    s.lamp({3.5, 4.0, 3.0});
    s.look({-3.5, 2.6, 5.0}, {0, 0.8, 0}, 55.0);
    return s.finish();
}

Setting open_meshes() {
    Stage s;
    s.ground();
    s.place(open_torus(), moved({-1.6, 1.6, 0}) * turned(50, {1, 0, 0.4}));
    s.place(book(), moved({1.3, 0.2, 0.3}));
    s.sun({-0.5, -1.0, -0.4});
    s.lamp({3.5, 3.0, 4.0});
    s.look({0, 2.6, 6.0}, {0, 0.9, 0});
    return s.finish();
}

Setting inconsistent_winding() {
    Stage s;
    s.ground();
    s.place(flipped_third_torus(), moved({-1.5, 1.6, 0}) * turned(60, {1, 0, 0.2}));
    s.place(inside_out_sphere(), moved({1.6, 1.2, 0.3}));
    s.lamp({0.4, 4.0, 3.0});
    s.look({0, 2.6, 6.0}, {0, 0.9, 0});
    return s.finish();
}

Setting orthographic_view() {
    Stage s;
    s.ground();
    s.place(knot(), moved({0, 1.8, 0}));
    s.place(box(1.0F), moved({-2.2, 0.8, 0.5}) * turned(35, {0, 1, 0.3}));
    s.sun({-0.6, -1.0, -0.5});
    s.lamp({2.5, 4.0, 2.0});
    s.look_orthographic({4, 5, 8}, {0, 0.8, 0}, 3.2, 0.5, 30.0);
    return s.finish();
}

Setting orthographic_near_plane_in_a_volume() {
    Stage s;
    s.ground();
    s.place(knot(), moved({0, 1.8, 0}));
    s.place(box(1.4F),
            moved({2.0, 3.4, 4.6}) * turned(25, {0, 1, 0.3}));  // nearer than the near plane
    s.sun({-0.45, -0.75, -0.9});
    s.lamp({2.6, 5.0, 6.2});
    s.look_orthographic({4, 5, 8}, {0, 0.8, 0}, 3.2, 5.5, 16.0);
    return s.finish();
}

Setting off_axis_view() {
    Stage s;
    s.ground();
    s.place(torus(), moved({0, 1.5, 0}) * turned(40, {1, 0.2, 0}));
    s.lamp({1.5, 4.0, 2.5});
    s.look({0, 2.4, 5.0}, {0, 0.8, 0});
    s.view().clip_from_view = shadows::infinite_frustum(-0.002, 0.010, -0.007, 0.002, 0.01);
    s.view().view_from_world = shadows::look_at({-1.5, 2.0, 5.0}, {-1.5, 2.0, 0.0}, {0, 1, 0});
    return s.finish();
}

Setting light_in_the_torus_hole() {
    Stage s;
    s.ground();
    s.place(torus(), moved({0, 1.5, 0}) * turned(70, {1, 0.1, 0}));
    s.lamp({0.05, 1.55, 0.02});  // within the bounds, outside the mesh
    s.look({2.0, 2.6, 4.5}, {0, 0.9, 0});
    return s.finish();
}

Setting hidden_caster() {
    Stage s;
    s.ground();
    s.place(torus(), moved({0, 1.5, 0}) * turned(40, {1, 0.2, 0}), true,
            false);  // casts, is not drawn
    s.place(box(1.0F), moved({0.4, 0.5, 0.6}));
    s.lamp({1.5, 4.5, 2.0});
    s.look({0, 2.6, 5.5}, {0, 0.6, 0});
    return s.finish();
}

Setting flat_scale() {
    Stage s;
    s.ground();
    s.place(shared(scene::make_sphere(1.0F, 32, 16)),
            moved({-1.2, 1.6, 0}) * turned(20, {0, 0, 1}) * scaled({1, 0, 1}));
    s.place(torus(), moved({1.4, 1.3, 0}) * turned(70, {1, 0, 0}) * scaled({1, 0, 1}));
    s.lamp({0.4, 4.0, 2.0});
    s.sun({0.3, -1.0, -0.5});
    s.look({0, 2.8, 6.0}, {0, 0.8, 0});
    return s.finish();
}

Setting far_from_the_origin() {
    const glm::dvec3 away(4.0e6, -1.0e6, 2.0e6);
    Stage s;
    s.ground(20.0F, moved(away));
    s.place(knot(), moved(away + glm::dvec3(0, 1.7, 0)) * turned(20, {1, 1, 0}));
    s.lamp(away + glm::dvec3(1.5, 4.5, 2.0));
    s.look(away + glm::dvec3(0, 2.6, 5.5), away + glm::dvec3(0, 0.8, 0));
    return s.finish();
}

Setting wall_of_bricks() {
    Stage s;
    s.ground();
    const MeshPointer brick = shared(scene::make_box(glm::vec3(0.5F, 0.25F, 0.25F)));
    for (int row = 0; row < 10; ++row) {
        for (int column = 0; column < 12; ++column) {
            const double shift = row % 2 == 0 ? 0.0 : 0.25;
            s.place(brick, moved({-3.0 + 0.5 * column + shift, 0.125 + 0.25 * row, 0.0}));
        }
    }
    s.lamp({1.0, 2.0, -2.5});
    s.look({-2.0, 4.0, 6.0}, {0, 0.6, 0.8});
    return s.finish();
}

// A ring high above a box above the ground, and a plate that is not drawn beside it: nothing
// receives on most of the light's way.
Stage far_apart(const glm::dvec3& at = glm::dvec3(0.0)) {
    Stage s;
    s.ground(20.0F, moved(at));
    s.place(torus(), moved(at + glm::dvec3(0, 9.0, 0)) * turned(25, {1, 0, 0.3}));
    s.place(box(0.8F), moved(at + glm::dvec3(0.6, 4.5, 0.2)) * turned(30, {0.2, 1, 0.1}));
    s.place(box(1.5F), moved(at + glm::dvec3(-3.0, 8.0, 0)) * scaled({1, 0.1, 1}), true, false);
    s.place(box(0.6F), moved(at + glm::dvec3(-2.6, 0.3, 0.4)));
    return s;
}

Setting gaps_under_a_sun_and_a_lamp() {
    Stage s = far_apart();
    s.sun({0.1, -1.0, 0.05});
    s.lamp({-1.0, 14.0, 0.5});
    s.look({3.0, 3.0, 11.0}, {-0.5, 3.6, 0});
    return s.finish();
}

Setting eye_in_a_gap() {
    Stage s = far_apart();
    s.sun({0.1, -1.0, 0.05});
    s.lamp({0.2, 14.0, 0.5}, 15.0);
    s.look({0.9, 2.2, 0.9}, {-2.6, 0.3, 0.2}, 80.0);
    return s.finish();
}

Setting gaps_far_from_the_origin() {
    const glm::dvec3 away(-3.0e6, 1.0e6, 2.0e6);
    Stage s = far_apart(away);
    s.sun({0.1, -1.0, 0.05});
    s.look_orthographic(away + glm::dvec3(2.0, 7.0, 9.0), away + glm::dvec3(-0.8, 2.4, 0), 3.6, 0.1,
                        30.0);
    return s.finish();
}

}  // namespace

const std::vector<Row>& rows() {
    static const std::vector<Row> all{
        {"pillars_two_lights", [] { return builtin("pillars"); }},
        {"room_light_inside_closed_mesh", [] { return builtin("room"); }},
        {"still_life_three_lights", [] { return builtin("still-life"); }},
        {"eye_inside_a_volume", eye_inside_a_volume},
        {"near_plane_cuts_a_volume", near_plane_cuts_a_volume},
        {"mirrored_and_sheared", mirrored_and_sheared},
        {"open_meshes", open_meshes},
        {"inconsistent_winding", inconsistent_winding},
        {"casters_behind_others", casters_behind_others},
        {"orthographic", orthographic_view},
        {"orthographic_near_plane_in_a_volume", orthographic_near_plane_in_a_volume},
        {"off_axis", off_axis_view},
        {"light_in_the_torus_hole", light_in_the_torus_hole},
        {"hidden_caster", hidden_caster},
        {"flat_scale", flat_scale},
        {"far_from_the_origin", far_from_the_origin},
        {"wall_of_bricks", wall_of_bricks},
        {"gaps_under_a_sun_and_a_lamp", gaps_under_a_sun_and_a_lamp},
        {"eye_in_a_gap", eye_in_a_gap},
        {"gaps_far_from_the_origin", gaps_far_from_the_origin},
        {"culled_back_faces", eye_inside_a_volume, true},
    };
    return all;
}

}  // namespace gnomon::test
