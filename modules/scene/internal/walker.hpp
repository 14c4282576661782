// SPDX-License-Identifier: MIT
//
// A figure that walks: one skinned mesh of limbs that bend smoothly at hips, knees, ankles, toes,
// shoulders and elbows, and a gait whose feet stand still on the ground while they carry.
#pragma once

#include <memory>
#include <string>

#include <gnomon/scene/scene.hpp>

namespace gnomon::scene::internal {

/// About 1.75 m tall, upright, feet on y = 0, looking along +Z, arms hanging. Every limb is closed;
/// they lie in each other where they meet.
[[nodiscard]] std::shared_ptr<const Mesh> make_walker_mesh(std::uint32_t material);

/// How far a figure gets in one cycle of its gait (two steps), and how long that takes.
inline constexpr double walker_stride_m = 1.16;
inline constexpr double walker_cycle_s = 1.1;

/// Adds a figure below a node at `local`, walking along its +Z. At time 0 it stands where it would
/// be after `cycles` of its gait, counted from the node; the nodes stand so as well. Its channels
/// are added to `animation`, whose samplers `samplers` become; they last one cycle.
void add_walker(Scene& scene, const std::string& name, const std::shared_ptr<const Mesh>& mesh,
                const LocalTransform& local, double cycles, Animation& animation,
                std::vector<AnimationSampler>& samplers);

}  // namespace gnomon::scene::internal
