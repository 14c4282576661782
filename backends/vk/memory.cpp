// SPDX-License-Identifier: MIT
//
// The block allocator.
#include "internal/memory.hpp"

#include <algorithm>
#include <bit>
#include <iterator>

#include <gnomon/core/expects.hpp>

#include "internal/device.hpp"
#include "internal/error.hpp"

namespace gnomon::vk {

struct MemoryBlock {
    MemoryPool* pool = nullptr;
    std::uint64_t size = 0;
    SpanAllocator space{size};
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::byte* mapped = nullptr;
};

/// Blocks of one memory type. Images of optimal tiling and buffers never share a block, so that
/// bufferImageGranularity cannot matter.
struct MemoryPool {
    std::uint32_t type = 0;
    bool images = false;
    std::vector<std::unique_ptr<MemoryBlock>> blocks;
};

SpanAllocator::SpanAllocator(std::uint64_t size) : size_(size), free_bytes_(size) {
    if (size > 0) {
        gaps_.emplace(0, size);
    }
}

std::optional<std::uint64_t> SpanAllocator::allocate(std::uint64_t size, std::uint64_t alignment) {
    GNOMON_EXPECTS(size > 0 && std::has_single_bit(alignment));
    for (auto gap = gaps_.begin(); gap != gaps_.end(); ++gap) {
        const auto [begin, gap_size] = *gap;
        const std::uint64_t offset = (begin + alignment - 1) & ~(alignment - 1);
        const std::uint64_t padding = offset - begin;
        if (gap_size < padding || gap_size - padding < size) {
            continue;
        }
        // The padding stays a gap of its own, so that what is freed is what was asked for.
        if (padding > 0) {
            gap->second = padding;
        } else {
            gaps_.erase(gap);
        }
        if (const std::uint64_t rest = gap_size - padding - size; rest > 0) {
            gaps_.emplace(offset + size, rest);
        }
        free_bytes_ -= size;
        return offset;
    }
    return std::nullopt;
}

void SpanAllocator::free(std::uint64_t offset, std::uint64_t size) {
    GNOMON_EXPECTS(size > 0 && offset + size <= size_);
    auto after = gaps_.lower_bound(offset);
    GNOMON_EXPECTS(after == gaps_.end() || offset + size <= after->first);
    free_bytes_ += size;
    if (after != gaps_.end() && after->first == offset + size) {
        size += after->second;
        after = gaps_.erase(after);
    }
    if (after != gaps_.begin()) {
        const auto before = std::prev(after);
        GNOMON_EXPECTS(before->first + before->second <= offset);
        if (before->first + before->second == offset) {
            before->second += size;
            return;
        }
    }
    gaps_.emplace(offset, size);
}

namespace {

constexpr std::uint64_t standard_block_size = 64ULL << 20;

struct Wish {
    VkMemoryPropertyFlags required;
    VkMemoryPropertyFlags preferred;
    VkMemoryPropertyFlags avoided;
};

Wish wish_for(MemoryKind kind) {
    constexpr VkMemoryPropertyFlags host =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    switch (kind) {
        case MemoryKind::Upload:
            return {host, 0,
                    VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT};
        case MemoryKind::Readback:
            return {host, VK_MEMORY_PROPERTY_HOST_CACHED_BIT, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT};
        default:
            return {0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT};
    }
}

}  // namespace

Memory::Memory(const Device& device) : device_(device) {}

Memory::~Memory() {
    for (const std::unique_ptr<MemoryPool>& pool : pools_) {
        for (const std::unique_ptr<MemoryBlock>& block : pool->blocks) {
            device_.fn.FreeMemory(device_.handle, block->memory, nullptr);
        }
    }
}

std::vector<std::uint32_t> Memory::types_for(std::uint32_t type_bits, MemoryKind kind) const {
    // Such types need extensions or uses that gnomon has not got.
    constexpr VkMemoryPropertyFlags never = VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT |
                                            VK_MEMORY_PROPERTY_PROTECTED_BIT |
                                            VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD;
    const Wish wish = wish_for(kind);
    const VkPhysicalDeviceMemoryProperties& memory = device_.adapter.memory;
    const auto flags = [&](std::uint32_t type) { return memory.memoryTypes[type].propertyFlags; };
    std::vector<std::uint32_t> types;
    for (std::uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
        if ((type_bits >> type & 1U) != 0 && (flags(type) & wish.required) == wish.required &&
            (flags(type) & never) == 0) {
            types.push_back(type);
        }
    }
    const auto badness = [&](std::uint32_t type) {
        return 4 * std::popcount(wish.preferred & ~flags(type)) +
               std::popcount(wish.avoided & flags(type));
    };
    std::stable_sort(types.begin(), types.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return badness(a) < badness(b); });
    return types;
}

