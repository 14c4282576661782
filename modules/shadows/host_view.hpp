// SPDX-License-Identifier: MIT
//
// HostView: the camera of a renderer that is not ours, as it is: whatever its clip space, its
// direction of depth, where y points and which way its view looks. Out of it come a View for the
// ShadowSystem and one for drawing, in which every clip position is the host's own to the bit.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>
#include <gnomon/shadows/view.hpp>

#pragma GCC visibility push(default)
namespace gnomon::shadows {

/// What becomes of z / w.
enum class HostDepth : std::uint8_t {
    MinusOneToOne,  ///< OpenGL's own: near and far at -1 and 1
    ZeroToOne,      ///< Vulkan's, Direct3D's, and OpenGL's by glClipControl
    Logarithmic,    ///< fragments write another depth: refused
};

/// Which row of the framebuffer is the first one in memory.
enum class HostRows : std::uint8_t {
    FromMinusOne,  ///< where y / w is -1: OpenGL's and Vulkan's
    FromOne,       ///< where it is 1: WebGPU's, and that of passes of a gpu::Device
};

/// What does not change from frame to frame.
struct HostConventions {
    HostDepth depth = HostDepth::MinusOneToOne;  ///< the range of z / w
    bool reversed = false;  ///< the greater depth is nearer to the eye, and depth is cleared to 0
    HostRows rows = HostRows::FromMinusOne;  ///< where rows are counted from
};

/// A host's camera, in gnomon's words and in its own.
struct HostView {
    /// For ShadowSystem::finish(). Depth is gnomon's (1 near, 0 far). Rows are counted as the
    /// host's framebuffer stores them, so its y is the host's negated, but for HostRows::FromOne.
    View view;
    /// For drawing with vertex stages of gnomon's: clip positions are then those of the host's
    /// matrices. Where rows begin at -1 the stages negate y as their last act, so here it is
    /// negated already.
    View as_drawn;
    HostConventions conventions;  ///< as they were given
};

/// Takes a host's matrices. `view_from_world`: rotation and translation, in metres, looking along
/// -Z or +Z; in a left-handed world as well. `clip_from_view`: perspective, off-axis too, or
/// orthographic, with a far plane or without (an infinite projection whose depth ends a little
/// before the far plane counts as one without); y up or down. Fails with ErrorCode::InvalidInput,
/// or Unsupported where shadow volumes cannot be right in it, with a sentence that says what to
/// change: logarithmic depth, an oblique near plane, a view that scales, a direction of depth that
/// is not what `conventions` say. The last is noticed in perspective alone: an orthographic
/// projection whose depth runs the other way is the same as one that looks along the other axis,
/// so there a wrong `reversed` gives wrong shadows. Cost: some hundred flops.
[[nodiscard]] Result<HostView> view_of_host(const glm::dmat4& view_from_world,
                                            const glm::dmat4& clip_from_view,
                                            const HostConventions& conventions);

}  // namespace gnomon::shadows
#pragma GCC visibility pop
