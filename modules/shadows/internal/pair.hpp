// SPDX-License-Identifier: MIT
//
// What the ShadowSystem remembers of one pair of caster and light, and how it brings it up to date.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/shadows/detector.hpp>
#include <gnomon/shadows/edge_quads.hpp>
#include <gnomon/shadows/facing.hpp>
#include <gnomon/shadows/layer_bound.hpp>
#include <gnomon/shadows/shadow_system.hpp>
#include <gnomon/shadows/silhouette.hpp>
#include <gnomon/shadows/technique.hpp>
#include <gnomon/shadows/volume.hpp>

#include "layer_grid.hpp"
#include "local_light.hpp"
#include "near_clip.hpp"
#include "reach.hpp"
#include "slots.hpp"
#include "umbra_culls.hpp"
#include "volume_pool.hpp"

namespace gnomon::shadows::internal {

struct CasterState : SlotHead {
    // What a submission is compared with comes first: few lines of the cache a caster.
    bool in_depth_buffer = true;
    NearCaps near_caps = NearCaps::Facing;
    bool changed = false;  ///< in anything since the last finish()
    bool moved = false;    ///< a bit of its pose changed since the last finish()
    std::shared_ptr<const ShadowMesh> mesh;
    Pose pose;
    std::uint64_t pose_revision = 0;  ///< changes whenever a bit of the pose does
    std::uint64_t mesh_before = 0;    ///< its id, as of the last finish()
    // A sphere round its bounds, in the world.
    glm::dvec3 center{0.0};
    double radius = 0.0;
    double hides_m2 = 0.0;  ///< no part that others can lie behind has more area; 0: there is none
};

[[nodiscard]] OrientedBounds bounds_of(const CasterState& caster);

/// A part of a volume that alone could lay too many layers over a point.
struct VolumePart {
    std::shared_ptr<const Volume> volume;
    std::uint64_t revision = 0;
    std::uint32_t layers = 0;
};

/// What few pairs need, or for a while only.
struct PairExtra {
    /// Of a strategy that keeps state, until the pair has been at rest for a while.
    std::unique_ptr<SilhouetteDetector> detector;
    const SilhouetteStrategy* strategy = nullptr;  ///< the detector's
    std::uint64_t detected_frame = 0;
    bool watched = false;              ///< the detector is in the list of those that may rest
    bool detector_is_current = false;  ///< the pair's volume is made of what it found last
    /// The pair's volume where the draw list has no draw of it as a whole: parts are drawn instead.
    std::shared_ptr<const Volume> whole;
    std::uint64_t whole_revision = 0;
    std::unique_ptr<QuadCasting> whole_quads;  ///< VolumeDraw::quads, with `whole`
    std::vector<VolumePart> parts;
    /// Metres from the light to the nearest casting face, for finite views; negative until asked
    /// for.
    double nearest_face = -1.0;

    [[nodiscard]] bool idle() const {
        return detector == nullptr && whole == nullptr && parts.empty() && nearest_face < 0.0;
    }
};

enum class PairFlag : std::uint8_t {
    Known = 1,         ///< its volume was made, from what the others say
    Flattened = 2,     ///< for a singular pose
    Directional = 4,   ///< for a light infinitely far away
    AvertedCaps = 8,   ///< Caster::near_caps
    FiniteFar = 16,    ///< far vertices of its volume are not at infinity
    FromOutside = 32,  ///< seen_from_outside()
    // 64 and 128: Bounded
};

/// What a pair's layers are: by the quick bounds alone, or by what else it took.
enum class Bounded : std::uint8_t { Quickly, OnHalfGrid, OnFullGrid, AsWellAsCanBe };

inline constexpr std::uint32_t no_draw = std::numeric_limits<std::uint32_t>::max();

/// One for every pair, whether it casts or not: kept small. Its volume is where it is drawn from,
/// in the draw list, or in `extra`; an empty one is nowhere, unless the GPU makes it.
struct PairState {
    /// The light in the caster's space, before rounding; in the world where flattened.
    glm::dvec3 light_exact{0.0};
    glm::vec3 detected{0.0F};  ///< the light that the facing was decided for
    float margin = 0.0F;       ///< how far it may move from there
    std::unique_ptr<PairExtra> extra;
    std::uint32_t draw = no_draw;  ///< among its light's draws
    /// The frame, modulo 65,536, in which the reason was not Unchanged last.
    std::uint16_t changed = 0;
    Reason reason = Reason::Unchanged;
    std::uint8_t flags = 0;

