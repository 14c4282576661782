// SPDX-License-Identifier: MIT
//
// The rules of bind group layouts and bind groups.
#include "world.hpp"

namespace gnomon::gpu::test {
namespace {

TEST(BindGroupLayout, Rules) {
    Device device(create_null_backend());
    const BindGroupLayoutDesc base{
        .label = "l",
        .entries = {{.binding = 3, .visibility = ShaderStage::Vertex, .has_dynamic_offset = true},
                    {.binding = 5,
                     .visibility = ShaderStage::Vertex | ShaderStage::Fragment,
                     .type = BindingType::SampledTexture}}};
    const auto add_dynamic = [](BindGroupLayoutDesc& d, std::uint32_t count) {
        for (std::uint32_t i = 0; i < count; ++i) {
            d.entries.push_back(
                {.binding = 10 + i, .visibility = ShaderStage::Vertex, .has_dynamic_offset = true});
        }
    };
    const std::vector<Row<BindGroupLayoutDesc>> rows = {
        {[](auto& d) { d.entries.clear(); }, valid},
        {[](auto& d) { d.entries[1].binding = 3; },
         "Binding 3 of [BindGroupLayout \"l\"] is used twice."},
        {[](auto& d) { d.entries[1].visibility = ShaderStage::None; },
         "Binding 5 of [BindGroupLayout \"l\"] is visible to no shader stage."},
        {[](auto& d) { d.entries[1].visibility = static_cast<ShaderStage>(5); },
         "The visibility (Vertex | 0x4) of binding 5 of [BindGroupLayout \"l\"] has unknown bits."},
        {[](auto& d) { d.entries[1].has_dynamic_offset = true; },
         "Binding 5 of [BindGroupLayout \"l\"] is a SampledTexture, which cannot have a dynamic "
         "offset."},
        {[&](auto& d) { add_dynamic(d, 3); }, valid},
        {[&](auto& d) { add_dynamic(d, 4); },
         "The number of dynamic offsets (5) of [BindGroupLayout \"l\"] exceeds max_dynamic_offsets "
         "(4)."},
    };
    expect_rows(base, rows, "While creating [BindGroupLayout \"l\"].",
                [&](const BindGroupLayoutDesc& d) { return device.create_bind_group_layout(d); });
}

class BindGroup : public testing::Test {
protected:
    BindGroupLayout layout(const BindGroupLayoutEntry& entry) {
        return take(w_.device.create_bind_group_layout({.label = "l", .entries = {entry}}));
    }

