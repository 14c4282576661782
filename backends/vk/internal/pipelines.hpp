// SPDX-License-Identifier: MIT
//
// Render pipelines. Viewport, scissor, stencil reference and blend constant are dynamic.
#pragma once

#include <span>
#include <vector>

#include <gnomon/gpu/descriptors.hpp>

#include "internal/host_passes.hpp"
#include "internal/render_passes.hpp"

namespace gnomon::vk {

/// A pipeline once more, for a kind of render passes of the host's.
struct PipelineInHostPass {
    HostPassKind kind = 0;
    VkPipeline handle = VK_NULL_HANDLE;
};

struct Pipeline {
    VkPipeline handle = VK_NULL_HANDLE;
    std::vector<PipelineInHostPass> in_host_passes;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    std::vector<gpu::BindGroupLayoutId> bind_group_layouts;

    /// Null where it was not made for that one.
    [[nodiscard]] VkPipeline in_host_pass(HostPassKind kind) const {
        for (const PipelineInHostPass& made : in_host_passes) {
            if (made.kind == kind) {
                return made.handle;
            }
        }
        return VK_NULL_HANDLE;
    }
};

/// The Vulkan objects that a pipeline's descriptor names.
struct PipelineParts {
    VkShaderModule vertex = VK_NULL_HANDLE;
    VkShaderModule fragment = VK_NULL_HANDLE;  ///< may be null
    std::vector<VkDescriptorSetLayout> set_layouts;
};

class PipelineMaker {
public:
    PipelineMaker(Device& device, RenderPasses& render_passes)
        : device_(device), render_passes_(render_passes) {}
    ~PipelineMaker();
    PipelineMaker(const PipelineMaker&) = delete;
    PipelineMaker& operator=(const PipelineMaker&) = delete;
    [[nodiscard]] Status initialise();

    /// Also for each of `host_passes`, beside whose colours it draws.
    [[nodiscard]] Result<Pipeline> make(const gpu::RenderPipelineDesc& desc,
                                        const PipelineParts& parts,
                                        std::span<const HostPass> host_passes);
    void free(const Pipeline& pipeline);

private:
    [[nodiscard]] Status check_supported(const gpu::RenderPipelineDesc& desc) const;
    [[nodiscard]] Status make_in_host_pass(VkGraphicsPipelineCreateInfo info,
                                           const gpu::RenderPipelineDesc& desc,
                                           const HostPass& host, Pipeline& pipeline);

    Device& device_;
    RenderPasses& render_passes_;
    VkPipelineCache cache_ = VK_NULL_HANDLE;
};

}  // namespace gnomon::vk
