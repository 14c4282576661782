// SPDX-License-Identifier: MIT
#include "figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <glm/gtc/quaternion.hpp>

#include <gnomon/core/expects.hpp>
#include <gnomon/scene/scene_description.hpp>

namespace gnomon::game {

namespace {

constexpr std::array<std::string_view, 17> needed{
    "pelvis",     "chest",      "head",           "left hip",    "left knee",  "left ankle",
    "left toes",  "right hip",  "right knee",     "right ankle", "right toes", "left shoulder",
    "left elbow", "left wrist", "right shoulder", "right elbow", "right wrist"};

glm::dquat about_x(double angle_rad) {
    return glm::angleAxis(angle_rad, glm::dvec3(1.0, 0.0, 0.0));
}

}  // namespace

std::size_t Skeleton::joint(std::string_view name) const {
    const auto found = std::ranges::find(joints, name, &Joint::name);
    GNOMON_EXPECTS(found != joints.end());
    return static_cast<std::size_t>(found - joints.begin());
}

Result<Skeleton> load_skeleton() {
    auto scene = scene::make_builtin_scene("walk");
    if (!scene) return forward_error(scene);
    const scene::Registry& registry = scene->registry;
    // One walker of several will do: the one whose skin was made first.
    const scene::Skin* skin = nullptr;
    registry.each<scene::Skin>([&](scene::Entity, const scene::Skin& found) {
        if (skin == nullptr) skin = &found;
    });
    const auto refuse = [](const char* what) {
        return fail(ErrorCode::Unsupported,
                    std::string("The built-in scene \"walk\" has no ") + what + ".");
    };
    if (skin == nullptr || scene->animations.empty()) return refuse("walking figure");

    const scene::Animation& walk = scene->animations.front();
    Skeleton skeleton;
    skeleton.samplers = walk.samplers;
    skeleton.cycle_s = walk.duration_s;
    for (std::size_t i = 0; i < skin->joints.size(); ++i) {
        const scene::Entity entity = skin->joints[i];
        Skeleton::Joint joint;
        const std::string& full_name = registry.get<scene::Name>(entity).value;
        for (const std::string_view name : needed) {
            if (full_name.ends_with(name)) joint.name = name;
        }
        if (const auto* parent = registry.try_get<scene::Parent>(entity)) {
            const auto at = std::ranges::find(skin->joints, parent->value);
            if (at != skin->joints.end()) {
                joint.parent = static_cast<int>(at - skin->joints.begin());
            }
        }
        joint.place = -glm::dvec3((*skin->inverse_bind_matrices)[i][3]);
        for (const scene::AnimationChannel& channel : walk.channels) {
            if (!(channel.target == entity)) continue;
            const int sampler = static_cast<int>(channel.sampler);
            if (channel.path == scene::AnimationPath::Rotation) joint.rotation = sampler;
            if (channel.path == scene::AnimationPath::Translation) joint.translation = sampler;
        }
        skeleton.joints.push_back(std::move(joint));
    }
    for (const std::string_view name : needed) {
        if (std::ranges::count(skeleton.joints, name, &Skeleton::Joint::name) != 1) {
            return refuse("walker with the joints that figures need");
        }
    }
    const int way = skeleton.joints[skeleton.joint("pelvis")].translation;
    if (way < 0) return refuse("walker that gets ahead");
    const auto& values = (*skeleton.samplers)[static_cast<std::size_t>(way)].values;
    skeleton.stride_m = double{values[values.size() - 1]} - double{values[2]};
    if (!(skeleton.stride_m > 0.0)) return refuse("walker that gets ahead");
    return skeleton;
}

Figure add_figure(scene::Scene& scene, const Skeleton& skeleton, const std::string& name,
                  const std::shared_ptr<const scene::Mesh>& mesh) {
    Figure figure;
    figure.root = scene.create_node(name);
    scene::Skin skin;
    std::vector<glm::dmat4> inverse_bind;
    for (const Skeleton::Joint& joint : skeleton.joints) {
        const bool is_root = joint.parent < 0;
        const auto parent = static_cast<std::size_t>(std::max(joint.parent, 0));
        const glm::dvec3 offset =
            is_root ? joint.place : joint.place - skeleton.joints[parent].place;
        figure.joints.push_back(scene.create_node(name + " " + joint.name, {.translation = offset},
                                                  is_root ? figure.root : figure.joints[parent]));
        glm::dmat4 inverse(1.0);
        inverse[3] = glm::dvec4(-joint.place, 1.0);
        inverse_bind.push_back(inverse);
    }
    skin.joints = figure.joints;
    skin.inverse_bind_matrices =
        std::make_shared<const std::vector<glm::dmat4>>(std::move(inverse_bind));
    figure.body = scene.create_node(name + " body", {}, figure.root);
    scene.registry.emplace<scene::MeshInstance>(figure.body, mesh);
    scene.registry.emplace<scene::Skin>(figure.body, std::move(skin));
    scene.registry.emplace<scene::Caster>(figure.body);
    scene.registry.emplace<scene::Receiver>(figure.body);
    return figure;
}

void pose_figure(scene::Registry& registry, const Skeleton& skeleton, const Figure& figure,
                 const Stance& stance) {
    auto& root = registry.get<scene::LocalTransform>(figure.root);
    root.translation = {stance.at.x, 0.0, stance.at.y};
    root.rotation = glm::angleAxis(stance.facing_rad, glm::dvec3(0.0, 1.0, 0.0));

    // A runner's steps are longer, so that a cycle brings it farther.
    const double amplitude = std::clamp(stance.stride, 0.0, 1.5);
    const double reach_m = skeleton.stride_m * std::max(amplitude, 0.75);
    const double cycles = stance.walked_m / reach_m;
    const double time_s = (cycles - std::floor(cycles)) * skeleton.cycle_s;
    const auto sampled = [&](int sampler, scene::AnimationPath path, double* out) {
        scene::evaluate((*skeleton.samplers)[static_cast<std::size_t>(sampler)], path, time_s, out);
    };
    // Thighs ahead, shins back, by as much as brings the hips down.
    constexpr double deepest_rad = 1.12;
    const double bend = deepest_rad * stance.crouch;
    const double leg_m = skeleton.joints[skeleton.joint("left hip")].place.y -
                         skeleton.joints[skeleton.joint("left ankle")].place.y;

    for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
        const Skeleton::Joint& joint = skeleton.joints[i];
        auto& local = registry.get<scene::LocalTransform>(figure.joints[i]);
        if (joint.translation >= 0) {
            std::array<double, 3> p{};
            sampled(joint.translation, scene::AnimationPath::Translation, p.data());
            const double walking = std::min(amplitude, 1.0);
            const double lower = leg_m * (1.0 - std::cos(bend)) * 0.97;
            local.translation = {0.0, glm::mix(joint.place.y - 0.004, p[1], walking) - lower,
                                 -0.10 * stance.crouch};
        }
        glm::dquat rotation(1.0, 0.0, 0.0, 0.0);
        if (joint.rotation >= 0) {
            std::array<double, 4> q{};
            sampled(joint.rotation, scene::AnimationPath::Rotation, q.data());
            const glm::dquat walk(q[3], q[0], q[1], q[2]);
            // Beyond a walk the same swing goes on farther, but a foot must not.
            const bool is_foot = joint.name.ends_with("ankle") || joint.name.ends_with("toes");
            const double share = is_foot ? std::min(amplitude, 1.0) : amplitude;
            rotation = glm::normalize(glm::slerp(glm::dquat(1.0, 0.0, 0.0, 0.0), walk, share));
        }
        const double lean = 0.14 * std::max(amplitude - 1.0, 0.0);
        if (joint.name == "chest") rotation = rotation * about_x(0.75 * stance.crouch + lean);
        if (joint.name == "head") rotation = rotation * about_x(-0.55 * stance.crouch);
        if (joint.name.ends_with("hip")) rotation = rotation * about_x(-bend);
        if (joint.name.ends_with("knee")) rotation = rotation * about_x(2.0 * bend);
        if (joint.name.ends_with("ankle")) rotation = rotation * about_x(-bend);
        if (joint.name.ends_with("elbow")) {
            rotation = rotation * about_x(-0.25 - 0.9 * stance.crouch);
        }
        if (stance.carries_lamp && joint.name == "right shoulder") rotation = about_x(-0.5);
        if (stance.carries_lamp && joint.name == "right elbow") rotation = about_x(-0.9);
        local.rotation = rotation;
    }
}

}  // namespace gnomon::game
