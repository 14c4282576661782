// SPDX-License-Identifier: MIT
//
// Detectors: what of a caster casts for a light, and the silhouette of that. Many strategies give
// the same answer at different costs; they stand in one table and are chosen by name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include <gnomon/shadows/facing.hpp>
#include <gnomon/shadows/light.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>
#include <gnomon/shadows/silhouette.hpp>

#pragma GCC visibility push(default)
namespace gnomon::shadows {

/// The faces that cast, one bit each: bit f % 64 of word f / 64 is face f. Facing knows no weights
/// but +1, 0 and -1. Both lists have a word for every 64 faces begun; bits beyond the last face are
/// 0.
struct CastingFaces {
    std::vector<std::uint64_t> plus;   ///< they weigh +1
    std::vector<std::uint64_t> minus;  ///< they weigh -1

    bool operator==(const CastingFaces&) const = default;
};
/// Of Facing::weights. Replaces `casting`. Cost: linear.
void pack_weights(std::span<const std::int8_t> weights, CastingFaces& casting);

/// Faces [first, first + count) all weigh `weight`, which is not 0.
struct FaceRun {
    std::uint32_t first = 0;  ///< the first face
    std::uint32_t count = 0;  ///< how many
    std::int32_t weight = 0;  ///< of each of them
    auto operator<=>(const FaceRun&) const = default;
};

/// Weights by face, any there are, as runs: ascending, and no two that could be one. Replaces
/// `runs`. Cost: linear.
void runs_of(std::span<const std::int8_t> weights, std::vector<FaceRun>& runs);
/// The same of casting faces. Cost: near the number of runs, plus some steps a word.
void runs_of(const CastingFaces& casting, std::vector<FaceRun>& runs);
/// And back. `weights` has a place for each face.
void weights_of(std::span<const FaceRun> runs, std::span<std::int8_t> weights);

/// What one call of a detector looked at.
struct DetectionStats {
    std::uint64_t faces_tested = 0;   ///< whose side was asked for
    std::uint64_t edges_tested = 0;   ///< that were looked at
    std::uint64_t double_tests = 0;   ///< as in FacingStats
    std::uint64_t exact_tests = 0;    ///< as in FacingStats
    std::uint64_t bytes_touched = 0;  ///< of the mesh and of what the detector remembers, about
};

/// Which strategy decided, and why it was that one.
enum class Choice : std::uint8_t {
    ByName,           ///< the strategy that was asked for by name
    FewFaces,         ///< simd: there are so few faces that searching does not pay
    LargeSilhouette,  ///< edges as in simd: a search meets a large part of them anyway
    Deforming,        ///< simd: no hierarchies are made for the places of one frame
    Jump,             ///< as dual_bvh: the light is new, or goes too far for certificates to pay
    SmallStep,        ///< certificates: the light is still near to where it was
};
/// How many values Choice has.
inline constexpr std::size_t choice_count = 6;
/// As the statistics name it: "jump", for instance.
[[nodiscard]] std::string_view to_string(Choice choice);

/// What casts and its boundary: the same for every strategy but for the order of the silhouette.
struct Detection {
    CastingFaces casting;                     ///< the faces that cast
    std::vector<SilhouetteEdge> silhouette;   ///< in any order, no edge twice
    std::vector<std::uint8_t> solid_averted;  ///< Facing::solid_averted
    /// A margin as Facing::margin, though maybe a smaller one: how far the light may move from
    /// where it is, for which all of this is provably the same.
    double margin = 0.0;
    /// False: all but the margin is what the same detector's last call gave, for the same mesh.
    bool changed = true;
    DetectionStats stats;  ///< what it took
};

/// One detector, one thread at a time.
class SilhouetteDetector {
public:
    /// Made by SilhouetteStrategy::create.
    SilhouetteDetector() = default;
    SilhouetteDetector(const SilhouetteDetector&) = delete;
    SilhouetteDetector& operator=(const SilhouetteDetector&) = delete;
    virtual ~SilhouetteDetector() = default;

    /// Exact for `light` as it is, as classify_faces() and find_silhouette() have it: nothing casts
    /// for a light that is not finite. The answer is valid until the next call. Where the strategy
    /// keeps state, whatever came before costs or saves time and changes no answer.
    virtual const Detection& detect(const ShadowMesh& mesh, LightLocal light,
                                    NearCaps near_caps) = 0;

    /// Of the last call.
    [[nodiscard]] virtual Choice choice() const { return Choice::ByName; }

    /// What it remembers between calls, the answer included.
    [[nodiscard]] virtual std::size_t memory_bytes() const = 0;
};

/// Who finds the silhouettes of pairs that edge quads can draw (edge_quads.hpp), and how.
enum class QuadFacing : std::uint8_t {
    None,      ///< the CPU, as for all other pairs
    Uploaded,  ///< a vertex shader, from one exact bit a face that the CPU found
    InShader,  ///< a vertex shader alone, in single precision: faces that are all but edge-on may
               ///< come out either way
};

/// A row of the table of strategies.
struct SilhouetteStrategy {
    std::string_view name;     ///< as `--silhouette` takes it
    std::string_view summary;  ///< one sentence for people
    /// A detector works from what it saw of the same pair last, so that each pair of caster and
    /// light wants one of its own. Otherwise one serves all in turn.
    bool keeps_state = false;
    std::unique_ptr<SilhouetteDetector> (*create)() = nullptr;  ///< makes a detector; never null
    /// Other than None: ShadowSystem asks no detector for the pairs that it leaves to the GPU; the
    /// detector is for the others.
    QuadFacing quads = QuadFacing::None;
};

/// All strategies, by name; "auto" is not among them: it is the choice between them.
[[nodiscard]] std::span<const SilhouetteStrategy> silhouette_strategies();
/// "auto": simd, dual_bvh or certificates, whatever costs least for the mesh and for how far the
/// light goes, by what they looked at so far; of simd and dual_bvh also one for the faces and the
/// other for the edges. A light that stays within the last margin costs a comparison. Its detector
/// keeps state; without it (a new one for each call, or one for many pairs) it takes every light
/// for a jump.
[[nodiscard]] const SilhouetteStrategy& automatic_strategy();
/// By name, "auto" included. Null where there is none.
[[nodiscard]] const SilhouetteStrategy* find_strategy(std::string_view name);

}  // namespace gnomon::shadows
#pragma GCC visibility pop
