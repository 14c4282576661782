// SPDX-License-Identifier: MIT
//
// A Vulkan device of the test's own, and the smallest drawing that uses every kind of object.
// Whatever the validation layer says that was not announced fails the test, also what it says while
// the device is destroyed.
#pragma once

#include <array>
#include <memory>

#include <gnomon/gpu/device.hpp>
#include <gnomon/vk/backend.hpp>

#include "tests/support/devices.hpp"
#include "tests/support/message_log.hpp"

namespace gnomon::vk_test {

using test::must;
using Rgba8 = std::array<std::uint8_t, 4>;

/// Validation where the layer is installed, and a log for the messages.
[[nodiscard]] Result<gpu::Device> open(const std::shared_ptr<test::MessageLog>& log,
                                       vk::BackendOptions options = {});

class DeviceFixture : public testing::Test {
protected:
    /// Skips the test where there is no Vulkan device, unless GNOMON_REQUIRE_DEVICES names "vk".
    void SetUp() override;

    std::shared_ptr<test::MessageLog> log = std::make_shared<test::MessageLog>("vk");
    std::unique_ptr<gpu::Device> device;
};

/// Fills targets with a uniform colour, or with another texture.
class Painter {
public:
    Painter(gpu::Device& device, std::uint32_t width, std::uint32_t height,
            gpu::Format format = gpu::Format::Rgba8Unorm);

    [[nodiscard]] gpu::Texture make_target() const;
    /// What the next fill will draw.
    void set_color(float r, float g, float b);
    void fill(const gpu::Texture& target);
    void copy(const gpu::Texture& source, const gpu::Texture& target);
    /// The pixel that all pixels of the target are; fails the test when they differ.
    [[nodiscard]] Rgba8 read_uniform(const gpu::Texture& target) const;

private:
    void draw(const gpu::RenderPipeline& pipeline, const gpu::BindGroup& group,
              const gpu::Texture& target);

    gpu::Device& device_;
    std::uint32_t width_, height_;
    gpu::Format format_;
    gpu::Buffer color_;
    gpu::Sampler sampler_;
    gpu::BindGroupLayout color_layout_, texture_layout_;
    gpu::BindGroup color_group_;
    gpu::RenderPipeline fill_, copy_;
};

}  // namespace gnomon::vk_test
