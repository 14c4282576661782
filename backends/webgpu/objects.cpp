// SPDX-License-Identifier: MIT
#include "internal/objects.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "internal/conv.hpp"

namespace gnomon::webgpu {

namespace {

using Json = nlohmann::ordered_json;

// Labels may hold anything; what is no UTF-8 is replaced.
std::string text_of(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

const char* sample_type_of(const gpu::BindGroupLayoutEntry& entry) {
    switch (entry.sample_type) {
        case gpu::SampleType::Float: return entry.multisampled ? "unfilterable-float" : "float";
        case gpu::SampleType::Uint: return "uint";
        case gpu::SampleType::Depth: return "depth";
    }
    return "";
}

Json face_of(const gpu::StencilFaceState& face) {
    return {{"compare", to_webgpu(face.compare)},
            {"failOp", to_webgpu(face.fail_op)},
            {"depthFailOp", to_webgpu(face.depth_fail_op)},
            {"passOp", to_webgpu(face.pass_op)}};
}

Json depth_stencil_of(const gpu::DepthStencilState& state) {
    Json json{{"format", to_webgpu(state.format)},
              {"depthWriteEnabled", state.depth_write_enabled},
              {"depthCompare", to_webgpu(state.depth_compare)},
              {"depthBias", state.depth_bias},
              {"depthBiasSlopeScale", state.depth_bias_slope_scale},
              {"depthBiasClamp", state.depth_bias_clamp}};
    if (gpu::has_stencil(state.format)) {
        json["stencilFront"] = face_of(state.stencil_front);
        json["stencilBack"] = face_of(state.stencil_back);
        json["stencilReadMask"] = state.stencil_read_mask;
        json["stencilWriteMask"] = state.stencil_write_mask;
    }
    return json;
}

Json component_of(const gpu::BlendComponent& component) {
    return {{"operation", to_webgpu(component.operation)},
            {"srcFactor", to_webgpu(component.src_factor)},
            {"dstFactor", to_webgpu(component.dst_factor)}};
}

Json target_of(const gpu::ColorTargetState& target) {
    Json json{{"format", to_webgpu(target.format)}, {"writeMask", to_webgpu(target.write_mask)}};
    if (target.blend) {
        json["blend"] = {{"color", component_of(target.blend->color)},
                         {"alpha", component_of(target.blend->alpha)}};
    }
    return json;
}

Json texture_of(const gpu::TextureDesc& desc) {
    return {{"label", desc.label},
            {"size", Json::array({desc.width, desc.height})},
            {"format", to_webgpu(desc.format)},
            {"usage", to_webgpu(desc.usage)},
            {"mipLevelCount", desc.mip_level_count},
            {"sampleCount", desc.sample_count}};
}

Json vertex_buffer_of(const gpu::VertexBufferLayout& layout) {
    Json attributes = Json::array();
    for (const gpu::VertexAttribute& attribute : layout.attributes) {
        attributes.push_back({{"format", to_webgpu(attribute.format)},
                              {"offset", attribute.offset},
                              {"shaderLocation", attribute.shader_location}});
    }
    return {{"arrayStride", layout.array_stride},
            {"stepMode", to_webgpu(layout.step_mode)},
            {"attributes", std::move(attributes)}};
}

}  // namespace

bool has_sampler(const gpu::BindGroupLayoutEntry& entry) {
    return entry.type == gpu::BindingType::SampledTexture && !entry.multisampled &&
           entry.sample_type == gpu::SampleType::Float;
}

std::string describe(const gpu::BufferDesc& desc) {
    return text_of({{"label", desc.label}, {"size", desc.size}, {"usage", to_webgpu(desc.usage)}});
}

std::string describe(const gpu::TextureDesc& desc) { return text_of(texture_of(desc)); }

std::string describe(const gpu::TextureDesc& desc, std::uint32_t adopted) {
    Json json = texture_of(desc);
    json["adopted"] = adopted;
    return text_of(json);
}

std::string describe(const gpu::SamplerDesc& desc) {
    return text_of({{"label", desc.label},
                    {"addressModeU", to_webgpu(desc.address_mode_u)},
                    {"addressModeV", to_webgpu(desc.address_mode_v)},
                    {"magFilter", to_webgpu(desc.mag_filter)},
                    {"minFilter", to_webgpu(desc.min_filter)},
                    {"mipmapFilter", to_webgpu(desc.mipmap_filter)}});
}

std::string describe(const gpu::ShaderDesc& desc) {
    return text_of({{"label", desc.label}, {"code", desc.source.wgsl}});
}

std::string describe(const gpu::BindGroupLayoutDesc& desc) {
    Json entries = Json::array();
    for (const gpu::BindGroupLayoutEntry& entry : desc.entries) {
        const auto add = [&](std::uint32_t binding, const char* type, Json what) {
            entries.push_back({{"binding", binding},
                               {"visibility", to_webgpu(entry.visibility)},
                               {type, std::move(what)}});
        };
        if (entry.type == gpu::BindingType::UniformBuffer) {
            add(entry.binding, "buffer",
                {{"type", "uniform"},
                 {"hasDynamicOffset", entry.has_dynamic_offset},
                 {"minBindingSize", entry.min_binding_size}});
            continue;
        }
        add(entry.binding, "texture",
            {{"sampleType", sample_type_of(entry)}, {"multisampled", entry.multisampled}});
        if (has_sampler(entry)) {
            add(entry.binding + sampler_binding_offset, "sampler", {{"type", "filtering"}});
        }
    }
    return text_of({{"label", desc.label}, {"entries", std::move(entries)}});
}

std::string describe(const gpu::BindGroupDesc& desc, const gpu::BindGroupLayoutDesc& layout) {
    Json entries = Json::array();
    for (const gpu::BindGroupEntry& entry : desc.entries) {
        const auto expected = std::find_if(
            layout.entries.begin(), layout.entries.end(),
            [&](const gpu::BindGroupLayoutEntry& e) { return e.binding == entry.binding; });
        if (expected->type == gpu::BindingType::UniformBuffer) {
            Json buffer{{"buffer", entry.buffer.index}, {"offset", entry.offset}};
            if (entry.size != 0) buffer["size"] = entry.size;
            entries.push_back({{"binding", entry.binding}, {"buffer", std::move(buffer)}});
            continue;
        }
        entries.push_back({{"binding", entry.binding},
                           {"texture", entry.texture.index},
                           {"aspect", to_webgpu(entry.aspect)}});
        if (has_sampler(*expected)) {
            entries.push_back({{"binding", entry.binding + sampler_binding_offset},
                               {"sampler", entry.sampler ? Json(entry.sampler.index) : Json()}});
        }
    }
    return text_of(
        {{"label", desc.label}, {"layout", desc.layout.index}, {"entries", std::move(entries)}});
}

std::string describe(const gpu::RenderPipelineDesc& desc) {
    Json layout = Json::array();
    for (const gpu::BindGroupLayoutId id : desc.bind_group_layouts) layout.push_back(id.index);
    Json buffers = Json::array();
    for (const auto& buffer : desc.vertex_buffers) buffers.push_back(vertex_buffer_of(buffer));
    Json json{{"label", desc.label},
              {"layout", std::move(layout)},
              {"vertex", {{"module", desc.vertex.index}, {"buffers", std::move(buffers)}}},
              {"primitive",
               {{"topology", to_webgpu(desc.primitive.topology)},
                {"frontFace", to_webgpu(desc.primitive.front_face)},
                {"cullMode", to_webgpu(desc.primitive.cull_mode)}}},
              {"multisample", {{"count", desc.sample_count}}}};
    // Naming the member at all needs the feature.
    if (desc.primitive.unclipped_depth) json["primitive"]["unclippedDepth"] = true;
    if (desc.depth_stencil) json["depthStencil"] = depth_stencil_of(*desc.depth_stencil);
    if (desc.fragment) {
        Json targets = Json::array();
        for (const gpu::ColorTargetState& target : desc.targets) {
            targets.push_back(target_of(target));
        }
        json["fragment"] = {{"module", desc.fragment.index}, {"targets", std::move(targets)}};
    }
    return text_of(json);
}

std::string describe(const gpu::QuerySetDesc& desc) {
    return text_of({{"label", desc.label}, {"type", to_webgpu(desc.type)}, {"count", desc.count}});
}

}  // namespace gnomon::webgpu
