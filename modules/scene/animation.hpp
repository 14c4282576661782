// SPDX-License-Identifier: MIT
//
// Animations as glTF has them: keys over time for the poses of nodes and the weights of morph
// targets. Evaluating one writes components; what follows from them is asked for next:
//
//     animate(scene, 0, time_s);
//     update_world_transforms(scene.registry);
//     deform(scene);                              // skins and morphs, deform.hpp
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/scene/registry.hpp>

#pragma GCC visibility push(default)
namespace gnomon::scene {

struct Scene;

/// What lies between two keys, as glTF has it.
enum class Interpolation : std::uint8_t {
    Step,         ///< the earlier key
    Linear,       ///< a line; for rotations the shorter arc
    CubicSpline,  ///< a Hermite spline with the keys' tangents
};
/// What of a node an animation moves.
enum class AnimationPath : std::uint8_t {
    Translation,  ///< LocalTransform::translation
    Rotation,     ///< LocalTransform::rotation
    Scale,        ///< LocalTransform::scale
    Weights,      ///< MorphWeights
};

/// Keys and values over time.
struct AnimationSampler {
    Interpolation interpolation = Interpolation::Linear;  ///< between keys
    std::vector<float> times_s;                           ///< at least one, increasing, finite
    std::size_t width = 0;  ///< numbers a value: 3, 4 (x, y, z, w), or one a morph target
    /// `width` numbers a key; for cubic splines three times as many: in-tangent, value,
    /// out-tangent.
    std::vector<float> values;
};

/// What a sampler moves.
struct AnimationChannel {
    Entity target;                                    ///< whose transform or weights
    AnimationPath path = AnimationPath::Translation;  ///< which of them
    std::uint32_t sampler = 0;                        ///< its place among Animation::samplers
};

/// Channels that play together.
struct Animation {
    std::string name;         ///< as the file has it; may be empty
    double duration_s = 0.0;  ///< the last key of all its channels
    std::shared_ptr<const std::vector<AnimationSampler>> samplers;  ///< shared by copies
    std::vector<AnimationChannel> channels;                         ///< in the file's order
    /// A scene may be put together from several models: which of them this one came with, and its
    /// place among the animations of that model.
    std::uint32_t model = 0;
    std::uint32_t place = 0;  ///< see `model`
};

/// The value of a sampler: before its first key the first, after its last key the last. Rotations
/// (`path`) go the shorter way round at even speed (slerp), along splines they are made unit again.
/// `out` has room for `width` numbers. Cost: a binary search.
void evaluate(const AnimationSampler& sampler, AnimationPath path, double time_s, double* out);

/// Writes LocalTransform and MorphWeights of everything that the animation moves. It loops: beyond
/// its duration, and before zero, time is taken modulo the duration; at the duration itself it
/// stands at its end. A target that is gone, or has no such component, is passed over. Fails with
/// ErrorCode::InvalidInput when there is no such animation or the time is not finite. Cost: a
/// binary search a channel.
[[nodiscard]] Status animate(Scene& scene, std::size_t animation, double time_s);

/// Places in Scene::animations of what `which` names, at most one for each model of the scene: an
/// animation's name, else its number within its model. None: the first of every model.
[[nodiscard]] std::vector<std::size_t> find_animations(
    const Scene& scene, const std::optional<std::string>& which = std::nullopt);

}  // namespace gnomon::scene
#pragma GCC visibility pop
