// SPDX-License-Identifier: MIT
//
// Translates a pipeline descriptor.
#include "internal/pipelines.hpp"

#include <array>

#include <fmt/format.h>

#include "internal/conv.hpp"
#include "internal/error.hpp"

namespace gnomon::vk {

namespace {

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits bit, VkShaderModule shader) {
    VkPipelineShaderStageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage = bit;
    info.module = shader;
    info.pName = "main";
    return info;
}

/// Of the constant that the build appends to vertex stages: what they multiply y by.
constexpr std::uint32_t y_sign_id = 100;
constexpr float y_kept = 1.0F;
constexpr VkSpecializationMapEntry y_sign_entry{y_sign_id, 0, sizeof y_kept};
constexpr VkSpecializationInfo keep_y{1, &y_sign_entry, sizeof y_kept, &y_kept};

struct VertexInput {
    std::vector<VkVertexInputBindingDescription> bindings;
    std::vector<VkVertexInputAttributeDescription> attributes;
};

VertexInput vertex_input(const gpu::RenderPipelineDesc& desc) {
    VertexInput input;
    for (std::uint32_t slot = 0; slot < desc.vertex_buffers.size(); ++slot) {
        const gpu::VertexBufferLayout& layout = desc.vertex_buffers[slot];
        input.bindings.push_back(
            {slot, static_cast<std::uint32_t>(layout.array_stride), to_vk(layout.step_mode)});
        for (const gpu::VertexAttribute& attribute : layout.attributes) {
            input.attributes.push_back({attribute.shader_location, slot, to_vk(attribute.format),
                                        static_cast<std::uint32_t>(attribute.offset)});
        }
    }
    return input;
}

VkStencilOpState stencil_face(const gpu::StencilFaceState& face,
                              const gpu::DepthStencilState& state) {
    VkStencilOpState out{};
    out.failOp = to_vk(face.fail_op);
    out.passOp = to_vk(face.pass_op);
    out.depthFailOp = to_vk(face.depth_fail_op);
    out.compareOp = to_vk(face.compare);
    out.compareMask = state.stencil_read_mask;
    out.writeMask = state.stencil_write_mask;
    return out;
}

VkPipelineDepthStencilStateCreateInfo depth_stencil(const gpu::DepthStencilState& state) {
    VkPipelineDepthStencilStateCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    // With depth testing off Vulkan writes no depth either.
    // SwiftShader looks at no bounds without it.
    const bool tested = state.depth_compare != gpu::Compare::Always || state.depth_write_enabled ||
                        state.depth_bounds_test;
    info.depthTestEnable = tested ? VK_TRUE : VK_FALSE;
    info.depthWriteEnable = state.depth_write_enabled ? VK_TRUE : VK_FALSE;
    info.depthCompareOp = to_vk(state.depth_compare);
    info.depthBoundsTestEnable = state.depth_bounds_test ? VK_TRUE : VK_FALSE;
    info.stencilTestEnable = gpu::has_stencil(state.format) ? VK_TRUE : VK_FALSE;
    info.front = stencil_face(state.stencil_front, state);
    info.back = stencil_face(state.stencil_back, state);
    return info;
}

VkPipelineRasterizationStateCreateInfo rasterization(const gpu::RenderPipelineDesc& desc) {
    VkPipelineRasterizationStateCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    info.depthClampEnable = desc.primitive.unclipped_depth ? VK_TRUE : VK_FALSE;
    info.polygonMode = VK_POLYGON_MODE_FILL;
    info.cullMode = to_vk(desc.primitive.cull_mode);
    info.frontFace = to_vk(desc.primitive.front_face);
    info.lineWidth = 1.0F;
    if (desc.depth_stencil) {
        const gpu::DepthStencilState& state = *desc.depth_stencil;
        info.depthBiasEnable =
            state.depth_bias != 0 || state.depth_bias_slope_scale != 0.0F ? VK_TRUE : VK_FALSE;
        info.depthBiasConstantFactor = static_cast<float>(state.depth_bias);
        info.depthBiasSlopeFactor = state.depth_bias_slope_scale;
        info.depthBiasClamp = state.depth_bias_clamp;
    }
    return info;
}

VkPipelineColorBlendAttachmentState blend_state(const gpu::ColorTargetState& target) {
    VkPipelineColorBlendAttachmentState state{};
    state.colorWriteMask = to_vk(target.write_mask);
    if (target.blend) {
        state.blendEnable = VK_TRUE;
        state.srcColorBlendFactor = to_vk(target.blend->color.src_factor);
        state.dstColorBlendFactor = to_vk(target.blend->color.dst_factor);
        state.colorBlendOp = to_vk(target.blend->color.operation);
        state.srcAlphaBlendFactor = to_vk(target.blend->alpha.src_factor);
        state.dstAlphaBlendFactor = to_vk(target.blend->alpha.dst_factor);
        state.alphaBlendOp = to_vk(target.blend->alpha.operation);
    }
    return state;
}

bool same_blending(const VkPipelineColorBlendAttachmentState& a,
                   const VkPipelineColorBlendAttachmentState& b) {
    return a.blendEnable == b.blendEnable && a.colorWriteMask == b.colorWriteMask &&
           a.srcColorBlendFactor == b.srcColorBlendFactor &&
           a.dstColorBlendFactor == b.dstColorBlendFactor && a.colorBlendOp == b.colorBlendOp &&
           a.srcAlphaBlendFactor == b.srcAlphaBlendFactor &&
           a.dstAlphaBlendFactor == b.dstAlphaBlendFactor && a.alphaBlendOp == b.alphaBlendOp;
}

/// Any render pass with these formats and sample counts will do: load and store operations, layouts
/// and resolve targets do not count for compatibility.
RenderPassKey compatible_key(const gpu::RenderPipelineDesc& desc) {
    RenderPassKey key;
    for (const gpu::ColorTargetState& target : desc.targets) {
        AttachmentState state;
        state.format = to_vk(target.format);
        state.samples = to_vk_samples(desc.sample_count);
        state.layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        key.colors.push_back(state);
    }
    if (desc.depth_stencil) {
        AttachmentState state;
        state.format = to_vk(desc.depth_stencil->format);
        state.samples = to_vk_samples(desc.sample_count);
        state.layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
        key.depth_stencil.push_back(state);
    }
    return key;
}

}  // namespace

