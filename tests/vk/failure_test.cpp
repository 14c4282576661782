// SPDX-License-Identifier: MIT
//
// What a driver's failures become. Functions in the device's own table are replaced by ones that
// fail; the validation layer sees whether what was made before the failure was freed.
#include <gmock/gmock.h>

#include "internal/buffers.hpp"
#include "internal/error.hpp"
#include "internal/queue.hpp"
#include "internal/textures.hpp"
#include "tests/vk/fixture.hpp"

namespace gnomon::vk {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// A function of any of Vulkan's types that does nothing but fail.
template <VkResult Code, class... Arguments>
VKAPI_ATTR VkResult VKAPI_CALL fails(Arguments...) {
    return Code;
}
template <VkResult Code, class... Arguments>
void make_fail(VkResult(VKAPI_PTR*& function)(Arguments...)) {
    function = fails<Code, Arguments...>;
}

class Failure : public vk_test::DeviceFixture {
protected:
    void SetUp() override {
        DeviceFixture::SetUp();
        device.reset();
        if (IsSkipped() || HasFatalFailure()) {
            return;
        }
        BackendOptions options;
        options.message_sink = test::make_sink(log);
        options.validation = true;
        Result<std::unique_ptr<Device>> made = Device::create(options);
        if (!made) {
            GTEST_SKIP() << made.error().message;
        }
        vulkan = std::move(*made);
        working = vulkan->fn;
    }

    void expect_buffer_fails(ErrorCode code, std::string_view call) {
        Memory memory{*vulkan};
        const Result<Buffer> buffer = make_buffer(
            *vulkan, memory, {.label = "doomed", .size = 64, .usage = gpu::BufferUsage::Vertex});
        vulkan->fn = working;
        ASSERT_FALSE(buffer);
        EXPECT_EQ(buffer.error().code, code);
        EXPECT_THAT(buffer.error().message,
                    StartsWith(std::string{call} + " failed for buffer 'doomed'"));
    }

    void expect_texture_fails(ErrorCode code, std::string_view call) {
        Memory memory{*vulkan};
        const Result<Texture> texture =
            make_texture(*vulkan, memory,
                         {.label = "doomed",
                          .width = 8,
                          .height = 8,
                          .format = gpu::Format::Rgba8Unorm,
                          .usage = gpu::TextureUsage::RenderAttachment});
        vulkan->fn = working;
        ASSERT_FALSE(texture);
        EXPECT_EQ(texture.error().code, code);
        EXPECT_THAT(texture.error().message,
                    StartsWith(std::string{call} + " failed for texture 'doomed'"));
    }

    std::unique_ptr<Device> vulkan;
    DeviceFunctions working;
};

TEST_F(Failure, OfEachStepOfABufferFreesTheOthers) {
    make_fail<VK_ERROR_OUT_OF_HOST_MEMORY>(vulkan->fn.CreateBuffer);
    expect_buffer_fails(ErrorCode::OutOfMemory, "vkCreateBuffer");
    make_fail<VK_ERROR_OUT_OF_DEVICE_MEMORY>(vulkan->fn.AllocateMemory);
    expect_buffer_fails(ErrorCode::OutOfMemory, "vkAllocateMemory");
    make_fail<VK_ERROR_DEVICE_LOST>(vulkan->fn.BindBufferMemory);
    expect_buffer_fails(ErrorCode::DeviceLost, "vkBindBufferMemory");
}

TEST_F(Failure, OfEachStepOfATextureFreesTheOthers) {
    make_fail<VK_ERROR_OUT_OF_HOST_MEMORY>(vulkan->fn.CreateImage);
    expect_texture_fails(ErrorCode::OutOfMemory, "vkCreateImage");
    make_fail<VK_ERROR_OUT_OF_DEVICE_MEMORY>(vulkan->fn.AllocateMemory);
    expect_texture_fails(ErrorCode::OutOfMemory, "vkAllocateMemory");
    make_fail<VK_ERROR_OUT_OF_DEVICE_MEMORY>(vulkan->fn.BindImageMemory);
    expect_texture_fails(ErrorCode::OutOfMemory, "vkBindImageMemory");
    make_fail<VK_ERROR_OUT_OF_HOST_MEMORY>(vulkan->fn.CreateImageView);
    expect_texture_fails(ErrorCode::OutOfMemory, "vkCreateImageView");
}

TEST_F(Failure, OfASubmissionLosesTheDeviceForGood) {
    Queue queue{*vulkan};
    ASSERT_TRUE(queue.initialise());
    ASSERT_TRUE(queue.commands());
    make_fail<VK_ERROR_DEVICE_LOST>(vulkan->fn.QueueSubmit);
    const Status first = queue.submit();
    vulkan->fn = working;
    ASSERT_FALSE(first);
    EXPECT_EQ(first.error().code, ErrorCode::DeviceLost);
    EXPECT_EQ(first.error().message,
              "vkQueueSubmit failed for the queue with VK_ERROR_DEVICE_LOST.");
    for (const Status& later : {queue.submit(), queue.finish()}) {
        ASSERT_FALSE(later);
        EXPECT_EQ(later.error().code, ErrorCode::DeviceLost);
        EXPECT_THAT(later.error().message, HasSubstr("vkQueueSubmit failed"));
    }
    EXPECT_FALSE(queue.commands());
}

TEST_F(Failure, BeforeRecordingLeavesTheQueueUsable) {
    Queue queue{*vulkan};
    ASSERT_TRUE(queue.initialise());
    make_fail<VK_ERROR_OUT_OF_HOST_MEMORY>(vulkan->fn.BeginCommandBuffer);
    const Result<VkCommandBuffer> refused = queue.commands();
    vulkan->fn = working;
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::OutOfMemory);
    ASSERT_TRUE(queue.commands());
    EXPECT_TRUE(queue.finish());
}

TEST_F(Failure, DeferredDestructionWaitsForItsSubmission) {
    Queue queue{*vulkan};
    ASSERT_TRUE(queue.initialise());
    int destroyed = 0;
    queue.defer([&] { ++destroyed; });
    EXPECT_EQ(destroyed, 1) << "nothing can use it";
    ASSERT_TRUE(queue.commands());
    queue.defer([&] { ++destroyed; });
    EXPECT_EQ(destroyed, 1) << "what is being recorded may use it";
    ASSERT_TRUE(queue.finish());
    EXPECT_EQ(destroyed, 2);
    ASSERT_TRUE(queue.commands());
    queue.defer([&] { ++destroyed; });
    queue.drain();
    EXPECT_EQ(destroyed, 3);
}

TEST(ErrorOf, AResultNamesItAndTheCall) {
    const Error unknown = failure(static_cast<VkResult>(-12345), "vkCall", "a thing").value();
    EXPECT_EQ(unknown.code, ErrorCode::Internal);
    EXPECT_EQ(unknown.message, "vkCall failed for a thing with VkResult -12345.");
    EXPECT_EQ(failure(VK_ERROR_FORMAT_NOT_SUPPORTED, "vkCall", "a thing").value().code,
              ErrorCode::Unsupported);
}

}  // namespace
}  // namespace gnomon::vk
