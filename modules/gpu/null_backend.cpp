// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstring>
#include <new>
#include <optional>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include <gnomon/gpu/null_backend.hpp>

#include "internal/null_image.hpp"

namespace gnomon::gpu {

namespace {

/// A table indexed by Id::index, as every backend keeps one.
template <class Object>
class Objects {
public:
    void put(std::uint32_t index, Object object) {
        if (index >= objects_.size()) objects_.resize(std::size_t{index} + 1);
        objects_[index].emplace(std::move(object));
    }
    void erase(std::uint32_t index) { objects_[index].reset(); }
    Object& at(std::uint32_t index) { return *objects_[index]; }

private:
    std::vector<std::optional<Object>> objects_;
};

class NullBackend final : public Backend {
public:
    explicit NullBackend(const NullBackendOptions& options) {
        caps_.backend = "null";
        caps_.adapter = "gnomon null backend, which draws nothing";
        caps_.stencil_path = "native";
        caps_.features = options.features;
        // WebGPU's default limits, so that what is valid here is valid on most machines.
        caps_.limits = {.max_texture_dimension_2d = 8192,
                        .max_color_attachments = 8,
                        .max_vertex_buffers = 8,
                        .max_vertex_attributes = 16,
                        .max_buffer_size = 256U << 20U,
                        .max_uniform_buffer_binding_size = 64U << 10U,
                        .min_uniform_buffer_offset_alignment = 256};
    }

    const Caps& caps() const override { return caps_; }

    Status create_buffer(BufferId id, const BufferDesc& desc) override {
        return allocating("Buffer", desc.label,
                          [&] { buffers_.put(id.index, std::vector<std::byte>(desc.size)); });
    }
    Status create_texture(TextureId id, const TextureDesc& desc) override {
        return allocating("Texture", desc.label, [&] { textures_.put(id.index, NullImage(desc)); });
    }
    Status create_query_set(QuerySetId id, const QuerySetDesc& desc) override {
        return allocating("QuerySet", desc.label, [&] {
            query_sets_.put(id.index, std::vector<std::uint64_t>(std::size_t{desc.count}));
        });
    }
    // Nothing is drawn, so nothing of these is ever looked at.
    Status create_sampler(SamplerId, const SamplerDesc&) override { return {}; }
    Status create_shader(ShaderId, const ShaderDesc&) override { return {}; }
    Status create_bind_group_layout(BindGroupLayoutId, const BindGroupLayoutDesc&) override {
        return {};
    }
    Status create_bind_group(BindGroupId, const BindGroupDesc&) override { return {}; }
    Status create_render_pipeline(RenderPipelineId, const RenderPipelineDesc&) override {
        return {};
    }

    void destroy(BufferId id) override { buffers_.erase(id.index); }
    void destroy(TextureId id) override { textures_.erase(id.index); }
    void destroy(QuerySetId id) override { query_sets_.erase(id.index); }
    void destroy(SamplerId) override {}
    void destroy(ShaderId) override {}
    void destroy(BindGroupLayoutId) override {}
    void destroy(BindGroupId) override {}
    void destroy(RenderPipelineId) override {}

    Status write_buffer(BufferId id, std::uint64_t offset,
                        std::span<const std::byte> data) override {
        std::memcpy(buffers_.at(id.index).data() + offset, data.data(), data.size());
        return {};
    }
    Status write_texture(TextureId id, std::uint32_t mip_level,
                         std::span<const std::byte> data) override {
        textures_.at(id.index).write(mip_level, data);
        return {};
    }

    Status submit(const CommandBuffer& commands) override {
        const RenderPassDesc* pass = nullptr;
        for (const Command& command : commands.commands) {
            if (const auto* begin = std::get_if<cmd::BeginRenderPass>(&command)) {
                pass = &commands.passes[begin->pass];
                begin_pass(*pass);
            } else if (std::holds_alternative<cmd::EndRenderPass>(command)) {
                end_pass(*pass);
            } else if (const auto* query = std::get_if<cmd::BeginOcclusionQuery>(&command)) {
                query_sets_.at(pass->occlusion_query_set.index)[query->index] = 0;
            } else if (const auto* copy = std::get_if<cmd::CopyBufferToBuffer>(&command)) {
                std::memcpy(buffers_.at(copy->destination.index).data() + copy->destination_offset,
                            buffers_.at(copy->source.index).data() + copy->source_offset,
                            copy->size);
            }
        }
        return {};
    }
    Status wait_idle() override { return {}; }

    Status read_buffer(BufferId id, std::uint64_t offset, std::span<std::byte> data) override {
        std::memcpy(data.data(), buffers_.at(id.index).data() + offset, data.size());
        return {};
    }
    Status read_texture(TextureId id, Aspect aspect, std::span<std::byte> data) override {
        textures_.at(id.index).read(aspect, data);
        return {};
    }
    Result<std::vector<std::uint64_t>> read_query_set(QuerySetId id) override {
        return query_sets_.at(id.index);
    }
    Status present(TextureId) override { return {}; }

private:
    template <class Make>
    static Status allocating(const char* kind, const std::string& label, Make make) {
        try {
            make();
            return {};
        } catch (const std::bad_alloc&) {
            return fail(ErrorCode::OutOfMemory,
                        fmt::format("There is no memory for [{} \"{}\"].", kind, label));
        }
    }

    void begin_pass(const RenderPassDesc& pass) {
        if (pass.timestamp_writes) stamp(*pass.timestamp_writes, &TimestampWrites::beginning_index);
        for (const ColorAttachment& color : pass.color_attachments) {
            if (color.load_op == LoadOp::Clear) {
                textures_.at(color.texture.index).clear_color(color.clear_value);
            }
        }
        if (!pass.depth_stencil) return;
        NullImage& image = textures_.at(pass.depth_stencil->texture.index);
        if (pass.depth_stencil->depth_load_op == LoadOp::Clear) {
            image.clear_depth(pass.depth_stencil->depth_clear_value);
        }
        if (pass.depth_stencil->stencil_load_op == LoadOp::Clear) {
            image.clear_stencil(pass.depth_stencil->stencil_clear_value);
        }
    }

    // What is discarded reads as zero, WebGPU's rule.
    void end_pass(const RenderPassDesc& pass) {
        for (const ColorAttachment& color : pass.color_attachments) {
            NullImage& image = textures_.at(color.texture.index);
            if (color.resolve_target) {
                textures_.at(color.resolve_target.index).copy_color_from(image);
            }
            if (color.store_op == StoreOp::Discard) image.clear_color({});
        }
        if (pass.depth_stencil) {
            NullImage& image = textures_.at(pass.depth_stencil->texture.index);
            if (pass.depth_stencil->depth_store_op == StoreOp::Discard) image.clear_depth(0.0F);
            if (pass.depth_stencil->stencil_store_op == StoreOp::Discard) image.clear_stencil(0);
        }
        if (pass.timestamp_writes) stamp(*pass.timestamp_writes, &TimestampWrites::end_index);
    }

    void stamp(const TimestampWrites& writes, std::uint32_t TimestampWrites::*index) {
        query_sets_.at(writes.query_set.index)[writes.*index] = ++clock_;
    }

    Caps caps_;
    Objects<std::vector<std::byte>> buffers_;
    Objects<NullImage> textures_;
    Objects<std::vector<std::uint64_t>> query_sets_;
    std::uint64_t clock_ = 0;
};

}  // namespace

std::unique_ptr<Backend> create_null_backend(const NullBackendOptions& options) {
    return std::make_unique<NullBackend>(options);
}

}  // namespace gnomon::gpu
