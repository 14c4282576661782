// SPDX-License-Identifier: MIT
//
// Bind group layouts and bind groups: descriptor set layouts, and sets from pools that grow.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <gnomon/gpu/descriptors.hpp>

#include "internal/device.hpp"

namespace gnomon::vk {

/// How many descriptors of each type a set has.
struct DescriptorCounts {
    std::uint32_t uniform_buffers = 0;
    std::uint32_t dynamic_uniform_buffers = 0;
    std::uint32_t sampled_textures = 0;
};

struct BindGroupLayout {
    VkDescriptorSetLayout handle = VK_NULL_HANDLE;
    std::vector<gpu::BindGroupLayoutEntry> entries;
    DescriptorCounts counts;
};

/// A texture that a bind group reads, and whether the vertex shader does.
struct BoundTexture {
    gpu::TextureId texture;
    bool in_vertex_shader = false;
};

struct DescriptorPool {
    VkDescriptorPool handle = VK_NULL_HANDLE;
    std::uint32_t free_sets = 0;
    DescriptorCounts free;
};

struct DescriptorSet {
    VkDescriptorSet handle = VK_NULL_HANDLE;
    DescriptorPool* pool = nullptr;
    DescriptorCounts counts;
};

struct BindGroup {
    DescriptorSet set;
    std::vector<gpu::BufferId> buffers;
    std::vector<BoundTexture> textures;
};

[[nodiscard]] Result<BindGroupLayout> make_bind_group_layout(Device& device,
                                                             const gpu::BindGroupLayoutDesc& desc);

class DescriptorPools {
public:
    explicit DescriptorPools(Device& device) : device_(device) {}
    ~DescriptorPools();
    DescriptorPools(const DescriptorPools&) = delete;
    DescriptorPools& operator=(const DescriptorPools&) = delete;

    [[nodiscard]] Result<DescriptorSet> allocate(const BindGroupLayout& layout,
                                                 const std::string& subject);
    void free(const DescriptorSet& set);

private:
    [[nodiscard]] Status add_pool(const DescriptorCounts& at_least);

    Device& device_;
    std::vector<std::unique_ptr<DescriptorPool>> pools_;
};

}  // namespace gnomon::vk
