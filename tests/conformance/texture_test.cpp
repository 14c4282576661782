// SPDX-License-Identifier: MIT
//
// Textures: what is written comes back, and what a shader reads of it.
#include <cmath>
#include <gnomon_shaders/conformance.hpp>

#include "tests/conformance/painting.hpp"
#include "tests/conformance/reading_shader.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::conformance {
namespace {

using gpu::AddressMode;
using gpu::FilterMode;
using test::drawing_devices;
using test::must;

class Textures : public test::DeviceTest {
protected:
    gpu::Texture make(std::uint32_t width, std::uint32_t height, gpu::Format format,
                      std::uint32_t mips = 1) {
        return must(device().create_texture({.label = "texture",
                                             .width = width,
                                             .height = height,
                                             .format = format,
                                             .usage = gpu::TextureUsage::CopySrc |
                                                      gpu::TextureUsage::CopyDst |
                                                      gpu::TextureUsage::TextureBinding,
                                             .mip_level_count = mips}));
    }
    template <class T>
    void write(const gpu::Texture& texture, std::uint32_t mip, const std::vector<T>& texels) {
        must(device().write_texture(texture, mip, std::as_bytes(std::span(texels))));
    }
    /// The first channel of the texture at (u, v) and a level of detail.
    float sampled(const gpu::Texture& texture, const gpu::SamplerDesc& sampler_desc, float u,
                  float v, float lod = 0.0F) {
        const auto sampler = must(device().create_sampler(sampler_desc));
        return texels_as<std::array<float, 4>>(
            read_by_shader(device(), {.fragment = shaders::sample_frag,
                                      .textures = {{.texture = texture, .sampler = sampler}},
                                      .block = std::array<float, 4>{u, v, lod, 0}}))[0][0];
    }
};

TEST_P(Textures, EveryColorFormatComesBackAsWritten) {
    for (const gpu::Format format :
         {gpu::Format::R8Unorm, gpu::Format::R8Uint, gpu::Format::R32Uint, gpu::Format::R32Float,
          gpu::Format::Rgba8Unorm, gpu::Format::Rgba8UnormSrgb, gpu::Format::Rgba16Float,
          gpu::Format::Rgba32Float, gpu::Format::Rgba32Uint}) {
        // an odd width, so that padded rows would show
        const auto texture = make(7, 5, format);
        std::vector<std::uint8_t> bytes(std::size_t{7} * 5 * gpu::texel_bytes(format));
        for (std::size_t i = 0; i < bytes.size(); ++i) {
            // below 0x70 there is no infinity and no NaN in any float format
            bytes[i] = static_cast<std::uint8_t>((i * 37 + i / 7) % 0x70);
        }
        write(texture, 0, bytes);
        EXPECT_EQ(texels_as<std::uint8_t>(must(device().read_texture(texture))), bytes)
            << "format " << static_cast<int>(format);
    }
}

TEST_P(Textures, RowZeroIsVZero) {
    const auto texture = make(1, 2, gpu::Format::R8Unorm);
    write(texture, 0, std::vector<std::uint8_t>{255, 0});
    EXPECT_EQ(sampled(texture, {}, 0.5F, 0.25F), 1.0F);
    EXPECT_EQ(sampled(texture, {}, 0.5F, 0.75F), 0.0F);
}

TEST_P(Textures, MipLevelsAreUploadedAndChosen) {
    const auto texture = make(4, 2, gpu::Format::R32Float, 3);
    write(texture, 0, std::vector<float>(8, 1.0F));
    write(texture, 1, std::vector<float>(2, 3.0F));
    write(texture, 2, std::vector<float>(1, 7.0F));
    const gpu::SamplerDesc nearest{.mipmap_filter = FilterMode::Nearest};
    const gpu::SamplerDesc linear{.mipmap_filter = FilterMode::Linear};
    EXPECT_EQ(sampled(texture, nearest, 0.5F, 0.5F, 0.0F), 1.0F);
    EXPECT_EQ(sampled(texture, nearest, 0.5F, 0.5F, 1.2F), 3.0F);
    EXPECT_EQ(sampled(texture, nearest, 0.5F, 0.5F, 2.0F), 7.0F);
    EXPECT_NEAR(sampled(texture, linear, 0.5F, 0.5F, 0.5F), 2.0F, 0.02F);
    EXPECT_NEAR(sampled(texture, linear, 0.5F, 0.5F, 1.5F), 5.0F, 0.04F);
}

TEST_P(Textures, FiltersWithinALevel) {
    const auto texture = make(2, 1, gpu::Format::R8Unorm);
    write(texture, 0, std::vector<std::uint8_t>{0, 255});
    EXPECT_EQ(sampled(texture, {.mag_filter = FilterMode::Nearest}, 0.4F, 0.5F), 0.0F);
    EXPECT_EQ(sampled(texture, {.mag_filter = FilterMode::Nearest}, 0.6F, 0.5F), 1.0F);
    EXPECT_NEAR(sampled(texture, {.mag_filter = FilterMode::Linear}, 0.5F, 0.5F), 0.5F, 0.01F);
    EXPECT_NEAR(sampled(texture, {.mag_filter = FilterMode::Linear}, 0.375F, 0.5F), 0.25F, 0.01F);
}

TEST_P(Textures, AddressModes) {
    const auto texture = make(2, 2, gpu::Format::R8Unorm);
    write(texture, 0, std::vector<std::uint8_t>{0, 255, 0, 255});
    struct Row {
        AddressMode mode;
        float u, expected;
    };
    constexpr Row rows[] = {
        {AddressMode::ClampToEdge, -0.25F, 0},  {AddressMode::ClampToEdge, 1.25F, 1},
        {AddressMode::ClampToEdge, 2.25F, 1},   {AddressMode::Repeat, -0.25F, 1},
        {AddressMode::Repeat, 1.25F, 0},        {AddressMode::Repeat, 2.25F, 0},
        {AddressMode::MirrorRepeat, -0.25F, 0}, {AddressMode::MirrorRepeat, 1.25F, 1},
        {AddressMode::MirrorRepeat, 2.25F, 0},
    };
    for (const Row& row : rows) {
        EXPECT_EQ(sampled(texture, {.address_mode_u = row.mode}, row.u, 0.5F), row.expected)
            << "mode " << static_cast<int>(row.mode) << ", u " << row.u;
    }
    const auto rows_texture = make(2, 2, gpu::Format::R8Unorm);
    write(rows_texture, 0, std::vector<std::uint8_t>{0, 0, 255, 255});
    EXPECT_EQ(sampled(rows_texture, {.address_mode_v = AddressMode::Repeat}, 0.5F, 1.25F), 0.0F);
    EXPECT_EQ(sampled(rows_texture, {.address_mode_v = AddressMode::ClampToEdge}, 0.5F, 1.25F),
              1.0F);
}

TEST_P(Textures, SrgbIsDecodedWhenRead) {
    const auto texture = make(1, 1, gpu::Format::Rgba8UnormSrgb);
    write(texture, 0, std::vector<std::uint8_t>{188, 0, 0, 255});
    EXPECT_NEAR(sampled(texture, {}, 0.5F, 0.5F), 0.5F, 0.005F);
}

TEST_P(Textures, IntegersAreFetched) {
    for (const gpu::Format format : {gpu::Format::R8Uint, gpu::Format::R32Uint}) {
        const auto texture = make(2, 1, format);
        if (format == gpu::Format::R8Uint) {
            write(texture, 0, std::vector<std::uint8_t>{7, 250});
        } else {
            write(texture, 0, std::vector<std::uint32_t>{7, 250});
        }
        const auto values = texels_as<std::uint32_t>(read_by_shader(
            device(), {.fragment = shaders::fetch_uint_frag,
                       .textures = {{.texture = texture, .sample_type = gpu::SampleType::Uint}},
                       .target_format = gpu::Format::R32Uint,
                       .width = 2}));
        EXPECT_EQ(values, (std::vector<std::uint32_t>{7, 250}));
    }
}

// Written again between two submissions: each sees what was written last.
TEST_P(Textures, AVertexShaderFetchesTexels) {
    const auto texture = make(2, 1, gpu::Format::Rgba32Uint);
    const auto layout = must(
        device().create_bind_group_layout({.label = "fetching",
                                           .entries = {{.binding = 1,
                                                        .visibility = gpu::ShaderStage::Vertex,
                                                        .type = gpu::BindingType::SampledTexture,
                                                        .sample_type = gpu::SampleType::Uint}}}));
    const auto group = must(device().create_bind_group(
        {.label = "fetching", .layout = layout, .entries = {{.binding = 1, .texture = texture}}}));
    const auto vertex = make_shader(device(), gpu::ShaderStage::Vertex, shaders::fetch_vert);
    const auto fragment = make_shader(device(), gpu::ShaderStage::Fragment, shaders::flat_frag);
    const auto target = must(device().create_texture(
        {.label = "target",
         .width = 1,
         .height = 1,
         .format = gpu::Format::Rgba32Float,
         .usage = gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::CopySrc}));
    const auto pipeline =
        must(device().create_render_pipeline({.label = "fetching",
                                              .bind_group_layouts = {layout},
                                              .vertex = vertex,
                                              .fragment = fragment,
                                              .targets = {{.format = gpu::Format::Rgba32Float}}}));
    for (const float scale : {1.0F, -3.0F}) {
        const std::vector<float> texels{9,           9, 9, 9, scale, scale * 2.5F, scale * 0.125F,
                                        scale * 1024};
        write(texture, 0, texels);
        gpu::CommandEncoder encoder = device().create_command_encoder("fetching");
        {
            gpu::RenderPassEncoder pass = encoder.begin_render_pass(
                {.label = "fetching",
                 .color_attachments = {{.texture = target, .load_op = gpu::LoadOp::Clear}}});
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, group);
            pass.draw(3);
        }
        must(device().submit(must(encoder.finish())));
        const auto colors = texels_as<std::array<float, 4>>(must(device().read_texture(target)));
        for (std::size_t c = 0; c < 4; ++c) {
            EXPECT_NEAR(colors[0][c], texels[4 + c], 1e-5F * std::abs(texels[4 + c]));
        }
    }
}

