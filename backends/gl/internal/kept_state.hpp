// SPDX-License-Identifier: MIT
//
// KeptState: OpenGL's state as a host left it, of everything that this backend changes. Asked for
// when it is made, given back when it goes.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "internal/adapter.hpp"
#include "internal/render_state.hpp"

namespace gnomon::gl {

/// How much is kept.
enum class KeptScope : std::uint8_t {
    Bindings,    ///< what making, writing and reading buffers, samplers, programs and queries touch
    Everything,  ///< what drawing, clearing and textures touch as well
};

class KeptState {
public:
    /// How many texture units and indexed uniform buffers are kept, from the first.
    struct Bound {
        GLuint texture_units = 0;
        GLuint uniform_buffers = 0;
    };

    KeptState(const Adapter& adapter, KeptScope scope, Bound bound);
    ~KeptState();
    KeptState(const KeptState&) = delete;
    KeptState& operator=(const KeptState&) = delete;

private:
    struct Buffers {
        GLint copy_read = 0, copy_write = 0, pack = 0, unpack = 0;
        GLint draw_framebuffer = 0, read_framebuffer = 0;
    };
    struct Unit {
        GLint texture = 0, multisampled = 0, sampler = 0;
    };
    struct Uniform {
        GLint buffer = 0;
        GLint64 start = 0, size = 0;
    };
    struct Blend {
        GLboolean enabled = GL_FALSE;
        GLint color_equation = 0, alpha_equation = 0;
        GLint color_source = 0, color_destination = 0, alpha_source = 0, alpha_destination = 0;
        std::array<GLboolean, 4> mask{};
    };
    struct StencilFace {
        GLint compare = 0, reference = 0, read_mask = 0, write_mask = 0;
        GLint fail = 0, depth_fail = 0, pass = 0;
    };
    struct Drawing {
        std::vector<GLboolean> switches;  ///< in the order of switch_names()
        std::vector<GLboolean> scissor_tests;
        std::array<GLint, 4> scissor{};
        std::array<GLfloat, 4> viewport{};
        std::array<GLdouble, 2> depth_range{};
        std::array<GLfloat, 2> depth_bounds{};
        std::vector<Blend> targets;
        std::array<GLfloat, 4> blend_constant{};
        StencilFace front, back;
        StencilFace two_side_back;  ///< of EXT_stencil_two_side, which has its own
        GLint active_stencil_face = GL_FRONT;
        GLboolean depth_mask = GL_TRUE;
        GLint depth_compare = 0, cull_face = 0, front_face = 0, provoking_vertex = 0;
        GLint clip_origin = 0, clip_depth = 0;
        std::array<GLint, 2> polygon_mode{};
        GLfloat point_size = 1, line_width = 1;
        GLfloat offset_factor = 0, offset_units = 0, offset_clamp = 0;
        GLint program = 0, vertex_array = 0, renderbuffer = 0;
        GLint active_texture = 0, uniform_buffer = 0;
        std::vector<Unit> units;
        std::vector<Uniform> uniforms;
        std::vector<GLint> pixel_store;  ///< in the order of pixel_store_names
    };

    [[nodiscard]] std::vector<GLenum> switch_names() const;
    void keep_drawing();
    void keep_targets();
    void keep_stencil();
    void keep_bound(Bound bound);
    /// What neither the backend's own state nor its shaders know of, and must not meet.
    void switch_off_the_rest() const;
    [[nodiscard]] StencilFace stencil_face() const;
    void restore_drawing() const;
    void restore_targets() const;
    void restore_stencil() const;
    void restore_bound() const;
    [[nodiscard]] GLint integer(GLenum name) const;
    [[nodiscard]] GLfloat real(GLenum name) const;
    void set_switch(GLenum name, bool on) const;

    const Adapter& adapter_;
    const GlFunctions& gl_;
    Buffers buffers_;
    Unit active_unit_;                  // its textures alone
    std::unique_ptr<Drawing> drawing_;  // null where bindings alone are kept
};

}  // namespace gnomon::gl
