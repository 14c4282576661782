// SPDX-License-Identifier: MIT
//
// The calls of gpu::Backend; objects are made and freed in backend_objects.cpp.
#include <gnomon/vk/backend.hpp>

#include <fmt/format.h>

#include "internal/error.hpp"
#include "internal/vulkan_backend.hpp"

namespace gnomon::vk {

Result<std::unique_ptr<gpu::Backend>> create_backend(const BackendOptions& options) {
    Result<std::unique_ptr<Device>> device = Device::create(options);
    if (!device) {
        return forward_error(device);
    }
    auto backend = std::make_unique<VulkanBackend>(std::move(*device));
    if (const Status initialised = backend->initialise(options); !initialised) {
        return forward_error(initialised);
    }
    return backend;
}

Result<AdoptedDevice> adopt_device(const HostDevice& host) {
    Result<std::unique_ptr<Device>> device = Device::adopt(host);
    if (!device) {
        return forward_error(device);
    }
    auto commands = std::make_shared<HostCommands>();
    auto backend = std::make_unique<VulkanBackend>(std::move(*device), commands);
    if (const Status initialised = backend->initialise({}); !initialised) {
        return forward_error(initialised);
    }
    return AdoptedDevice{std::move(backend), std::move(commands)};
}

VulkanBackend::VulkanBackend(std::unique_ptr<Device> device, std::shared_ptr<HostCommands> commands)
    : device_(std::move(device)),
      host_commands_(std::move(commands)),
      memory_(*device_),
      descriptor_pools_(*device_),
      queue_(*device_),
      transfers_(*device_, memory_, queue_),
      render_passes_(*device_, queue_),
      pipeline_maker_(*device_, render_passes_) {}

Status VulkanBackend::initialise(const BackendOptions& options) {
    if (const Status initialised = queue_.initialise(); !initialised) {
        return initialised;
    }
    if (host_commands_ != nullptr) {
        queue_.share_with_host();
    }
    if (const Status initialised = pipeline_maker_.initialise(); !initialised) {
        return initialised;
    }
    const Result<VkSampler> nearest = make_sampler(*device_, {.label = "nearest"});
    if (!nearest) {
        return forward_error(nearest);
    }
    nearest_sampler_ = *nearest;
    if (options.window) {
        swapchain_ = std::make_unique<Swapchain>(*device_, queue_, *options.window);
    }
    return {};
}

void VulkanBackend::look_at_host() {
    if (host_commands_ == nullptr || host_commands_->command_buffer.times_set() == host_buffers_) {
        return;
    }
    host_buffers_ = host_commands_->command_buffer.times_set();
    host_buffer_ = host_commands_->command_buffer;
    queue_.let_go();
}

template <class Object>
Status VulkanBackend::check_write(const Object& object) {
    look_at_host();
    if (host_buffer_ == nullptr || object.read_by_host != host_buffers_) {
        return {};
    }
    return fail(
        ErrorCode::InvalidInput,
        fmt::format("A write to {} would change what commands read that are in the host's "
                    "command buffer already, since writes run before all of that: submit it "
                    "first and set HostCommands::command_buffer to null or to another, or "
                    "give each view in one command buffer a GuestPass or LightMasks of its "
                    "own.",
                    object.subject));
}

Status VulkanBackend::write_buffer(gpu::BufferId id, std::uint64_t offset,
                                   std::span<const std::byte> bytes) {
    if (const Status possible = check_write(resources_.buffers[id]); !possible) {
        return possible;
    }
    return transfers_.write(resources_.buffers[id], offset, bytes);
}

Status VulkanBackend::write_texture(gpu::TextureId id, std::uint32_t mip_level,
                                    std::span<const std::byte> bytes) {
    if (const Status possible = check_write(resources_.textures[id]); !possible) {
        return possible;
    }
    return transfers_.write(resources_.textures[id], mip_level, bytes);
}

Status VulkanBackend::submit(const gpu::CommandBuffer& commands) {
    look_at_host();
    if (host_buffer_ != nullptr) {
        queue_.hold();
        CommandRecorder recorder{*device_,
                                 render_passes_,
                                 resources_,
                                 queue_,
                                 static_cast<VkCommandBuffer>(host_buffer_),
                                 host_buffers_};
        const Status recorded = recorder.record(commands);
        // Uploads, and what cannot be recorded in a render pass, run before what the host submits.
        const Status uploaded = queue_.submit();
        return recorded ? uploaded : recorded;
    }
    const Result<VkCommandBuffer> out = queue_.commands();
    if (!out) {
        return forward_error(out);
    }
    CommandRecorder recorder{*device_, render_passes_, resources_, queue_, *out};
    if (const Status recorded = recorder.record(commands); !recorded) {
        return recorded;
    }
    return queue_.submit();
}

Status VulkanBackend::wait_idle() {
    look_at_host();
    return queue_.finish();
}

Status VulkanBackend::read_buffer(gpu::BufferId id, std::uint64_t offset,
                                  std::span<std::byte> bytes) {
    return transfers_.read(resources_.buffers[id], offset, bytes);
}

Status VulkanBackend::read_texture(gpu::TextureId id, gpu::Aspect aspect,
                                   std::span<std::byte> bytes) {
    return transfers_.read(resources_.textures[id], aspect, bytes);
}

Result<std::vector<std::uint64_t>> VulkanBackend::read_query_set(gpu::QuerySetId id) {
    return transfers_.read(resources_.query_sets[id]);
}

Status VulkanBackend::present(gpu::TextureId id) {
    if (swapchain_ == nullptr) {
        return fail(ErrorCode::Unsupported,
                    "This Vulkan device was made without a window, so nothing can be presented.");
    }
    return swapchain_->present(resources_.textures[id]);
}

}  // namespace gnomon::vk
