// SPDX-License-Identifier: MIT
//
// How the host reads its images back: by a copy, or sample by sample with a shader.
#include <array>
#include <cstring>

#include <gnomon_shaders/guest.hpp>

#include "tests/guest/vk_host.hpp"

namespace gnomon::test {

namespace {

constexpr VkImageLayout sampled = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;

}  // namespace

void VkHost::move_image(const Image& image, VkImageLayout from, VkImageLayout to) {
    auto barrier = vk_info<VkImageMemoryBarrier>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER);
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.oldLayout = from;
    barrier.newLayout = to;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image.handle;
    barrier.subresourceRange = {image.aspects, 0, 1, 0, 1};
    CmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                       VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

std::vector<std::byte> VkHost::read(const Image& image, VkImageAspectFlags aspect,
                                    VkImageLayout layout, std::size_t texel_bytes) {
    std::vector<std::byte> bytes(std::size_t{row_width} * row_height * texel_bytes);
    const Buffer buffer = make_buffer(nullptr, bytes.size(), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    begin();
    move_image(image, layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    VkBufferImageCopy region{};
    region.imageSubresource = {aspect, 0, 0, 1};
    region.imageExtent = {row_width, row_height, 1};
    CmdCopyImageToBuffer(commands_, image.handle, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                         buffer.handle, 1, &region);
    move_image(image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, layout);
    end();
    void* mapped = nullptr;
    check_vk(MapMemory(device_, buffer.memory, 0, bytes.size(), 0, &mapped), "mapping");
    std::memcpy(bytes.data(), mapped, bytes.size());
    UnmapMemory(device_, buffer.memory);
    free_buffer(buffer);
    return bytes;
}

std::vector<std::uint8_t> VkHost::stencil() {
    const auto bytes = read(depth_, VK_IMAGE_ASPECT_STENCIL_BIT, way_.layout, 1);
    std::vector<std::uint8_t> rows(bytes.size());
    std::memcpy(rows.data(), bytes.data(), bytes.size());
    return rows;
}

std::vector<std::uint8_t> VkHost::stencil_sample(std::uint32_t sample) {
    const auto values = fetch_sample(depth_, depth_.stencil_view, way_.layout, sample);
    return {values.begin(), values.end()};
}

std::size_t VkHost::make_mask(VkFormat format, std::uint32_t samples) {
    masks_.push_back(make_image(
        format, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT, samples));
    return masks_.size() - 1;
}

vk::HostImage VkHost::mask(std::size_t number) const {
    return {reinterpret_cast<std::uint64_t>(masks_.at(number).handle), sampled};
}

std::vector<std::uint32_t> VkHost::read_bits(std::size_t number, std::uint32_t sample) {
    const Image& mask = masks_.at(number);
    if (mask.samples > 1) return fetch_sample(mask, mask.view, sampled, sample);
    const auto bytes = read(mask, VK_IMAGE_ASPECT_COLOR_BIT, sampled, 4);
    std::vector<std::uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), bytes.size());
    return words;
}

std::vector<std::uint8_t> VkHost::read_bytes(std::size_t number) {
    const auto bytes = read(masks_.at(number), VK_IMAGE_ASPECT_COLOR_BIT, sampled, 1);
    std::vector<std::uint8_t> rows(bytes.size());
    std::memcpy(rows.data(), bytes.data(), bytes.size());
    return rows;
}

std::vector<std::uint32_t> VkHost::fetch_sample(const Image& image, VkImageView view,
                                                VkImageLayout layout, std::uint32_t sample) {
    if (fetching_.pipeline == VK_NULL_HANDLE) make_fetching();
    const VkImageLayout readable = image.aspects == VK_IMAGE_ASPECT_COLOR_BIT
                                       ? sampled
                                       : VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
    const VkDescriptorImageInfo source{fetching_.sampler, view, readable};
    auto write = vk_info<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
    write.dstSet = fetching_.set;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    write.pImageInfo = &source;
    UpdateDescriptorSets(device_, 1, &write, 0, nullptr);
    begin();
    move_image(image, layout, readable);
    auto pass = vk_info<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
    pass.renderPass = fetching_.render_pass;
    pass.framebuffer = fetching_.framebuffer;
    pass.renderArea = {{0, 0}, {row_width, row_height}};
    CmdBeginRenderPass(commands_, &pass, VK_SUBPASS_CONTENTS_INLINE);
    CmdBindPipeline(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, fetching_.pipeline);
    CmdBindDescriptorSets(commands_, VK_PIPELINE_BIND_POINT_GRAPHICS, fetching_.layout, 0, 1,
                          &fetching_.set, 0, nullptr);
    CmdPushConstants(commands_, fetching_.layout, VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof sample,
                     &sample);
    CmdDraw(commands_, 3, 1, 0, 0);
    CmdEndRenderPass(commands_);
    move_image(image, readable, layout);
    end();
    const auto bytes =
        read(fetching_.target, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_GENERAL, 4);
    std::vector<std::uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), bytes.size());
    return words;
}

