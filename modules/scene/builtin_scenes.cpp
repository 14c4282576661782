// SPDX-License-Identifier: MIT
//
// The scenes that need no file: for demonstrations, pictures and tests. Materials are warm and
// dull, so that shadows are what one looks at.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include <gnomon/scene/deform.hpp>
#include <gnomon/scene/primitives.hpp>
#include <gnomon/scene/scene_description.hpp>
#include <gnomon/scene/transforms.hpp>

#include "internal/compose.hpp"
#include "internal/walker.hpp"

namespace gnomon::scene {
namespace {

using internal::add_instance;
using internal::DrawnAs;
using internal::turned_deg;

std::uint32_t paint(Scene& scene, const char* name, const glm::vec3& color, float roughness = 0.85F,
                    float metallic = 0.0F) {
    Material material;
    material.name = name;
    material.base_color = glm::vec4(color, 1.0F);
    material.roughness = roughness;
    material.metallic = metallic;
    return internal::add_material(scene, material);
}

std::uint32_t paint_two_sided(Scene& scene, const char* name, const glm::vec3& color) {
    const std::uint32_t material = paint(scene, name, color);
    scene.materials[material].double_sided = true;
    return material;
}

constexpr glm::vec3 sand{0.60F, 0.54F, 0.45F};
constexpr glm::vec3 limestone{0.74F, 0.69F, 0.60F};
constexpr glm::vec3 terracotta{0.60F, 0.26F, 0.15F};
constexpr glm::vec3 brass{0.72F, 0.50F, 0.20F};
constexpr glm::vec3 oak{0.42F, 0.27F, 0.15F};
constexpr glm::vec3 plaster{0.80F, 0.75F, 0.67F};
constexpr glm::vec3 slate{0.22F, 0.29F, 0.34F};
constexpr glm::vec3 olive{0.33F, 0.35F, 0.18F};

constexpr glm::vec3 warm_light{1.0F, 0.82F, 0.60F};
constexpr glm::vec3 cool_light{0.62F, 0.76F, 1.0F};
constexpr glm::vec3 rose_light{1.0F, 0.62F, 0.55F};
constexpr glm::vec3 evening_sun{1.0F, 0.90F, 0.76F};

/// A receiver that casts nothing: there is nothing below it.
void add_ground(Scene& scene, float size, const glm::vec3& color = sand) {
    const std::uint32_t material = paint(scene, "ground", color, 0.95F);
    add_instance(scene, "ground",
                 std::make_shared<const Mesh>(make_plane(size, size, 16, material)), {},
                 std::nullopt, DrawnAs{false, true});
}

std::shared_ptr<const Mesh> share(Mesh mesh) {
    return std::make_shared<const Mesh>(std::move(mesh));
}

LocalTransform at(const glm::dvec3& translation, const glm::dvec3& rotation_deg = glm::dvec3(0.0),
                  const glm::dvec3& scale = glm::dvec3(1.0)) {
    return {translation, turned_deg(rotation_deg), scale, std::nullopt};
}

void add_point_light(Scene& scene, const char* name, const glm::dvec3& position,
                     const glm::vec3& color, float candela) {
    const Entity entity = scene.create_node(name, at(position));
    scene.registry.emplace<PointLight>(entity, color, candela);
}

void add_camera(Scene& scene, const glm::dvec3& eye, const glm::dvec3& target, double fovy_deg) {
    const Entity entity = scene.create_node("camera", internal::looking_along(eye, target - eye));
    scene.registry.emplace<Camera>(entity, PerspectiveCamera{glm::radians(fovy_deg), 0.02});
}

Scene make_pillars() {
    Scene scene;
    add_camera(scene, {8.6, 4.3, 10.4}, {-0.3, 1.35, -0.2}, 38.0);
    add_ground(scene, 60.0F);
    const std::uint32_t stone = paint(scene, "limestone", limestone);
    const auto shaft = share(make_cylinder(0.32F, 3.0F, 40, stone));
    const auto slab = share(make_box({0.95F, 0.22F, 0.95F}, stone));
    constexpr int columns = 10;
    for (int i = 0; i < columns; ++i) {
        // Turned so that the camera looks between two of them.
        const double angle = 2.0 * std::numbers::pi * (i + 0.9) / columns;
        const Entity column = scene.create_node(
            fmt::format("column {}", i + 1), at({5.0 * std::cos(angle), 0.0, 5.0 * std::sin(angle)},
                                                {0.0, -glm::degrees(angle), 0.0}));
        add_instance(scene, fmt::format("base {}", i + 1), slab, at({0.0, 0.11, 0.0}), column);
        add_instance(scene, fmt::format("shaft {}", i + 1), shaft, at({0.0, 1.72, 0.0}), column);
        add_instance(scene, fmt::format("capital {}", i + 1), slab, at({0.0, 3.33, 0.0}), column);
    }
    add_instance(scene, "pedestal", share(make_cylinder(1.1F, 0.5F, 64, stone)),
                 at({0.0, 0.25, 0.0}));
    const std::uint32_t metal = paint(scene, "brass", brass, 0.45F, 0.3F);
    add_instance(scene, "knot", share(make_torus_knot(0.85F, 0.24F, 2, 3, 288, 28, metal)),
                 at({0.0, 2.05, 0.0}, {90.0, 0.0, 20.0}));
    const Entity sun =
        scene.create_node("sun", internal::looking_along(glm::dvec3(0.0), {0.86, -0.44, -0.35}));
    scene.registry.emplace<DirectionalLight>(sun, evening_sun, 2.6F);
    add_point_light(scene, "lantern", {1.9, 3.1, 2.1}, warm_light, 20.0F);
    return scene;
}

Scene make_knot() {
    Scene scene;
    add_camera(scene, {3.2, 4.4, 4.5}, {-0.15, 1.08, 0.0}, 36.0);
    add_ground(scene, 36.0F, {0.30F, 0.30F, 0.25F});
    const std::uint32_t material = paint(scene, "terracotta", terracotta, 0.6F);
    add_instance(scene, "knot", share(make_torus_knot(0.9F, 0.24F, 2, 3, 320, 32, material)),
                 at({0.0, 1.5, 0.0}, {68.0, 0.0, 0.0}));
    add_point_light(scene, "lamp", {1.7, 4.6, 1.3}, warm_light, 52.0F);
    return scene;
}

/// Faces the other way: a room is a box seen from inside.
Mesh turned_inside_out(Mesh mesh) {
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    }
    for (glm::vec3& normal : mesh.normals) normal = -normal;
    return mesh;
}

/// Boxes that make one piece of furniture, below one node.
class Furniture {
public:
    Furniture(Scene& scene, const std::string& name, const LocalTransform& local,
              std::uint32_t material)
        : scene_(scene), name_(name), node_(scene.create_node(name, local)), material_(material) {}

