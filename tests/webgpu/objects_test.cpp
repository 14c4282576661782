// SPDX-License-Identifier: MIT
//
// Descriptors as WebGPU's dictionaries.
#include "internal/objects.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace gnomon::webgpu {
namespace {

using Json = nlohmann::json;

template <class Tag>
gpu::Id<Tag> id(std::uint32_t index) {
    return {.index = index, .generation = 1};
}

void expect_json(const std::string& actual, const char* expected) {
    EXPECT_EQ(Json::parse(actual).dump(1), Json::parse(expected).dump(1));
}

TEST(Objects, Texture) {
    expect_json(describe(gpu::TextureDesc{
                    .label = "t",
                    .width = 3,
                    .height = 2,
                    .format = gpu::Format::Depth32FloatStencil8,
                    .usage = gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::CopySrc,
                    .sample_count = 4}),
                R"({"label": "t", "size": [3, 2], "format": "depth32float-stencil8", "usage": 17,
                    "mipLevelCount": 1, "sampleCount": 4})");
}

TEST(Objects, ATextureOfAHostsHasTheNumberThatThePageAdoptedItBy) {
    expect_json(
        describe(gpu::TextureDesc{.label = "t",
                                  .width = 3,
                                  .height = 2,
                                  .format = gpu::Format::R32Uint,
                                  .usage = gpu::TextureUsage::RenderAttachment},
                 7),
        R"({"label": "t", "size": [3, 2], "format": "r32uint", "usage": 16, "mipLevelCount": 1,
            "sampleCount": 1, "adopted": 7})");
}

TEST(Objects, Sampler) {
    expect_json(describe(gpu::SamplerDesc{.label = "s",
                                          .address_mode_u = gpu::AddressMode::MirrorRepeat,
                                          .mag_filter = gpu::FilterMode::Linear}),
                R"({"label": "s", "addressModeU": "mirror-repeat", "addressModeV": "clamp-to-edge",
                    "magFilter": "linear", "minFilter": "nearest", "mipmapFilter": "nearest"})");
}

TEST(Objects, LayoutsHaveASamplerBesideWhatIsFiltered) {
    using gpu::BindingType;
    using gpu::SampleType;
    using gpu::ShaderStage;
    expect_json(describe(gpu::BindGroupLayoutDesc{
                    .label = "l",
                    .entries = {{.binding = 0,
                                 .visibility = ShaderStage::Vertex | ShaderStage::Fragment,
                                 .has_dynamic_offset = true,
                                 .min_binding_size = 64},
                                {.binding = 1,
                                 .visibility = ShaderStage::Fragment,
                                 .type = BindingType::SampledTexture},
                                {.binding = 2,
                                 .visibility = ShaderStage::Fragment,
                                 .type = BindingType::SampledTexture,
                                 .multisampled = true},
                                {.binding = 3,
                                 .visibility = ShaderStage::Vertex,
                                 .type = BindingType::SampledTexture,
                                 .sample_type = SampleType::Uint},
                                {.binding = 4,
                                 .visibility = ShaderStage::Fragment,
                                 .type = BindingType::SampledTexture,
                                 .sample_type = SampleType::Depth}}}),
                R"({"label": "l", "entries": [
            {"binding": 0, "visibility": 3,
             "buffer": {"type": "uniform", "hasDynamicOffset": true, "minBindingSize": 64}},
            {"binding": 1, "visibility": 2, "texture": {"sampleType": "float", "multisampled": false}},
            {"binding": 101, "visibility": 2, "sampler": {"type": "filtering"}},
            {"binding": 2, "visibility": 2,
             "texture": {"sampleType": "unfilterable-float", "multisampled": true}},
            {"binding": 3, "visibility": 1, "texture": {"sampleType": "uint", "multisampled": false}},
            {"binding": 4, "visibility": 2, "texture": {"sampleType": "depth", "multisampled": false}}]})");
}

