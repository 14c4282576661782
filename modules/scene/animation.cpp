// SPDX-License-Identifier: MIT
//
// glTF 2.0 specification, appendix C, "Animation Sampler Interpolation Modes".
#include <gnomon/scene/animation.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include <fmt/format.h>

#include <gnomon/scene/scene.hpp>

namespace gnomon::scene {
namespace {

/// Quaternions in files, and between the keys of a spline, are unit only nearly.
glm::dquat unit(const double* xyzw, const glm::dquat& otherwise) {
    const glm::dquat q(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
    const double length = glm::length(q);
    return length > 1e-12 ? q / length : otherwise;
}

glm::dquat unit(std::span<const float> xyzw) {
    const double values[] = {xyzw[0], xyzw[1], xyzw[2], xyzw[3]};
    return unit(values, glm::dquat(1.0, 0.0, 0.0, 0.0));
}

void store(const glm::dquat& q, double* out) {
    out[0] = q.x;
    out[1] = q.y;
    out[2] = q.z;
    out[3] = q.w;
}

/// The numbers of a key; `part` picks the in-tangent, the value or the out-tangent of a spline's.
enum class Part : std::size_t { InTangent, Value, OutTangent };
std::span<const float> key(const AnimationSampler& s, std::size_t k, Part part = Part::Value) {
    const bool is_spline = s.interpolation == Interpolation::CubicSpline;
    const std::size_t at = is_spline ? 3 * k + static_cast<std::size_t>(part) : k;
    return std::span(s.values).subspan(at * s.width, s.width);
}

/// Cubic Hermite between keys k and k + 1, `step_s` apart, at u of the way.
void interpolate_spline(const AnimationSampler& s, std::size_t k, double step_s, double u,
                        double* out) {
    const double u2 = u * u;
    const double u3 = u2 * u;
    const auto from = key(s, k);
    const auto to = key(s, k + 1);
    const auto leave = key(s, k, Part::OutTangent);
    const auto arrive = key(s, k + 1, Part::InTangent);
    for (std::size_t i = 0; i < s.width; ++i) {
        out[i] = (2.0 * u3 - 3.0 * u2 + 1.0) * from[i] + step_s * (u3 - 2.0 * u2 + u) * leave[i] +
                 (3.0 * u2 - 2.0 * u3) * to[i] + step_s * (u3 - u2) * arrive[i];
    }
}

double looped(double time_s, double duration_s) {
    if (time_s >= 0.0 && time_s <= duration_s) return time_s;
    if (!(duration_s > 0.0)) return 0.0;
    const double rest = std::fmod(time_s, duration_s);
    return rest < 0.0 ? rest + duration_s : rest;
}

void apply(Registry& registry, const AnimationChannel& channel, std::span<const double> value) {
    if (channel.path == AnimationPath::Weights) {
        auto* weights = registry.try_get<MorphWeights>(channel.target);
        if (weights != nullptr && weights->values.size() == value.size()) {
            weights->values.assign(value.begin(), value.end());
        }
        return;
    }
    auto* local = registry.try_get<LocalTransform>(channel.target);
    if (local == nullptr) return;
    if (channel.path == AnimationPath::Rotation) {
        local->rotation = glm::dquat(value[3], value[0], value[1], value[2]);
    } else {
        (channel.path == AnimationPath::Translation ? local->translation : local->scale) = {
            value[0], value[1], value[2]};
    }
}

}  // namespace

void evaluate(const AnimationSampler& sampler, AnimationPath path, double time_s, double* out) {
    const auto& times = sampler.times_s;
    const auto after = std::upper_bound(times.begin(), times.end(), time_s,
                                        [](double t, float k) { return t < double{k}; });
    const auto next = static_cast<std::size_t>(after - times.begin());
    const std::size_t at = next == 0 ? 0 : next - 1;
    const auto value = key(sampler, at);
    const bool is_rotation = path == AnimationPath::Rotation;
    if (next == 0 || next == times.size() || sampler.interpolation == Interpolation::Step) {
        std::copy(value.begin(), value.end(), out);
        if (is_rotation) store(unit(value), out);
        return;
    }
    const double step_s = double{times[next]} - double{times[at]};
    const double u = (time_s - double{times[at]}) / step_s;
    if (sampler.interpolation == Interpolation::CubicSpline) {
        interpolate_spline(sampler, at, step_s, u, out);
        if (is_rotation) store(unit(out, unit(value)), out);
    } else if (is_rotation) {
        store(glm::normalize(glm::slerp(unit(value), unit(key(sampler, next)), u)), out);
    } else {
        const auto to = key(sampler, next);
        for (std::size_t i = 0; i < sampler.width; ++i) out[i] = (1.0 - u) * value[i] + u * to[i];
    }
}

Status animate(Scene& scene, std::size_t animation, double time_s) {
    if (animation >= scene.animations.size()) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("Animation {} was asked for, but the scene has {}.", animation,
                                scene.animations.size()));
    }
    if (!std::isfinite(time_s)) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("The time is {} s, but must be finite.", time_s));
    }
    const Animation& played = scene.animations[animation];
    const double time = looped(time_s, played.duration_s);
    std::vector<double> value;
    for (const AnimationChannel& channel : played.channels) {
        const AnimationSampler& sampler = (*played.samplers)[channel.sampler];
        value.resize(sampler.width);
        evaluate(sampler, channel.path, time, value.data());
        apply(scene.registry, channel, value);
    }
    return {};
}

std::vector<std::size_t> find_animations(const Scene& scene,
                                         const std::optional<std::string>& which) {
    std::vector<std::size_t> found;
    std::set<std::uint32_t> models;  // that have one already
    const auto find = [&](const auto& is_it) {
        for (std::size_t i = 0; i < scene.animations.size(); ++i) {
            if (is_it(scene.animations[i]) && models.insert(scene.animations[i].model).second) {
                found.push_back(i);
            }
        }
    };
    if (!which) {
        find([](const Animation&) { return true; });
        return found;
    }
    find([&](const Animation& animation) { return animation.name == *which; });
    find([&](const Animation& animation) { return std::to_string(animation.place) == *which; });
    std::sort(found.begin(), found.end());
    return found;
}

}  // namespace gnomon::scene
