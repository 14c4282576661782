// SPDX-License-Identifier: MIT
//
// The fill meter: how many stencil fragments a light's volumes cost, counted by the device itself.
// On request, for it draws the volumes two times more; the same numbers wherever the masks are the
// same. It is no timer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>
#include <gnomon/shadow_pass/shadow_pass.hpp>

#pragma GCC visibility push(default)
namespace gnomon::shadow_pass {

/// Samples, as Fill has them.
struct LightFill {
    std::uint64_t rasterised = 0;  ///< Fill::Rasterised
    std::uint64_t counted = 0;     ///< Fill::Counted
};

/// Counts the volumes of the pass's last prepare(), of those lights of its list that `lights` names
/// by their places, one entry each, against the depth that `target` has. `target`: attachments as
/// the pass was made for (ShadowPassDesc), which are loaded, kept and not changed; load and store
/// operations and queries are set here. Blocks until the device has counted. Fails with
/// ErrorCode::Unsupported where the adapter lacks exact occlusion queries, and as the device does.
/// Needs ShadowPassDesc::meter.
[[nodiscard]] Result<std::vector<LightFill>> count_fill(gpu::Device& device, const ShadowPass& pass,
                                                        gpu::RenderPassDesc target,
                                                        std::span<const std::size_t> lights);

}  // namespace gnomon::shadow_pass
#pragma GCC visibility pop