void VkHost::make_fetching() {
    Fetching& f = fetching_;
    const auto sampler = vk_info<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
    check_vk(CreateSampler(device_, &sampler, nullptr, &f.sampler), "sampler");
    at_the_end([this] { DestroySampler(device_, fetching_.sampler, nullptr); });
    const VkDescriptorSetLayoutBinding binding{0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1,
                                               VK_SHADER_STAGE_FRAGMENT_BIT, nullptr};
    auto set_layout = vk_info<VkDescriptorSetLayoutCreateInfo>(
        VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    set_layout.bindingCount = 1;
    set_layout.pBindings = &binding;
    check_vk(CreateDescriptorSetLayout(device_, &set_layout, nullptr, &f.set_layout),
             "descriptor set layout");
    at_the_end([this] { DestroyDescriptorSetLayout(device_, fetching_.set_layout, nullptr); });
    const VkDescriptorPoolSize one{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1};
    auto pool_info =
        vk_info<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    pool_info.maxSets = 1;
    pool_info.poolSizeCount = 1;
    pool_info.pPoolSizes = &one;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    check_vk(CreateDescriptorPool(device_, &pool_info, nullptr, &pool), "descriptor pool");
    at_the_end([this, pool] { DestroyDescriptorPool(device_, pool, nullptr); });
    auto set = vk_info<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    set.descriptorPool = pool;
    set.descriptorSetCount = 1;
    set.pSetLayouts = &f.set_layout;
    check_vk(AllocateDescriptorSets(device_, &set, &f.set), "descriptor set");
    make_fetching_pass();
    make_fetching_pipeline();
}

void VkHost::make_fetching_pass() {
    Fetching& f = fetching_;
    f.target = make_image(VK_FORMAT_R32_UINT, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, 1);
    VkAttachmentDescription attachment{};
    attachment.format = VK_FORMAT_R32_UINT;
    attachment.samples = VK_SAMPLE_COUNT_1_BIT;
    attachment.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
    attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    attachment.finalLayout = VK_IMAGE_LAYOUT_GENERAL;
    const VkAttachmentReference color{0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
    VkSubpassDescription subpass{};
    subpass.colorAttachmentCount = 1;
    subpass.pColorAttachments = &color;
    VkSubpassDependency before{};
    before.srcSubpass = VK_SUBPASS_EXTERNAL;
    before.srcStageMask = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
    before.dstStageMask = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
    before.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    before.dstAccessMask = VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT;
    auto info = vk_info<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
    info.attachmentCount = 1;
    info.pAttachments = &attachment;
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    info.dependencyCount = 1;
    info.pDependencies = &before;
    check_vk(CreateRenderPass(device_, &info, nullptr, &f.render_pass), "render pass");
    at_the_end([this] { DestroyRenderPass(device_, fetching_.render_pass, nullptr); });
    auto framebuffer = vk_info<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
    framebuffer.renderPass = f.render_pass;
    framebuffer.attachmentCount = 1;
    framebuffer.pAttachments = &f.target.view;
    framebuffer.width = row_width;
    framebuffer.height = row_height;
    framebuffer.layers = 1;
    check_vk(CreateFramebuffer(device_, &framebuffer, nullptr, &f.framebuffer), "framebuffer");
    at_the_end([this] { DestroyFramebuffer(device_, fetching_.framebuffer, nullptr); });
}

void VkHost::make_fetching_pipeline() {
    Fetching& f = fetching_;
    const auto make_stage = [this](VkShaderStageFlagBits which, const gpu::ShaderSource& source) {
        auto module =
            vk_info<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
        module.codeSize = source.spirv.size_bytes();
        module.pCode = source.spirv.data();
        auto stage = vk_info<VkPipelineShaderStageCreateInfo>(
            VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
        check_vk(CreateShaderModule(device_, &module, nullptr, &stage.module), "shader");
        stage.stage = which;
        stage.pName = "main";
        at_the_end(
            [this, shader = stage.module] { DestroyShaderModule(device_, shader, nullptr); });
        return stage;
    };
    const std::array stages{
        make_stage(VK_SHADER_STAGE_VERTEX_BIT, guest::shaders::full_screen_vert),
        make_stage(VK_SHADER_STAGE_FRAGMENT_BIT, guest::shaders::sample_frag)};
    const VkPushConstantRange constants{VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(std::uint32_t)};
    auto layout =
        vk_info<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &f.set_layout;
    layout.pushConstantRangeCount = 1;
    layout.pPushConstantRanges = &constants;
    check_vk(CreatePipelineLayout(device_, &layout, nullptr, &f.layout), "pipeline layout");
    at_the_end([this] { DestroyPipelineLayout(device_, fetching_.layout, nullptr); });
    const auto input = vk_info<VkPipelineVertexInputStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
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
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineColorBlendAttachmentState written{};
    written.colorWriteMask = VK_COLOR_COMPONENT_R_BIT;
    auto blend = vk_info<VkPipelineColorBlendStateCreateInfo>(
        VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
    blend.attachmentCount = 1;
    blend.pAttachments = &written;
    auto info =
        vk_info<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
    info.stageCount = stages.size();
    info.pStages = stages.data();
    info.pVertexInputState = &input;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewports;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &samples;
    info.pColorBlendState = &blend;
    info.layout = f.layout;
    info.renderPass = f.render_pass;
    check_vk(CreateGraphicsPipelines(device_, VK_NULL_HANDLE, 1, &info, nullptr, &f.pipeline),
             "pipeline");
    at_the_end([this] { DestroyPipeline(device_, fetching_.pipeline, nullptr); });
}

}  // namespace gnomon::test