    [[nodiscard]] bool is(PairFlag flag) const {
        return (flags & static_cast<unsigned>(flag)) != 0;
    }
    void set(PairFlag flag, bool on) {
        const auto bit = static_cast<unsigned>(flag);
        flags = static_cast<std::uint8_t>(on ? flags | bit : flags & ~bit);
    }
    [[nodiscard]] Bounded bounded() const { return static_cast<Bounded>(flags >> 6U); }
    void set_bounded(Bounded how) {
        flags = static_cast<std::uint8_t>((flags & 0x3FU) | static_cast<unsigned>(how) << 6U);
    }
    PairExtra& more() {
        if (extra == nullptr) extra = std::make_unique<PairExtra>();
        return *extra;
    }
    void release_idle_extra() {
        if (extra != nullptr && extra->idle()) extra.reset();
    }
};
static_assert(sizeof(void*) != 8 || sizeof(PairState) == 56, "there may be millions of them");

/// How a light's volumes were distributed last.
struct LayerMemory {
    std::vector<std::uint64_t> revisions;  ///< of the light, each volume and each pose
    std::uint32_t batches = 1;
};

/// One draw of a light that is split into batches.
struct Piece {
    static constexpr std::uint32_t whole = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t caster = 0;    ///< its slot
    std::uint32_t part = whole;  ///< of the pair's PairExtra::parts
    std::uint32_t batch = 0;
    bool first = true;  ///< of its pair's
    bool operator==(const Piece&) const = default;
};

struct LightState : SlotHead {
    Light light;
    bool changed = false;        ///< in anything since the last finish()
    bool moved = false;          ///< a bit of its position changed since the last finish()
    std::uint64_t revision = 0;  ///< changes whenever a bit of the position does
    // By caster slot; layers are 0 where there is no volume.
    std::vector<PairState> pairs;
    std::vector<std::uint32_t> layers;  ///< that a pair's volume can lay over a point
    std::array<std::uint64_t, reason_count> culled{};  ///< pairs without a volume, by Reason
    LightUmbras umbras;                                ///< casters that others may lie behind
    LayerMemory memory;
    std::unique_ptr<LayerGrid> grid;  ///< of all pairs' layers, while there are many; or null
    // In the draw list.
    bool listed = false;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::vector<Piece> pieces;  ///< one for each draw where the light is split, else empty
    bool all_anew = false;      ///< this frame: none of its draws stays
    bool gained = false;        ///< this frame: there are pairs that need a draw
    bool touched = false;       ///< this frame: a pair's layers or where they lie may have changed
    bool worked_on = false;     ///< this frame: a pair may have changed
    /// By their quick layers alone its volumes piled up too high lately: pairs that change get the
    /// coarse bound at once.
    bool piled_up = false;
};

/// What detection reuses from pair to pair.
struct Scratch {
    /// Of strategies that keep no state.
    std::vector<std::pair<const SilhouetteStrategy*, std::unique_ptr<SilhouetteDetector>>>
        detectors;
    Facing facing;  ///< of singular poses
    Detection flattened;
    std::vector<FaceRun> runs;
};

/// A pair that has no volume, for now.
[[nodiscard]] constexpr bool is_culled(Reason reason) {
    return reason == Reason::OutOfRange || reason == Reason::OutOfView ||
           reason == Reason::ReachesNothing || reason == Reason::InUmbra;
}

/// Beyond what the light lights.
[[nodiscard]] bool is_out_of_range(const CasterState& caster, const Light& light);

/// What is the same for all pairs of a frame.
struct FrameTerms {
    FarVertices far_vertices = FarVertices::AtInfinity;  ///< of pairs that are not clamped
    const SilhouetteStrategy* strategy = nullptr;        ///< null: "auto"
    std::uint64_t frame = 0;
    CapOptions caps = {};
    FillTerms fill = {};
    std::optional<Technique> force_technique = std::nullopt;
    VolumePool* pool = nullptr;      ///< for volumes; null: each is new
    const NearClip* clip = nullptr;  ///< the light's; null: every cap may be drawn
    StaleOptions stale = {};
};

/// A pair that may have changed, and what came of it.
struct PairWork {
    std::uint32_t light = 0;
    std::uint32_t caster = 0;
    std::uint32_t layers = 0;
    FarVertices far_vertices = FarVertices::AtInfinity;
    Reason was = Reason::Unchanged;  ///< the pair's reason before
    bool had_volume = false;
    bool in_umbra = false;  ///< its caster lies in another's
    Reach reach = {};
    std::optional<Shown> shown = std::nullopt;          ///< where it has been asked for
    std::optional<Technique> technique = std::nullopt;  ///< where it has been asked for
    std::shared_ptr<const Volume> made = nullptr;       ///< null: its volume stays what it was
    std::unique_ptr<QuadCasting> quads = nullptr;       ///< VolumeDraw::quads, with `made`
};

/// Unique in the process, never 0.
[[nodiscard]] std::uint64_t next_volume_revision();

/// What a strategy may be chosen by, beside the mesh.
struct PairHistory {
    bool is_new = true;
    std::uint32_t frames_at_rest = 0;  ///< before this frame; not of a new pair
};

/// The strategy for one pair in one frame, and why it is that. Where `wanted` is null this is where
/// "auto" decides: a pair that moves again and again gets a detector of its own, which decides from
/// then on; all others are served by one that keeps no state.
struct ChosenStrategy {
    const SilhouetteStrategy* strategy = nullptr;
    Choice choice = Choice::ByName;  ///< unless the detector knows better
};
[[nodiscard]] ChosenStrategy choose_strategy(const SilhouetteStrategy* wanted,
                                             const ShadowMesh& mesh, const PairHistory& history);

/// What the volumes of a caster may be drawn with, in the view and for the light of `clip`. Cost:
/// see NearClip.
[[nodiscard]] Technique choose_technique(const CasterState& caster, const NearClip& clip);

/// Whether depth-pass has to draw far caps: at infinity they are in front of nothing, and neither
/// are they on a plane behind all that can be seen; any others close the volume.
[[nodiscard]] bool depth_pass_has_far_caps(bool far_at_infinity, const Reach& reach,
                                           const Screen& screen);

/// Brings the pair up to date: its reason, and in `work` a new volume where it needs one, its
/// layers where they may be others, and its reach. A volume that cannot be seen is not made: then
/// the pair is as new, but for its reason. `volume` is the one it has, null for none or an empty
/// one, and `quads` what the GPU makes it from, if it does. Touches nothing but its arguments, so
/// that pairs may be updated by several threads at a time. Adds to the stats.
void update_pair(PairState& pair, const CasterState& caster, const LightState& light,
                 const FrameTerms& terms, const Volume* volume, const QuadCasting* quads,
                 Scratch& scratch, PairWork& work, FrameStats& stats);

/// Gives a pair that was left to the GPU a volume of the CPU's after all, in `work`, with its
/// layers: exact for the light as it is. Adds to the stats.
void take_back_from_gpu(PairState& pair, const CasterState& caster, const LightState& light,
                        const FrameTerms& terms, Scratch& scratch, PairWork& work,
                        FrameStats& stats);

/// The light in the caster's space, as the shader receives it.
[[nodiscard]] LightLocal current_light(const PairState& pair, const LightState& light);

/// Where the pair's layers are bounded.
[[nodiscard]] LayerSpace space_of(const PairState& pair, const CasterState& caster,
                                  const LightState& light);

/// Distance from a point to the nearest of the faces that the volume's caps are made of, in world
/// metres.
double nearest_face(const Volume& volume, const ShadowMesh& mesh,
                    const glm::dmat4& world_from_local, const glm::dvec3& point_world);

}  // namespace gnomon::shadows::internal
