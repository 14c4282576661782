// SPDX-License-Identifier: MIT
//
// What the front end remembers of each object: as much of its descriptor as validation needs, in
// the form in which it is needed. Objects refer to each other's ids, never to each other's records,
// so that any of them may go first.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <gnomon/gpu/descriptors.hpp>

namespace gnomon::gpu {

struct ShaderRecord {
    std::string label;
    ShaderStage stage = ShaderStage::None;
};

/// The entries of a bind group layout, sorted by binding, what its kind ignores set to defaults.
/// Equal layouts share one shape, so that WebGPU's "group-equivalent" is a comparison of pointers.
struct LayoutShape {
    std::vector<BindGroupLayoutEntry> entries;
    std::uint32_t dynamic_offset_count = 0;
};

struct BindGroupLayoutRecord {
    std::string label;
    const LayoutShape* shape = nullptr;  ///< lives as long as the device
};

struct DynamicBinding {
    std::uint32_t binding = 0;
    BufferId buffer;
    std::uint64_t offset = 0;
    std::uint64_t size = 0;
    std::uint64_t buffer_size = 0;
};

struct BindGroupRecord {
    std::string label;
    const LayoutShape* shape = nullptr;
    std::vector<DynamicBinding> dynamic_bindings;  ///< in order of binding
    std::vector<BufferId> buffers;
    std::vector<TextureId> textures;
    std::vector<SamplerId> samplers;
};

struct VertexSlot {
    std::uint64_t stride = 0;
    std::uint64_t last_attribute_end = 0;  ///< 0: no attributes, no buffer needed
    VertexStepMode step_mode = VertexStepMode::Vertex;
};

struct RenderPipelineRecord {
    std::string label;
    std::vector<const LayoutShape*> groups;
    std::vector<VertexSlot> vertex_slots;
    std::vector<Format> color_formats;
    Format depth_stencil_format = Format::Undefined;
    std::uint32_t sample_count = 1;
    bool writes_depth = false;
    bool writes_stencil = false;
};

/// Ties a handle's tag to its record and to the word that error messages use.
template <class Tag>
struct ObjectKind;

#define GNOMON_GPU_OBJECT_KIND(Name, RecordType)   \
    template <>                                    \
    struct ObjectKind<Name##Tag> {                 \
        using Record = RecordType;                 \
        static constexpr const char* name = #Name; \
    };
GNOMON_GPU_OBJECT_KIND(Buffer, BufferDesc)
GNOMON_GPU_OBJECT_KIND(Texture, TextureDesc)
GNOMON_GPU_OBJECT_KIND(Sampler, SamplerDesc)
GNOMON_GPU_OBJECT_KIND(Shader, ShaderRecord)
GNOMON_GPU_OBJECT_KIND(BindGroupLayout, BindGroupLayoutRecord)
GNOMON_GPU_OBJECT_KIND(BindGroup, BindGroupRecord)
GNOMON_GPU_OBJECT_KIND(RenderPipeline, RenderPipelineRecord)
GNOMON_GPU_OBJECT_KIND(QuerySet, QuerySetDesc)
#undef GNOMON_GPU_OBJECT_KIND

}  // namespace gnomon::gpu
