// SPDX-License-Identifier: MIT
//
// Which draws are worth a scissor of their own. Leaving one out changes no pixel (outside of
// VolumeDraw::bounds counts cancel out); it is a matter of cost alone: a change of state between
// two draws against the pixels that are rasterised in vain.
#pragma once

#include <cstdint>

#include <gnomon/shadow_pass/shadow_pass.hpp>
#include <gnomon/shadows/screen_bounds.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>

#include "volume_instances.hpp"

namespace gnomon::shadow_pass::internal {

/// A rectangle that holds what the draw's triangles cover; the whole target where some of it is
/// behind the eye.
[[nodiscard]] shadows::PixelRect covered_pixels(const shadows::ShadowMesh& mesh,
                                                const VolumeInstance& instance, TargetSize target);

/// Whether cutting a draw that covers no more than `covered` to `wanted` saves enough pixels.
[[nodiscard]] bool scissor_pays(const shadows::PixelRect& covered,
                                const shadows::PixelRect& wanted);

}  // namespace gnomon::shadow_pass::internal
