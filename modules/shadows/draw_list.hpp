// SPDX-License-Identifier: MIT
//
// DrawList: what a ShadowSystem says is to be drawn in a frame, and why. Plain values: who draws
// them, with gnomon::shadow_pass or otherwise, needs nothing else of the system.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/shadows/detector.hpp>
#include <gnomon/shadows/edge_quads.hpp>
#include <gnomon/shadows/screen_bounds.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>
#include <gnomon/shadows/technique.hpp>
#include <gnomon/shadows/volume.hpp>
#include <gnomon/shadows/volume_slab.hpp>

#pragma GCC visibility push(default)
namespace gnomon::shadows {

/// Why a pair's volume is what it is this frame.
enum class Reason : std::uint8_t {
    Unchanged,     ///< poses are bit-equal, or differ by the rounding of their own composition:
                   ///< nothing was detected or built, but caps that the camera now needs
                   ///< (FrameStats::caps_made)
    WithinMargin,  ///< moved, but provably less than the silhouette needs to change: nothing was
                   ///< detected
    New,           ///< the pair was not there before
    LightMoved,    ///< beyond the margin, in the caster's space
    CasterMoved,   ///< likewise
    BothMoved,     ///< likewise
    MeshChanged,   ///< another ShadowMesh
    ProjectionChanged,  ///< other far vertices are needed; detected anew as well
    NearCapsChanged,    ///< Caster::near_caps did; detected anew as well
    OutOfRange,         ///< the caster is beyond the light's range: no volume
    OutOfView,          ///< nothing of the shadow can be seen: no volume until it can
    ReachesNothing,     ///< the shadow reaches no receiver: no volume until it does
    InUmbra,            ///< the caster lies in another's shadow: no volume until it does not
    LeftStale,          ///< moved, and StaleOptions allow the silhouette to be out of date
};
/// How many values Reason has.
inline constexpr std::size_t reason_count = 14;
/// As the statistics name it: "light moved", for instance.
[[nodiscard]] std::string_view to_string(Reason reason);

/// One volume to draw.
struct VolumeDraw {
    std::uint64_t light = 0;                 ///< its key
    std::uint64_t caster = 0;                ///< its key
    std::shared_ptr<const ShadowMesh> mesh;  ///< of the caster
    std::shared_ptr<const Volume> volume;    ///< empty where `quads` are drawn instead
    /// The silhouette is found on the GPU, from quads on every edge of the mesh: strategies with
    /// SilhouetteStrategy::quads, for casters that fits_edge_quads(), cast one-sided and are not
    /// deformed.
    std::optional<QuadCasting> quads;
    /// Changes whenever the indices or the bits of `quads` do; unique in the process.
    std::uint64_t revision = 0;
    glm::dmat4 world_from_local{1.0};  ///< takes near vertices to the world: the caster's pose
    /// Takes the far vertices (p * scale + offset) to the world, homogeneous: the caster's own
    /// pose, but for singular poses, and where they lie on a plane (FillOptions::clamp).
    glm::dmat4 world_from_far{1.0};
    Extrusion extrusion;                         ///< what makes far vertices of near ones
    Technique technique = Technique::DepthFail;  ///< chosen for this pair and view
    bool near_caps = true;        ///< depth-pass: whether near caps must be drawn as well
    bool far_caps = true;         ///< whether far caps must be, with this technique
    bool mirrored = false;        ///< the pose turns triangles over: front and back exchange
    Reason reason = Reason::New;  ///< why the volume is what it is
    /// Volumes of one light with the same number may be counted together in eight bits.
    std::uint32_t batch = 0;
    /// Nothing outside of it changes; where it is empty the volume need not be drawn. All of the
    /// picture without FillOptions::scissor.
    ScreenBounds bounds;
    /// Nothing changes where the depth that is stored lies outside, on a surface. All of it without
    /// FillOptions::depth_bounds.
    DepthBounds depth;
    /// Where not empty, these may be drawn instead of the whole, each with the same triangles,
    /// technique and extrusion: no receiver that the light reaches lies in what they leave out. The
    /// whole is as right.
    std::vector<VolumeSlab> slabs;
};

/// The volumes of one light: draws[first .. first + count).
struct LightDraws {
    std::uint64_t light = 0;  ///< its key
    std::uint32_t first = 0;  ///< among DrawList::draws
    std::uint32_t count = 0;  ///< how many; may be 0
    /// 1 where no point can lie under more layers than SystemOptions::max_layers. Else draws come
    /// in batches of at most 127 layers each, volumes that exceed that alone in parts, ascending;
    /// a point is in shadow where any batch counts.
    std::uint32_t batches = 1;
    ScreenBounds bounds = {};  ///< of all its volumes together
    /// Some of its volumes end behind the last receiver, openly perhaps, others may not: where no
    /// surface is at all, counts mean nothing, and whoever draws them sets them to 0.
    bool clear_background = false;
};

/// What a frame was made of, and what it took.
struct FrameStats {
    std::string_view silhouette;  ///< SystemOptions::silhouette; `choices` has what "auto" chose
    std::uint64_t casters = 0;    ///< submitted, or standing as they were
    std::uint64_t lights = 0;     ///< likewise
    std::uint64_t pairs = 0;      ///< of a light and a caster
    /// Without a volume: OutOfRange, OutOfView, ReachesNothing, InUmbra.
    std::uint64_t pairs_culled = 0;
    std::uint64_t pairs_hidden = 0;  ///< with a volume that changes nothing in this view
    /// Of the culled and hidden ones: whose caster lies in another's umbra.
    std::uint64_t pairs_in_umbra = 0;
    std::uint64_t pairs_clamped = 0;     ///< of all pairs drawn: far vertices on a plane
    std::uint64_t pairs_in_slabs = 0;    ///< of those that are seen: VolumeDraw::slabs
    std::uint64_t pairs_redetected = 0;  ///< whose silhouette was found anew
    std::uint64_t pairs_reused = 0;      ///< whose silhouette stayed
    std::uint64_t zpass_pairs = 0;       ///< drawn by depth-pass
    std::uint64_t zfail_pairs = 0;       ///< drawn by depth-fail
    std::uint64_t silhouette_edges = 0;  ///< of all pairs drawn, but for quad_pairs
    std::uint64_t quad_pairs = 0;  ///< of all pairs drawn: those whose silhouette the GPU finds
    std::uint64_t stencil_batches = 0;  ///< of all lights; as many as lights with volumes where
                                        ///< none was split
    std::uint64_t split_lights = 0;     ///< lights with more than one batch
    DetectionStats detection;           ///< of all pairs redetected
    std::array<std::uint64_t, choice_count> choices{};  ///< redetected pairs, by Choice
    /// Volumes made while none of their caps were drawn (CapOptions::when_drawn), whose caps were
    /// put together this frame because one is.
    std::uint64_t caps_made = 0;
    double detect_ms = 0.0;  ///< facing and silhouettes; of all threads together
    double build_ms = 0.0;   ///< index ranges, parts included; of all threads together
    std::array<std::uint64_t, reason_count> reasons{};  ///< pairs, by Reason
};

/// What to draw this frame: sorted by light key, then caster key; a caster whose volume was split
/// has a draw for each part. Same input, same list: whatever came before, and however many threads
/// worked on it; but for volumes with empty bounds, which are kept for when they are seen again,
/// and for how those caps are put together that none of the draws needs. A copy shares the meshes
/// and volumes.
struct DrawList {
    /// Changes whenever anything in lights or draws does but VolumeDraw::reason; unique in the
    /// process. 0 for a list that no system made: whoever changes a copy should say so.
    std::uint64_t revision = 0;
    std::vector<LightDraws> lights;  ///< every light of the frame, also one without volumes
    std::vector<VolumeDraw> draws;   ///< of all lights, one after the other
    FrameStats stats;                ///< of this frame
};

}  // namespace gnomon::shadows
#pragma GCC visibility pop