std::uint64_t Memory::block_size(std::uint32_t type) const {
    const VkPhysicalDeviceMemoryProperties& memory = device_.adapter.memory;
    const std::uint64_t heap = memory.memoryHeaps[memory.memoryTypes[type].heapIndex].size;
    return std::min(standard_block_size, heap / 8);
}

MemoryPool& Memory::pool(std::uint32_t type, bool images) {
    for (const std::unique_ptr<MemoryPool>& pool : pools_) {
        if (pool->type == type && pool->images == images) {
            return *pool;
        }
    }
    pools_.push_back(std::make_unique<MemoryPool>(MemoryPool{type, images, {}}));
    return *pools_.back();
}

VkResult Memory::add_block(MemoryPool& pool, std::uint64_t size) {
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.allocationSize = size;
    info.memoryTypeIndex = pool.type;
    auto block = std::make_unique<MemoryBlock>(MemoryBlock{.pool = &pool, .size = size});
    VkResult result = device_.fn.AllocateMemory(device_.handle, &info, nullptr, &block->memory);
    if (result != VK_SUCCESS) {
        return result;
    }
    const VkMemoryPropertyFlags flags = device_.adapter.memory.memoryTypes[pool.type].propertyFlags;
    if (!pool.images && (flags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0) {
        void* mapped = nullptr;
        result = device_.fn.MapMemory(device_.handle, block->memory, 0, VK_WHOLE_SIZE, 0, &mapped);
        if (result != VK_SUCCESS) {
            device_.fn.FreeMemory(device_.handle, block->memory, nullptr);
            return result;
        }
        block->mapped = static_cast<std::byte*>(mapped);
    }
    pool.blocks.push_back(std::move(block));
    return VK_SUCCESS;
}

VkResult Memory::allocate_from(MemoryPool& pool, const VkMemoryRequirements& requirements,
                               Allocation& allocation) {
    const auto take = [&](MemoryBlock& block) {
        const std::optional<std::uint64_t> offset =
            block.space.allocate(requirements.size, requirements.alignment);
        if (offset) {
            allocation = {.block = &block,
                          .memory = block.memory,
                          .offset = *offset,
                          .size = requirements.size,
                          .mapped = block.mapped != nullptr ? block.mapped + *offset : nullptr};
        }
        return offset.has_value();
    };
    const std::uint64_t block_bytes = block_size(pool.type);
    const bool shared = requirements.size <= block_bytes / 2;
    if (shared) {
        for (const std::unique_ptr<MemoryBlock>& block : pool.blocks) {
            if (take(*block)) {
                return VK_SUCCESS;
            }
        }
        if (add_block(pool, block_bytes) == VK_SUCCESS && take(*pool.blocks.back())) {
            return VK_SUCCESS;
        }
    }
    // Large, or a whole block no longer fits into the heap: exactly what is needed.
    const VkResult result = add_block(pool, requirements.size);
    if (result == VK_SUCCESS) {
        take(*pool.blocks.back());
    }
    return result;
}

Result<Allocation> Memory::allocate(const VkMemoryRequirements& requirements, MemoryKind kind,
                                    std::string_view subject) {
    VkResult result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
    for (const std::uint32_t type : types_for(requirements.memoryTypeBits, kind)) {
        Allocation allocation;
        result = allocate_from(pool(type, kind == MemoryKind::Image), requirements, allocation);
        if (result == VK_SUCCESS) {
            return allocation;
        }
    }
    return failure(
        result, "vkAllocateMemory",
        std::string(subject) + ", which needs " + std::to_string(requirements.size) + " bytes,");
}

void Memory::free(Allocation& allocation) {
    if (allocation.block == nullptr) {
        return;
    }
    MemoryBlock& block = *allocation.block;
    block.space.free(allocation.offset, allocation.size);
    allocation = {};
    if (!block.space.empty()) {
        return;
    }
    // One empty block of standard size stays, so that a resource made and freed each frame does not
    // go to the driver each frame.
    MemoryPool& owner = *block.pool;
    const std::uint64_t standard = block_size(owner.type);
    const auto spare_blocks = std::count_if(
        owner.blocks.begin(), owner.blocks.end(), [&](const std::unique_ptr<MemoryBlock>& other) {
            return other->space.empty() && other->size == standard;
        });
    if (block.size == standard && spare_blocks == 1) {
        return;
    }
    device_.fn.FreeMemory(device_.handle, block.memory, nullptr);
    std::erase_if(owner.blocks,
                  [&](const std::unique_ptr<MemoryBlock>& other) { return other.get() == &block; });
}

}  // namespace gnomon::vk
