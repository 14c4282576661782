// SPDX-License-Identifier: MIT
#include "scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/scene/primitives.hpp>

namespace gnomon::peers {

namespace {

std::size_t add_mesh(PeerScene& scene, scene::Mesh mesh) {
    scene.meshes.push_back(
        {std::move(mesh.positions), std::move(mesh.normals), std::move(mesh.indices)});
    return scene.meshes.size() - 1;
}

glm::dmat4 at(const glm::dvec3& place, double turn_deg = 0.0, const glm::dvec3& axis = {0, 1, 0}) {
    return glm::rotate(glm::translate(glm::dmat4(1.0), place), glm::radians(turn_deg), axis);
}

// Cells enough for engines that light vertices.
void add_ground(PeerScene& scene, float size) {
    scene.instances.push_back(
        {.mesh = add_mesh(scene, scene::make_plane(size, size, 64)), .casts = false});
}

// About `triangles`, closed: the tube has an eighth of the ring's segments.
scene::Mesh knot(double triangles, float ring_radius, float tube_radius) {
    const auto tube = static_cast<std::uint32_t>(std::sqrt(triangles / 16.0));
    return scene::make_torus_knot(ring_radius, tube_radius, 2, 3, tube * 8, tube);
}

// A thousand to five thousand triangles each.
PeerScene make_crowd() {
    PeerScene scene{.eye = {0.0, 17.0, 36.0}, .target = {0.0, 0.0, 2.0}};
    add_ground(scene, 160.0F);
    const std::array shapes{add_mesh(scene, scene::make_sphere(0.9F, 32, 17)),
                            add_mesh(scene, scene::make_torus(0.8F, 0.3F, 50, 20)),
                            add_mesh(scene, scene::make_torus_knot(0.6F, 0.18F, 2, 3, 100, 15)),
                            add_mesh(scene, scene::make_torus_knot(0.6F, 0.15F, 3, 4, 125, 20))};
    for (std::size_t i = 0; i < 256; ++i) {
        const auto column = static_cast<double>(i % 16);
        const auto row = static_cast<double>(i / 16);
        const glm::dvec3 place(3.0 * column - 22.5, 1.3, 3.0 * row - 22.5);
        scene.instances.push_back({.mesh = shapes[(i + i / 16) % shapes.size()],
                                   .world_from_local = at(place, 37.0 * static_cast<double>(i)),
                                   .moves = i % 8 == 0});
    }
    for (int i = 0; i < 4; ++i) {
        const double turn = glm::radians(90.0 * i + 20.0);
        scene.lights.push_back(
            {.position_world = {14.0 * std::cos(turn), 9.0, 14.0 * std::sin(turn), 1.0},
             .intensity = 120.0});
    }
    return scene;
}

PeerScene make_boxes() {
    PeerScene scene{.eye = {0.0, 18.0, 44.0}, .target = {0.0, 0.0, 4.0}};
    add_ground(scene, 160.0F);
    const std::size_t box = add_mesh(scene, scene::make_box({0.9F, 1.6F, 0.9F}));
    for (std::size_t i = 0; i < 1000; ++i) {
        const auto column = static_cast<double>(i % 40);
        const auto row = static_cast<double>(i / 40);
        scene.instances.push_back(
            {.mesh = box,
             .world_from_local =
                 at({1.8 * column - 35.1, 0.9, 1.8 * row - 21.6}, 23.0 * static_cast<double>(i)),
             .moves = i % 8 == 0});
    }
    scene.lights.push_back({.position_world = {0.6, 0.7, 0.4, 0.0}});
    return scene;
}

PeerScene make_statue(double triangles, double light_step_deg) {
    PeerScene scene{
        .eye = {0.0, 4.2, 8.5}, .target = {0.0, 1.4, 0.0}, .light_step_deg = light_step_deg};
    add_ground(scene, 40.0F);
    scene.instances.push_back({.mesh = add_mesh(scene, knot(triangles, 1.5F, 0.45F)),
                               .world_from_local = at({0.0, 2.2, 0.0}, 70.0, {1, 0, 0}),
                               .moves = true});
    scene.lights.push_back({.position_world = {3.5, 6.0, 2.0, 1.0}, .intensity = 40.0});
    return scene;
}

// The eye is behind bars that cross the line from it to two lamps: it lies within the volumes of
// all of them, and their shadows fall like a star on the wall it looks at.
PeerScene make_room() {
    PeerScene scene{.eye = {0.0, 1.7, 1.0}, .target = {0.0, 1.2, -6.0}};
    scene::Mesh walls = scene::make_box({12.0F, 5.0F, 16.0F});
    for (std::size_t i = 0; i + 2 < walls.indices.size(); i += 3)
        std::swap(walls.indices[i + 1], walls.indices[i + 2]);
    for (glm::vec3& normal : walls.normals) normal = -normal;
    scene.instances.push_back({.mesh = add_mesh(scene, std::move(walls)),
                               .world_from_local = at({0.0, 2.5, 0.0}),
                               .casts = false});
    const std::size_t bar = add_mesh(scene, scene::make_box({2.6F, 0.16F, 0.05F}));
    for (int i = 0; i < 24; ++i) {
        const double z = 2.0 + 0.1 * i;
        scene.instances.push_back({.mesh = bar,
                                   .world_from_local = at({0.0, 1.7, z}, 15.0 * i, {0, 0, 1}),
                                   .moves = i % 8 == 0});
    }
    const std::size_t shape = add_mesh(scene, knot(3000.0, 0.5F, 0.16F));
    for (int i = 0; i < 6; ++i) {
        scene.instances.push_back(
            {.mesh = shape,
             .world_from_local = at({1.5 * i - 3.75, 0.8, -3.0 - 0.5 * (i % 2)}, 60.0 * i),
             .moves = i % 8 == 0});
    }
    scene.lights = {{.position_world = {0.0, 1.75, 6.0, 1.0}, .intensity = 30.0},
                    {.position_world = {0.0, 1.65, 7.0, 1.0}, .intensity = 30.0}};
    // So little that the eye stays within the volumes.
    scene.center = {0.0, 1.7, 5.5};
    scene.light_step_deg = 0.5;
    scene.light_swing_deg = 3.0;
    return scene;
}

struct Known {
    std::string_view name;
    PeerScene (*make)();
};

constexpr std::array<Known, 5> known_scenes{{{"crowd", make_crowd},
                                             {"boxes", make_boxes},
                                             {"knot", [] { return make_statue(100e3, 1.0); }},
                                             {"million", [] { return make_statue(1e6, 0.1); }},
                                             {"room", make_room}}};

}  // namespace

Result<Motion> motion_named(std::string_view name) {
    if (name == "static") return Motion::Static;
    if (name == "light") return Motion::Light;
    if (name == "lights") return Motion::Lights;
    if (name == "casters") return Motion::Casters;
    return fail(
        ErrorCode::InvalidInput,
        fmt::format("\"{}\" is no motion; there are static, light, lights, casters.", name));
}

std::size_t PeerScene::triangle_count() const {
    std::size_t count = 0;
    for (const Instance& instance : instances) count += meshes[instance.mesh].triangle_count();
    return count;
}

std::size_t PeerScene::caster_count() const {
    std::size_t count = 0;
    for (const Instance& instance : instances) count += instance.casts ? 1U : 0U;
    return count;
}

bool PeerScene::casts(std::size_t mesh) const {
    return std::ranges::any_of(instances, [&](const Instance& instance) {
        return instance.mesh == mesh && instance.casts;
    });
}

std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    for (const Known& known : known_scenes) names.emplace_back(known.name);
    return names;
}

