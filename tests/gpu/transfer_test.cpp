// SPDX-License-Identifier: MIT
//
// The rules of writing, reading back and presenting.
#include <array>
#include <limits>

#include "world.hpp"

namespace gnomon::gpu::test {
namespace {

constexpr std::array<std::byte, 1024> bytes{};

class Transfer : public testing::Test {
protected:
    Texture texture(const char* label, Format format, TextureUsage usage,
                    std::uint32_t samples = 1) {
        return take(w_.device.create_texture({.label = label,
                                              .width = 2,
                                              .height = 2,
                                              .format = format,
                                              .usage = usage | TextureUsage::RenderAttachment,
                                              .sample_count = samples}));
    }

    World w_;
};

struct BufferRange {
    BufferId buffer;
    std::uint64_t offset = 0;
    std::uint64_t size = 0;
};

TEST_F(Transfer, WriteBuffer) {
    const std::vector<Row<BufferRange>> rows = {
        {[](auto& r) { r.offset = 104, r.size = 16; }, valid},
        {[](auto& r) { r.offset = 120, r.size = 0; }, valid},
        {[](auto& r) { r.offset = 2; }, "The offset (2) is not a multiple of 4."},
        {[](auto& r) { r.size = 6; }, "The size (6) is not a multiple of 4."},
        {[](auto& r) { r.offset = 108, r.size = 16; },
         "The range (offset 108, size 16) does not fit in [Buffer \"vertices\"] (size 120)."},
        {[](auto& r) { r.offset = ~std::uint64_t{3}, r.size = 8; },
         "The range (offset 18446744073709551612, size 8) does not fit in [Buffer \"vertices\"] "
         "(size 120)."},
        {[](auto& r) { r.offset = 124, r.size = 0; },
         "The range (offset 124, size 0) does not fit in [Buffer \"vertices\"] (size 120)."},
    };
    const auto write = [&](const BufferRange& r) {
        return w_.device.write_buffer(r.buffer, r.offset, std::span(bytes).first(r.size));
    };
    expect_rows(BufferRange{w_.vertices, 0, 8}, rows, "While writing [Buffer \"vertices\"].",
                write);
    expect_outcome(write({w_.indices, 0, 4}),
                   "The usage (CopySrc | Index) of [Buffer \"indices\"] lacks CopyDst. While "
                   "writing [Buffer \"indices\"].");
    expect_outcome(write({{}, 0, 4}),
                   "A Buffer is needed, but the id is empty. While writing [Buffer].");
}

TEST_F(Transfer, ReadBuffer) {
    const std::vector<Row<BufferRange>> rows = {
        {[](auto& r) { r.offset = 8, r.size = 16; }, valid},
        {[](auto& r) { r.size = 0; }, valid},
        {[](auto& r) { r.offset = 2; }, "The offset (2) is not a multiple of 4."},
        {[](auto& r) { r.size = 6; }, "The size (6) is not a multiple of 4."},
        {[](auto& r) { r.size = 28; },
         "The range (offset 0, size 28) does not fit in [Buffer \"indices\"] (size 24)."},
        {[](auto& r) { r.offset = 4, r.size = ~std::uint64_t{3}; },
         "The range (offset 4, size 18446744073709551612) does not fit in [Buffer \"indices\"] "
         "(size 24)."},
    };
    const auto read = [&](const BufferRange& r) {
        return w_.device.read_buffer(r.buffer, r.offset, r.size);
    };
    expect_rows(BufferRange{w_.indices, 0, 24}, rows, "While reading [Buffer \"indices\"].", read);
    expect_outcome(read({w_.uniforms, 0, 4}),
                   "The usage (CopyDst | Uniform) of [Buffer \"uniforms\"] lacks CopySrc. While "
                   "reading [Buffer \"uniforms\"].");
    expect_outcome(read({{}, 0, 4}),
                   "A Buffer is needed, but the id is empty. While reading [Buffer].");
}

TEST_F(Transfer, WriteTexture) {
    struct Write {
        TextureId texture;
        std::uint32_t mip_level = 0;
        std::size_t size = 0;
    };
    const auto write = [&](const Write& c) {
        return w_.device.write_texture(c.texture, c.mip_level, std::span(bytes).first(c.size));
    };
    // albedo: 8 x 4 texels of 4 bytes, four mip levels.
    const std::vector<Row<Write>> rows = {
        {[](auto& c) { c.mip_level = 1, c.size = 4 * 2 * 4; }, valid},
        {[](auto& c) { c.mip_level = 3, c.size = 4; }, valid},
        {[](auto& c) { c.mip_level = 4; },
         "The mip level (4) is not below the mip level count (4) of [Texture \"albedo\"]."},
        {[](auto& c) { c.size = 124; },
         "The data has 124 bytes, but mip level 0 of [Texture \"albedo\"] (8 x 4, Rgba8Unorm) has "
         "128."},
        {[](auto& c) { c.mip_level = 2; },
         "The data has 128 bytes, but mip level 2 of [Texture \"albedo\"] (2 x 1, Rgba8Unorm) has "
         "8."},
    };
    expect_rows(Write{w_.albedo, 0, 128}, rows, "While writing [Texture \"albedo\"].", write);

    const Texture depth = texture("d", Format::Depth32Float, TextureUsage::CopyDst);
    expect_outcome(write({depth, 0, 16}),
                   "The format (Depth32Float) of [Texture \"d\"] is not a color format. While "
                   "writing [Texture \"d\"].");
    const Texture four = texture("m", Format::R8Unorm, TextureUsage::CopyDst, 4);
    expect_outcome(write({four, 0, 4}),
                   "[Texture \"m\"] is multisampled. While writing [Texture \"m\"].");
    const Texture closed = texture("c", Format::R8Unorm, TextureUsage::CopySrc);
    expect_outcome(write({closed, 0, 4}),
                   "The usage (CopySrc | RenderAttachment) of [Texture \"c\"] lacks CopyDst. While "
                   "writing [Texture \"c\"].");
    expect_outcome(write({{}, 0, 4}),
                   "A Texture is needed, but the id is empty. While writing [Texture].");
}

TEST_F(Transfer, ReadTexture) {
    const auto read = [&](TextureId id, Aspect aspect) {
        return w_.device.read_texture(id, aspect);
    };
    const Texture depth_only = texture("d", Format::Depth32Float, TextureUsage::CopySrc);
    expect_outcome(read(w_.color, Aspect::Color), valid);
    expect_outcome(read(w_.color, Aspect::DepthOnly),
                   "The format (Rgba8Unorm) of [Texture \"color\"] has no aspect DepthOnly. While "
                   "reading [Texture \"color\"].");
    expect_outcome(read(w_.depth, Aspect::DepthOnly), valid);
    expect_outcome(read(w_.depth, Aspect::StencilOnly), valid);
    expect_outcome(read(w_.depth, Aspect::Color),
                   "The format (Depth32FloatStencil8) of [Texture \"depth\"] has no aspect Color. "
                   "While reading [Texture \"depth\"].");
    expect_outcome(read(depth_only, Aspect::DepthOnly), valid);
    expect_outcome(read(depth_only, Aspect::StencilOnly),
                   "The format (Depth32Float) of [Texture \"d\"] has no aspect StencilOnly. While "
                   "reading [Texture \"d\"].");
    expect_outcome(read(w_.color4, Aspect::Color),
                   "[Texture \"color4\"] is multisampled. While reading [Texture \"color4\"].");
    expect_outcome(read(w_.albedo, Aspect::Color),
                   "The usage (CopyDst | TextureBinding) of [Texture \"albedo\"] lacks CopySrc. "
                   "While reading [Texture \"albedo\"].");
    expect_outcome(read({}, Aspect::Color),
                   "A Texture is needed, but the id is empty. While reading [Texture].");
}

TEST_F(Transfer, ReadQuerySet) {
    expect_outcome(w_.device.read_query_set(w_.occlusion), valid);
    expect_outcome(w_.device.read_query_set({}),
                   "A QuerySet is needed, but the id is empty. While reading [QuerySet].");
}

TEST_F(Transfer, Present) {
    expect_outcome(w_.device.present(w_.color), valid);
    expect_outcome(w_.device.present(w_.albedo),
                   "The usage (CopyDst | TextureBinding) of [Texture \"albedo\"] lacks CopySrc. "
                   "While presenting [Texture \"albedo\"].");
    expect_outcome(w_.device.present(w_.depth),
                   "The format (Depth32FloatStencil8) of [Texture \"depth\"] cannot be shown on a "
                   "window. While presenting [Texture \"depth\"].");
    expect_outcome(w_.device.present(texture("u", Format::R8Uint, TextureUsage::CopySrc)),
                   "The format (R8Uint) of [Texture \"u\"] cannot be shown on a window. While "
                   "presenting [Texture \"u\"].");
    expect_outcome(w_.device.present(w_.color4),
                   "[Texture \"color4\"] is multisampled. While presenting [Texture \"color4\"].");
    expect_outcome(w_.device.present({}),
                   "A Texture is needed, but the id is empty. While presenting [Texture].");
}

}  // namespace
}  // namespace gnomon::gpu::test
