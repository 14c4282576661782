// SPDX-License-Identifier: MIT
#include "render_setup.hpp"

#include <cmath>

#include <fnmatch.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/gtc/matrix_transform.hpp>

#include <gnomon/render/camera.hpp>
#include <gnomon/scene/animation.hpp>
#include <gnomon/scene/deform.hpp>
#include <gnomon/scene/scene_description.hpp>
#include <gnomon/scene/transforms.hpp>

namespace gnomon::cli {

namespace {

template <class Tag>
void keep_matching(scene::Registry& registry, const std::optional<std::string>& glob) {
    if (!glob) return;
    std::vector<scene::Entity> dropped;
    registry.each<Tag>([&](scene::Entity entity, const Tag&) {
        const auto* name = registry.try_get<scene::Name>(entity);
        const std::string text = name == nullptr ? std::string() : name->value;
        if (fnmatch(glob->c_str(), text.c_str(), 0) != 0) dropped.push_back(entity);
    });
    for (const scene::Entity entity : dropped) registry.remove<Tag>(entity);
}

template <class Light>
void remove_lights(scene::Registry& registry) {
    std::vector<scene::Entity> entities;
    registry.each<Light>([&](scene::Entity entity, const Light&) { entities.push_back(entity); });
    for (const scene::Entity entity : entities) registry.remove<Light>(entity);
}

// A pose whose -Z looks along `travel`.
glm::dmat4 looking_along(const glm::dvec3& travel) {
    return render::camera_pose({0.0, 0.0, 0.0}, travel, {0.0, 1.0, 0.0});
}

void add_light(scene::Scene& scene, const LightArgument& argument, double scene_size) {
    scene::LocalTransform local;
    if (argument.directional) {
        local.matrix = looking_along(glm::normalize(argument.value));
        scene.registry.emplace<scene::DirectionalLight>(scene.create_node("--light", local));
    } else {
        local.translation = argument.value;
        const scene::Entity entity = scene.create_node("--light", local);
        // Brightness is relative (the renderer exposes for it); what matters is how lights compare
        // with each other.
        scene.registry.emplace<scene::PointLight>(
            entity, glm::vec3(1.0F), static_cast<float>(0.25 * scene_size * scene_size),
            argument.range_m);
    }
}

void set_lights(scene::Scene& scene, const std::vector<LightArgument>& arguments,
                double scene_size) {
    scene::Registry& registry = scene.registry;
    if (!arguments.empty()) {
        remove_lights<scene::PointLight>(registry);
        remove_lights<scene::SpotLight>(registry);
        remove_lights<scene::DirectionalLight>(registry);
        for (const LightArgument& argument : arguments) add_light(scene, argument, scene_size);
    } else if (registry.count<scene::PointLight>() + registry.count<scene::SpotLight>() +
                   registry.count<scene::DirectionalLight>() ==
               0) {
        add_light(scene, {.directional = true, .value = {0.75, -1.0, -0.4}}, scene_size);
    }
}

// The pose without scale, shear or mirroring: a camera has none. Nothing where it has no direction
// left.
std::optional<glm::dmat4> rigid(const glm::dmat4& pose) {
    const glm::dvec3 back = glm::normalize(glm::dvec3(pose[2]));
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(pose[1]), back));
    const glm::dvec3 up = glm::cross(back, right);
    const double sum = glm::dot(back, right) + glm::dot(up, glm::dvec3(pose[3]));
    if (!std::isfinite(sum)) return std::nullopt;
    return glm::dmat4(glm::dvec4(right, 0.0), glm::dvec4(up, 0.0), glm::dvec4(back, 0.0), pose[3]);
}

