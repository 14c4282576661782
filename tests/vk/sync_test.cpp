// SPDX-License-Identifier: MIT
//
// Which uses need a barrier, and which do not. No device is needed.
#include <gtest/gtest.h>

#include "internal/sync.hpp"

namespace gnomon::vk {
namespace {

constexpr VkImageAspectFlags color = VK_IMAGE_ASPECT_COLOR_BIT;

TEST(Tracker, AFreshBufferNeedsNoBarrier) {
    Tracker tracker;
    Dependency dependency;
    EXPECT_FALSE(tracker.use_buffer(Usage::CopyDestination, dependency));
}

TEST(Tracker, AReadWaitsForTheWriteOnce) {
    Tracker tracker;
    Dependency dependency;
    static_cast<void>(tracker.use_buffer(Usage::CopyDestination, dependency));
    ASSERT_TRUE(tracker.use_buffer(Usage::Uniform, dependency));
    EXPECT_EQ(dependency.source_stages, VkFlags{VK_PIPELINE_STAGE_TRANSFER_BIT});
    EXPECT_EQ(dependency.source_access, VkFlags{VK_ACCESS_TRANSFER_WRITE_BIT});
    EXPECT_EQ(dependency.destination_access, VkFlags{VK_ACCESS_UNIFORM_READ_BIT});
    EXPECT_FALSE(tracker.use_buffer(Usage::Uniform, dependency));
}

TEST(Tracker, EachKindOfReadWaitsForItself) {
    Tracker tracker;
    Dependency dependency;
    static_cast<void>(tracker.use_buffer(Usage::CopyDestination, dependency));
    EXPECT_TRUE(tracker.use_buffer(Usage::Uniform, dependency));
    ASSERT_TRUE(tracker.use_buffer(Usage::VertexInput, dependency));
    EXPECT_EQ(dependency.source_stages, VkFlags{VK_PIPELINE_STAGE_TRANSFER_BIT});
    EXPECT_FALSE(tracker.use_buffer(Usage::Uniform, dependency));
}

TEST(Tracker, AWriteWaitsForAllReaders) {
    Tracker tracker;
    Dependency dependency;
    static_cast<void>(tracker.use_buffer(Usage::CopyDestination, dependency));
    static_cast<void>(tracker.use_buffer(Usage::VertexInput, dependency));
    static_cast<void>(tracker.use_buffer(Usage::CopySource, dependency));
    ASSERT_TRUE(tracker.use_buffer(Usage::CopyDestination, dependency));
    EXPECT_EQ(dependency.source_stages,
              VkFlags{VK_PIPELINE_STAGE_VERTEX_INPUT_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT});
    EXPECT_EQ(dependency.source_access, 0U) << "there is nothing to flush after reads";
}

TEST(Tracker, AWriteAfterAWriteWaits) {
    Tracker tracker;
    Dependency dependency;
    static_cast<void>(tracker.use_image(Usage::ColorAttachment, color, dependency));
    ASSERT_TRUE(tracker.use_image(Usage::ColorAttachment, color, dependency));
    EXPECT_EQ(dependency.source_access & VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT,
              VkFlags{VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT});
    EXPECT_EQ(dependency.old_layout, dependency.new_layout);
}

TEST(Tracker, AChangeOfLayoutIsABarrierEvenBetweenReads) {
    Tracker tracker;
    Dependency dependency;
    EXPECT_TRUE(tracker.use_image(Usage::ColorAttachment, color, dependency));
    EXPECT_EQ(dependency.old_layout, VK_IMAGE_LAYOUT_UNDEFINED);
    EXPECT_TRUE(tracker.use_image(Usage::SampledInFragment, color, dependency));
    ASSERT_TRUE(tracker.use_image(Usage::CopySource, color, dependency));
    EXPECT_EQ(dependency.old_layout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    EXPECT_EQ(dependency.new_layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    EXPECT_EQ(dependency.source_stages, VkFlags{VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT});
    EXPECT_FALSE(tracker.use_image(Usage::CopySource, color, dependency));
}

TEST(Tracker, ForgottenContentsAreNotKeptByTheNextTransition) {
    Tracker tracker;
    Dependency dependency;
    static_cast<void>(tracker.use_image(Usage::ColorAttachment, color, dependency));
    tracker.forget_contents();
    ASSERT_TRUE(tracker.use_image(Usage::ColorAttachment, color, dependency));
    EXPECT_EQ(dependency.old_layout, VK_IMAGE_LAYOUT_UNDEFINED);
    EXPECT_EQ(dependency.source_stages, VkFlags{VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT})
        << "the earlier write is still waited for";
}

TEST(LayoutOf, DepthAndStencilAreSampledInTheirOwnLayout) {
    EXPECT_EQ(layout_of(Usage::SampledInFragment,
                        VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT),
              VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL);
    EXPECT_EQ(layout_of(Usage::SampledInFragment, color), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

}  // namespace
}  // namespace gnomon::vk
