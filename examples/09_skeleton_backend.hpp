// SPDX-License-Identifier: MIT
//
// A backend to begin with: everything that gpu::Backend asks for, in the order in which
// docs/backends.md lists it, and as little of it as passes the conformance list. The graphics API
// that it translates to is one that every reader of this file knows: gnomon's own interface again,
// on another device. Put your API's calls where `api_` stands, your handles into the tables, and
// keep the rest; where a real API asks for more than a call, a comment says what.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include <gnomon/gpu/device.hpp>

namespace skeleton {

using namespace gnomon;

/// What the API made, by the front's ids. Ids are small numbers that are used again: a vector will
/// do. Nobody asks for an id that was not put.
template <class Tag>
class Table {
public:
    Status put(gpu::Id<Tag> id, Result<gpu::Owned<Tag>> made) {
        if (!made) return forward_error(made);  // of the driver, and with the object's label
        if (id.index >= objects_.size()) objects_.resize(std::size_t{id.index} + 1);
        objects_[id.index] = std::move(*made);
        return {};
    }
    /// The device may still be using it. This API waits by itself; with another one, put the object
    /// on a list here, and free it when the submission is done that may use it.
    void erase(gpu::Id<Tag> id) { objects_[id.index].reset(); }
    /// The API's own handle; none for none.
    [[nodiscard]] gpu::Id<Tag> operator[](gpu::Id<Tag> id) const {
        return id ? objects_[id.index].id() : gpu::Id<Tag>{};
    }

private:
    std::vector<gpu::Owned<Tag>> objects_;
};

template <class... Functions>
struct Overloaded : Functions... {
    using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

class Backend final : public gpu::Backend {
public:
    // 1. The adapter: what is decided once. A feature is on only if the API has it to the letter
    // (gpu/caps.hpp); what is off costs speed or precision, never a wrong shadow.
    explicit Backend(gpu::Device api) : api_(std::move(api)), caps_(api_.caps()) {
        caps_.backend = "skeleton";
    }
    [[nodiscard]] const gpu::Caps& caps() const override { return caps_; }

    // 2. Enumerations would be translated here, all in one place. These are the same.

    // 3. Objects. All that a descriptor says has been checked: no call here checks again. New
    // buffers and textures are zero; where your API leaves them as they come, clear them.
    Status create_buffer(gpu::BufferId id, const gpu::BufferDesc& desc) override {
        return buffers_.put(id, api_.create_buffer(desc));
    }
    Status create_texture(gpu::TextureId id, const gpu::TextureDesc& desc) override {
        return textures_.put(id, api_.create_texture(desc));
    }
    Status import_texture(gpu::TextureId id, const gpu::TextureDesc& desc,
                          const gpu::NativeTexture& native) override {
        return textures_.put(id, api_.import_texture(desc, native));
    }
    [[nodiscard]] gpu::ClipDepth clip_depth(gpu::TextureId id) const override {
        return api_.clip_depth_of(textures_[id]);
    }
    Status create_sampler(gpu::SamplerId id, const gpu::SamplerDesc& desc) override {
        return samplers_.put(id, api_.create_sampler(desc));
    }
    // SPIR-V and GLSL say the same; take what your API reads, or translate the SPIR-V at build time
    // (cmake/compile_shaders.cmake). Vertex stages have turned y over at their end: row 0 is on top
    // where the API's y points down, and counter-clockwise is what it was with y up.
    Status create_shader(gpu::ShaderId id, const gpu::ShaderDesc& desc) override {
        return shaders_.put(id, api_.create_shader(desc));
    }
    Status create_bind_group_layout(gpu::BindGroupLayoutId id,
                                    const gpu::BindGroupLayoutDesc& desc) override {
        return layouts_.put(id, api_.create_bind_group_layout(desc));
    }
    Status create_bind_group(gpu::BindGroupId id, const gpu::BindGroupDesc& desc) override {
        gpu::BindGroupDesc api_desc = desc;
        api_desc.layout = layouts_[desc.layout];
        for (gpu::BindGroupEntry& entry : api_desc.entries) {
            entry.buffer = buffers_[entry.buffer];
            entry.texture = textures_[entry.texture];
            entry.sampler = samplers_[entry.sampler];
        }
        return groups_.put(id, api_.create_bind_group(api_desc));
    }
    // The two stencil faces are independent, depth_compare has no default, and w = 0 must survive
    // the vertex stage: here is where most backends go wrong first.
    Status create_render_pipeline(gpu::RenderPipelineId id,
                                  const gpu::RenderPipelineDesc& desc) override {
        gpu::RenderPipelineDesc api_desc = desc;
        for (gpu::BindGroupLayoutId& layout : api_desc.bind_group_layouts)
            layout = layouts_[layout];
        api_desc.vertex = shaders_[desc.vertex];
        api_desc.fragment = shaders_[desc.fragment];
        return pipelines_.put(id, api_.create_render_pipeline(api_desc));
    }
    Status create_query_set(gpu::QuerySetId id, const gpu::QuerySetDesc& desc) override {
        return queries_.put(id, api_.create_query_set(desc));
    }

