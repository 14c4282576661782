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
#include <gnomon/shadows/draw_list.hpp>
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

#pragma GCC visibility push(default)
namespace gnomon::shadows {

/// Something that casts shadows, as the host submits it.
struct Caster {
    std::uint64_t key = 0;                   ///< the host's name for it; unique among casters
    std::shared_ptr<const ShadowMesh> mesh;  ///< not null; shared by all that have these triangles
    glm::dmat4 world_from_local{1.0};        ///< affine
    /// Every casting face is in the depth buffer: drawn, unculled, undiscarded. Then depth-pass
    /// needs no near caps.
    bool in_depth_buffer = true;
    /// Averted: for casters in a depth buffer that came from the host's own shaders.
    NearCaps near_caps = NearCaps::Facing;
};

/// What it means that something is not submitted.
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

    /// Whether all is exact.
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

/// What a system is made with.
struct SystemOptions {
    std::optional<Technique> force_technique =
        std::nullopt;                      ///< for every pair, valid or not; for tests and reports
    std::string_view silhouette = "auto";  ///< a name from silhouette_strategies(), or "auto"
    /// A light whose volumes could lay more layers than this over a point is split into batches.
    /// 1 .. 255: what eight bits count. Less is for tests.
    std::uint32_t max_layers = 255;
    LayerBound layer_bound = LayerBound::Proved;  ///< whether lights are split
    /// Runs the detection and building of pairs that changed. Empty: all on the thread that calls
    /// finish(). That is the default because a library that starts threads unasked competes with
    /// its host's own; thread_jobs() is a runner for hosts without any.
    Jobs jobs = {};
    /// A fan is used for those pairs for which it is exact; the others have faces.
    CapOptions caps = {};
    Receivers receivers = Receivers::Anywhere;  ///< whether they are submitted
    FillOptions fill = {};                      ///< what is left out of volumes
    StaleOptions stale = {};                    ///< all off: exact
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

/// Turns casters and lights, submitted every frame, into volumes to draw, and works on what changed
/// alone. One thread at a time.
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
        /// As caster(): the last of a key counts.
        void light(const Light& light);
        /// It is gone; nothing happens where it was not there. For Submission::Delta.
        void remove_caster(std::uint64_t key);
        /// Likewise.
        void remove_light(std::uint64_t key);
        /// The system must have been made with Receivers::Submitted.
        void receiver(const Receiver& receiver);
        /// Whether receiver() may be called.
        [[nodiscard]] bool takes_receivers() const;
        /// As remove_caster().
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

    /// Begins a frame; the one before must be finished or dropped.
    [[nodiscard]] Frame begin_frame(Submission submission = Submission::Full);

    /// Cost: linear in pairs and draws.
    [[nodiscard]] SystemMemory memory() const;

private:
    struct State;
    explicit ShadowSystem(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace gnomon::shadows
#pragma GCC visibility pop
