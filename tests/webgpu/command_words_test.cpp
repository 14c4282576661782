// SPDX-License-Identifier: MIT
//
// Command lists as words, each kind of command: what bridge.js relies on.
#include "internal/command_words.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>

namespace gnomon::webgpu {
namespace {

using testing::ElementsAre;

template <class Tag>
gpu::Id<Tag> id(std::uint32_t index) {
    return {.index = index, .generation = 1};
}

std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value); }
// 1.0 as a double.
constexpr std::uint32_t one_low = 0;
constexpr std::uint32_t one_high = 0x3FF0'0000;

// Words of one command, behind those of the label, which is empty.
std::vector<std::uint32_t> words_of(const gpu::Command& command) {
    std::vector<std::uint32_t> words;
    write_words({.label = {}, .commands = {command}, .passes = {}, .strings = {"abcde"}}, words);
    EXPECT_EQ(words.at(0), 0U);
    words.erase(words.begin());
    return words;
}

TEST(CommandWords, BeginWithTheNumberThatTheBridgeKnowsThemBy) {
    EXPECT_THAT(words_of(gpu::cmd::EndRenderPass{}), ElementsAre(1));
    EXPECT_THAT(words_of(gpu::cmd::SetPipeline{id<gpu::RenderPipelineTag>(7)}), ElementsAre(2, 7));
    EXPECT_THAT(words_of(gpu::cmd::SetBindGroup{.group = 1,
                                                .bind_group = id<gpu::BindGroupTag>(9),
                                                .dynamic_offset_count = 2,
                                                .dynamic_offsets = {256, 512}}),
                ElementsAre(3, 1, 9, 2, 256, 512));
    EXPECT_THAT(words_of(gpu::cmd::SetVertexBuffer{2, id<gpu::BufferTag>(3), 0x1'0000'0008}),
                ElementsAre(4, 2, 3, 8, 1));
    EXPECT_THAT(
        words_of(gpu::cmd::SetIndexBuffer{id<gpu::BufferTag>(3), gpu::IndexFormat::Uint16, 4}),
        ElementsAre(5, 3, 0, 4, 0));
    EXPECT_THAT(words_of(gpu::cmd::SetStencilReference{128}), ElementsAre(6, 128));
    EXPECT_THAT(words_of(gpu::cmd::SetBlendConstant{{.r = 1.0}}),
                ElementsAre(7, one_low, one_high, 0, 0, 0, 0, 0, 0));
    EXPECT_THAT(words_of(gpu::cmd::SetViewport{0, 1, 2, 3, 0.25F, 1}),
                ElementsAre(8, 0, bits(1), bits(2), bits(3), bits(0.25F), bits(1)));
    EXPECT_THAT(words_of(gpu::cmd::SetScissorRect{1, 2, 3, 4}), ElementsAre(9, 1, 2, 3, 4));
    EXPECT_THAT(words_of(gpu::cmd::SetDepthBounds{}), ElementsAre()) << "WebGPU has none";
    EXPECT_THAT(words_of(gpu::cmd::Draw{3, 1, 6, 5}), ElementsAre(11, 3, 1, 6, 5));
    EXPECT_THAT(words_of(gpu::cmd::DrawIndexed{3, 1, 6, -1, 5}),
                ElementsAre(12, 3, 1, 6, 0xFFFF'FFFF, 5));
    EXPECT_THAT(words_of(gpu::cmd::BeginOcclusionQuery{4}), ElementsAre(13, 4));
    EXPECT_THAT(words_of(gpu::cmd::EndOcclusionQuery{}), ElementsAre(14));
    EXPECT_THAT(words_of(gpu::cmd::PushDebugGroup{0}), ElementsAre(15, 5, 0x64636261, 0x65))
        << "text is packed";
    EXPECT_THAT(words_of(gpu::cmd::PopDebugGroup{}), ElementsAre(16));
    EXPECT_THAT(words_of(gpu::cmd::CopyBufferToBuffer{id<gpu::BufferTag>(1), 4,
                                                      id<gpu::BufferTag>(2), 8, 12}),
                ElementsAre(17, 1, 4, 0, 2, 8, 0, 12, 0));
}

TEST(CommandWords, OfAPassSayWhatIsNotThere) {
    std::vector<std::uint32_t> words;
    write_words({.label = "frame",
                 .commands = {gpu::cmd::BeginRenderPass{0}},
                 .passes = {{.color_attachments = {{.texture = id<gpu::TextureTag>(2),
                                                    .load_op = gpu::LoadOp::Clear,
                                                    .clear_value = {.a = 1.0}}}}},
                 .strings = {}},
                words);
    EXPECT_THAT(words, ElementsAre(5, 0x6D617266, 0x65,                  // "frame"
                                   0, 0,                                 // a pass, no label
                                   1, 2, no_object, 1, 0,                // one colour
                                   0, 0, 0, 0, 0, 0, one_low, one_high,  // cleared to
                                   no_object, no_object, no_object));    // nothing else
}

TEST(CommandWords, OfAPassSayWhatIsThere) {
    std::vector<std::uint32_t> words{1, 2, 3};
    gpu::RenderPassDesc pass;
    pass.depth_stencil = {.texture = id<gpu::TextureTag>(5),
                          .depth_load_op = gpu::LoadOp::Clear,
                          .depth_clear_value = 0.5F,
                          .stencil_store_op = gpu::StoreOp::Discard,
                          .stencil_clear_value = 3,
                          .stencil_read_only = true};
    pass.occlusion_query_set = id<gpu::QuerySetTag>(6);
    pass.timestamp_writes = {
        .query_set = id<gpu::QuerySetTag>(7), .beginning_index = 2, .end_index = 3};
    write_words(
        {.label = {}, .commands = {gpu::cmd::BeginRenderPass{0}}, .passes = {pass}, .strings = {}},
        words);
    EXPECT_THAT(words, ElementsAre(0, 0, 0, 0,              // labels; no colour
                                   5, 1, 0, 0, bits(0.5F),  // depth
                                   0, 1, 1, 3,              // stencil
                                   6, 7, 2, 3));            // queries
}

}  // namespace
}  // namespace gnomon::webgpu
