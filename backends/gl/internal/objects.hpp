// SPDX-License-Identifier: MIT
//
// What the backend keeps for each object of the interface, and the tables they live in. Plain data:
// the names of GL objects are freed by the functions that made them (textures.cpp, pipeline.cpp,
// bindings.cpp, backend.cpp), since only those know whether the context is current.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gnomon/gpu/descriptors.hpp>

#include "internal/conv.hpp"
#include "internal/gl_functions.hpp"
#include "internal/stencil_path.hpp"

namespace gnomon::gl {

/// Objects of one kind by Id::index. The front end reuses indices and never asks for one that it
/// did not create.
template <class Tag, class Object>
class Table {
public:
    Object& put(gpu::Id<Tag> id, Object object) {
        if (slots_.size() <= id.index) slots_.resize(std::size_t{id.index} + 1);
        return slots_[id.index].emplace(std::move(object));
    }
    [[nodiscard]] Object& operator[](gpu::Id<Tag> id) { return *slots_[id.index]; }
    [[nodiscard]] const Object& operator[](gpu::Id<Tag> id) const { return *slots_[id.index]; }
    /// Hands the object over and forgets it; nothing when its creation failed.
    [[nodiscard]] std::optional<Object> take(gpu::Id<Tag> id) {
        if (id.index >= slots_.size()) return std::nullopt;
        return std::exchange(slots_[id.index], std::nullopt);
    }
    template <class Function>
    void for_each(Function&& function) {
        for (auto& slot : slots_) {
            if (slot) function(*slot);
        }
    }

private:
    std::vector<std::optional<Object>> slots_;
};

struct BufferObject {
    GLuint name = 0;
    std::uint64_t size = 0;
};

/// A host's depth and stencil, which can be attached to framebuffers of ours: a texture of the
/// targets that TextureObject has, or a renderbuffer.
struct HostDepthStencil {
    GLuint texture = 0;
    GLuint renderbuffer = 0;
    GLint level = 0;
    auto operator<=>(const HostDepthStencil&) const = default;
};

/// The framebuffer of a depth-stencil texture that was imported, and how the host draws into it.
struct HostFramebuffer {
    GLuint name = 0;
    bool owned = false;  ///< made here, about a texture or renderbuffer of the host's
    /// What it has there; not known of the window's framebuffer, of arrays and of cubes.
    std::optional<HostDepthStencil> attached = std::nullopt;
    /// Its samples are where those of our own textures are (fixedsamplelocations).
    bool fixed_samples = true;
    bool upper_left = false;
    GLenum clip_depth = GL_NEGATIVE_ONE_TO_ONE;
};

struct TextureObject {
    std::string label;
    GLuint name = 0;
    /// The same texels, read by a shader as stencil. Made with the texture where it is wanted,
    /// because which aspect is read is state of the texture and not of the binding.
    GLuint stencil_view = 0;
    GLenum target = GL_TEXTURE_2D;
    gpu::Format format = gpu::Format::Undefined;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::optional<HostFramebuffer> host = std::nullopt;  ///< where it is set, there is no name
    bool borrowed = false;  ///< a colour texture that was imported: the name is the host's
};

struct SamplerObject {
    GLuint name = 0;
};

struct ShaderObject {
    std::string label;
    GLuint name = 0;
};

struct BindGroupLayoutObject {
    std::vector<gpu::BindGroupLayoutEntry> entries;  ///< in order of binding
};

struct UniformBinding {
    GLuint index = 0;
    GLuint buffer = 0;
    GLintptr offset = 0;
    GLsizeiptr size = 0;
    bool dynamic = false;
};

struct TextureBinding {
    GLuint unit = 0;
    GLenum target = GL_TEXTURE_2D;
    GLuint texture = 0;
    GLuint sampler = 0;
};

struct BindGroupObject {
    std::vector<UniformBinding> uniforms;  ///< in order of binding, as dynamic offsets come
    std::vector<TextureBinding> textures;
};

struct GlVertexAttribute {
    GLuint location = 0;
    GLuint slot = 0;
    GLuint offset = 0;
    GlVertexFormat format;
};

struct GlVertexSlot {
    GLsizei stride = 0;
    GLuint divisor = 0;
};

struct GlBlend {
    bool enabled = false;
    GLenum color_equation = GL_FUNC_ADD, alpha_equation = GL_FUNC_ADD;
    GLenum color_source = GL_ONE, color_destination = GL_ZERO;
    GLenum alpha_source = GL_ONE, alpha_destination = GL_ZERO;
    bool operator==(const GlBlend&) const = default;
};

struct GlTarget {
    GlBlend blend;
    gpu::ColorWrite write_mask = gpu::ColorWrite::All;
};

struct GlDepthBias {
    GLfloat slope_scale = 0.0F;
    GLfloat constant = 0.0F;
    GLfloat clamp = 0.0F;
    [[nodiscard]] bool enabled() const { return slope_scale != 0.0F || constant != 0.0F; }
    bool operator==(const GlDepthBias&) const = default;
};

struct GlDepth {
    bool enabled = false;
    bool write = false;
    GLenum compare = GL_ALWAYS;
    bool unclipped = false;
    bool bounded = false;
    GlDepthBias bias;
};

struct PipelineObject {
    GLuint program = 0;
    GLint base_instance_location = -1;  ///< SPIRV-Cross's stand-in for gl_BaseInstance, if used
    GLenum topology = GL_TRIANGLES;
    GLenum front_face = GL_CCW;
    gpu::CullMode cull_mode = gpu::CullMode::None;
    GlDepth depth;
    GlStencil stencil;
    std::vector<GlTarget> targets;
    std::vector<GlVertexAttribute> attributes;
    std::vector<GlVertexSlot> slots;
};

struct QuerySetObject {
    gpu::QueryType type = gpu::QueryType::Occlusion;
    std::vector<GLuint> names;
    std::vector<bool> written;  ///< a query that never ran has no result in GL; WebGPU says 0
};

struct Objects {
    Table<gpu::BufferTag, BufferObject> buffers;
    Table<gpu::TextureTag, TextureObject> textures;
    Table<gpu::SamplerTag, SamplerObject> samplers;
    Table<gpu::ShaderTag, ShaderObject> shaders;
    Table<gpu::BindGroupLayoutTag, BindGroupLayoutObject> bind_group_layouts;
    Table<gpu::BindGroupTag, BindGroupObject> bind_groups;
    Table<gpu::RenderPipelineTag, PipelineObject> pipelines;
    Table<gpu::QuerySetTag, QuerySetObject> query_sets;
};

}  // namespace gnomon::gl
