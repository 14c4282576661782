// SPDX-License-Identifier: MIT
//
// The rules of how a render pass begins.
#pragma once

#include <cstdint>
#include <vector>

#include "internal/device_state.hpp"
#include "internal/violations.hpp"

namespace gnomon::gpu {

/// What the commands inside of a pass are held against.
struct PassTargets {
    std::uint32_t width = 0;  ///< 0 while no attachment is known
    std::uint32_t height = 0;
    std::uint32_t sample_count = 1;
    std::vector<Format> color_formats;
    Format depth_stencil_format = Format::Undefined;
    bool depth_read_only = false;
    bool stencil_read_only = false;
    std::vector<TextureId> textures;  ///< all attachments and resolve targets
    std::uint32_t occlusion_queries = 0;
    /// False when an attachment is missing: formats and sizes then mean nothing.
    bool complete = true;
};

[[nodiscard]] PassTargets validate_pass(const DeviceState& device, const RenderPassDesc& desc,
                                        Violations& violations);

}  // namespace gnomon::gpu
