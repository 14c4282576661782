// SPDX-License-Identifier: MIT
//
// The rules of objects that name no others: buffers, textures, shaders, query sets.
#include "mock_backend.hpp"
#include "world.hpp"

namespace gnomon::gpu::test {
namespace {

Device device_without(bool Features::*feature) {
    NullBackendOptions options;
    options.features.*feature = false;
    return Device(create_null_backend(options));
}

TEST(Descriptor, Buffer) {
    Device device(create_null_backend());
    const BufferDesc base{"b", 64, BufferUsage::Vertex};
    const std::vector<Row<BufferDesc>> rows = {
        {[](auto& d) { d.size = 0; }, "The size of [Buffer \"b\"] is zero."},
        {[](auto& d) { d.size = 4; }, valid},
        {[](auto& d) { d.size = 6; }, "The size (6) of [Buffer \"b\"] is not a multiple of 4."},
        {[](auto& d) { d.size = 268435460; },
         "The size (268435460) of [Buffer \"b\"] exceeds max_buffer_size (268435456)."},
        {[](auto& d) { d.usage = BufferUsage::None; }, "[Buffer \"b\"] has no usage."},
        {[](auto& d) { d.usage = static_cast<BufferUsage>(0x41); },
         "The usage (CopySrc | 0x40) of [Buffer \"b\"] has unknown bits."},
    };
    expect_rows(base, rows, "While creating [Buffer \"b\"].",
                [&](const BufferDesc& desc) { return device.create_buffer(desc); });
}

TEST(Descriptor, UnlabelledObjectsAreNamedByTheirKind) {
    Device device(create_null_backend());
    expect_outcome(device.create_buffer({}),
                   "The size of [Buffer] is zero. While creating [Buffer].");
}

TEST(Descriptor, Texture) {
    Device device(create_null_backend());
    const TextureDesc base = target_desc("t", Format::Rgba8Unorm);
    const std::vector<Row<TextureDesc>> rows = {
        {[](auto& d) { d.width = 0; }, "The size (0 x 32) of [Texture \"t\"] is zero."},
        {[](auto& d) { d.height = 0; }, "The size (64 x 0) of [Texture \"t\"] is zero."},
        {[](auto& d) { d.width = 8192, d.height = 1; }, valid},
        {[](auto& d) { d.width = 8193; },
         "The size (8193 x 32) of [Texture \"t\"] exceeds max_texture_dimension_2d (8192)."},
        {[](auto& d) { d.height = 8193; },
         "The size (64 x 8193) of [Texture \"t\"] exceeds max_texture_dimension_2d (8192)."},
        {[](auto& d) { d.format = Format::Undefined; },
         "The format of [Texture \"t\"] is Undefined."},
        {[](auto& d) { d.format = static_cast<Format>(99); },
         "The format of [Texture \"t\"] is unknown."},
        {[](auto& d) { d.usage = TextureUsage::None; }, "[Texture \"t\"] has no usage."},
        {[](auto& d) { d.usage = static_cast<TextureUsage>(16); },
         "The usage (0x10) of [Texture \"t\"] has unknown bits."},
        {[](auto& d) { d.mip_level_count = 0; },
         "The mip level count (0) of [Texture \"t\"] is not within 1 and 7, as 64 x 32 allows."},
        {[](auto& d) { d.mip_level_count = 7; }, valid},
        {[](auto& d) { d.mip_level_count = 8; },
         "The mip level count (8) of [Texture \"t\"] is not within 1 and 7, as 64 x 32 allows."},
        {[](auto& d) { d.sample_count = 4; }, valid},
        {[](auto& d) { d.sample_count = 2; },
         "The sample count (2) of [Texture \"t\"] is neither 1 nor 4."},
        {[](auto& d) { d.sample_count = 4, d.mip_level_count = 2; },
         "[Texture \"t\"] is multisampled, but has 2 mip levels instead of 1."},
        {[](auto& d) { d.sample_count = 4, d.usage = TextureUsage::TextureBinding; },
         "[Texture \"t\"] is multisampled, but its usage (TextureBinding) lacks "
         "RenderAttachment."},
    };
    expect_rows(base, rows, "While creating [Texture \"t\"].",
                [&](const TextureDesc& desc) { return device.create_texture(desc); });
}

TEST(Descriptor, TextureFormatsAreThoseOfTheAdapter) {
    struct Case {
        Format format;
        bool Features::*feature;
        const char* name;
    };
    for (const Case& c : {Case{Format::Depth24UnormStencil8, &Features::depth24unorm_stencil8,
                               "Depth24UnormStencil8"},
                          Case{Format::Depth32FloatStencil8, &Features::depth32float_stencil8,
                               "Depth32FloatStencil8"}}) {
        Device all(create_null_backend());
        expect_outcome(all.create_texture(target_desc("t", c.format)), valid);
        Device some = device_without(c.feature);
        expect_outcome(some.create_texture(target_desc("t", c.format)),
                       std::string("The format of [Texture \"t\"] is ") + c.name +
                           ", which this adapter does not have. While creating [Texture \"t\"].");
        expect_outcome(some.create_texture(target_desc("t", Format::Depth32Float)), valid);
    }
    expect_outcome(device_without(&Features::multisample_4)
                       .create_texture(target_desc("t", Format::Rgba8Unorm, 4)),
                   "The sample count of [Texture \"t\"] is 4, but this adapter has no "
                   "multisample_4. While creating [Texture \"t\"].");
    Device narrow = device_without(&Features::multisample_32bit);
    expect_outcome(narrow.create_texture(target_desc("t", Format::R32Float, 4)), valid);
    expect_outcome(narrow.create_texture(target_desc("t", Format::R32Uint, 4)),
                   "The sample count of [Texture \"t\"] is 4, but its format is R32Uint and this "
                   "adapter has no multisample_32bit. While creating [Texture \"t\"].");
}

TEST(Descriptor, SamplersAreAlwaysValid) {
    Device device(create_null_backend());
    expect_outcome(device.create_sampler({}), valid);
    expect_outcome(device.create_sampler({.label = "s",
                                          .address_mode_u = AddressMode::MirrorRepeat,
                                          .min_filter = FilterMode::Linear}),
                   valid);
}

TEST(Descriptor, Shader) {
    Device device(create_null_backend());
    const std::vector<Row<ShaderDesc>> rows = {
        {[](auto& d) { d.stage = ShaderStage::Vertex; }, valid},
        {[](auto& d) { d.stage = ShaderStage::None; },
         "The stage of [Shader \"s\"] is None instead of either Vertex or Fragment."},
        {[](auto& d) { d.stage = ShaderStage::Vertex | ShaderStage::Fragment; },
         "The stage of [Shader \"s\"] is Vertex | Fragment instead of either Vertex or Fragment."},
        {[](auto& d) { d.source.glsl = {}; }, valid},
        {[](auto& d) { d.source.spirv = {}; }, valid},
        {[](auto& d) { d.source = {}; }, "The source of [Shader \"s\"] is empty."},
    };
    expect_rows(shader_desc("s", ShaderStage::Fragment), rows, "While creating [Shader \"s\"].",
                [&](const ShaderDesc& desc) { return device.create_shader(desc); });
}

TEST(Descriptor, ShadersHaveTheSourceThatTheBackendTakes) {
    const auto create = [](const char* backend_name, void (*change)(ShaderDesc&)) {
        auto backend = std::make_unique<testing::NiceMock<MockBackend>>();
        backend->caps_.backend = backend_name;
        Device device(std::move(backend));
        ShaderDesc desc = shader_desc("s", ShaderStage::Vertex);
        change(desc);
        return device.create_shader(desc).map([](const Shader&) {});
    };
    const auto no_glsl = [](ShaderDesc& desc) { desc.source.glsl = {}; };
    const auto no_spirv = [](ShaderDesc& desc) { desc.source.spirv = {}; };
    expect_outcome(create("gl", no_spirv), valid);
    expect_outcome(create("gl", no_glsl),
                   "The GLSL source of [Shader \"s\"] is empty, and the backend takes GLSL. While "
                   "creating [Shader \"s\"].");
    expect_outcome(create("vk", no_glsl), valid);
    expect_outcome(create("vk", no_spirv),
                   "The SPIR-V source of [Shader \"s\"] is empty, and the backend takes SPIR-V. "
                   "While creating [Shader \"s\"].");
    expect_outcome(create("webgpu", no_spirv),
                   "The WGSL source of [Shader \"s\"] is empty, and the backend takes WGSL. While "
                   "creating [Shader \"s\"].");
    const auto wgsl_alone = [](ShaderDesc& desc) { desc.source = {.wgsl = "fn main() {}"}; };
    expect_outcome(create("webgpu", wgsl_alone), valid);
}

TEST(Descriptor, QuerySet) {
    Device device(create_null_backend());
    const QuerySetDesc base{"q", QueryType::Timestamp, 2};
    const std::vector<Row<QuerySetDesc>> rows = {
        {[](auto& d) { d.type = QueryType::Occlusion; }, valid},
        {[](auto& d) { d.count = 4096; }, valid},
        {[](auto& d) { d.count = 0; },
         "The count (0) of [QuerySet \"q\"] is not within 1 and 4096."},
        {[](auto& d) { d.count = 4097; },
         "The count (4097) of [QuerySet \"q\"] is not within 1 and 4096."},
    };
    const char* frame = "While creating [QuerySet \"q\"].";
    expect_rows(base, rows, frame,
                [&](const QuerySetDesc& desc) { return device.create_query_set(desc); });
    expect_outcome(device_without(&Features::timestamp_query).create_query_set(base),
                   std::string("The type of [QuerySet \"q\"] is Timestamp, but this adapter has no "
                               "timestamp_query. ") +
                       frame);
    expect_outcome(
        device_without(&Features::occlusion_query).create_query_set({"q", QueryType::Occlusion, 2}),
        std::string("The type of [QuerySet \"q\"] is Occlusion, but this adapter has no "
                    "occlusion_query. ") +
            frame);
}

}  // namespace
}  // namespace gnomon::gpu::test
