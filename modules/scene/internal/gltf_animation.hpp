// SPDX-License-Identifier: MIT
//
// Animations of a glTF file: their references after the checks, and how their keys are read.
#pragma once

#include <string>
#include <vector>

#include <gnomon/scene/animation.hpp>

#include "internal/json_place.hpp"

namespace gnomon::scene::internal {

struct GltfModel;

struct AnimationSamplerSource {
    int input = 0;  ///< accessor of the times
    int output = 0;
    Interpolation interpolation = Interpolation::Linear;
};

struct AnimationChannelSource {
    std::size_t sampler = 0;
    std::size_t node = 0;
    AnimationPath path = AnimationPath::Translation;
    std::size_t width = 0;  ///< numbers a value
};

struct AnimationSource {
    std::string name;
    std::vector<AnimationSamplerSource> samplers;
    std::vector<AnimationChannelSource> channels;
    /// Channels without a node, of an extension's path, or of a node that has a matrix.
    std::size_t left_out = 0;
};

/// The file's animations, everything about them checked but their bytes. Throws InputError. The
/// rest of the file has passed check_gltf() up to its nodes.
[[nodiscard]] std::vector<AnimationSource> check_animations(const JsonPlace& root);

/// Who stands for a node where an animation moves it: its own entity for its pose, the entities
/// that carry its mesh for weights. Empty: it is not in the scene.
class AnimationTargets {
public:
    virtual ~AnimationTargets() = default;
    [[nodiscard]] virtual std::vector<Entity> of(std::size_t node, AnimationPath path) const = 0;
};

/// Reads the keys. Throws InputError: times that are not finite, negative or not increasing, values
/// that are not finite, rotations of length zero, more numbers than a file of this size may have.
[[nodiscard]] std::vector<Animation> read_animations(const GltfModel& model,
                                                     const AnimationTargets& targets);

}  // namespace gnomon::scene::internal
