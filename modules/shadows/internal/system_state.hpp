// SPDX-License-Identifier: MIT
//
// What a ShadowSystem holds. Submission (shadow_system.cpp) writes down what differs; finish()
// (frame.cpp) works on that alone, and keeps the draw list in step (draw_list.cpp).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include <gnomon/shadows/shadow_system.hpp>

#include "batches.hpp"
#include "near_clip.hpp"
#include "pair.hpp"
#include "reach.hpp"
#include "receiver_tree.hpp"

namespace gnomon::shadows {

/// What the system knows of a draw beside what the list says.
struct DrawOrigin {
    enum class Fill : std::uint8_t { Not, View, All };  ///< what of the draw is to be written
    std::uint32_t caster = 0;                           ///< its slot
    std::uint32_t silhouette_edges = 0;          ///< of the pair; 0 for other parts than the first
    bool first = true;                           ///< of its pair's draws
    Technique technique = Technique::DepthFail;  ///< the draw's
    bool quads = false;                          ///< the draw has some
    bool hidden = false;                         ///< its bounds are empty
    bool in_slabs = false;
    bool reach_known = false;
    bool technique_known = false;  ///< that `technique` is right for this frame
    bool bounds_known = false;     ///< that the draw's bounds are
    bool caps_made = false;        ///< this frame, for a volume of ranges alone
    Fill fill = Fill::Not;
    internal::Reach reach = {};
};

/// A receiver that is submitted.
struct ReceiverState : internal::SlotHead {
    OrientedBounds bounds;
    internal::Aabb box;
};

struct ShadowSystem::State {
    SystemOptions options;
    const SilhouetteStrategy* strategy = nullptr;  // null: "auto"

    // Submission.
    Submission submission = Submission::Full;
    internal::Slots<internal::CasterState> casters;
    internal::Slots<internal::LightState> lights;
    std::vector<std::uint32_t> changed_casters;  // slots; may be free again, or twice
    std::vector<std::pair<std::uint32_t, OrientedBounds>> bounds_before;  // of those not new
    internal::Slots<ReceiverState> receivers;
    bool lights_changed = false;
    bool receivers_changed = false;
    bool came_or_went = false;  // casters or lights
    std::uint64_t next_revision = 1;

    // The last finish().
    DrawList list;
    std::vector<DrawOrigin> origins;    // of list.draws
    std::vector<std::uint32_t> listed;  // slots, of list.lights
    std::optional<View> view;
    std::optional<internal::Screen> screen;  // of the view
    FarVertices far_vertices = FarVertices::AtInfinity;
    std::vector<internal::PairWork> work;  // what may have a reason other than Unchanged
    internal::ReceiverTree receiver_tree;
    // Pairs, by light and caster, that have no volume because nothing could be seen of it.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> deferred;
    bool settled = false;  // list says of itself that nothing changed
    std::uint64_t frame = 0;

    // Detectors that pairs hold, by light and caster.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> detectors;

    // Reused from frame to frame.
    internal::VolumePool pool;
    std::mutex scratch_mutex;
    std::vector<std::unique_ptr<internal::Scratch>> scratches;  // that no task uses
    std::vector<internal::DrawnPair> drawn;
    struct DrawToFill {
        std::uint32_t draw;
        std::uint32_t light;  // its place in list.lights
    };
    std::vector<DrawToFill> fills;
    std::vector<internal::NearClip> clips;  // of this frame, by light slot
    std::vector<std::size_t> chunks;        // where those of `work` or `fills` begin, and the end

    // shadow_system.cpp
    void submit(const Caster& caster);
    void submit(const Light& light);
    void submit(const Receiver& receiver);
    void drop_caster(std::uint32_t slot);
    void drop_light(std::uint32_t slot);
    void drop_receiver(std::uint32_t slot);
    void drop_unsubmitted();

    // frame.cpp
    void finish(const View& now);
    void settle();
    void forget_reasons();
    void collect_work(bool all);
    void update_pairs();
    [[nodiscard]] internal::FrameTerms terms() {
        return {.far_vertices = far_vertices,
                .strategy = strategy,
                .frame = frame,
                .caps = options.caps,
                .fill = fill_terms(),
                .force_technique = options.force_technique,
                .pool = &pool,
                .stale = options.stale};
    }
    [[nodiscard]] internal::FillTerms fill_terms() const {
        const bool known = options.receivers == Receivers::Submitted;
        return {options.fill, known ? &receiver_tree : nullptr, screen ? &*screen : nullptr};
    }
    void plant_receivers();
    void find_umbras(bool all);  // umbra_culls.cpp
    void take_up_deferred();
    void update_one(internal::PairWork& item, internal::Scratch& scratch, FrameStats& stats);
    [[nodiscard]] bool place_results();
    void place_volume(internal::LightState& light, internal::PairState& pair,
                      internal::PairWork& item);
    void take_from_grids(std::uint32_t caster, const OrientedBounds& bounds);
    void put_into_grids();
    [[nodiscard]] bool piles_up(internal::LightState& light);
    [[nodiscard]] internal::PairWork work_for(const internal::LightState& light,
                                              std::uint32_t caster) const;
    [[nodiscard]] bool take_back_quads(internal::LightState& light);
    [[nodiscard]] bool split_lights();
    void tidy_up();
    void let_detectors_rest();
    void count_pairs();
    /// task(i) for all i < count, by the host's runner where there is one.
    void run(std::size_t count, const std::function<void(std::size_t)>& task) const;

    // draw_list.cpp
    [[nodiscard]] const Volume* volume_of(const internal::LightState& light,
                                          std::uint32_t caster) const;
    [[nodiscard]] const QuadCasting* quads_of(const internal::LightState& light,
                                              std::uint32_t caster) const;
    void gather_drawn(const internal::LightState& light);
    void lift_volumes(internal::LightState& light);
    void rearrange();
    void drop_draws();
    void make_room(std::size_t kept);
    void make_draw(std::size_t at, internal::LightState& light, const internal::Piece& piece);
    [[nodiscard]] bool fill(bool view_changed);
    [[nodiscard]] bool fill_draw(std::uint32_t index, internal::LightState& light,
                                 const internal::NearClip& clip,
                                 const std::array<glm::dvec3, 8>& seen);
    void choose_slabs(VolumeDraw& draw, const internal::PairState& pair,
                      const internal::LightState& light, const internal::ShadowHull& hull,
                      const internal::Reach& reach) const;
    void make_caps(VolumeDraw& draw, DrawOrigin& origin, internal::PairState& pair) const;
    void renew_revisions();
    void count_draws();
};

}  // namespace gnomon::shadows
