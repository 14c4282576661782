// SPDX-License-Identifier: MIT
//
// Render pipelines. Viewport, scissor, stencil reference and blend constant are dynamic.
#pragma once

#include <vector>

#include <gnomon/gpu/descriptors.hpp>

#include "internal/render_passes.hpp"

namespace gnomon::vk {

struct Pipeline {
    VkPipeline handle = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    std::vector<gpu::BindGroupLayoutId> bind_group_layouts;
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

    [[nodiscard]] Result<Pipeline> make(const gpu::RenderPipelineDesc& desc,
                                        const PipelineParts& parts);

private:
    [[nodiscard]] Status check_supported(const gpu::RenderPipelineDesc& desc) const;

    Device& device_;
    RenderPasses& render_passes_;
    VkPipelineCache cache_ = VK_NULL_HANDLE;
};

}  // namespace gnomon::vk