    void destroy(gpu::BufferId id) override { buffers_.erase(id); }
    void destroy(gpu::TextureId id) override { textures_.erase(id); }
    void destroy(gpu::SamplerId id) override { samplers_.erase(id); }
    void destroy(gpu::ShaderId id) override { shaders_.erase(id); }
    void destroy(gpu::BindGroupLayoutId id) override { layouts_.erase(id); }
    void destroy(gpu::BindGroupId id) override { groups_.erase(id); }
    void destroy(gpu::RenderPipelineId id) override { pipelines_.erase(id); }
    void destroy(gpu::QuerySetId id) override { queries_.erase(id); }

    // 4. The executor: one visit over the command list. State that is not set anew in a pass is
    // WebGPU's default (the whole target as viewport and scissor), not what the last pass left.
    Status submit(const gpu::CommandBuffer& commands) override {
        gpu::CommandEncoder encoder = api_.create_command_encoder(commands.label);
        std::optional<gpu::RenderPassEncoder> pass;
        const Overloaded execute{
            [&](const gpu::cmd::BeginRenderPass& c) {
                pass.emplace(encoder.begin_render_pass(api_pass(commands.passes[c.pass])));
            },
            [&](const gpu::cmd::EndRenderPass&) { pass.reset(); },
            [&](const gpu::cmd::SetPipeline& c) { pass->set_pipeline(pipelines_[c.pipeline]); },
            [&](const gpu::cmd::SetBindGroup& c) {
                pass->set_bind_group(c.group, groups_[c.bind_group],
                                     std::span(c.dynamic_offsets).first(c.dynamic_offset_count));
            },
            [&](const gpu::cmd::SetVertexBuffer& c) {
                pass->set_vertex_buffer(c.slot, buffers_[c.buffer], c.offset);
            },
            [&](const gpu::cmd::SetIndexBuffer& c) {
                pass->set_index_buffer(buffers_[c.buffer], c.format, c.offset);
            },
            [&](const gpu::cmd::SetStencilReference& c) {
                pass->set_stencil_reference(c.reference);
            },
            [&](const gpu::cmd::SetBlendConstant& c) { pass->set_blend_constant(c.color); },
            [&](const gpu::cmd::SetViewport& c) {
                pass->set_viewport(c.x, c.y, c.width, c.height, c.min_depth, c.max_depth);
            },
            [&](const gpu::cmd::SetScissorRect& c) {
                pass->set_scissor_rect(c.x, c.y, c.width, c.height);
            },
            [&](const gpu::cmd::SetDepthBounds& c) { pass->set_depth_bounds(c.min, c.max); },
            [&](const gpu::cmd::Draw& c) {
                pass->draw(c.vertex_count, c.instance_count, c.first_vertex, c.first_instance);
            },
            [&](const gpu::cmd::DrawIndexed& c) {
                pass->draw_indexed(c.index_count, c.instance_count, c.first_index, c.base_vertex,
                                   c.first_instance);
            },
            [&](const gpu::cmd::BeginOcclusionQuery& c) { pass->begin_occlusion_query(c.index); },
            [&](const gpu::cmd::EndOcclusionQuery&) { pass->end_occlusion_query(); },
            [&](const gpu::cmd::PushDebugGroup& c) {
                const std::string& label = commands.strings[c.label];
                pass ? pass->push_debug_group(label) : encoder.push_debug_group(label);
            },
            [&](const gpu::cmd::PopDebugGroup&) {
                pass ? pass->pop_debug_group() : encoder.pop_debug_group();
            },
            [&](const gpu::cmd::CopyBufferToBuffer& c) {
                encoder.copy_buffer_to_buffer(buffers_[c.source], c.source_offset,
                                              buffers_[c.destination], c.destination_offset,
                                              c.size);
            }};
        for (const gpu::Command& command : commands.commands) std::visit(execute, command);
        auto recorded = encoder.finish();
        if (!recorded) return forward_error(recorded);
        return api_.submit(*recorded);
    }
    Status wait_idle() override { return api_.wait_idle(); }

