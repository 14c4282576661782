// SPDX-License-Identifier: MIT
//
// One function a strategy, each at home in strategies/<name>.cpp; edge_stack.cpp has both of its.
#pragma once

#include <memory>

#include <gnomon/shadows/detector.hpp>

namespace gnomon::shadows::internal {

[[nodiscard]] std::unique_ptr<SilhouetteDetector> brute_force_detector();
[[nodiscard]] std::unique_ptr<SilhouetteDetector> simd_detector();
[[nodiscard]] std::unique_ptr<SilhouetteDetector> dual_bvh_detector();
[[nodiscard]] std::unique_ptr<SilhouetteDetector> certificates_detector();
[[nodiscard]] std::unique_ptr<SilhouetteDetector> automatic_detector();
[[nodiscard]] std::unique_ptr<SilhouetteDetector> edge_stack_detector();
[[nodiscard]] std::unique_ptr<SilhouetteDetector> edge_stack_naive_detector();
[[nodiscard]] std::unique_ptr<SilhouetteDetector> vnv_detector();
[[nodiscard]] std::unique_ptr<SilhouetteDetector> edge_list_detector();
[[nodiscard]] std::unique_ptr<SilhouetteDetector> hextree_detector();

/// What "auto" does about a light that went far, before it knows anything of the mesh but its size.
[[nodiscard]] Choice choose_for_jump(const ShadowMesh& mesh);

/// The bytes that a detection's lists hold.
[[nodiscard]] std::size_t memory_of(const Detection& detection);
/// What a light casts that is not finite.
const Detection& nothing_of(const ShadowMesh& mesh, Detection& detection);

}  // namespace gnomon::shadows::internal
