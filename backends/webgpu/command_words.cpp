// SPDX-License-Identifier: MIT
#include "internal/command_words.hpp"

#include <bit>
#include <cstring>
#include <string_view>
#include <type_traits>

namespace gnomon::webgpu {

namespace {

class Writer {
public:
    explicit Writer(std::vector<std::uint32_t>& words) : words_(words) {}

    void write(const gpu::CommandBuffer& source) {
        put(source.label);
        for (const gpu::Command& command : source.commands) {
            // Depth bounds are a feature that WebGPU does not have; each pass begins with them
            // open.
            if (std::holds_alternative<gpu::cmd::SetDepthBounds>(command)) continue;
            put(static_cast<std::uint32_t>(command.index()));
            std::visit(
                [&](const auto& c) {
                    using Type = std::decay_t<decltype(c)>;
                    if constexpr (std::is_same_v<Type, gpu::cmd::BeginRenderPass>) {
                        put(source.passes[c.pass]);
                    } else if constexpr (std::is_same_v<Type, gpu::cmd::PushDebugGroup>) {
                        put(source.strings[c.label]);
                    } else if constexpr (!std::is_empty_v<Type>) {
                        put(c);
                    }
                },
                command);
        }
    }

private:
    void put(std::uint32_t value) { words_.push_back(value); }
    void put(std::int32_t value) { words_.push_back(static_cast<std::uint32_t>(value)); }
    void put(float value) { words_.push_back(std::bit_cast<std::uint32_t>(value)); }
    void put(std::uint64_t value) {
        words_.push_back(static_cast<std::uint32_t>(value));
        words_.push_back(static_cast<std::uint32_t>(value >> 32U));
    }
    void put(double value) { put(std::bit_cast<std::uint64_t>(value)); }
    void put(std::string_view text) {
        put(static_cast<std::uint32_t>(text.size()));
        const std::size_t first = words_.size();
        words_.resize(first + (text.size() + 3) / 4);
        if (!text.empty()) std::memcpy(&words_[first], text.data(), text.size());
    }
    template <class Tag>
    void put(gpu::Id<Tag> id) {
        put(id ? id.index : no_object);
    }
    void put(gpu::LoadOp op) { put(op == gpu::LoadOp::Clear ? 1U : 0U); }
    void put(gpu::StoreOp op) { put(op == gpu::StoreOp::Discard ? 1U : 0U); }
    void put(gpu::IndexFormat format) { put(format == gpu::IndexFormat::Uint32 ? 1U : 0U); }
    void put(const gpu::Color& color) { put(color.r, color.g, color.b, color.a); }
    template <class First, class Second, class... Rest>
    void put(const First& first, const Second& second, const Rest&... rest) {
        put(first);
        put(second);
        (put(rest), ...);
    }

    void put(const gpu::RenderPassDesc& pass) {
        put(std::string_view(pass.label));
        put(static_cast<std::uint32_t>(pass.color_attachments.size()));
        for (const gpu::ColorAttachment& a : pass.color_attachments) {
            put(a.texture, a.resolve_target, a.load_op, a.store_op, a.clear_value);
        }
        put(pass.depth_stencil ? pass.depth_stencil->texture : gpu::TextureId{});
        if (pass.depth_stencil) {
            const gpu::DepthStencilAttachment& a = *pass.depth_stencil;
            put(a.depth_load_op, a.depth_store_op, a.depth_read_only ? 1U : 0U,
                a.depth_clear_value);
            put(a.stencil_load_op, a.stencil_store_op, a.stencil_read_only ? 1U : 0U,
                a.stencil_clear_value);
        }
        put(pass.occlusion_query_set);
        put(pass.timestamp_writes ? pass.timestamp_writes->query_set : gpu::QuerySetId{});
        if (pass.timestamp_writes) {
            put(pass.timestamp_writes->beginning_index, pass.timestamp_writes->end_index);
        }
    }
    void put(const gpu::cmd::SetPipeline& c) { put(c.pipeline); }
    void put(const gpu::cmd::SetBindGroup& c) {
        put(c.group, c.bind_group, c.dynamic_offset_count);
        for (std::uint32_t i = 0; i < c.dynamic_offset_count; ++i) put(c.dynamic_offsets[i]);
    }
    void put(const gpu::cmd::SetVertexBuffer& c) { put(c.slot, c.buffer, c.offset); }
    void put(const gpu::cmd::SetIndexBuffer& c) { put(c.buffer, c.format, c.offset); }
    void put(const gpu::cmd::SetStencilReference& c) { put(c.reference); }
    void put(const gpu::cmd::SetBlendConstant& c) { put(c.color); }
    void put(const gpu::cmd::SetViewport& c) {
        put(c.x, c.y, c.width, c.height, c.min_depth, c.max_depth);
    }
    void put(const gpu::cmd::SetScissorRect& c) { put(c.x, c.y, c.width, c.height); }
    void put(const gpu::cmd::Draw& c) {
        put(c.vertex_count, c.instance_count, c.first_vertex, c.first_instance);
    }
    void put(const gpu::cmd::DrawIndexed& c) {
        put(c.index_count, c.instance_count, c.first_index, c.base_vertex, c.first_instance);
    }
    void put(const gpu::cmd::BeginOcclusionQuery& c) { put(c.index); }
    void put(const gpu::cmd::CopyBufferToBuffer& c) {
        put(c.source, c.source_offset, c.destination, c.destination_offset, c.size);
    }
    void put(const gpu::cmd::SetDepthBounds&) {}  // passed over above

    std::vector<std::uint32_t>& words_;
};

}  // namespace

void write_words(const gpu::CommandBuffer& commands, std::vector<std::uint32_t>& words) {
    words.clear();
    Writer(words).write(commands);
}

}  // namespace gnomon::webgpu