// The file's first camera, where it has one.
Status use_camera_of_file(const RenderOptions& options, Shot& shot) {
    const scene::Registry& registry = shot.scene.registry;
    std::optional<scene::Entity> found;
    registry.each<scene::Camera, scene::WorldTransform>(
        [&](scene::Entity entity, const scene::Camera&, const scene::WorldTransform&) {
            if (!found) found = entity;
        });
    if (!found) return {};
    const auto pose = rigid(registry.get<scene::WorldTransform>(*found).world_from_local);
    if (!pose) {
        const auto* name = registry.try_get<scene::Name>(*found);
        return fail(ErrorCode::InvalidInput,
                    fmt::format("{}: the pose of the camera \"{}\" leaves it no direction to look "
                                "in; --eye and --target replace it.",
                                options.scene, name == nullptr ? "" : name->value));
    }
    shot.camera = registry.get<scene::Camera>(*found);
    shot.world_from_camera = *pose;
    auto* perspective = std::get_if<scene::PerspectiveCamera>(&shot.camera.projection);
    if (perspective != nullptr && options.fovy_deg)
        perspective->fovy_rad = glm::radians(*options.fovy_deg);
    return {};
}

// Poses the scene at --time. A scene without animations stands, and says so.
Status play(const RenderOptions& options, Shot& shot) {
    const bool plays =
        options.time_s || options.animation || options.motion.kind == MotionKind::Time;
    if (!plays) return {};
    if (shot.scene.animations.empty()) {
        shot.scene.messages.push_back(fmt::format(
            "{}: the scene has no animations; it is drawn as it stands.", options.scene));
        return {};
    }
    shot.animations = scene::find_animations(shot.scene, options.animation);
    if (shot.animations.empty()) {
        std::vector<std::string> known;
        for (const scene::Animation& animation : shot.scene.animations) {
            known.push_back(fmt::format("{} \"{}\"", animation.place, animation.name));
        }
        return fail(ErrorCode::InvalidInput,
                    fmt::format("--animation: {} has no animation \"{}\"; it has {}.",
                                options.scene, *options.animation, fmt::join(known, ", ")));
    }
    return pose_at(shot, options.time_s.value_or(0.0));
}

}  // namespace

Status pose_at(Shot& shot, double time_s) {
    if (shot.animations.empty()) return {};
    for (const std::size_t animation : shot.animations) {
        if (const Status played = scene::animate(shot.scene, animation, time_s); !played) {
            return played;
        }
    }
    scene::update_world_transforms(shot.scene.registry);
    shot.time_s = time_s;
    return scene::deform(shot.scene);
}

Result<Shot> make_shot(const RenderOptions& options) {
    auto loaded = scene::load_scene(options.scene);
    if (!loaded) return forward_error(loaded);
    Shot shot;
    shot.scene = std::move(*loaded);
    scene::Registry& registry = shot.scene.registry;
    scene::update_world_transforms(registry);
    // Before all that follows from where things stand: lights, framing, near plane.
    if (const Status posed = play(options, shot); !posed) return forward_error(posed);
    shot.bounds = scene::world_bounds(shot.scene);
    const double diagonal = shot.bounds.diagonal();
    set_lights(shot.scene, options.lights, diagonal > 0.0 ? diagonal : 1.0);
    scene::update_world_transforms(registry);
    keep_matching<scene::Caster>(registry, options.casters);
    keep_matching<scene::Receiver>(registry, options.receivers);

    const double fovy_rad = glm::radians(options.fovy_deg.value_or(45.0));
    const double aspect = static_cast<double>(options.size.width) / options.size.height;
    shot.near_m = options.near_m.value_or(diagonal > 0.0 ? 1e-5 * diagonal : 0.01);
    shot.camera.projection = scene::PerspectiveCamera{.fovy_rad = fovy_rad, .near_m = shot.near_m};
    shot.world_from_camera = render::frame_bounds(shot.bounds, fovy_rad, aspect);
    if (options.eye || options.target) {
        const glm::dvec3 center = shot.bounds.empty() ? glm::dvec3(0.0) : shot.bounds.center();
        const glm::dvec3 eye = options.eye.value_or(glm::dvec3(shot.world_from_camera[3]));
        const glm::dvec3 target = options.target.value_or(center);
        if (glm::length(eye - target) < smallest_length) {
            return fail(ErrorCode::InvalidInput,
                        "--eye and --target are the same point: there is no direction to look in.");
        }
        shot.world_from_camera = render::camera_pose(eye, target, options.up);
    } else if (const Status used = use_camera_of_file(options, shot); !used) {
        return forward_error(used);
    }
    return shot;
}

}  // namespace gnomon::cli
