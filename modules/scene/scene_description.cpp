// SPDX-License-Identifier: MIT
//
// The format: docs/scene-description.md. Strict on purpose: a misspelt member that is silently
// ignored costs its author an hour.
#include <gnomon/scene/scene_description.hpp>

#include <map>

#include <fmt/format.h>

#include <gnomon/scene/gltf.hpp>
#include <gnomon/scene/primitives.hpp>
#include <gnomon/scene/transforms.hpp>

#include "internal/compose.hpp"
#include "internal/gltf_file.hpp"
#include "internal/guarded.hpp"

namespace gnomon::scene {
namespace {

using internal::DrawnAs;
using internal::JsonPlace;

constexpr double smallest_size = 1e-9;
/// The reach of a shape is the sum of its lengths, and has to be finite in single precision.
constexpr double largest_size = 1e38;

double number_or(const JsonPlace& place, const char* name, double otherwise,
                 double min = -JsonPlace::largest, double max = JsonPlace::largest) {
    const auto found = place.find(name);
    return found ? found->number(min, max) : otherwise;
}

float float_or(const JsonPlace& place, const char* name, double otherwise, double min,
               double max = JsonPlace::largest) {
    return static_cast<float>(number_or(place, name, otherwise, min, max));
}

float length_or(const JsonPlace& place, const char* name, double otherwise) {
    return float_or(place, name, otherwise, smallest_size, largest_size);
}

std::uint32_t segments_or(const JsonPlace& place, const char* name, std::uint32_t otherwise,
                          std::uint64_t min = 3, std::uint64_t max = 2048) {
    const auto found = place.find(name);
    return found ? static_cast<std::uint32_t>(found->whole(min, max)) : otherwise;
}

bool flag_or(const JsonPlace& place, const char* name, bool otherwise) {
    const auto found = place.find(name);
    return found ? found->boolean() : otherwise;
}

glm::dvec3 vec3_or(const JsonPlace& place, const char* name, const glm::dvec3& otherwise) {
    const auto found = place.find(name);
    return found ? found->vec3() : otherwise;
}

std::string name_or(const JsonPlace& place, std::string otherwise) {
    const auto found = place.find("name");
    return found ? found->text() : std::move(otherwise);
}

LocalTransform read_pose(const JsonPlace& place) {
    LocalTransform local;
    local.translation = vec3_or(place, "translation", glm::dvec3(0.0));
    local.rotation = internal::turned_deg(vec3_or(place, "rotation_deg", glm::dvec3(0.0)));
    if (const auto scale = place.find("scale")) {
        local.scale = scale->value().is_array() ? scale->vec3() : glm::dvec3(scale->number());
    }
    return local;
}

DrawnAs read_drawn(const JsonPlace& place) {
    return {flag_or(place, "casts", true), flag_or(place, "receives", true)};
}

/// Moves the node up or down until its lowest point is where its origin was.
void stand_on_ground(Scene& scene, Entity entity) {
    update_world_transforms(scene.registry);
    const Bounds bounds = internal::bounds_below(scene, entity);
    if (bounds.empty()) return;
    auto& local = scene.registry.get<LocalTransform>(entity);
    local.translation.y += local.translation.y - bounds.min.y;
}

Material read_material(const JsonPlace& place) {
    place.only({"name", "base_color", "metallic", "roughness", "emissive", "double_sided"});
    Material material;
    material.name = name_or(place, "");
    if (const auto color = place.find("base_color")) {
        const std::size_t count = color->value().size() == 4 ? 4 : 3;
        const std::vector<double> values = color->numbers(count, 0.0);
        for (std::size_t i = 0; i < count; ++i) {
            material.base_color[static_cast<int>(i)] = static_cast<float>(values[i]);
        }
    }
    material.metallic = float_or(place, "metallic", material.metallic, 0.0, 1.0);
    material.roughness = float_or(place, "roughness", material.roughness, 0.0, 1.0);
    if (const auto emissive = place.find("emissive")) material.emissive = emissive->vec3(0.0);
    material.double_sided = flag_or(place, "double_sided", false);
    return material;
}

/// What all shapes have in common, then the members of each.
Mesh read_shape(const JsonPlace& place, std::uint32_t material) {
    const std::string& shape =
        place.member("shape").one_of({"box", "sphere", "torus", "torus_knot", "plane", "cylinder"});
    const auto only = [&](std::initializer_list<std::string_view> own) {
        nlohmann::json rest = place.value();
        for (const char* common : {"shape", "name", "translation", "rotation_deg", "scale",
                                   "stand_on_ground", "casts", "receives", "material"}) {
            rest.erase(common);
        }
        JsonPlace(rest, place.file(), place.path()).only(own);
    };
    if (shape == "box") {
        only({"size"});
        const auto size = place.find("size");
        return make_box(size ? glm::vec3(size->vec3(smallest_size)) : glm::vec3(1.0F), material);
    }
    if (shape == "sphere") {
        only({"radius", "slices", "stacks"});
        return make_sphere(length_or(place, "radius", 0.5), segments_or(place, "slices", 48),
                           segments_or(place, "stacks", 24, 2), material);
    }
    if (shape == "torus") {
        only({"ring_radius", "tube_radius", "ring_segments", "tube_segments"});
        return make_torus(length_or(place, "ring_radius", 0.5),
                          length_or(place, "tube_radius", 0.2),
                          segments_or(place, "ring_segments", 64),
                          segments_or(place, "tube_segments", 24), material);
    }
    if (shape == "torus_knot") {
        only({"ring_radius", "tube_radius", "p", "q", "ring_segments", "tube_segments"});
        return make_torus_knot(length_or(place, "ring_radius", 0.5),
                               length_or(place, "tube_radius", 0.14),
                               segments_or(place, "p", 2, 1, 32), segments_or(place, "q", 3, 1, 32),
                               segments_or(place, "ring_segments", 256),
                               segments_or(place, "tube_segments", 24), material);
    }
    if (shape == "plane") {
        only({"size", "cells"});
        glm::vec2 size(10.0F);
        if (const auto given = place.find("size")) {
            const std::vector<double> sides = given->numbers(2, smallest_size);
            size = {static_cast<float>(sides[0]), static_cast<float>(sides[1])};
        }
        return make_plane(size.x, size.y, segments_or(place, "cells", 1, 1), material);
    }
    only({"radius", "height", "slices"});
    return make_cylinder(length_or(place, "radius", 0.5), length_or(place, "height", 1.0),
                         segments_or(place, "slices", 48), material);
}

void add_primitive(Scene& scene, const JsonPlace& place) {
    place.object();
    std::uint32_t material = 0;
    if (const auto given = place.find("material")) {
        material = internal::add_material(scene, read_material(*given));
    }
    auto mesh = std::make_shared<const Mesh>(read_shape(place, material));
    std::string name = name_or(place, mesh->name);
    const Entity entity = internal::add_instance(scene, std::move(name), std::move(mesh),
                                                 read_pose(place), std::nullopt, read_drawn(place));
    if (flag_or(place, "stand_on_ground", false)) stand_on_ground(scene, entity);
}

void add_light(Scene& scene, const JsonPlace& place) {
    const std::string& type = place.object().member("type").one_of({"sun", "point", "spot"});
    if (type == "sun") {
        place.only({"type", "name", "color", "intensity", "direction"});
    } else if (type == "point") {
        place.only({"type", "name", "color", "intensity", "range", "position"});
    } else {
        place.only({"type", "name", "color", "intensity", "range", "position", "direction",
                    "inner_cone_deg", "outer_cone_deg"});
    }
    LocalTransform local;
    if (type != "sun") local.translation = place.member("position").vec3();
    if (type != "point") {
        const JsonPlace direction = place.member("direction");
        if (glm::length(direction.vec3()) < smallest_size) {
            direction.must_be("the way the light travels: a vector longer than zero");
        }
        local = internal::looking_along(local.translation, direction.vec3());
    }
    const auto color_place = place.find("color");
    const glm::vec3 color(color_place ? color_place->vec3(0.0) : glm::dvec3(1.0));
    const float intensity = float_or(place, "intensity", 1.0, 0.0);
    std::optional<double> range_m;
    if (const auto range = place.find("range")) range_m = range->number(smallest_size);

    const Entity entity = scene.create_node(name_or(place, type), local);
    if (type == "sun") {
        scene.registry.emplace<DirectionalLight>(entity, color, intensity);
    } else if (type == "point") {
        scene.registry.emplace<PointLight>(entity, color, intensity, range_m);
    } else {
        const double outer_deg = number_or(place, "outer_cone_deg", 45.0, 0.1, 90.0);
        const double inner_deg = number_or(place, "inner_cone_deg", 0.0, 0.0, outer_deg);
        scene.registry.emplace<SpotLight>(entity, color, intensity, range_m,
                                          static_cast<float>(glm::radians(inner_deg)),
                                          static_cast<float>(glm::radians(outer_deg)));
    }
}

void add_camera(Scene& scene, const JsonPlace& place) {
    place.only(
        {"name", "eye", "target", "up", "fovy_deg", "near", "half_height", "half_width", "far"});
    const glm::dvec3 eye = place.member("eye").vec3();
    const glm::dvec3 target = place.member("target").vec3();
    const glm::dvec3 up = vec3_or(place, "up", {0.0, 1.0, 0.0});
    if (glm::length(target - eye) < smallest_size) place.member("target").must_be("away from eye");
    if (glm::length(up) < smallest_size) place.member("up").must_be("longer than zero");

    Camera camera;
    if (place.has("half_height")) {
        if (place.has("fovy_deg")) {
            place.refuse(
                "has both fovy_deg, which makes it perspective, and half_height, which "
                "makes it orthographic");
        }
        OrthographicCamera orthographic;
        orthographic.half_height_m = place.member("half_height").number(smallest_size);
        orthographic.half_width_m =
            number_or(place, "half_width", orthographic.half_height_m, smallest_size);
        orthographic.near_m = number_or(place, "near", 0.0, 0.0);
        orthographic.far_m = number_or(place, "far", orthographic.near_m + 1000.0,
                                       orthographic.near_m + smallest_size);
        camera.projection = orthographic;
    } else {
        for (const char* name : {"half_width", "far"}) {
            if (const auto member = place.find(name)) {
                member->refuse("belongs to an orthographic camera, which has a half_height");
            }
        }
        PerspectiveCamera perspective;
        perspective.fovy_rad = glm::radians(number_or(place, "fovy_deg", 45.0, 1.0, 170.0));
        perspective.near_m = number_or(place, "near", perspective.near_m, smallest_size);
        camera.projection = perspective;
    }
    const Entity entity =
        scene.create_node(name_or(place, "camera"), internal::looking_along(eye, target - eye, up));
    scene.registry.emplace<Camera>(entity, camera);
}

class DescriptionReader {
public:
    DescriptionReader(std::filesystem::path folder, const JsonPlace& root)
        : folder_(std::move(folder)) {
        root.only({"models", "primitives", "lights", "camera"});
        // First, so that it comes before the cameras of models.
        if (const auto camera = root.find("camera")) add_camera(scene_, *camera);
        for_each(root, "models", [this](const JsonPlace& place) { add_model(place); });
        for_each(root, "primitives", [this](const JsonPlace& p) { add_primitive(scene_, p); });
        for_each(root, "lights", [this](const JsonPlace& place) { add_light(scene_, place); });
        update_world_transforms(scene_.registry);
    }

