// SPDX-License-Identifier: MIT
//
// GL_EXT_stencil_two_side: an active face that the plain stencil calls speak of. It keeps a back
// face of its own, apart from the one of glStencilOpSeparate, hence never mixed with those.
#include "internal/stencil_path.hpp"

#include <initializer_list>

namespace gnomon::gl {
namespace {

class TwoSideStrategy final : public StencilStrategy {
public:
    [[nodiscard]] std::string_view name() const override { return "two-side"; }
    [[nodiscard]] Status accepts(const gpu::RenderPipelineDesc&) const override { return {}; }
    void begin(const GlFunctions& gl) const override { gl.Enable(stencil_test_two_side_ext); }
    void apply(const GlFunctions& gl, const GlStencil& stencil) const override {
        apply_face(gl, GL_BACK, stencil.back, stencil);
        apply_face(gl, GL_FRONT, stencil.front, stencil);
    }
    void draw(const GlFunctions&, const GlStencil&, GLenum,
              const std::function<void()>& issue) const override {
        issue();
    }
    void open_write_mask(const GlFunctions& gl) const override {
        // The extension is silent on which face's mask a clear uses.
        for (const GLenum face : std::initializer_list<GLenum>{GL_BACK, GL_FRONT}) {
            gl.ActiveStencilFaceEXT(face);
            gl.StencilMask(0xFF);
        }
    }
    void end(const GlFunctions& gl) const override {
        for (const GLenum face : std::initializer_list<GLenum>{GL_BACK, GL_FRONT}) {
            gl.ActiveStencilFaceEXT(face);
            gl.StencilMask(~GLuint{0});
        }
        gl.Disable(stencil_test_two_side_ext);
    }

private:
    static void apply_face(const GlFunctions& gl, GLenum which, const GlStencilFace& face,
                           const GlStencil& stencil) {
        gl.ActiveStencilFaceEXT(which);
        gl.StencilFunc(face.compare, stencil.reference, stencil.read_mask);
        gl.StencilOp(face.fail, face.depth_fail, face.pass);
        gl.StencilMask(stencil.write_mask);
    }
};

}  // namespace

std::unique_ptr<StencilStrategy> make_two_side_strategy() {
    return std::make_unique<TwoSideStrategy>();
}

}  // namespace gnomon::gl
