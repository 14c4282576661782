// SPDX-License-Identifier: MIT
//
// How one volume is drawn: in which calls, of which indices, and what each of them is as far as the
// stencil operations and the depth test are concerned.
#pragma once

#include <cstdint>
#include <vector>

#include <gnomon/shadow_pass/shadow_pass.hpp>

namespace gnomon::shadow_pass::internal {

/// What a run of indices is to the depth test.
enum class Role : std::uint8_t {
    Volume,   ///< sides and far caps; near caps too where they are not biased
    Cap,      ///< near caps, moved away from the eye: behind the surface that they lie on
    OpenCap,  ///< of averted faces left to shading: in front of it
};
inline constexpr std::size_t role_count = 3;

/// A run of indices that one draw call takes.
struct Run {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::int32_t base_vertex = 0;  ///< 1: near caps, drawn as far caps
    bool exchanged = false;        ///< front and back are
    bool of_mesh = false;  ///< within the mesh's caps (MeshCaps), else within Volume::indices
    Role role = Role::Volume;
};

/// Which caps close a volume, and how they meet surfaces.
struct Ends {
    bool near = true;
    bool far = true;
    bool open = false;    ///< averted near caps are in front of what they lie on
    bool biased = false;  ///< near caps are behind it
    bool operator==(const Ends&) const = default;
};
/// Of a slab of the draw, or of the whole where that is null.
[[nodiscard]] Ends ends_of(const shadows::VolumeDraw& draw, const shadows::VolumeSlab* slab,
                           const ShadowPassDesc& desc);

/// Behind what `runs` has, in an order that changes state seldom; neighbours that are drawn alike
/// are one. Of `volume` ranges alone are read.
void append_runs(const shadows::Volume& volume, const Ends& ends, std::vector<Run>& runs);

/// The near caps of the faces that cast, whatever the technique, without those that are undone: for
/// Part::Caps.
[[nodiscard]] std::vector<Run> near_caps_of(const shadows::ShadowMesh& mesh,
                                            const shadows::Volume& volume);

}  // namespace gnomon::shadow_pass::internal
