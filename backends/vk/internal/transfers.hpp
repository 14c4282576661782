// SPDX-License-Identifier: MIT
//
// Bytes between the host and resources. Writing goes through the staging belt and keeps queue
// order; reading submits what was recorded and waits.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "internal/resources.hpp"
#include "internal/staging.hpp"

namespace gnomon::vk {

class Transfers {
public:
    Transfers(Device& device, Memory& memory, Queue& queue)
        : device_(device), queue_(queue), belt_(device, memory, queue), readback_(device, memory) {}

    [[nodiscard]] Status write(Buffer& buffer, std::uint64_t offset,
                               std::span<const std::byte> bytes);
    [[nodiscard]] Status write(Texture& texture, std::uint32_t mip_level,
                               std::span<const std::byte> bytes);
    [[nodiscard]] Status read(Buffer& buffer, std::uint64_t offset, std::span<std::byte> bytes);
    /// Depth as 32-bit floats whatever the format, stencil as bytes.
    [[nodiscard]] Status read(Texture& texture, gpu::Aspect aspect, std::span<std::byte> bytes);
    [[nodiscard]] Result<std::vector<std::uint64_t>> read(const QuerySet& queries);

private:
    [[nodiscard]] Result<StagingBelt::Slice> stage(std::span<const std::byte> bytes,
                                                   std::uint64_t alignment);
    [[nodiscard]] Status submit_if_full();
    /// Lets the host see what was copied into the read-back buffer, and waits for it.
    [[nodiscard]] Status finish_reading(VkCommandBuffer commands);

    Device& device_;
    Queue& queue_;
    StagingBelt belt_;
    ReadbackBuffer readback_;
};

}  // namespace gnomon::vk
