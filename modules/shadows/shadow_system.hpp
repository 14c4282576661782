// SPDX-License-Identifier: MIT
//
// ShadowSystem: from casters and lights, submitted in a plain loop by whatever owns them, to a list
// of volumes to draw. It compares what it is told with what it saw last and works only on what
// changed; it says why for every pair.
//
//     auto frame = system.begin_frame();  // Full: what is not submitted is gone
//     for (auto& ship : ships)
//         frame.caster({.key = ship.id, .mesh = ship.mesh, .world_from_local = ship.pose});
//     frame.light({.key = 1, .position_world = {0.3, 1.0, 0.2, 0.0}});
//     const DrawList& list = std::move(frame).finish(view);
//
// A frame in which nothing changed costs the comparing of what is submitted, and nothing at all
// where only changes are (Submission::Delta). It knows no ECS, no GPU, no scene. One system, one
// thread at a time.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/expects.hpp>
#include <gnomon/core/result.hpp>
#include <gnomon/shadows/detector.hpp>
#include <gnomon/shadows/edge_quads.hpp>
#include <gnomon/shadows/facing.hpp>
#include <gnomon/shadows/jobs.hpp>
#include <gnomon/shadows/light.hpp>
#include <gnomon/shadows/receiver.hpp>
#include <gnomon/shadows/screen_bounds.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>
#include <gnomon/shadows/technique.hpp>
#include <gnomon/shadows/view.hpp>
#include <gnomon/shadows/volume.hpp>
#include <gnomon/shadows/volume_slab.hpp>

