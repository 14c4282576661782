// SPDX-License-Identifier: MIT
//
// Receivers: where surfaces are that shadows can be seen on. Who submits them all gets volumes that
// end behind the last one that a shadow can reach, and none where it reaches none; the mask is the
// same on every one of them. Most casters are receivers as well.
#pragma once

#include <cstdint>

#include <gnomon/shadows/technique.hpp>

#pragma GCC visibility push(default)
namespace gnomon::shadows {

/// A place where surfaces are, in a box.
struct Receiver {
    std::uint64_t key = 0;  ///< the host's name for it; unique among receivers
    /// Holds all of the surface, as it is drawn. Smaller is better: a terrain had better come in
    /// tiles.
    OrientedBounds bounds;
};

/// What a system knows of receivers.
enum class Receivers : std::uint8_t {
    Anywhere,   ///< there may be surfaces in any place; none is submitted
    Submitted,  ///< every surface in the depth buffer lies within a receiver that is submitted
};

/// What is left out of volumes because no pixel can tell. All are exact on every surface of a
/// receiver that the light reaches; where no surface is (the depth buffer is 0), masks may differ.
/// `Receivers::Submitted` is needed for what says so. On are those that pay as a rule.
struct FillOptions {
    /// Volumes that cannot be seen are not drawn, and of casters that move not made.
    bool cull_by_view = true;
    /// The same for those that reach no receiver within the light's range (Submitted).
    bool cull_by_receivers = true;
    /// Far vertices go onto a plane behind the last receiver that the shadow can reach, by the
    /// projection from the light (Submitted). After D. B. Lloyd et al., "CC Shadow Volumes" (2004).
    bool clamp = true;
    /// Where along its way the light meets no receiver, volumes are left out as well
    /// (VolumeDraw::slabs): the near end where none comes first, and what lies between two, where
    /// that saves more than the caps at the cuts cost, as far as projected bounds can tell. Needs
    /// `clamp`. After the same paper. Off: a fifth fewer fragments in some scenes, but more and
    /// smaller draws, which pay only where fragments are dear (docs/performance.md).
    bool slabs = false;
    /// VolumeDraw::bounds is what the volume can change of the picture, else all of it.
    bool scissor = true;
    /// VolumeDraw::depth is where the volume can change the count of what is stored, else all of
    /// it. Used where the adapter can (gpu::Features::depth_bounds); exact outside of the band
    /// along shadows' edges.
    bool depth_bounds = true;
    /// Volumes of casters that lie wholly in the shadow of another one, as far as planes behind a
    /// convex part of that one can tell, are not drawn, and where they moved not made: what theirs
    /// would cover, the other one's does. Zero stays zero and all else is not zero; counts are
    /// less.
    bool cull_by_umbra = true;

    /// All off: volumes are drawn whole.
    [[nodiscard]] static constexpr FillOptions none() {
        return {false, false, false, false, false, false, false};
    }
};

}  // namespace gnomon::shadows
#pragma GCC visibility pop
