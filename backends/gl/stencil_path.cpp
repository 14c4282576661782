// SPDX-License-Identifier: MIT
#include "internal/stencil_path.hpp"

#include "internal/conv.hpp"

namespace gnomon::gl {
namespace {

GlStencilFace face_to_gl(const gpu::StencilFaceState& face) {
    return {to_gl(face.compare), to_gl(face.fail_op), to_gl(face.depth_fail_op),
            to_gl(face.pass_op)};
}

}  // namespace

GlStencil to_gl(const std::optional<gpu::DepthStencilState>& state) {
    if (!state || !gpu::has_stencil(state->format)) return {};
    GlStencil stencil{.enabled = true,
                      .front = face_to_gl(state->stencil_front),
                      .back = face_to_gl(state->stencil_back),
                      .read_mask = state->stencil_read_mask,
                      .write_mask = state->stencil_write_mask};
    stencil.enabled = stencil.front != GlStencilFace{} || stencil.back != GlStencilFace{};
    return stencil;
}

std::unique_ptr<StencilStrategy> make_stencil_strategy(StencilPath path) {
    switch (path) {
        case StencilPath::TwoSide: return make_two_side_strategy();
        case StencilPath::TwoPass: return make_two_pass_strategy();
        case StencilPath::Separate: break;
    }
    return make_separate_strategy();
}

}  // namespace gnomon::gl
