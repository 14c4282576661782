// SPDX-License-Identifier: MIT
//
// Makes descriptor set layouts and allocates descriptor sets.
#include "internal/bind_groups.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "internal/conv.hpp"
#include "internal/error.hpp"

namespace gnomon::vk {

namespace {

constexpr std::uint32_t sets_per_pool = 256;
constexpr std::uint32_t descriptors_per_pool = 512;  // of each type

VkDescriptorType type_of(const gpu::BindGroupLayoutEntry& entry) {
    if (entry.type == gpu::BindingType::SampledTexture) {
        return VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    }
    return entry.has_dynamic_offset ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC
                                    : VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
}

bool fits(const DescriptorPool& pool, const DescriptorCounts& counts) {
    return pool.free_sets > 0 && pool.free.uniform_buffers >= counts.uniform_buffers &&
           pool.free.dynamic_uniform_buffers >= counts.dynamic_uniform_buffers &&
           pool.free.sampled_textures >= counts.sampled_textures;
}

}  // namespace

Result<BindGroupLayout> make_bind_group_layout(Device& device,
                                               const gpu::BindGroupLayoutDesc& desc) {
    BindGroupLayout layout;
    layout.entries = desc.entries;
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (const gpu::BindGroupLayoutEntry& entry : desc.entries) {
        VkDescriptorSetLayoutBinding binding{};
        binding.binding = entry.binding;
        binding.descriptorType = type_of(entry);
        binding.descriptorCount = 1;
        binding.stageFlags = to_vk(entry.visibility);
        bindings.push_back(binding);
        switch (binding.descriptorType) {
            case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER: ++layout.counts.uniform_buffers; break;
            case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC:
                ++layout.counts.dynamic_uniform_buffers;
                break;
            default: ++layout.counts.sampled_textures; break;
        }
    }
    VkDescriptorSetLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    info.bindingCount = static_cast<std::uint32_t>(bindings.size());
    info.pBindings = bindings.data();
    if (const VkResult result =
            device.fn.CreateDescriptorSetLayout(device.handle, &info, nullptr, &layout.handle);
        result != VK_SUCCESS) {
        return failure(result, "vkCreateDescriptorSetLayout",
                       fmt::format("bind group layout '{}'", desc.label));
    }
    device.set_name(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, layout.handle, desc.label);
    return layout;
}

DescriptorPools::~DescriptorPools() {
    for (const std::unique_ptr<DescriptorPool>& pool : pools_) {
        device_.fn.DestroyDescriptorPool(device_.handle, pool->handle, nullptr);
    }
}

Status DescriptorPools::add_pool(const DescriptorCounts& at_least) {
    auto pool = std::make_unique<DescriptorPool>();
    pool->free_sets = sets_per_pool;
    pool->free = {std::max(at_least.uniform_buffers, descriptors_per_pool),
                  std::max(at_least.dynamic_uniform_buffers, descriptors_per_pool),
                  std::max(at_least.sampled_textures, descriptors_per_pool)};
    const std::array<VkDescriptorPoolSize, 3> sizes{{
        {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, pool->free.uniform_buffers},
        {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, pool->free.dynamic_uniform_buffers},
        {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, pool->free.sampled_textures},
    }};
    VkDescriptorPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    info.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
    info.maxSets = sets_per_pool;
    info.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    if (const VkResult result =
            device_.fn.CreateDescriptorPool(device_.handle, &info, nullptr, &pool->handle);
        result != VK_SUCCESS) {
        return failure(result, "vkCreateDescriptorPool", "the bind groups");
    }
    pools_.push_back(std::move(pool));
    return {};
}

Result<DescriptorSet> DescriptorPools::allocate(const BindGroupLayout& layout,
                                                const std::string& subject) {
    const auto try_pool = [&](DescriptorPool& pool, DescriptorSet& set) {
        VkDescriptorSetAllocateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
        info.descriptorPool = pool.handle;
        info.descriptorSetCount = 1;
        info.pSetLayouts = &layout.handle;
        const VkResult result =
            device_.fn.AllocateDescriptorSets(device_.handle, &info, &set.handle);
        if (result == VK_SUCCESS) {
            set.pool = &pool;
            set.counts = layout.counts;
            --pool.free_sets;
            pool.free.uniform_buffers -= layout.counts.uniform_buffers;
            pool.free.dynamic_uniform_buffers -= layout.counts.dynamic_uniform_buffers;
            pool.free.sampled_textures -= layout.counts.sampled_textures;
        }
        return result;
    };
    DescriptorSet set;
    for (const std::unique_ptr<DescriptorPool>& pool : pools_) {
        // A pool with room may still refuse because it is fragmented: the next one is asked then.
        if (fits(*pool, layout.counts) && try_pool(*pool, set) == VK_SUCCESS) {
            return set;
        }
    }
    if (const Status added = add_pool(layout.counts); !added) {
        return forward_error(added);
    }
    if (const VkResult result = try_pool(*pools_.back(), set); result != VK_SUCCESS) {
        return failure(result, "vkAllocateDescriptorSets", subject);
    }
    return set;
}

void DescriptorPools::free(const DescriptorSet& set) {
    // Cannot fail: the specification allows no other result than success.
    device_.fn.FreeDescriptorSets(device_.handle, set.pool->handle, 1, &set.handle);
    ++set.pool->free_sets;
    set.pool->free.uniform_buffers += set.counts.uniform_buffers;
    set.pool->free.dynamic_uniform_buffers += set.counts.dynamic_uniform_buffers;
    set.pool->free.sampled_textures += set.counts.sampled_textures;
}

}  // namespace gnomon::vk