TEST(Objects, BindGroupsWithoutASamplerSayNull) {
    const gpu::BindGroupLayoutDesc layout{
        .entries = {{.binding = 1, .visibility = gpu::ShaderStage::Fragment},
                    {.binding = 2,
                     .visibility = gpu::ShaderStage::Fragment,
                     .type = gpu::BindingType::SampledTexture}}};
    expect_json(describe(
                    gpu::BindGroupDesc{
                        .label = "g",
                        .layout = id<gpu::BindGroupLayoutTag>(4),
                        .entries = {{.binding = 1, .buffer = id<gpu::BufferTag>(5), .offset = 256},
                                    {.binding = 2,
                                     .texture = id<gpu::TextureTag>(6),
                                     .aspect = gpu::Aspect::StencilOnly}}},
                    layout),
                R"({"label": "g", "layout": 4, "entries": [
            {"binding": 1, "buffer": {"buffer": 5, "offset": 256}},
            {"binding": 2, "texture": 6, "aspect": "stencil-only"},
            {"binding": 102, "sampler": null}]})");
}

TEST(Objects, AVolumePipeline) {
    const gpu::RenderPipelineDesc desc{
        .label = "p",
        .bind_group_layouts = {id<gpu::BindGroupLayoutTag>(1)},
        .vertex = id<gpu::ShaderTag>(2),
        .vertex_buffers = {{.array_stride = 148,
                            .step_mode = gpu::VertexStepMode::Instance,
                            .attributes = {{.format = gpu::VertexFormat::Float32x4,
                                            .offset = 16,
                                            .shader_location = 3}}}},
        .primitive = {.unclipped_depth = true},
        .depth_stencil =
            gpu::DepthStencilState{.format = gpu::Format::Depth32FloatStencil8,
                                   .depth_compare = gpu::Compare::Greater,
                                   .stencil_front = {.pass_op = gpu::StencilOp::IncrementWrap},
                                   .stencil_back = {.pass_op = gpu::StencilOp::DecrementWrap}}};
    expect_json(describe(desc), R"({"label": "p", "layout": [1],
        "vertex": {"module": 2, "buffers": [{"arrayStride": 148, "stepMode": "instance",
            "attributes": [{"format": "float32x4", "offset": 16, "shaderLocation": 3}]}]},
        "primitive": {"topology": "triangle-list", "frontFace": "ccw", "cullMode": "none",
                      "unclippedDepth": true},
        "multisample": {"count": 1},
        "depthStencil": {"format": "depth32float-stencil8", "depthWriteEnabled": false,
            "depthCompare": "greater", "depthBias": 0, "depthBiasSlopeScale": 0.0,
            "depthBiasClamp": 0.0, "stencilReadMask": 255, "stencilWriteMask": 255,
            "stencilFront": {"compare": "always", "failOp": "keep", "depthFailOp": "keep",
                             "passOp": "increment-wrap"},
            "stencilBack": {"compare": "always", "failOp": "keep", "depthFailOp": "keep",
                            "passOp": "decrement-wrap"}}})");
}

TEST(Objects, APipelineWithColour) {
    gpu::RenderPipelineDesc desc{
        .label = "p",
        .vertex = id<gpu::ShaderTag>(2),
        .fragment = id<gpu::ShaderTag>(3),
        .primitive = {.cull_mode = gpu::CullMode::Back},
        .targets = {{.format = gpu::Format::Rgba16Float,
                     .blend = gpu::BlendState{.color = {.src_factor = gpu::BlendFactor::SrcAlpha,
                                                        .dst_factor =
                                                            gpu::BlendFactor::OneMinusSrcAlpha}},
                     .write_mask = gpu::ColorWrite::Red | gpu::ColorWrite::Alpha}},
        .sample_count = 4};
    expect_json(describe(desc), R"({"label": "p", "layout": [],
        "vertex": {"module": 2, "buffers": []},
        "primitive": {"topology": "triangle-list", "frontFace": "ccw", "cullMode": "back"},
        "multisample": {"count": 4},
        "fragment": {"module": 3, "targets": [{"format": "rgba16float", "writeMask": 9,
            "blend": {"color": {"operation": "add", "srcFactor": "src-alpha",
                                "dstFactor": "one-minus-src-alpha"},
                      "alpha": {"operation": "add", "srcFactor": "one", "dstFactor": "zero"}}}]}})");
}

TEST(Objects, LabelsMayHoldAnything) {
    const std::string text = describe(
        gpu::QuerySetDesc{.label = "\"\\\n\xFF", .type = gpu::QueryType::Timestamp, .count = 2});
    const Json json = Json::parse(text);
    EXPECT_EQ(json["type"], "timestamp");
    EXPECT_EQ(json["count"], 2);
}

}  // namespace
}  // namespace gnomon::webgpu
