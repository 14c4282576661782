// SPDX-License-Identifier: MIT
//
// Facing: one small integer a face, decided once; silhouette, caps and queries all read the stored
// value. That is what makes leaks impossible: a volume built from any weights is closed
// (docs/conventions.md, "A silhouette is a boundary").
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/shadows/light.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>

#pragma GCC visibility push(default)
namespace gnomon::shadows {

/// How often each stage of the facing test was needed.
struct FacingStats {
    std::uint64_t faces = 0;         ///< asked about
    std::uint64_t double_tests = 0;  ///< the single-precision filter could not decide
    std::uint64_t exact_tests = 0;   ///< nor could double precision
};

/// Which faces of a solid (a closed component that casts one-sided) cast, and thus carry its near
/// caps. Two-sided components do not ask: all their faces cast (docs/conventions.md, "Near caps on
/// averted faces").
enum class NearCaps : std::uint8_t {
    /// Those towards the light. Right for any eye, wherever it is. The caps lie on lit surfaces, so
    /// that the depth buffer has to come from the shared position function.
    Facing,
    /// Those turned away from the light, by their winding. The caps lie on surfaces that no direct
    /// light reaches, so that it does not matter how a depth buffer that came from other shaders
    /// compares with them. Asks for two things: the caster is drawn, and nothing that is seen lies
    /// inside the solid; whatever does is lit there, since the solid casts beyond itself only.
    Averted,
};

/// What classify_faces() says of a mesh and a light.
struct Facing {
    /// A face's weight: +1 it casts and faces the light, -1 it casts and is turned away, 0 it casts
    /// nothing.
    ///
    /// A closed component with the light outside its bounds casts one-sided: the faces towards the
    /// light where its signed volume is positive and NearCaps::Facing was asked for, else the
    /// averted ones: always so where it is inside out. Everything else casts two-sided: every face.
    /// A face whose plane contains the light weighs 0 either way.
    std::vector<std::int8_t> weights;
    /// By component: 1 where it is a solid whose averted faces cast, as NearCaps::Averted asks.
    /// 0 for what is inside out: its caps are the same for either kind.
    std::vector<std::uint8_t> solid_averted;
    /// The light may move this far in caster space (for a directional light: its unit vector) and
    /// every weight is provably the same. Rounding is allowed for; >= 0.
    double margin = 0.0;
    FacingStats stats;  ///< how it came about
};

/// The two forms of the single-precision stage: the same operations on the same numbers.
enum class FacingFilter : std::uint8_t {
    Simd,    ///< several faces at a time, where the compiler has vectors
    Scalar,  ///< one by one: the reference that tests hold the other against
};

/// Every weight is exact for `light` as it is, the same bits in every build; both filters give the
/// same margin too, unless the compiler fuses products with sums. A light that is not finite casts
/// nothing, with margin 0. Cost: linear, some nanoseconds a face, and some microseconds for each
/// face that needs exact arithmetic.
void classify_faces(const ShadowMesh& mesh, LightLocal light, Facing& out,
                    NearCaps near_caps = NearCaps::Facing,
                    FacingFilter filter = FacingFilter::Simd);

/// For a caster whose pose is singular (a zero scale) and therefore has no light of its own:
/// decides in the space that `parent_from_local` leads to, two-sided, in double precision. margin
/// is 0. `light_parent` is unrounded.
void classify_faces_flattened(const ShadowMesh& mesh, const glm::dmat4& parent_from_local,
                              const glm::dvec4& light_parent, Facing& out);

}  // namespace gnomon::shadows
#pragma GCC visibility pop