TEST_P(Textures, DepthAndStencilOfOneTextureAreReadAtOnce) {
    if (!features().sampled_stencil) GTEST_SKIP() << "no sampled_stencil";
    for (const gpu::Format format : depth_stencil_formats(device())) {
        Painting painting(
            device(), {.depth_stencil_format = format, .clear_depth = 0.25F, .clear_stencil = 9});
        const gpu::StencilFaceState replace{.pass_op = gpu::StencilOp::Replace};
        painting.paint({{.vertices = triangles_of({.bottom = 0, .z = 0.75F}),
                         .depth_stencil = {.depth_write_enabled = true,
                                           .depth_compare = gpu::Compare::Always,
                                           .stencil_front = replace,
                                           .stencil_back = replace},
                         .stencil_reference = 200}});
        const auto sampler = must(device().create_sampler({.label = "nearest"}));
        const auto texels = texels_as<std::array<float, 4>>(
            read_by_shader(device(), {.fragment = shaders::depth_and_stencil_frag,
                                      .textures = {{.texture = painting.depth_stencil_texture(),
                                                    .sampler = sampler,
                                                    .aspect = gpu::Aspect::DepthOnly,
                                                    .sample_type = gpu::SampleType::Depth},
                                                   {.texture = painting.depth_stencil_texture(),
                                                    .aspect = gpu::Aspect::StencilOnly,
                                                    .sample_type = gpu::SampleType::Uint}},
                                      .width = 4,
                                      .height = 4}));
        for (std::size_t i = 0; i < 16; ++i) {
            EXPECT_NEAR(texels[i][0], i < 8 ? 0.75F : 0.25F, 1e-6F) << "pixel " << i;
            EXPECT_EQ(texels[i][1], i < 8 ? 200.0F : 9.0F) << "pixel " << i;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Devices, Textures, testing::ValuesIn(drawing_devices()),
                         test::device_case_name);

}  // namespace
}  // namespace gnomon::conformance
