// SPDX-License-Identifier: MIT
//
// One draw per face, told apart by culling: for drivers with neither of the other two. All front
// faces of a draw come before all back faces, so it equals one draw only where nothing but the
// stencil is written and the order of the stencil operations does not matter.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "internal/stencil_path.hpp"

namespace gnomon::gl {
namespace {

bool writes_color(const gpu::RenderPipelineDesc& desc) {
    return std::any_of(desc.targets.begin(), desc.targets.end(), [](const auto& target) {
        return target.write_mask != gpu::ColorWrite::None;
    });
}

bool is_wrapping_step(gpu::StencilOp op) {
    return op == gpu::StencilOp::IncrementWrap || op == gpu::StencilOp::DecrementWrap;
}

/// Whether the operations commute: a stencil test that no write can sway, and operations that are
/// all the same or all steps of a wrapping counter.
bool order_is_free(const gpu::DepthStencilState& state) {
    const gpu::StencilFaceState& front = state.stencil_front;
    const gpu::StencilFaceState& back = state.stencil_back;
    const auto is_constant = [](gpu::Compare compare) {
        return compare == gpu::Compare::Always || compare == gpu::Compare::Never;
    };
    const bool test_is_fixed = (state.stencil_read_mask & state.stencil_write_mask & 0xFFU) == 0 ||
                               (is_constant(front.compare) && is_constant(back.compare));
    if (!test_is_fixed) return false;

    gpu::StencilOp first = gpu::StencilOp::Keep;
    for (const gpu::StencilOp op : {front.fail_op, front.depth_fail_op, front.pass_op, back.fail_op,
                                    back.depth_fail_op, back.pass_op}) {
        if (op == gpu::StencilOp::Keep) continue;
        if (first == gpu::StencilOp::Keep) first = op;
        if (op != first && !(is_wrapping_step(op) && is_wrapping_step(first))) return false;
    }
    return true;
}

class TwoPassStrategy final : public StencilStrategy {
public:
    [[nodiscard]] std::string_view name() const override { return "two-pass"; }

    [[nodiscard]] Status accepts(const gpu::RenderPipelineDesc& desc) const override {
        if (!desc.depth_stencil || !gpu::has_stencil(desc.depth_stencil->format) ||
            desc.depth_stencil->stencil_front == desc.depth_stencil->stencil_back ||
            desc.primitive.topology != gpu::PrimitiveTopology::TriangleList) {
            return {};
        }
        const char* reason = nullptr;
        if (writes_color(desc)) {
            reason = "it writes colour";
        } else if (desc.depth_stencil->depth_write_enabled) {
            reason = "it writes depth";
        } else if (desc.primitive.cull_mode != gpu::CullMode::None) {
            reason = "it culls faces";
        } else if (!order_is_free(*desc.depth_stencil)) {
            reason = "the result of its stencil operations depends on the order of the triangles";
        }
        if (reason == nullptr) return {};
        return fail(ErrorCode::Unsupported,
                    fmt::format("[RenderPipeline \"{}\"] has different stencil states for front "
                                "and back faces, and {}: the stencil path \"two-pass\" draws the "
                                "faces one after the other and cannot give the same result.",
                                desc.label, reason));
    }

    void begin(const GlFunctions&) const override {}

    void apply(const GlFunctions& gl, const GlStencil& stencil) const override {
        apply_face(gl, stencil.front, stencil);
    }

    void draw(const GlFunctions& gl, const GlStencil& stencil, GLenum topology,
              const std::function<void()>& issue) const override {
        // Points and lines have no back, and culling does not reach them.
        if (!stencil.enabled || stencil.front == stencil.back || topology != GL_TRIANGLES) {
            issue();
            return;
        }
        gl.Enable(GL_CULL_FACE);  // accepts() saw to it that culling is off
        gl.CullFace(GL_BACK);
        issue();
        apply_face(gl, stencil.back, stencil);
        gl.CullFace(GL_FRONT);
        issue();
        gl.Disable(GL_CULL_FACE);
        apply_face(gl, stencil.front, stencil);
    }

    void open_write_mask(const GlFunctions& gl) const override { gl.StencilMask(0xFF); }
    void end(const GlFunctions& gl) const override { gl.StencilMask(~GLuint{0}); }

private:
    static void apply_face(const GlFunctions& gl, const GlStencilFace& face,
                           const GlStencil& stencil) {
        gl.StencilFunc(face.compare, stencil.reference, stencil.read_mask);
        gl.StencilOp(face.fail, face.depth_fail, face.pass);
        gl.StencilMask(stencil.write_mask);
    }
};

}  // namespace

std::unique_ptr<StencilStrategy> make_two_pass_strategy() {
    return std::make_unique<TwoPassStrategy>();
}

}  // namespace gnomon::gl