    void box(const char* part, const glm::vec3& size, const glm::dvec3& center) {
        add_instance(scene_, name_ + " " + part, share(make_box(size, material_)), at(center),
                     node_);
    }
    void legs(const glm::vec3& leg, double half_x, double half_z) {
        const auto mesh = share(make_box(leg, material_));
        int number = 0;
        for (const double x : {-half_x, half_x}) {
            for (const double z : {-half_z, half_z}) {
                add_instance(scene_, fmt::format("{} leg {}", name_, ++number), mesh,
                             at({x, leg.y * 0.5, z}), node_);
            }
        }
    }

private:
    Scene& scene_;
    std::string name_;
    Entity node_;
    std::uint32_t material_;
};

void add_chair(Scene& scene, const std::string& name, const LocalTransform& local,
               std::uint32_t material) {
    Furniture chair(scene, name, local, material);
    chair.box("seat", {0.46F, 0.05F, 0.46F}, {0.0, 0.455, 0.0});
    chair.legs({0.045F, 0.43F, 0.045F}, 0.19, 0.19);
    chair.box("left post", {0.045F, 0.5F, 0.035F}, {-0.19, 0.73, 0.205});
    chair.box("right post", {0.045F, 0.5F, 0.035F}, {0.19, 0.73, 0.205});
    for (int i = 0; i < 3; ++i) {
        const std::string rail = fmt::format("rail {}", i + 1);
        chair.box(rail.c_str(), {0.335F, 0.06F, 0.02F}, {0.0, 0.62 + 0.15 * i, 0.205});
    }
}

Scene make_room() {
    Scene scene;
    add_camera(scene, {2.65, 1.85, 2.15}, {-0.55, 0.72, -0.45}, 58.0);
    const std::uint32_t wall = paint(scene, "plaster", plaster, 0.95F);
    const std::uint32_t wood = paint(scene, "oak", oak, 0.6F);
    const std::uint32_t dark = paint(scene, "slate", slate, 0.7F);
    const std::uint32_t clay = paint(scene, "terracotta", terracotta, 0.7F);
    add_instance(scene, "walls", share(turned_inside_out(make_box({6.4F, 2.8F, 5.2F}, wall))),
                 at({0.0, 1.4, 0.0}));

    Furniture table(scene, "table", at({0.0, 0.0, 0.0}, {0.0, 14.0, 0.0}), wood);
    table.box("top", {1.7F, 0.05F, 0.95F}, {0.0, 0.745, 0.0});
    table.legs({0.07F, 0.72F, 0.07F}, 0.76, 0.39);

    add_chair(scene, "chair 1", at({-0.25, 0.0, 0.92}, {0.0, 22.0, 0.0}), dark);
    add_chair(scene, "chair 2", at({0.35, 0.0, -0.95}, {0.0, 196.0, 0.0}), dark);
    add_chair(scene, "chair 3", at({1.45, 0.0, -0.35}, {0.0, 96.0, 0.0}), dark);
    add_chair(scene, "chair 4", at({-1.65, 0.0, 0.55}, {0.0, -58.0, 0.0}), dark);

    add_instance(scene, "vase", share(make_cylinder(0.07F, 0.28F, 32, clay)),
                 at({-0.30, 0.91, -0.05}));
    add_instance(scene, "fruit", share(make_sphere(0.075F, 32, 16, clay)), at({0.28, 0.845, 0.12}));

    Furniture shelf(scene, "shelf", at({-1.2, 0.0, -2.42}), wood);
    shelf.box("left side", {0.04F, 1.7F, 0.3F}, {-0.7, 0.85, 0.0});
    shelf.box("right side", {0.04F, 1.7F, 0.3F}, {0.7, 0.85, 0.0});
    for (int i = 0; i < 4; ++i) {
        const std::string board = fmt::format("board {}", i + 1);
        shelf.box(board.c_str(), {1.36F, 0.035F, 0.28F}, {0.0, 0.12 + 0.5 * i, 0.0});
    }
    add_instance(scene, "shade", share(make_cylinder(0.24F, 0.02F, 48, dark)),
                 at({0.25, 2.56, 0.15}));
    add_point_light(scene, "lamp", {0.25, 2.42, 0.15}, warm_light, 13.0F);
    return scene;
}

Scene make_still_life() {
    Scene scene;
    add_camera(scene, {1.0, 3.0, 3.8}, {0.02, 0.3, -0.12}, 34.0);
    const std::uint32_t board = paint(scene, "slate", slate, 0.9F);
    const std::uint32_t red = paint(scene, "terracotta", terracotta, 0.6F);
    const std::uint32_t stone = paint(scene, "limestone", limestone);
    const std::uint32_t metal = paint(scene, "brass", brass, 0.4F, 0.3F);
    const std::uint32_t green = paint(scene, "olive", olive);
    add_instance(scene, "table", share(make_box({18.0F, 0.2F, 18.0F}, board)),
                 at({0.0, -0.1, 0.0}));
    add_instance(scene, "sphere", share(make_sphere(0.45F, 96, 48, red)), at({-0.75, 0.45, 0.25}));
    add_instance(scene, "box", share(make_box({0.7F, 1.0F, 0.7F}, stone)),
                 at({0.15, 0.5, -0.65}, {0.0, 28.0, 0.0}));
    add_instance(scene, "torus", share(make_torus(0.42F, 0.13F, 96, 32, metal)),
                 at({0.62, 0.13, 0.55}));
    add_instance(scene, "cylinder", share(make_cylinder(0.22F, 1.3F, 64, green)),
                 at({-0.45, 0.65, -0.95}));
    add_point_light(scene, "key", {-2.9, 2.9, 1.5}, warm_light, 34.0F);
    add_point_light(scene, "fill", {3.4, 2.4, 2.2}, cool_light, 9.0F);
    add_point_light(scene, "rim", {1.3, 2.6, -3.4}, rose_light, 12.0F);
    return scene;
}

/// Only the triangles that are wanted, by their centre and number: opens a closed shape.
template <class Wanted>
Mesh keep_triangles(Mesh mesh, const Wanted& wanted) {
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const std::array<std::uint32_t, 3> corners{mesh.indices[i], mesh.indices[i + 1],
                                                   mesh.indices[i + 2]};
        const glm::vec3 sum =
            mesh.positions[corners[0]] + mesh.positions[corners[1]] + mesh.positions[corners[2]];
        if (wanted(sum / 3.0F, i / 3)) kept.insert(kept.end(), corners.begin(), corners.end());
    }
    mesh.indices = std::move(kept);
    mesh.sub_meshes.front().index_count = static_cast<std::uint32_t>(mesh.indices.size());
    return mesh;
}

