// SPDX-License-Identifier: MIT
//
// Separate stencil state per face, OpenGL 2.0: the path of every driver since.
#include "internal/stencil_path.hpp"

namespace gnomon::gl {
namespace {

class SeparateStrategy final : public StencilStrategy {
public:
    [[nodiscard]] std::string_view name() const override { return "separate"; }
    [[nodiscard]] Status accepts(const gpu::RenderPipelineDesc&) const override { return {}; }
    void begin(const GlFunctions&) const override {}
    void apply(const GlFunctions& gl, const GlStencil& stencil) const override {
        apply_face(gl, GL_FRONT, stencil.front, stencil);
        apply_face(gl, GL_BACK, stencil.back, stencil);
    }
    void draw(const GlFunctions&, const GlStencil&, GLenum,
              const std::function<void()>& issue) const override {
        issue();
    }
    void open_write_mask(const GlFunctions& gl) const override {
        gl.StencilMaskSeparate(GL_FRONT_AND_BACK, 0xFF);
    }
    void end(const GlFunctions& gl) const override { gl.StencilMask(~GLuint{0}); }

private:
    static void apply_face(const GlFunctions& gl, GLenum which, const GlStencilFace& face,
                           const GlStencil& stencil) {
        gl.StencilFuncSeparate(which, face.compare, stencil.reference, stencil.read_mask);
        gl.StencilOpSeparate(which, face.fail, face.depth_fail, face.pass);
        gl.StencilMaskSeparate(which, stencil.write_mask);
    }
};

}  // namespace

std::unique_ptr<StencilStrategy> make_separate_strategy() {
    return std::make_unique<SeparateStrategy>();
}

}  // namespace gnomon::gl
