// SPDX-License-Identifier: MIT
//
// Device memory in blocks: a driver allows few allocations (4,096 is common) and each is slow, so
// resources share blocks of 64 MiB. What is larger than half a block gets memory of its own.
// SpanAllocator is the arithmetic and knows nothing of Vulkan.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include <gnomon/core/result.hpp>

#include "internal/functions.hpp"

namespace gnomon::vk {

class Device;

/// Hands out parts of 0..size, first fit by address. Free neighbours are always merged.
class SpanAllocator {
public:
    explicit SpanAllocator(std::uint64_t size);

    /// The offset, a multiple of `alignment` (a power of two), or nothing when no gap is large
    /// enough. `size` is at least 1. Cost: linear in the number of gaps.
    [[nodiscard]] std::optional<std::uint64_t> allocate(std::uint64_t size,
                                                        std::uint64_t alignment);
    /// Exactly what allocate() gave.
    void free(std::uint64_t offset, std::uint64_t size);

    [[nodiscard]] bool empty() const { return free_bytes_ == size_; }
    [[nodiscard]] std::uint64_t free_bytes() const { return free_bytes_; }
    [[nodiscard]] std::size_t gap_count() const { return gaps_.size(); }

private:
    std::uint64_t size_ = 0;
    std::uint64_t free_bytes_ = 0;
    std::map<std::uint64_t, std::uint64_t> gaps_;  // offset to size
};

enum class MemoryKind : std::uint8_t {
    Buffer,    ///< device-local, linear
    Image,     ///< device-local, optimal tiling
    Upload,    ///< mapped, written by the host
    Readback,  ///< mapped, read by the host
};

struct MemoryBlock;
struct MemoryPool;

/// A piece of a block. Empty when default-made.
struct Allocation {
    MemoryBlock* block = nullptr;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::uint64_t offset = 0;
    std::uint64_t size = 0;
    std::byte* mapped = nullptr;  ///< for Upload and Readback
};

class Memory {
public:
    explicit Memory(const Device& device);
    ~Memory();
    Memory(const Memory&) = delete;
    Memory& operator=(const Memory&) = delete;

    /// `subject` names the resource in the error: "buffer 'indices'".
    [[nodiscard]] Result<Allocation> allocate(const VkMemoryRequirements& requirements,
                                              MemoryKind kind, std::string_view subject);
    void free(Allocation& allocation);

private:
    [[nodiscard]] std::vector<std::uint32_t> types_for(std::uint32_t type_bits,
                                                       MemoryKind kind) const;
    [[nodiscard]] std::uint64_t block_size(std::uint32_t type) const;
    MemoryPool& pool(std::uint32_t type, bool images);
    VkResult add_block(MemoryPool& pool, std::uint64_t size);
    VkResult allocate_from(MemoryPool& pool, const VkMemoryRequirements& requirements,
                           Allocation& allocation);

    const Device& device_;
    std::vector<std::unique_ptr<MemoryPool>> pools_;
};

}  // namespace gnomon::vk