namespace gnomon::shadows {

struct Caster {
    std::uint64_t key = 0;  ///< the host's name for it; unique among casters
    std::shared_ptr<const ShadowMesh> mesh;
    glm::dmat4 world_from_local{1.0};  ///< affine
    /// Every casting face is in the depth buffer: drawn, unculled, undiscarded. Then depth-pass
    /// needs no near caps.
    bool in_depth_buffer = true;
    /// Averted: for casters in a depth buffer that came from the host's own shaders.
    NearCaps near_caps = NearCaps::Facing;
};

/// Why a pair's volume is what it is this frame.
enum class Reason : std::uint8_t {
    Unchanged,     ///< poses are bit-equal, or differ by the rounding of their own composition:
                   ///< nothing was detected or built, but caps that the camera now needs
                   ///< (FrameStats::caps_made)
    WithinMargin,  ///< moved, but provably less than the silhouette needs to change: nothing was
                   ///< detected
    New,           ///< the pair was not there before
    LightMoved,
    CasterMoved,
    BothMoved,
    MeshChanged,
    ProjectionChanged,  ///< other far vertices are needed; detected anew as well
    NearCapsChanged,    ///< Caster::near_caps did; detected anew as well
    OutOfRange,         ///< the caster is beyond the light's range: no volume
    OutOfView,          ///< nothing of the shadow can be seen: no volume until it can
    ReachesNothing,     ///< the shadow reaches no receiver: no volume until it does
    InUmbra,            ///< the caster lies in another's shadow: no volume until it does not
    LeftStale,          ///< moved, and StaleOptions allow the silhouette to be out of date
};
inline constexpr std::size_t reason_count = 14;
[[nodiscard]] std::string_view to_string(Reason reason);

/// One volume to draw.
struct VolumeDraw {
    std::uint64_t light = 0;
    std::uint64_t caster = 0;
    std::shared_ptr<const ShadowMesh> mesh;
    std::shared_ptr<const Volume> volume;  ///< empty where `quads` are drawn instead
    /// The silhouette is found on the GPU, from quads on every edge of the mesh: strategies with
    /// SilhouetteStrategy::quads, for casters that fits_edge_quads(), cast one-sided and are not
    /// deformed.
    std::optional<QuadCasting> quads;
    /// Changes whenever the indices or the bits of `quads` do; unique in the process.
    std::uint64_t revision = 0;
    glm::dmat4 world_from_local{1.0};
    /// Takes the far vertices (p * scale + offset) to the world, homogeneous: the caster's own
    /// pose, but for singular poses, and where they lie on a plane (FillOptions::clamp).
    glm::dmat4 world_from_far{1.0};
    Extrusion extrusion;
    Technique technique = Technique::DepthFail;
    bool near_caps = true;  ///< depth-pass: whether near caps must be drawn as well
    bool far_caps = true;   ///< whether far caps must be, with this technique
    bool mirrored = false;  ///< the pose turns triangles over: front and back exchange
    Reason reason = Reason::New;
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
    std::uint64_t light = 0;
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    /// 1 where no point can lie under more layers than SystemOptions::max_layers. Else draws come
    /// in batches of at most 127 layers each, volumes that exceed that alone in parts, ascending;
    /// a point is in shadow where any batch counts.
    std::uint32_t batches = 1;
    ScreenBounds bounds = {};  ///< of all its volumes together
    /// Some of its volumes end behind the last receiver, openly perhaps, others may not: where no
    /// surface is at all, counts mean nothing, and whoever draws them sets them to 0.
    bool clear_background = false;
};

struct FrameStats {
    std::string_view silhouette;  ///< SystemOptions::silhouette; `choices` has what "auto" chose
    std::uint64_t casters = 0;
    std::uint64_t lights = 0;
    std::uint64_t pairs = 0;
    /// Without a volume: OutOfRange, OutOfView, ReachesNothing, InUmbra.
    std::uint64_t pairs_culled = 0;
    std::uint64_t pairs_hidden = 0;  ///< with a volume that changes nothing in this view
    /// Of the culled and hidden ones: whose caster lies in another's umbra.
    std::uint64_t pairs_in_umbra = 0;
    std::uint64_t pairs_clamped = 0;   ///< of all pairs drawn: far vertices on a plane
    std::uint64_t pairs_in_slabs = 0;  ///< of those that are seen: VolumeDraw::slabs
    std::uint64_t pairs_redetected = 0;
    std::uint64_t pairs_reused = 0;
    std::uint64_t zpass_pairs = 0;
    std::uint64_t zfail_pairs = 0;
    std::uint64_t silhouette_edges = 0;  ///< of all pairs drawn, but for quad_pairs
    std::uint64_t quad_pairs = 0;  ///< of all pairs drawn: those whose silhouette the GPU finds
    std::uint64_t stencil_batches = 0;  ///< of all lights; as many as lights with volumes where
                                        ///< none was split
    std::uint64_t split_lights = 0;     ///< lights with more than one batch
    DetectionStats detection;
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
    std::vector<VolumeDraw> draws;
    FrameStats stats;
};

enum class Submission : std::uint8_t {
    Full,   ///< what is not submitted is gone
    Delta,  ///< what is not submitted is as it was; use remove_caster and remove_light
};

/// Silhouettes that may be out of date, for hosts that would rather be a little wrong than wait.
/// Volumes stay closed, so that nothing leaks: what is wrong lies between the shadow's edge as it
/// is and as it was. All off: exact. A pair is never left out of date where its light enters the
/// caster's bounds, nor where the mesh or what else its volume is made for has changed; and quads
/// of the GPU that decide facing in the shader are always up to date. What has come to rest stays
/// as it is: within the tolerance, and up to detect_every - 1 frames of motion behind.
struct StaleOptions {
    /// 0 .. pi: the silhouette is kept while the light, as seen from the middle of the caster's
    /// bounds and in the caster's space, has turned by no more since it was found.
    double pose_tolerance_rad = 0.0;
    /// 1 .. 1024: a pair that moves in every frame has a new silhouette in every n-th alone, pairs
    /// in turn. After H. Y. Kwoon, "The Theory of Stencil Shadow Volumes" (2002).
    std::uint32_t detect_every = 1;

