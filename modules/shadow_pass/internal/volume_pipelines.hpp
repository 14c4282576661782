// SPDX-License-Identifier: MIT
//
// The pipelines that shadow volumes are counted with: one for each technique, side and role that a
// pass may need.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/gpu/device.hpp>
#include <gnomon/shadow_pass/shadow_pass.hpp>
#include <gnomon/shadows/technique.hpp>

#include "volume_draws.hpp"

namespace gnomon::shadow_pass::internal {

/// Where vertices come from.
struct VertexStage {
    std::vector<gpu::BindGroupLayoutId> layouts;
    gpu::ShaderId shader;
    std::vector<gpu::VertexBufferLayout> buffers;
};

/// By pipeline_index(); empty where the pass has no use for one.
using Pipelines = std::array<gpu::RenderPipeline, 8 * role_count>;

/// Whether the pipelines test depth bounds: where the adapter can, and depth is as
/// VolumeDraw::depth has it.
[[nodiscard]] bool has_depth_bounds(const gpu::Device& device, const ShadowPassDesc& desc);

/// `exchanged`: front and back are. `unclipped`: as gpu::PrimitiveState has it.
[[nodiscard]] inline std::size_t pipeline_index(shadows::Technique technique, bool exchanged,
                                                bool unclipped, Role role) {
    return (technique == shadows::Technique::DepthFail ? 1U : 0U) + (exchanged ? 2U : 0U) +
           (unclipped ? 4U : 0U) + 8U * static_cast<std::size_t>(role);
}

/// What a pipeline is for.
struct Counting {
    std::uint32_t mask = 0xFF;                ///< stencil bits that count
    std::optional<Fill> fill = std::nullopt;  ///< for record_fill(): counts nothing itself
};

/// Every stencil operation wraps within the mask and leaves the other bits alone. Fails as the
/// device does.
[[nodiscard]] Result<Pipelines> create_volume_pipelines(gpu::Device& device,
                                                        const ShadowPassDesc& desc,
                                                        const VertexStage& stage,
                                                        gpu::ShaderId fragment,
                                                        const Counting& counting);

}  // namespace gnomon::shadow_pass::internal