/// A ball with slits from near one pole to near the other, and a hole at the bottom.
Mesh make_lantern(float radius, int slits, std::uint32_t material) {
    return keep_triangles(make_sphere(radius, 96, 48, material), [&](const glm::vec3& center,
                                                                     std::size_t) {
        const float turn = std::atan2(center.z, center.x) / (2.0F * std::numbers::pi_v<float>)+1.0F;
        const float place = turn * static_cast<float>(slits);
        const bool in_slit = place - std::floor(place) < 0.5F;
        const bool between_poles = std::abs(center.y) < 0.72F * radius;
        return !(in_slit && between_poles) && center.y > -0.93F * radius;
    });
}

Scene make_open_shapes() {
    Scene scene;
    add_camera(scene, {2.2, 3.75, 4.6}, {0.1, 0.42, 0.0}, 36.0);
    add_ground(scene, 27.0F, {0.24F, 0.20F, 0.165F});
    const std::uint32_t clay = paint_two_sided(scene, "terracotta", terracotta);
    const std::uint32_t paper = paint_two_sided(scene, "plaster", plaster);
    const std::uint32_t metal = paint_two_sided(scene, "brass", brass);
    const std::uint32_t stone = paint_two_sided(scene, "slate", slate);

    // The lamp is inside: the slits are drawn on everything round it.
    add_instance(scene, "lantern", share(make_lantern(0.55F, 12, metal)), at({-0.1, 0.95, 0.1}));
    add_point_light(scene, "lamp", {-0.1, 0.95, 0.1}, warm_light, 31.0F);

    const Mesh bowl =
        keep_triangles(make_sphere(0.5F, 64, 32, clay),
                       [](const glm::vec3& center, std::size_t) { return center.y < 0.0F; });
    add_instance(scene, "bowl", share(bowl), at({-1.35, 0.5, 1.0}, {14.0, 0.0, -10.0}));

    // A folding screen.
    const auto sheet = share(make_plane(0.72F, 1.5F, 4, paper));
    for (int i = 0; i < 5; ++i) {
        const double fold = i % 2 == 0 ? 32.0 : -32.0;
        add_instance(scene, fmt::format("sheet {}", i + 1), sheet,
                     at({-1.7 + 0.61 * i, 0.75, -1.75}, {90.0, fold, 0.0}));
    }
    const Mesh arch = keep_triangles(
        make_cylinder(0.5F, 0.9F, 64, stone), [](const glm::vec3& center, std::size_t) {
            const bool is_side = glm::length(glm::vec2(center.x, center.z)) > 0.45F;
            return is_side && center.z < 0.0F && std::abs(center.y) < 0.44F;
        });
    add_instance(scene, "arch", share(arch), at({0.75, 0.0, 1.35}, {90.0, 0.0, 20.0}));

    // Half a tube, and its mirror image: the same mesh, seen through a negative scale.
    const auto hook = share(
        keep_triangles(make_torus(0.42F, 0.11F, 96, 32, clay),
                       [](const glm::vec3& center, std::size_t) { return center.x > -0.08F; }));
    add_instance(scene, "hook", hook, at({1.65, 0.0, 0.35}, {-90.0, 0.0, 90.0}));
    add_instance(scene, "mirrored hook", hook,
                 at({1.85, 0.0, -0.55}, {-90.0, 0.0, -90.0}, {-1.0, 1.0, 1.0}));
    const Entity sky =
        scene.create_node("sky", internal::looking_along(glm::dvec3(0.0), {0.62, -0.74, -0.30}));
    scene.registry.emplace<DirectionalLight>(sky, cool_light, 0.9F);
    return scene;
}