    // 5. Transfers. Writing is in queue order, reading blocks; rows are tightly packed, row 0 on
    // top.
    Status write_buffer(gpu::BufferId id, std::uint64_t offset,
                        std::span<const std::byte> data) override {
        return api_.write_buffer(buffers_[id], offset, data);
    }
    Status write_texture(gpu::TextureId id, std::uint32_t mip_level,
                         std::span<const std::byte> data) override {
        return api_.write_texture(textures_[id], mip_level, data);
    }
    Status read_buffer(gpu::BufferId id, std::uint64_t offset, std::span<std::byte> data) override {
        return copy(api_.read_buffer(buffers_[id], offset, data.size()), data);
    }
    Status read_texture(gpu::TextureId id, gpu::Aspect aspect, std::span<std::byte> data) override {
        return copy(api_.read_texture(textures_[id], aspect), data);
    }
    Result<std::vector<std::uint64_t>> read_query_set(gpu::QuerySetId id) override {
        return api_.read_query_set(queries_[id]);
    }

    // 6. The window; ErrorCode::Unsupported where there is none.
    Status present(gpu::TextureId id) override { return api_.present(textures_[id]); }

private:
    [[nodiscard]] gpu::RenderPassDesc api_pass(gpu::RenderPassDesc pass) const {
        for (gpu::ColorAttachment& color : pass.color_attachments) {
            color.texture = textures_[color.texture];
            color.resolve_target = textures_[color.resolve_target];
        }
        if (pass.depth_stencil)
            pass.depth_stencil->texture = textures_[pass.depth_stencil->texture];
        pass.occlusion_query_set = queries_[pass.occlusion_query_set];
        if (pass.timestamp_writes)
            pass.timestamp_writes->query_set = queries_[pass.timestamp_writes->query_set];
        return pass;
    }
    static Status copy(const Result<std::vector<std::byte>>& read, std::span<std::byte> into) {
        if (!read) return forward_error(read);
        std::ranges::copy(*read, into.begin());
        return {};
    }

    gpu::Device api_;  // first, so that it goes last
    gpu::Caps caps_;
    Table<gpu::BufferTag> buffers_;
    Table<gpu::TextureTag> textures_;
    Table<gpu::SamplerTag> samplers_;
    Table<gpu::ShaderTag> shaders_;
    Table<gpu::BindGroupLayoutTag> layouts_;
    Table<gpu::BindGroupTag> groups_;
    Table<gpu::RenderPipelineTag> pipelines_;
    Table<gpu::QuerySetTag> queries_;
};

}  // namespace skeleton
