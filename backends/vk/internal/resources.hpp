// SPDX-License-Identifier: MIT
//
// All objects that the front end has ids for.
#pragma once

#include <string>
#include <vector>

#include "internal/bind_groups.hpp"
#include "internal/buffers.hpp"
#include "internal/pipelines.hpp"
#include "internal/table.hpp"
#include "internal/textures.hpp"

namespace gnomon::vk {

struct QuerySet {
    std::string subject;  ///< "query set 'frame times'", for errors
    VkQueryPool pool = VK_NULL_HANDLE;
    gpu::QueryType type = gpu::QueryType::Occlusion;
    std::vector<bool> written;  ///< the others have no value that Vulkan would give: they are 0
};

struct Resources {
    Table<gpu::BufferTag, Buffer> buffers;
    Table<gpu::TextureTag, Texture> textures;
    Table<gpu::SamplerTag, VkSampler> samplers;
    Table<gpu::ShaderTag, VkShaderModule> shaders;
    Table<gpu::BindGroupLayoutTag, BindGroupLayout> bind_group_layouts;
    Table<gpu::BindGroupTag, BindGroup> bind_groups;
    Table<gpu::RenderPipelineTag, Pipeline> pipelines;
    Table<gpu::QuerySetTag, QuerySet> query_sets;
};

}  // namespace gnomon::vk