Result<PeerScene> make_scene(std::string_view name) {
    for (const Known& known : known_scenes) {
        if (known.name != name) continue;
        PeerScene scene = known.make();
        scene.name = name;
        return scene;
    }
    return fail(ErrorCode::InvalidInput, fmt::format("There is no scene \"{}\"; there are {}.",
                                                     name, fmt::join(scene_names(), ", ")));
}

glm::dmat4 pose_in(const PeerScene& scene, const Instance& instance, Motion motion,
                   std::int64_t frame) {
    if (motion != Motion::Casters || !instance.moves) return instance.world_from_local;
    const double turn = glm::radians(scene.caster_step_deg * static_cast<double>(frame));
    glm::dmat4 pose = glm::rotate(glm::dmat4(1.0), turn, glm::dvec3(0.0, 1.0, 0.0)) *
                      glm::dmat4(glm::dmat3(instance.world_from_local));
    pose[3] = instance.world_from_local[3];
    return pose;
}

glm::dvec4 light_in(const PeerScene& scene, std::size_t light, Motion motion, std::int64_t frame) {
    const glm::dvec4& position = scene.lights[light].position_world;
    if (motion != Motion::Lights && (motion != Motion::Light || light != 0)) return position;
    double turn = glm::radians(scene.light_step_deg * static_cast<double>(frame));
    if (const double swing = glm::radians(scene.light_swing_deg); swing > 0.0)
        turn = swing * std::sin(turn / swing);
    const glm::dvec4 pivot(scene.center * position.w, 0.0);
    return pivot +
           glm::rotate(glm::dmat4(1.0), turn, glm::dvec3(0.0, 1.0, 0.0)) * (position - pivot);
}

}  // namespace gnomon::peers