    World w_;
};

TEST_F(BindGroup, EntriesMatchTheLayoutOneToOne) {
    const BindGroupLayout two = take(w_.device.create_bind_group_layout(
        {.label = "two",
         .entries = {{.binding = 4, .visibility = ShaderStage::Vertex},
                     {.binding = 2, .visibility = ShaderStage::Vertex}}}));
    const BindGroupDesc base{
        .label = "g",
        .layout = two,
        .entries = {{.binding = 2, .buffer = w_.uniforms}, {.binding = 4, .buffer = w_.uniforms}}};
    const std::vector<Row<BindGroupDesc>> rows = {
        {[](auto& d) { std::swap(d.entries[0], d.entries[1]); }, valid},
        {[](auto& d) { d.entries.pop_back(); },
         "Binding 4 of [BindGroupLayout \"two\"] is missing in [BindGroup \"g\"]."},
        {[](auto& d) { d.entries.erase(d.entries.begin()); },
         "Binding 2 of [BindGroupLayout \"two\"] is missing in [BindGroup \"g\"]."},
        {[](auto& d) { d.entries.clear(); },
         "Binding 2 of [BindGroupLayout \"two\"] is missing in [BindGroup \"g\"]."},
        {[](auto& d) { d.entries[0].binding = 4; },
         "Binding 2 of [BindGroupLayout \"two\"] is missing in [BindGroup \"g\"]."},
        {[](auto& d) { d.entries.push_back(d.entries[0]); },
         "Binding 2 of [BindGroup \"g\"] is given twice."},
        {[](auto& d) { d.entries[1].binding = 3; },
         "Binding 3 of [BindGroup \"g\"] is not in [BindGroupLayout \"two\"]."},
        {[](auto& d) { d.layout = {}; }, "A BindGroupLayout is needed, but the id is empty."},
    };
    expect_rows(base, rows, "While creating [BindGroup \"g\"].",
                [&](const BindGroupDesc& d) { return w_.device.create_bind_group(d); });
}

TEST_F(BindGroup, UniformBuffers) {
    const Buffer large = w_.buffer("large", 65536 + 256, BufferUsage::Uniform);
    const BindGroupDesc base{
        .label = "g",
        .layout = w_.uniform_layout,
        .entries = {{.binding = 0, .buffer = w_.uniforms, .offset = 256, .size = 64}}};
    const std::vector<Row<BindGroupEntry>> rows = {
        {[](auto& e) { e.buffer = {}; }, "A Buffer is needed, but the id is empty."},
        {[&](auto& e) { e.texture = w_.albedo; },
         "Its layout has a UniformBuffer there, but the entry names a Texture."},
        {[&](auto& e) { e.sampler = w_.sampler; },
         "Its layout has a UniformBuffer there, but the entry names a Sampler."},
        {[&](auto& e) { e.buffer = w_.indices; },
         "The usage (CopySrc | Index) of [Buffer \"indices\"] lacks Uniform."},
        {[](auto& e) { e.offset = 128; },
         "The offset (128) is not a multiple of min_uniform_buffer_offset_alignment (256)."},
        {[](auto& e) { e.offset = 768, e.size = 256; }, valid},
        {[](auto& e) { e.offset = 768, e.size = 0; }, valid},
        {[](auto& e) { e.offset = 768, e.size = 260; },
         "The range (offset 768, size 260) does not fit in [Buffer \"uniforms\"] (size 1024)."},
        {[](auto& e) { e.offset = 1024, e.size = 0; },
         "The range (offset 1024, size 0) does not fit in [Buffer \"uniforms\"] (size 1024)."},
        {[](auto& e) { e.size = ~std::uint64_t{0} - 255; },
         "The range (offset 256, size 18446744073709551360) does not fit in [Buffer \"uniforms\"] "
         "(size 1024)."},
        {[](auto& e) { e.size = 60; },
         "The size (60) of [Buffer \"uniforms\"] as it is bound is below min_binding_size (64)."},
        {[&](auto& e) { e.buffer = large, e.size = 65536; }, valid},
        {[&](auto& e) { e.buffer = large, e.offset = 0, e.size = 0; },
         "The size (65792) of [Buffer \"large\"] as it is bound exceeds "
         "max_uniform_buffer_binding_size (65536)."},
    };
    expect_rows(base.entries[0], rows,
                "While checking binding 0. While creating [BindGroup \"g\"].",
                [&](const BindGroupEntry& entry) {
                    BindGroupDesc desc = base;
                    desc.entries[0] = entry;
                    return w_.device.create_bind_group(desc);
                });
}

TEST_F(BindGroup, Textures) {
    const BindGroupDesc base{
        .label = "g",
        .layout = w_.texture_layout,
        .entries = {{.binding = 1, .texture = w_.albedo, .sampler = w_.sampler}}};
    const Texture unbindable = take(
        w_.device.create_texture({"unbindable", 1, 1, Format::R8Unorm, TextureUsage::CopyDst}));
    const std::vector<Row<BindGroupEntry>> rows = {
        {[](auto& e) { e.texture = {}; }, "A Texture is needed, but the id is empty."},
        {[&](auto& e) { e.buffer = w_.uniforms; },
         "Its layout has a SampledTexture there, but the entry names a Buffer."},
        {[&](auto& e) { e.texture = unbindable; },
         "The usage (CopyDst) of [Texture \"unbindable\"] lacks TextureBinding."},
        {[&](auto& e) { e.texture = w_.color4; },
         "Its layout says multisampled = false, but the sample count of [Texture \"color4\"] is "
         "4."},
        {[](auto& e) { e.sampler = {}; }, "A Sampler is needed, but the id is empty."},
        {[](auto& e) { e.aspect = Aspect::DepthOnly; },
         "The aspect DepthOnly of [Texture \"albedo\"] (Rgba8Unorm) cannot be read as Float."},
    };
    expect_rows(base.entries[0], rows,
                "While checking binding 1. While creating [BindGroup \"g\"].",
                [&](const BindGroupEntry& entry) {
                    BindGroupDesc desc = base;
                    desc.entries[0] = entry;
                    return w_.device.create_bind_group(desc);
                });
}

TEST_F(BindGroup, SampleTypeFitsFormatAndAspect) {
    const auto all_formats = {Format::R8Unorm,
                              Format::R8Uint,
                              Format::R32Uint,
                              Format::Rgba32Uint,
                              Format::Rgba16Float,
                              Format::Depth32Float,
                              Format::Depth32FloatStencil8};
    for (const Format format : all_formats) {
        const Texture texture = take(w_.device.create_texture(target_desc("t", format)));
        for (const SampleType type : {SampleType::Float, SampleType::Uint, SampleType::Depth}) {
            const BindGroupLayout one = layout({.binding = 0,
                                                .visibility = ShaderStage::Fragment,
                                                .type = BindingType::SampledTexture,
                                                .sample_type = type});
            for (const Aspect aspect : {Aspect::Color, Aspect::DepthOnly, Aspect::StencilOnly}) {
                const bool is_valid =
                    (type == SampleType::Float && aspect == Aspect::Color && has_color(format) &&
                     !is_uint(format)) ||
                    (type == SampleType::Uint && aspect == Aspect::Color && is_uint(format)) ||
                    (type == SampleType::Uint && aspect == Aspect::StencilOnly &&
                     has_stencil(format)) ||
                    (type == SampleType::Depth && aspect == Aspect::DepthOnly && has_depth(format));
                const auto made = w_.device.create_bind_group({"g",
                                                               one,
                                                               {{.binding = 0,
                                                                 .texture = texture,
                                                                 .sampler = w_.sampler,
                                                                 .aspect = aspect}}});
                EXPECT_EQ(made.has_value(), is_valid)
                    << "format " << static_cast<int>(format) << ", type " << static_cast<int>(type)
                    << ", aspect " << static_cast<int>(aspect);
            }
        }
    }
}

TEST_F(BindGroup, SamplersMayBeLeftOutWhereTexelsAreOnlyFetched) {
    const Texture integers = take(w_.device.create_texture(target_desc("i", Format::R8Uint)));
    const Sampler linear =
        take(w_.device.create_sampler({.label = "linear", .mag_filter = FilterMode::Linear}));
    const BindGroupLayout uint_layout = layout({.binding = 0,
                                                .visibility = ShaderStage::Fragment,
                                                .type = BindingType::SampledTexture,
                                                .sample_type = SampleType::Uint});
    const BindGroupLayout multisampled = layout({.binding = 0,
                                                 .visibility = ShaderStage::Fragment,
                                                 .type = BindingType::SampledTexture,
                                                 .multisampled = true});
    const auto create = [&](BindGroupLayoutId l, TextureId texture, SamplerId sampler) {
        return w_.device.create_bind_group(
            {"g", l, {{.binding = 0, .texture = texture, .sampler = sampler}}});
    };
    const std::string frame = " While checking binding 0. While creating [BindGroup \"g\"].";
    expect_outcome(create(uint_layout, integers, {}), valid);
    expect_outcome(create(uint_layout, integers, w_.sampler), valid);
    expect_outcome(
        create(uint_layout, integers, linear),
        "[Sampler \"linear\"] filters linearly, but the texture is read as Uint." + frame);
    expect_outcome(create(multisampled, w_.color4, {}), valid);
    expect_outcome(create(multisampled, w_.albedo, {}),
                   "Its layout says multisampled = true, but the sample count of [Texture "
                   "\"albedo\"] is 1." +
                       frame);
}

TEST_F(BindGroup, StencilIsSampledWhereTheAdapterCan) {
    for (const bool able : {true, false}) {
        NullBackendOptions options;
        options.features.sampled_stencil = able;
        World w(create_null_backend(options));
        const BindGroupLayout l =
            take(w.device.create_bind_group_layout({"l",
                                                    {{.binding = 0,
                                                      .visibility = ShaderStage::Fragment,
                                                      .type = BindingType::SampledTexture,
                                                      .sample_type = SampleType::Uint}}}));
        expect_outcome(
            w.device.create_bind_group(
                {"g", l, {{.binding = 0, .texture = w.depth, .aspect = Aspect::StencilOnly}}}),
            able ? valid
                 : "The aspect StencilOnly of [Texture \"depth\"] needs sampled_stencil, which "
                   "this adapter does not have. While checking binding 0. While creating "
                   "[BindGroup \"g\"].");
    }
}

}  // namespace
}  // namespace gnomon::gpu::test