Status PipelineMaker::initialise() {
    VkPipelineCacheCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
    if (const VkResult result =
            device_.fn.CreatePipelineCache(device_.handle, &info, nullptr, &cache_);
        result != VK_SUCCESS) {
        return failure(result, "vkCreatePipelineCache", "the pipelines");
    }
    return {};
}

PipelineMaker::~PipelineMaker() {
    device_.fn.DestroyPipelineCache(device_.handle, cache_, nullptr);
}

Status PipelineMaker::check_supported(const gpu::RenderPipelineDesc& desc) const {
    const VkPhysicalDeviceFeatures& enabled = device_.adapter.enabled;
    if (desc.depth_stencil && desc.depth_stencil->depth_bias_clamp != 0.0F &&
        enabled.depthBiasClamp == VK_FALSE) {
        return fail(ErrorCode::Unsupported,
                    fmt::format("The depth_bias_clamp of render pipeline '{}' is {}, but the "
                                "adapter lacks depthBiasClamp.",
                                desc.label, desc.depth_stencil->depth_bias_clamp));
    }
    for (const gpu::ColorTargetState& target : desc.targets) {
        if (enabled.independentBlend == VK_FALSE &&
            !same_blending(blend_state(target), blend_state(desc.targets.front()))) {
            return fail(ErrorCode::Unsupported,
                        fmt::format("The {} targets of render pipeline '{}' blend differently, but "
                                    "the adapter lacks independentBlend.",
                                    desc.targets.size(), desc.label));
        }
    }
    return {};
}

// `info`: the pipeline as it is for passes of ours without a colour.
Status PipelineMaker::make_in_host_pass(VkGraphicsPipelineCreateInfo info,
                                        const gpu::RenderPipelineDesc& desc, const HostPass& host,
                                        Pipeline& pipeline) {
    const HostRenderPass& pass = host.pass;
    // None is written.
    const std::vector<VkPipelineColorBlendAttachmentState> targets(pass.color_formats.size());
    VkPipelineColorBlendStateCreateInfo blend = *info.pColorBlendState;
    blend.attachmentCount = static_cast<std::uint32_t>(targets.size());
    blend.pAttachments = targets.data();
    info.pColorBlendState = &blend;
    std::vector<VkFormat> formats;
    for (const std::uint32_t format : pass.color_formats) {
        formats.push_back(static_cast<VkFormat>(format));
    }
    VkPipelineRenderingCreateInfo rendering{};
    rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
    rendering.colorAttachmentCount = static_cast<std::uint32_t>(formats.size());
    rendering.pColorAttachmentFormats = formats.data();
    rendering.depthAttachmentFormat = to_vk(desc.depth_stencil->format);
    rendering.stencilAttachmentFormat = rendering.depthAttachmentFormat;
    info.renderPass = reinterpret_cast<VkRenderPass>(pass.render_pass);
    info.subpass = pass.subpass;
    if (info.renderPass == VK_NULL_HANDLE) {
        info.pNext = &rendering;
    }
    PipelineInHostPass made{host.kind};
    if (const VkResult result = device_.fn.CreateGraphicsPipelines(device_.handle, cache_, 1, &info,
                                                                   nullptr, &made.handle);
        result != VK_SUCCESS) {
        return failure(
            result, "vkCreateGraphicsPipelines",
            fmt::format("render pipeline '{}' in a render pass of the host's", desc.label));
    }
    pipeline.in_host_passes.push_back(made);
    device_.set_name(VK_OBJECT_TYPE_PIPELINE, made.handle, desc.label + ", in the host's pass");
    return {};
}

