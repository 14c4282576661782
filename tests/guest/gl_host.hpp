// SPDX-License-Identifier: MIT
//
// A host with a renderer of its own, in plain OpenGL: its context, its framebuffer, its shaders,
// its conventions. It knows nothing of gnomon but where its meshes come from.
#pragma once

#ifndef GL_GLEXT_PROTOTYPES
#define GL_GLEXT_PROTOTYPES
#endif
#include <GL/glcorearb.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <gnomon/gl/context.hpp>
#include <gnomon/gl/host_target.hpp>
#include <gnomon/gpu/types.hpp>
#include <gnomon/shadows/host_view.hpp>

#include "tests/rows/rows.hpp"

namespace gnomon::test {

// clang-format off
#define GNOMON_HOST_FUNCTIONS(X)                                                                  \
    X(AttachShader) X(BindAttribLocation) X(BindBuffer) X(BindFramebuffer) X(BindRenderbuffer)    \
    X(BindTexture) X(BindVertexArray) X(BufferData) X(CheckFramebufferStatus) X(Clear)            \
    X(ClearDepth) X(ClearStencil) X(ClipControl) X(CompileShader) X(CreateProgram)                \
    X(CreateShader) X(DeleteFramebuffers) X(DeleteRenderbuffers) X(DeleteTextures) X(DepthFunc)   \
    X(Disable) X(DrawArrays) X(DrawElements) X(Enable) X(EnableVertexAttribArray)                 \
    X(FramebufferRenderbuffer) X(FramebufferTexture2D) X(GenBuffers) X(GenFramebuffers) X(GenRenderbuffers) X(GenTextures)   \
    X(GenVertexArrays) X(GetError) X(GetIntegerv) X(GetProgramiv) X(GetUniformLocation)           \
    X(LinkProgram) X(PixelStorei) X(ReadPixels) X(RenderbufferStorage)                            \
    X(RenderbufferStorageMultisample) X(ShaderSource) X(TexParameteri) X(TexStorage2D)            \
    X(TexStorage2DMultisample) X(Uniform1i) X(UniformMatrix4fv) X(UseProgram)                     \
    X(VertexAttribPointer) X(Viewport)
// clang-format on

struct HostGl {
#define GNOMON_HOST_MEMBER(name) decltype(&::gl##name) name = nullptr;
    GNOMON_HOST_FUNCTIONS(GNOMON_HOST_MEMBER)
#undef GNOMON_HOST_MEMBER
    explicit HostGl(const gl::Context& context);
};

enum class Far : std::uint8_t {
    Infinite,
    Epsilon,  ///< as far as single precision goes: the usual way of keeping w = 0 before the plane
    Finite,
};

/// How a host draws.
struct HostWay {
    std::string name;
    bool zero_to_one = false;
    bool reversed = false;
    Far far = Far::Infinite;
    bool y_down = false;
    bool upper_left = false;
    bool along_plus_z = false;  ///< its view looks along +Z
    /// Positions as gnomon computes them, from one matrix; else by three in turn.
    bool shared_positions = false;
    gpu::Format format = gpu::Format::Depth24UnormStencil8;
    gl::HostTarget::Kind kind = gl::HostTarget::Kind::Framebuffer;
    double near_m = 0.05;
    /// With four, depth and stencil are a texture but for a Renderbuffer.
    std::uint32_t samples = 1;
};

class GlHost {
public:
    /// Makes a framebuffer of row_width x row_height in the context, and keeps it current.
    GlHost(std::unique_ptr<gl::Context> context, HostWay way);
    ~GlHost();
    GlHost(const GlHost&) = delete;
    GlHost& operator=(const GlHost&) = delete;

    void make_current() const;
    [[nodiscard]] void* find(const char* name) const { return context_->get_proc_address(name); }
    [[nodiscard]] const HostGl& gl() const { return gl_; }
    [[nodiscard]] gl::HostTarget target() const;
    [[nodiscard]] shadows::HostConventions conventions() const;

    /// The setting's camera in this host's way, in single precision.
    struct Camera {
        glm::mat4 view_from_world{1.0F};
        glm::mat4 clip_from_view{1.0F};
    };
    [[nodiscard]] Camera camera_of(const Setting& setting) const;

    /// Clears and draws the scene's depth.
    void draw(const Setting& setting);
    /// One byte a pixel, in truth's order of rows: what is up in the picture comes first.
    [[nodiscard]] std::vector<std::uint8_t> stencil() const;
    /// The same of one of four samples.
    [[nodiscard]] std::vector<std::uint8_t> stencil_sample(int sample) const;
    /// Where samples lie as the picture is seen: row 0 is at the bottom, so are they.
    [[nodiscard]] bool samples_are_mirrored() const { return way_.y_down == way_.upper_left; }

    /// A texture of its own for light masks: GL_R32UI or GL_R8.
    [[nodiscard]] GLuint make_mask(GLenum format, std::uint32_t samples = 1);
    [[nodiscard]] static gl::HostTarget mask_target(GLuint mask) {
        return {.kind = gl::HostTarget::Kind::Texture, .name = mask};
    }
    /// Its texels, of one sample where there are four, in truth's order of rows.
    [[nodiscard]] std::vector<std::uint32_t> read_bits(GLuint mask, int sample = 0) const;
    [[nodiscard]] std::vector<std::uint8_t> read_bytes(GLuint mask) const;

private:
    void make_program();
    void make_framebuffer();
    void make_depth_stencil(GLenum format);
    [[nodiscard]] bool depth_is_texture() const {
        using enum gl::HostTarget::Kind;
        return way_.kind == Texture || (way_.kind == Framebuffer && way_.samples > 1);
    }
    [[nodiscard]] GLsizei renderbuffer_samples() const {
        return way_.samples > 1 ? static_cast<GLsizei>(way_.samples) : 0;
    }
    /// Unsigned integers of one sample.
    [[nodiscard]] std::vector<std::uint32_t> fetch_sample(GLuint texture, int sample) const;
    template <class T>
    [[nodiscard]] std::vector<T> read(GLuint framebuffer, GLenum format, GLenum type) const;
    void set_clip_control() const;

    std::unique_ptr<gl::Context> context_;
    HostWay way_;
    HostGl gl_;
    GLuint program_ = 0, fetching_program_ = 0, vertex_array_ = 0;
    GLuint framebuffer_ = 0, color_ = 0, depth_stencil_ = 0;
    std::vector<GLuint> masks_;
};

}  // namespace gnomon::test