    Scene take() { return std::move(scene_); }

private:
    template <class Visit>
    static void for_each(const JsonPlace& root, const char* name, const Visit& visit) {
        const auto list = root.find(name);
        if (!list) return;
        list->array();
        for (std::size_t i = 0; i < list->size(); ++i) visit(list->at(i));
    }

    void add_model(const JsonPlace& place) {
        place.only({"file", "name", "translation", "rotation_deg", "scale", "stand_on_ground",
                    "casts", "receives"});
        const std::string& file = place.member("file").text();
        const Entity entity = internal::append_scene(scene_, load(file), name_or(place, file),
                                                     read_pose(place), read_drawn(place));
        if (flag_or(place, "stand_on_ground", false)) stand_on_ground(scene_, entity);
    }

    const Scene& load(const std::string& file) {
        const auto found = loaded_.find(file);
        if (found != loaded_.end()) return found->second;
        Result<Scene> model = load_gltf(folder_ / file);
        if (!model) throw internal::InputError(model.error());
        return loaded_.emplace(file, *std::move(model)).first->second;
    }

    std::filesystem::path folder_;
    Scene scene_;
    std::map<std::string, Scene> loaded_;
};

bool ends_with(std::string_view text, std::string_view ending) {
    return text.size() >= ending.size() && text.substr(text.size() - ending.size()) == ending;
}

}  // namespace

Result<Scene> load_scene_description(const std::filesystem::path& path) {
    const std::string name = path.string();
    return internal::guarded(name, [&] {
        const std::vector<std::byte> bytes = internal::read_file(path, name);
        const nlohmann::json document =
            internal::parse_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name);
        return DescriptionReader(path.parent_path(), JsonPlace(document, name)).take();
    });
}

Result<Scene> load_scene(const std::string& source) {
    constexpr std::string_view builtin = "builtin:";
    if (source.compare(0, builtin.size(), builtin) == 0) {
        return make_builtin_scene(std::string_view(source).substr(builtin.size()));
    }
    if (ends_with(source, ".glb") || ends_with(source, ".gltf")) return load_gltf(source);
    if (ends_with(source, ".scene.json")) return load_scene_description(source);
    return fail(ErrorCode::InvalidInput,
                fmt::format("{}: the name ends in none of .glb, .gltf and .scene.json and does "
                            "not begin with builtin:.",
                            source));
}

}  // namespace gnomon::scene
