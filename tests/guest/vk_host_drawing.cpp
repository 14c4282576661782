// SPDX-License-Identifier: MIT
//
// How the host draws its scene: in a render pass of one subpass or two, or by dynamic rendering.
#include <array>

#include <gnomon/scene/scene.hpp>
#include <gnomon/scene/transforms.hpp>
#include <gnomon_shaders/guest.hpp>

#include "tests/guest/vk_host.hpp"

namespace gnomon::test {

namespace {

constexpr VkFormat depth_format = VK_FORMAT_D32_SFLOAT_S8_UINT;
constexpr VkFormat color_format = VK_FORMAT_B8G8R8A8_UNORM;

// What its matrices move points by, in push constants.
struct Matrices {
    glm::mat4 clip_from_world;
    glm::mat4 world_from_local;
};

VkAttachmentDescription cleared(VkFormat format, std::uint32_t samples, VkImageLayout afterwards) {
    VkAttachmentDescription attachment{};
    attachment.format = format;
    attachment.samples = static_cast<VkSampleCountFlagBits>(samples);
    attachment.loadOp = attachment.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    attachment.storeOp = attachment.stencilStoreOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachment.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    attachment.finalLayout = afterwards;
    return attachment;
}

}  // namespace

// Depth alone in one subpass, or with a colour in the second of two.
void VkHost::make_render_pass() {
    const bool two = way_.in_pass == InPass::Classic;
    const std::array attachments{
        cleared(depth_format, way_.samples, way_.layout),
        cleared(color_format, way_.samples, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL)};
    const VkAttachmentReference depth{0, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL};
    const VkAttachmentReference color{1, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    std::array<VkSubpassDescription, 2> subpasses{};
    VkSubpassDescription& drawing = subpasses[two ? 1 : 0];
    drawing.pDepthStencilAttachment = &depth;
    drawing.colorAttachmentCount = two ? 1 : 0;
    drawing.pColorAttachments = &color;
    // Drawn to again and again: after all that came before.
    VkSubpassDependency before{};
    before.srcSubpass = VK_SUBPASS_EXTERNAL;
    before.dstSubpass = two ? 1 : 0;
    before.srcStageMask = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
    before.dstStageMask =
        VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    before.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    before.dstAccessMask = VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT |
                           VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
                           VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
    auto info = vk_info<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
    info.attachmentCount = two ? 2 : 1;
    info.pAttachments = attachments.data();
    info.subpassCount = two ? 2 : 1;
    info.pSubpasses = subpasses.data();
    info.dependencyCount = 1;
    info.pDependencies = &before;
    check_vk(CreateRenderPass(device_, &info, nullptr, &render_pass_), "render pass");
    at_the_end([this] { DestroyRenderPass(device_, render_pass_, nullptr); });
    const std::array views{depth_.view, color_.view};
    auto framebuffer = vk_info<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
    framebuffer.renderPass = render_pass_;
    framebuffer.attachmentCount = info.attachmentCount;
    framebuffer.pAttachments = views.data();
    framebuffer.width = row_width;
    framebuffer.height = row_height;
    framebuffer.layers = 1;
    check_vk(CreateFramebuffer(device_, &framebuffer, nullptr, &framebuffer_), "framebuffer");
    at_the_end([this] { DestroyFramebuffer(device_, framebuffer_, nullptr); });
}

void VkHost::make_pipeline() {
    auto module = vk_info<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    module.codeSize = guest::shaders::host_vert.spirv.size_bytes();
    module.pCode = guest::shaders::host_vert.spirv.data();
    auto stage = vk_info<VkPipelineShaderStageCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
    check_vk(CreateShaderModule(device_, &module, nullptr, &stage.module), "shader");
    stage.stage = VK_SHADER_STAGE_VERTEX_BIT;
    stage.pName = "main";
    const VkPushConstantRange constants{VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(Matrices)};
    auto layout =
        vk_info<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    layout.pushConstantRangeCount = 1;
    layout.pPushConstantRanges = &constants;
    check_vk(CreatePipelineLayout(device_, &layout, nullptr, &layout_), "pipeline layout");
    at_the_end([this] { DestroyPipelineLayout(device_, layout_, nullptr); });
    const VkVertexInputBindingDescription binding{0, sizeof(glm::vec3),
                                                  VK_VERTEX_INPUT_RATE_VERTEX};
    const VkVertexInputAttributeDescription attribute{0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0};
    auto input = vk_info<VkPipelineVertexInputStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
    input.vertexBindingDescriptionCount = 1;
    input.pVertexBindingDescriptions = &binding;
    input.vertexAttributeDescriptionCount = 1;
    input.pVertexAttributeDescriptions = &attribute;
    auto assembly = vk_info<VkPipelineInputAssemblyStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    const VkViewport viewport{0, 0, row_width, row_height, 0, 1};
    const VkRect2D scissor{{0, 0}, {row_width, row_height}};
    auto viewports = vk_info<VkPipelineViewportStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
    viewports.viewportCount = viewports.scissorCount = 1;
    viewports.pViewports = &viewport;
    viewports.pScissors = &scissor;
    auto raster = vk_info<VkPipelineRasterizationStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
    raster.lineWidth = 1.0F;
    auto samples = vk_info<VkPipelineMultisampleStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
    samples.rasterizationSamples = static_cast<VkSampleCountFlagBits>(way_.samples);
    auto depth = vk_info<VkPipelineDepthStencilStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
    depth.depthTestEnable = depth.depthWriteEnable = VK_TRUE;
    depth.depthCompareOp = way_.reversed ? VK_COMPARE_OP_GREATER : VK_COMPARE_OP_LESS;
    const VkPipelineColorBlendAttachmentState nothing{};
    auto blend = vk_info<VkPipelineColorBlendStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
    blend.attachmentCount = way_.in_pass != InPass::No ? 1 : 0;
    blend.pAttachments = &nothing;
    auto rendering =
        vk_info<VkPipelineRenderingCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO);
    rendering.colorAttachmentCount = 1;
    rendering.pColorAttachmentFormats = &color_format;
    rendering.depthAttachmentFormat = rendering.stencilAttachmentFormat = depth_format;
    auto info =
        vk_info<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
    if (way_.in_pass == InPass::Dynamic) info.pNext = &rendering;
    info.stageCount = 1;
    info.pStages = &stage;
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewports;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.layout = layout_;
    info.renderPass = render_pass_;
    info.subpass = way_.in_pass == InPass::Classic ? 1 : 0;
    check_vk(CreateGraphicsPipelines(device_, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_),
             "pipeline");
    at_the_end([this] { DestroyPipeline(device_, pipeline_, nullptr); });
    DestroyShaderModule(device_, stage.module, nullptr);
}

void VkHost::begin_pass() {
    std::array<VkClearValue, 2> clears{};
    clears[0].depthStencil = {way_.reversed ? 0.0F : 1.0F, 0x55};
    if (way_.in_pass != InPass::Dynamic) {
        auto pass = vk_info<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
        pass.renderPass = render_pass_;
        pass.framebuffer = framebuffer_;
        pass.renderArea = {{0, 0}, {row_width, row_height}};
        pass.clearValueCount = 2;
        pass.pClearValues = clears.data();
        CmdBeginRenderPass(commands_, &pass, VK_SUBPASS_CONTENTS_INLINE);
        if (way_.in_pass == InPass::Classic) CmdNextSubpass(commands_, VK_SUBPASS_CONTENTS_INLINE);
        return;
    }
    move_image(depth_, VK_IMAGE_LAYOUT_UNDEFINED, way_.layout);
    move_image(color_, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    auto color = vk_info<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
    color.imageView = color_.view;
    color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingAttachmentInfo depth = color;
    depth.imageView = depth_.view;
    depth.imageLayout = way_.layout;
    depth.clearValue = clears[0];
    auto rendering = vk_info<VkRenderingInfo>(VK_STRUCTURE_TYPE_RENDERING_INFO);
    rendering.renderArea = {{0, 0}, {row_width, row_height}};
    rendering.layerCount = 1;
    rendering.colorAttachmentCount = 1;
    rendering.pColorAttachments = &color;
    rendering.pDepthAttachment = rendering.pStencilAttachment = &depth;
    CmdBeginRendering(commands_, &rendering);
}

void VkHost::end_pass() {
    if (way_.in_pass == InPass::Dynamic) {
        CmdEndRendering(commands_);
    } else {
        CmdEndRenderPass(commands_);
    }
}

void VkHost::draw(const Setting& setting, const std::function<void(VkCommandBuffer)>& in_pass) {
    const Camera camera = camera_of(setting);
    begin();
    begin_pass();
    CmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
    std::vector<Buffer>& buffers = read_by_submitted_;
    setting.scene.registry.each<scene::Receiver, scene::MeshInstance, scene::WorldTransform>(
        [&](scene::Entity entity, const scene::Receiver&, const scene::MeshInstance& instance,
            const scene::WorldTransform& transform) {
            const scene::Geometry geometry =
                scene::geometry_of(setting.scene.registry, entity, instance, transform);
            const auto bytes = std::as_bytes(geometry.positions);
            const std::vector<std::uint32_t>& indices = instance.mesh->indices;
            buffers.push_back(
                make_buffer(bytes.data(), bytes.size(), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT));
            const VkDeviceSize zero = 0;
            CmdBindVertexBuffers(commands_, 0, 1, &buffers.back().handle, &zero);
            buffers.push_back(
                make_buffer(indices.data(), 4 * indices.size(), VK_BUFFER_USAGE_INDEX_BUFFER_BIT));
            CmdBindIndexBuffer(commands_, buffers.back().handle, 0, VK_INDEX_TYPE_UINT32);
            Matrices matrices{camera.clip_from_view * camera.view_from_world,
                              glm::mat4(geometry.world_from_positions)};
            // The build lets every vertex shader negate y at its end, this host's as well.
            for (int c = 0; c < 4; ++c) {
                matrices.clip_from_world[c][1] = -matrices.clip_from_world[c][1];
            }
            CmdPushConstants(commands_, layout_, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof matrices,
                             &matrices);
            CmdDrawIndexed(commands_, static_cast<std::uint32_t>(indices.size()), 1, 0, 0, 0);
        });
    if (in_pass) in_pass(commands_);
    end_pass();
    end();
}

}  // namespace gnomon::test