void PipelineMaker::free(const Pipeline& pipeline) {
    device_.fn.DestroyPipeline(device_.handle, pipeline.handle, nullptr);
    for (const PipelineInHostPass& in_host_pass : pipeline.in_host_passes) {
        device_.fn.DestroyPipeline(device_.handle, in_host_pass.handle, nullptr);
    }
    device_.fn.DestroyPipelineLayout(device_.handle, pipeline.layout, nullptr);
}

Result<Pipeline> PipelineMaker::make(const gpu::RenderPipelineDesc& desc,
                                     const PipelineParts& parts,
                                     std::span<const HostPass> host_passes) {
    if (const Status supported = check_supported(desc); !supported) {
        return forward_error(supported);
    }
    const std::string subject = fmt::format("render pipeline '{}'", desc.label);
    const Result<VkRenderPass> render_pass = render_passes_.render_pass(compatible_key(desc));
    if (!render_pass) {
        return forward_error(render_pass);
    }

    std::array<VkPipelineShaderStageCreateInfo, 2> stages{
        stage(VK_SHADER_STAGE_VERTEX_BIT, parts.vertex),
        stage(VK_SHADER_STAGE_FRAGMENT_BIT, parts.fragment)};
    if (device_.y_up == YUp::Viewport) {
        stages[0].pSpecializationInfo = &keep_y;
    }
    const VertexInput input = vertex_input(desc);
    VkPipelineVertexInputStateCreateInfo vertex{};
    vertex.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    vertex.vertexBindingDescriptionCount = static_cast<std::uint32_t>(input.bindings.size());
    vertex.pVertexBindingDescriptions = input.bindings.data();
    vertex.vertexAttributeDescriptionCount = static_cast<std::uint32_t>(input.attributes.size());
    vertex.pVertexAttributeDescriptions = input.attributes.data();
    VkPipelineInputAssemblyStateCreateInfo assembly{};
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = to_vk(desc.primitive.topology);
    VkPipelineViewportStateCreateInfo viewport{};
    viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;
    const VkPipelineRasterizationStateCreateInfo raster = rasterization(desc);
    VkPipelineMultisampleStateCreateInfo multisample{};
    multisample.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    multisample.rasterizationSamples = to_vk_samples(desc.sample_count);
    const VkPipelineDepthStencilStateCreateInfo depth =
        depth_stencil(desc.depth_stencil.value_or(gpu::DepthStencilState{}));
    std::vector<VkPipelineColorBlendAttachmentState> targets;
    for (const gpu::ColorTargetState& target : desc.targets) {
        targets.push_back(blend_state(target));
    }
    VkPipelineColorBlendStateCreateInfo blend{};
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = static_cast<std::uint32_t>(targets.size());
    blend.pAttachments = targets.data();
    constexpr std::array<VkDynamicState, 5> dynamic_states{
        VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR, VK_DYNAMIC_STATE_STENCIL_REFERENCE,
        VK_DYNAMIC_STATE_BLEND_CONSTANTS, VK_DYNAMIC_STATE_DEPTH_BOUNDS};
    VkPipelineDynamicStateCreateInfo dynamic{};
    dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
    dynamic.dynamicStateCount = static_cast<std::uint32_t>(dynamic_states.size());
    dynamic.pDynamicStates = dynamic_states.data();

    Pipeline pipeline;
    pipeline.bind_group_layouts = desc.bind_group_layouts;
    VkPipelineLayoutCreateInfo layout{};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.setLayoutCount = static_cast<std::uint32_t>(parts.set_layouts.size());
    layout.pSetLayouts = parts.set_layouts.data();
    if (const VkResult result =
            device_.fn.CreatePipelineLayout(device_.handle, &layout, nullptr, &pipeline.layout);
        result != VK_SUCCESS) {
        return failure(result, "vkCreatePipelineLayout", subject);
    }

    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.stageCount = parts.fragment != VK_NULL_HANDLE ? 2 : 1;
    info.pStages = stages.data();
    info.pVertexInputState = &vertex;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &multisample;
    info.pDepthStencilState = desc.depth_stencil ? &depth : nullptr;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = pipeline.layout;
    info.renderPass = *render_pass;
    if (const VkResult result = device_.fn.CreateGraphicsPipelines(device_.handle, cache_, 1, &info,
                                                                   nullptr, &pipeline.handle);
        result != VK_SUCCESS) {
        device_.fn.DestroyPipelineLayout(device_.handle, pipeline.layout, nullptr);
        return failure(result, "vkCreateGraphicsPipelines", subject);
    }
    device_.set_name(VK_OBJECT_TYPE_PIPELINE, pipeline.handle, desc.label);
    for (const HostPass& host : host_passes) {
        if (const Status made = make_in_host_pass(info, desc, host, pipeline); !made) {
            free(pipeline);
            return forward_error(made);
        }
    }
    return pipeline;
}

}  // namespace gnomon::vk
