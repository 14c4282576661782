// SPDX-License-Identifier: MIT
//
// The rules of how a render pass begins: attachments, resolve targets, clears, queries.
#include <limits>

#include "world.hpp"

namespace gnomon::gpu::test {
namespace {

class Pass : public testing::Test {
protected:
    void expect(const RenderPassDesc& base, const std::vector<Row<RenderPassDesc>>& rows) {
        expect_rows(base, rows,
                    "While encoding begin_render_pass (command 0) in [RenderPass \"pass\"] of "
                    "[CommandBuffer \"frame\"].",
                    [&](const RenderPassDesc& desc) {
                        return w_.record_pass(desc, [](RenderPassEncoder&) {});
                    });
    }
    Texture target(const char* label, Format format, std::uint32_t samples = 1) {
        return take(w_.device.create_texture(target_desc(label, format, samples)));
    }
    Texture small(std::uint32_t width, std::uint32_t height) {
        TextureDesc desc = target_desc("small", Format::Rgba8Unorm);
        desc.width = width;
        desc.height = height;
        return take(w_.device.create_texture(desc));
    }

    World w_;
};

TEST_F(Pass, ColorAttachments) {
    const Texture closed = take(w_.device.create_texture(
        {"closed", 64, 32, Format::Rgba8Unorm, TextureUsage::TextureBinding}));
    const Texture narrow = small(63, 32);
    const Texture low = small(64, 31);
    std::vector<Texture> nine;
    for (int i = 0; i < 9; ++i) nine.push_back(target("many", Format::R8Unorm));
    const auto attach_first = [&](RenderPassDesc& d, std::size_t count) {
        d.color_attachments.clear();
        for (std::size_t i = 0; i < count; ++i) d.color_attachments.push_back({nine[i]});
    };
    expect(w_.pass_desc(),
           {
               {[](auto& d) { d.color_attachments.clear(); }, valid},
               {[](auto& d) { d.depth_stencil.reset(); }, valid},
               {[](auto& d) { d.color_attachments.clear(), d.depth_stencil.reset(); },
                "The pass has no attachment."},
               {[&](auto& d) { attach_first(d, 8); }, valid},
               {[&](auto& d) { attach_first(d, 9); },
                "The number of color attachments (9) exceeds max_color_attachments (8)."},
               {[](auto& d) { d.color_attachments[0].texture = {}; },
                "A Texture is needed, but the id is empty."},
               {[&](auto& d) { d.color_attachments[0].texture = closed; },
                "The usage (TextureBinding) of [Texture \"closed\"] lacks RenderAttachment."},
               {[&](auto& d) { d.color_attachments.push_back({w_.color}); },
                "[Texture \"color\"] is attached twice."},
               {[&](auto& d) { d.color_attachments.push_back({narrow}); },
                "The size (63 x 32) of [Texture \"small\"] is not the size (64 x 32) of the first "
                "attachment."},
               {[&](auto& d) { d.color_attachments.push_back({low}); },
                "The size (64 x 31) of [Texture \"small\"] is not the size (64 x 32) of the first "
                "attachment."},
               {[&](auto& d) { d.color_attachments.push_back({w_.color4}); },
                "The sample count (4) of [Texture \"color4\"] is not the one (1) of the first "
                "attachment."},
               {[&](auto& d) {
                    d.color_attachments[0].texture = w_.depth;
                    d.depth_stencil.reset();
                },
                "The format (Depth32FloatStencil8) of [Texture \"depth\"] is not a color format."},
           });
}

TEST_F(Pass, IntegerClearValuesFitTheFormat) {
    const Texture byte = target("byte", Format::R8Uint);
    const Texture word = target("word", Format::R32Uint);
    const Texture words = target("words", Format::Rgba32Uint);
    const auto clear = [](TextureId texture, double value) {
        return [texture, value](RenderPassDesc& d) {
            d.color_attachments = {
                {.texture = texture, .load_op = LoadOp::Clear, .clear_value = {.r = value}}};
        };
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    expect(w_.pass_desc(),
           {
               {clear(byte, 255), valid},
               {clear(byte, 256),
                "The clear value (256) of [Texture \"byte\"] (R8Uint) is not within 0 and 255."},
               {clear(byte, -1),
                "The clear value (-1) of [Texture \"byte\"] (R8Uint) is not within 0 and 255."},
               {clear(byte, nan),
                "The clear value (nan) of [Texture \"byte\"] (R8Uint) is not within 0 and 255."},
               {clear(word, 4294967295.0), valid},
               {clear(word, 4294967296.0),
                "The clear value (4294967296) of [Texture \"word\"] (R32Uint) is not within 0 and "
                "4294967295."},
               {[&](RenderPassDesc& d) {
                    d.color_attachments = {
                        {.texture = words, .load_op = LoadOp::Clear, .clear_value = {.a = -2}}};
                },
                "The clear value (-2) of [Texture \"words\"] (Rgba32Uint) is not within 0 and "
                "4294967295."},
           });
}

TEST_F(Pass, ResolveTargets) {
    const Texture resolved = target("resolved", Format::Rgba8Unorm);
    const Texture srgb = target("srgb", Format::Rgba8UnormSrgb);
    const Texture narrow = small(63, 32);
    const Texture uint4 = target("uint4", Format::R8Uint, 4);
    const Texture uint1 = target("uint1", Format::R8Uint);
    const Texture other4 = target("other4", Format::Rgba8Unorm, 4);
    const RenderPassDesc base{
        .label = "pass", .color_attachments = {{.texture = w_.color4, .resolve_target = resolved}}};
    expect(
        base,
        {
            {[](auto& d) { d.color_attachments[0].resolve_target = {}; }, valid},
            {[&](auto& d) { d.color_attachments[0].resolve_target = narrow; },
             "The size (63 x 32) of the resolve target [Texture \"small\"] is not the size (64 x "
             "32) of [Texture \"color4\"]."},
            {[&](auto& d) { d.color_attachments[0].resolve_target = srgb; },
             "The format (Rgba8UnormSrgb) of the resolve target [Texture \"srgb\"] is not the "
             "format (Rgba8Unorm) of [Texture \"color4\"]."},
            {[&](auto& d) { d.color_attachments[0].resolve_target = other4; },
             "The sample count of the resolve target [Texture \"other4\"] is 4 instead of 1."},
            {[&](auto& d) { d.color_attachments[0].texture = w_.color; },
             "[Texture \"color\"] is resolved, but is not multisampled."},
            {[&](auto& d) { d.color_attachments[0] = {.texture = uint4, .resolve_target = uint1}; },
             "The format (R8Uint) of [Texture \"uint4\"] is an integer format, which cannot be "
             "resolved."},
            {[&](auto& d) {
                 d.color_attachments.push_back({.texture = other4, .resolve_target = resolved});
             },
             "[Texture \"resolved\"] is attached twice."},
        });
}

TEST_F(Pass, DepthStencil) {
    const Texture depth_only = target("depth_only", Format::Depth32Float);
    const Texture another = target("another", Format::Rgba8Unorm);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    expect(w_.pass_desc(),
           {
               {[](auto& d) { d.depth_stencil->texture = {}; },
                "A Texture is needed, but the id is empty."},
               {[&](auto& d) { d.depth_stencil->texture = another; },
                "The format (Rgba8Unorm) of [Texture \"another\"] is not a depth-stencil format."},
               {[](auto& d) { d.depth_stencil->depth_clear_value = 1.0F; }, valid},
               {[](auto& d) { d.depth_stencil->depth_clear_value = 1.5F; },
                "The depth clear value (1.5) of [Texture \"depth\"] is not within 0 and 1."},
               {[](auto& d) { d.depth_stencil->depth_clear_value = -0.5F; },
                "The depth clear value (-0.5) of [Texture \"depth\"] is not within 0 and 1."},
               {[nan](auto& d) { d.depth_stencil->depth_clear_value = nan; },
                "The depth clear value (nan) of [Texture \"depth\"] is not within 0 and 1."},
               {[](auto& d) { d.depth_stencil->stencil_clear_value = 255; }, valid},
               {[](auto& d) { d.depth_stencil->stencil_clear_value = 256; },
                "The stencil clear value (256) of [Texture \"depth\"] exceeds 255."},
               {[&](auto& d) { d.depth_stencil->texture = depth_only; },
                "The stencil of [Texture \"depth_only\"] is cleared, but its format (Depth32Float) "
                "has no stencil aspect."},
               {[&](auto& d) {
                    d.depth_stencil->texture = depth_only;
                    d.depth_stencil->stencil_load_op = LoadOp::Load;
                },
                valid},
               {[](auto& d) { d.depth_stencil->depth_read_only = true; },
                "The depth of [Texture \"depth\"] is read-only, but is cleared."},
               {[](auto& d) { d.depth_stencil->stencil_read_only = true; },
                "The stencil of [Texture \"depth\"] is read-only, but is cleared."},
           });
    RenderPassDesc read_only = w_.pass_desc();
    read_only.depth_stencil = DepthStencilAttachment{
        .texture = w_.depth, .depth_read_only = true, .stencil_read_only = true};
    expect(read_only, {
                          {[](auto& d) { d.depth_stencil->depth_store_op = StoreOp::Discard; },
                           "The depth of [Texture \"depth\"] is read-only, but is discarded."},
                          {[](auto& d) { d.depth_stencil->stencil_store_op = StoreOp::Discard; },
                           "The stencil of [Texture \"depth\"] is read-only, but is discarded."},
                      });
}

TEST_F(Pass, Queries) {
    const auto stamp = [](QuerySetId set, std::uint32_t begin, std::uint32_t end) {
        return [=](RenderPassDesc& d) { d.timestamp_writes = TimestampWrites{set, begin, end}; };
    };
    expect(w_.pass_desc(),
           {
               {[](auto& d) { d.occlusion_query_set = {}; }, valid},
               {[&](auto& d) { d.occlusion_query_set = w_.timestamps; },
                "The type of [QuerySet \"timestamps\"] is Timestamp instead of Occlusion."},
               {stamp(w_.timestamps, 1, 0), valid},
               {stamp({}, 0, 1), "A QuerySet is needed, but the id is empty."},
               {stamp(w_.occlusion, 0, 1),
                "The type of [QuerySet \"occlusion\"] is Occlusion instead of Timestamp."},
               {stamp(w_.timestamps, 2, 0),
                "The timestamp index (2) is not below the count (2) of [QuerySet \"timestamps\"]."},
               {stamp(w_.timestamps, 0, 2),
                "The timestamp index (2) is not below the count (2) of [QuerySet \"timestamps\"]."},
               {stamp(w_.timestamps, 1, 1),
                "Both timestamps of the pass go to index 1 of [QuerySet \"timestamps\"]."},
           });
}

}  // namespace
}  // namespace gnomon::gpu::test