    [[nodiscard]] bool none() const { return pose_tolerance_rad == 0.0 && detect_every == 1; }
};

/// How it is known that no point lies under more layers than the stencil counts.
enum class LayerBound : std::uint8_t {
    /// Each light's layers are bounded from above, and split where the bound is too high. Pairs
    /// that the GPU finds the silhouettes of have a coarse bound only: where that is too high the
    /// CPU takes them back, until they are detected anew: then a list may say more of what came
    /// before than DrawList promises, though not what is drawn.
    Proved,
    /// The host says so: nothing is bounded, nothing split. Where it is wrong, the shadow is.
    Promised,
};

struct SystemOptions {
    std::optional<Technique> force_technique =
        std::nullopt;                      ///< for every pair, valid or not; for tests and reports
    std::string_view silhouette = "auto";  ///< a name from silhouette_strategies(), or "auto"
    /// A light whose volumes could lay more layers than this over a point is split into batches.
    /// 1 .. 255: what eight bits count. Less is for tests.
    std::uint32_t max_layers = 255;
    LayerBound layer_bound = LayerBound::Proved;
    /// Runs the detection and building of pairs that changed. Empty: all on the thread that calls
    /// finish(). That is the default because a library that starts threads unasked competes with
    /// its host's own; thread_jobs() is a runner for hosts without any.
    Jobs jobs = {};
    /// A fan is used for those pairs for which it is exact; the others have faces.
    CapOptions caps = {};
    Receivers receivers = Receivers::Anywhere;
    FillOptions fill = {};
    StaleOptions stale = {};
};

/// What a ShadowSystem holds, in bytes: capacities, without what the allocator adds.
struct SystemMemory {
    std::uint64_t casters = 0;  ///< with the look-up of their keys
    std::uint64_t lights = 0;   ///< likewise, and how each was split
    /// 60 bytes for each pair of a light and a caster, in range or not, 61 where one may lie in
    /// another's umbra.
    std::uint64_t pairs = 0;
    /// What pairs hold for a while: detectors that keep state, until a pair has been at rest for 64
    /// to 128 frames; whole volumes and parts of lights that are split; distances for finite views.
    std::uint64_t extras = 0;
    std::uint64_t receivers = 0;  ///< with their tree
    std::uint64_t draws = 0;      ///< of the draw list
    std::uint64_t volumes = 0;  ///< what it shares with copies of the list: volumes, their indices
    std::uint64_t scratch = 0;  ///< what is reused from frame to frame
};

class ShadowSystem {
public:
    /// Fails with ErrorCode::InvalidInput for an unknown strategy name, max_layers beyond 1 .. 255
    /// or stale options beyond their limits.
    [[nodiscard]] static Result<ShadowSystem> create(const SystemOptions& options = {});
    ShadowSystem(ShadowSystem&&) noexcept;
    ShadowSystem& operator=(ShadowSystem&&) noexcept;
    ~ShadowSystem();

    /// One frame's submission. Ends with finish(); dropped without it, it has still been submitted.
    class Frame {
    public:
        /// A key submitted twice in a frame: the last one counts. Cost: a comparison where casters
        /// come in the order of the last frame, else a look-up and a comparison; the mesh's
        /// reference count is left alone where it is the same mesh.
        void caster(const Caster& caster);
        void light(const Light& light);
        void remove_caster(std::uint64_t key);
        void remove_light(std::uint64_t key);
        /// The system must have been made with Receivers::Submitted.
        void receiver(const Receiver& receiver);
        [[nodiscard]] bool takes_receivers() const;
        void remove_receiver(std::uint64_t key);
        /// Detects and builds what changed. A matrix or light that is not finite leaves its pairs
        /// out and is counted as culled. The list is the system's and stands until its next
        /// finish(); copy it to keep it. Cost: nothing where no submission differed from the last
        /// and the view is the same to the bit (one look at what had changed before, once); else
        /// some microseconds for each pair whose caster or light changed, some hundred nanoseconds
        /// for each draw where the view did, or microseconds where its bounds may shadow the eye,
        /// and a pass over the draws where some came or went. Allocates nothing where nothing
        /// changed.
        [[nodiscard]] const DrawList& finish(const View& view) &&;

    private:
        friend class ShadowSystem;
        explicit Frame(ShadowSystem& system) : system_(&system) {}
        ShadowSystem* system_;
    };

    [[nodiscard]] Frame begin_frame(Submission submission = Submission::Full);

    /// Cost: linear in pairs and draws.
    [[nodiscard]] SystemMemory memory() const;

private:
    struct State;
    explicit ShadowSystem(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace gnomon::shadows