/// One walker, five times, as a camera with an open shutter and a flash would see it: from one to
/// the next it does a cycle and a fifth. The shadows run over the ground and up a wall.
Scene make_walk() {
    Scene scene;
    add_camera(scene, {-0.55, 2.7, 9.6}, {0.2, 0.86, -0.6}, 18.5);
    add_ground(scene, 60.0F, {0.33F, 0.27F, 0.21F});
    const std::uint32_t stone = paint(scene, "sandstone", {0.64F, 0.50F, 0.36F}, 0.95F);
    add_instance(scene, "wall", share(make_box({40.0F, 3.6F, 0.3F}, stone)), at({0.0, 1.8, -1.6}));
    const auto walker =
        internal::make_walker_mesh(paint(scene, "indigo", {0.07F, 0.15F, 0.24F}, 0.55F));
    Animation walk;
    walk.name = "walk";
    std::vector<AnimationSampler> samplers;
    constexpr int times = 5;
    const double apart_m = 1.2 * internal::walker_stride_m;
    for (int i = 0; i < times; ++i) {
        internal::add_walker(scene, fmt::format("walker {}", i + 1), walker,
                             at({-0.5 * (times - 1) * apart_m, 0.0, 0.0}, {0.0, 90.0, 0.0}),
                             1.2 * i, walk, samplers);
    }
    walk.samplers = std::make_shared<const std::vector<AnimationSampler>>(std::move(samplers));
    scene.animations.push_back(std::move(walk));
    const Entity sun =
        scene.create_node("sun", internal::looking_along(glm::dvec3(0.0), {0.50, -0.43, -0.87}));
    scene.registry.emplace<DirectionalLight>(sun, evening_sun, 2.4F);
    return scene;
}

struct Builtin {
    std::string_view name;
    Scene (*make)();
};
constexpr std::array<Builtin, 6> builtins{{{"pillars", make_pillars},
                                           {"knot", make_knot},
                                           {"room", make_room},
                                           {"still-life", make_still_life},
                                           {"open-shapes", make_open_shapes},
                                           {"walk", make_walk}}};

}  // namespace

std::vector<std::string> builtin_scene_names() {
    std::vector<std::string> names;
    for (const Builtin& builtin : builtins) names.emplace_back(builtin.name);
    return names;
}

Result<Scene> make_builtin_scene(std::string_view name) {
    for (const Builtin& builtin : builtins) {
        if (builtin.name != name) continue;
        Scene scene = builtin.make();
        update_world_transforms(scene.registry);
        if (const Status deformed = deform(scene); !deformed) return forward_error(deformed);
        return scene;
    }
    return fail(ErrorCode::InvalidInput, fmt::format("The built-in scene \"{}\" does not exist; "
                                                     "there are {}.",
                                                     name, fmt::join(builtin_scene_names(), ", ")));
}

}  // namespace gnomon::scene
