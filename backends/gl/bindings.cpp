// SPDX-License-Identifier: MIT
#include "internal/bindings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "internal/debug_output.hpp"

namespace gnomon::gl {
namespace {

// The buffer at GL_COPY_WRITE_BUFFER. NVIDIA's driver (580.159) sends large writes another way than
// small ones and than glClearBufferData, which they may overtake: what was written is zero then. So
// zeros go the way that later writes of all of the buffer will, in pieces as large as can be.
void fill_with_zeros(const GlFunctions& gl, std::uint64_t size) {
    constexpr std::uint64_t most = std::uint64_t{64} << 20U;
    const std::uint64_t pieces = (size + most - 1) / most;
    const std::vector<std::byte> zeros(pieces == 0 ? 0 : (size + pieces - 1) / pieces);
    for (std::uint64_t offset = 0; offset < size; offset += zeros.size()) {
        gl.BufferSubData(
            GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(offset),
            static_cast<GLsizeiptr>(std::min<std::uint64_t>(zeros.size(), size - offset)),
            zeros.data());
    }
}

}  // namespace

Result<BufferObject> make_buffer(const Adapter& adapter, const gpu::BufferDesc& desc) {
    const GlFunctions& gl = adapter.gl;
    BufferObject buffer{.name = 0, .size = desc.size};
    gl.GenBuffers(1, &buffer.name);
    gl.BindBuffer(GL_COPY_WRITE_BUFFER, buffer.name);
    gl.BufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(desc.size), nullptr,
                  GL_DYNAMIC_DRAW);
    const auto check = [&] {
        return check_errors(
            gl, fmt::format("Creating [Buffer \"{}\"] of {} bytes", desc.label, desc.size));
    };
    Status made = check();
    if (made) {
        // Some drivers look for the memory only when it is written to.
        fill_with_zeros(gl, desc.size);
        made = check();
    }
    if (!made) {
        gl.DeleteBuffers(1, &buffer.name);
        return forward_error(made);
    }
    if (adapter.debug) set_label(gl, GL_BUFFER, buffer.name, desc.label);
    return buffer;
}

Result<SamplerObject> make_sampler(const Adapter& adapter, const gpu::SamplerDesc& desc) {
    const GlFunctions& gl = adapter.gl;
    SamplerObject sampler;
    gl.GenSamplers(1, &sampler.name);
    gl.SamplerParameteri(sampler.name, GL_TEXTURE_WRAP_S, to_gl(desc.address_mode_u));
    gl.SamplerParameteri(sampler.name, GL_TEXTURE_WRAP_T, to_gl(desc.address_mode_v));
    gl.SamplerParameteri(sampler.name, GL_TEXTURE_MAG_FILTER, to_gl(desc.mag_filter));
    gl.SamplerParameteri(sampler.name, GL_TEXTURE_MIN_FILTER,
                         minification(desc.min_filter, desc.mipmap_filter));
    if (adapter.debug) set_label(gl, GL_SAMPLER, sampler.name, desc.label);
    if (const Status made = check_errors(gl, fmt::format("Creating [Sampler \"{}\"]", desc.label));
        !made) {
        gl.DeleteSamplers(1, &sampler.name);
        return forward_error(made);
    }
    return sampler;
}

Result<QuerySetObject> make_query_set(const Adapter& adapter, const gpu::QuerySetDesc& desc) {
    const GlFunctions& gl = adapter.gl;
    QuerySetObject set{.type = desc.type,
                       .names = std::vector<GLuint>(desc.count),
                       .written = std::vector<bool>(desc.count)};
    gl.GenQueries(static_cast<GLsizei>(desc.count), set.names.data());
    if (const Status made = check_errors(
            gl, fmt::format("Creating [QuerySet \"{}\"] of {} queries", desc.label, desc.count));
        !made) {
        return forward_error(made);
    }
    return set;
}

Result<BindGroupLayoutObject> make_bind_group_layout(const Adapter& adapter,
                                                     const gpu::BindGroupLayoutDesc& desc) {
    BindGroupLayoutObject layout{.entries = desc.entries};
    std::sort(layout.entries.begin(), layout.entries.end(),
              [](const auto& a, const auto& b) { return a.binding < b.binding; });
    for (const gpu::BindGroupLayoutEntry& entry : layout.entries) {
        const bool is_buffer = entry.type == gpu::BindingType::UniformBuffer;
        const GLuint limit = is_buffer ? adapter.uniform_buffer_bindings : adapter.texture_units;
        if (entry.binding >= limit) {
            return fail(ErrorCode::Unsupported,
                        fmt::format("[BindGroupLayout \"{}\"] has a {} at binding {}, but this "
                                    "OpenGL driver has only {} of them, counted from 0.",
                                    desc.label, is_buffer ? "uniform buffer" : "sampled texture",
                                    entry.binding, limit));
        }
    }
    return layout;
}

BindGroupObject make_bind_group(const Objects& objects, const gpu::BindGroupDesc& desc) {
    BindGroupObject group;
    for (const gpu::BindGroupLayoutEntry& slot : objects.bind_group_layouts[desc.layout].entries) {
        const auto entry =
            std::find_if(desc.entries.begin(), desc.entries.end(),
                         [&slot](const auto& e) { return e.binding == slot.binding; });
        if (slot.type == gpu::BindingType::UniformBuffer) {
            const BufferObject& buffer = objects.buffers[entry->buffer];
            const std::uint64_t size = entry->size != 0 ? entry->size : buffer.size - entry->offset;
            group.uniforms.push_back({.index = slot.binding,
                                      .buffer = buffer.name,
                                      .offset = static_cast<GLintptr>(entry->offset),
                                      .size = static_cast<GLsizeiptr>(size),
                                      .dynamic = slot.has_dynamic_offset});
        } else {
            const TextureObject& texture = objects.textures[entry->texture];
            const bool stencil = entry->aspect == gpu::Aspect::StencilOnly;
            group.textures.push_back(
                {.unit = slot.binding,
                 .target = texture.target,
                 .texture = stencil ? texture.stencil_view : texture.name,
                 .sampler = entry->sampler ? objects.samplers[entry->sampler].name : 0});
        }
    }
    return group;
}

}  // namespace gnomon::gl
