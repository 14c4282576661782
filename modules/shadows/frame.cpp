// SPDX-License-Identifier: MIT
//
// ShadowSystem::Frame::finish(): works on the pairs of what was written down as different, and on
// nothing else.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <numeric>

#include "internal/finite.hpp"
#include "internal/system_state.hpp"

namespace gnomon::shadows {

using internal::CasterState;
using internal::LightState;
using internal::PairFlag;
using internal::PairState;
using internal::PairWork;
using internal::Scratch;

namespace {

// Fewer are summed up sooner than a thread wakes.
constexpr std::size_t casters_of_task = 1'000;

// Pairs at rest give their detectors back after this many frames, at most twice as many.
constexpr std::uint64_t frames_to_rest = 64;

// Whether volumes still pile up by their quick layers is asked again after so many.
constexpr std::uint64_t frames_to_forget = 256;

bool same_view(const View& a, const View& b) {
    return a.projection == b.projection &&
           std::memcmp(&a.view_from_world, &b.view_from_world, sizeof a.view_from_world) == 0 &&
           std::memcmp(&a.clip_from_view, &b.clip_from_view, sizeof a.clip_from_view) == 0;
}

std::uint64_t next_list_revision() {
    static std::atomic<std::uint64_t> next{1};
    return next.fetch_add(1);
}

// A scratch that is nobody else's for as long as this lives.
class Borrowed {
public:
    Borrowed(std::mutex& mutex, std::vector<std::unique_ptr<Scratch>>& unused)
        : mutex_(mutex), unused_(unused) {
        const std::lock_guard lock(mutex_);
        if (!unused_.empty()) {
            scratch_ = std::move(unused_.back());
            unused_.pop_back();
        } else {
            scratch_ = std::make_unique<Scratch>();
        }
    }
    Borrowed(const Borrowed&) = delete;
    Borrowed& operator=(const Borrowed&) = delete;
    ~Borrowed() {
        const std::lock_guard lock(mutex_);
        unused_.push_back(std::move(scratch_));
    }
    Scratch& operator*() { return *scratch_; }

private:
    std::mutex& mutex_;
    std::vector<std::unique_ptr<Scratch>>& unused_;
    std::unique_ptr<Scratch> scratch_;
};

std::size_t place_of(Reason reason) { return static_cast<std::size_t>(reason); }

// For other views or receivers.
bool waits(Reason reason) {
    return reason == Reason::OutOfView || reason == Reason::ReachesNothing;
}

template <class T>
void give_back(std::vector<T>& reused) {
    reused.clear();
    if (reused.capacity() > 1'024) reused.shrink_to_fit();
}

void add(FrameStats& sum, const FrameStats& part) {
    sum.pairs_redetected += part.pairs_redetected;
    sum.detection.faces_tested += part.detection.faces_tested;
    sum.detection.edges_tested += part.detection.edges_tested;
    sum.detection.double_tests += part.detection.double_tests;
    sum.detection.exact_tests += part.detection.exact_tests;
    sum.detection.bytes_touched += part.detection.bytes_touched;
    for (std::size_t i = 0; i < choice_count; ++i) sum.choices[i] += part.choices[i];
    sum.detect_ms += part.detect_ms;
    sum.build_ms += part.build_ms;
    for (std::size_t i = 0; i < reason_count; ++i) sum.reasons[i] += part.reasons[i];
}

}  // namespace

void ShadowSystem::State::run(std::size_t count,
                              const std::function<void(std::size_t)>& task) const {
    if (options.jobs && count > 1) {
        options.jobs(count, task);
    } else {
        for (std::size_t i = 0; i < count; ++i) task(i);
    }
}

void ShadowSystem::State::finish(const View& now) {
    ++frame;
    if (submission == Submission::Full) drop_unsubmitted();
    if (frame % frames_to_rest == 0) let_detectors_rest();
    if (frame % frames_to_forget == 0) {
        for (std::uint32_t l = 0; l < lights.end(); ++l) lights[l].piled_up = false;
    }
    const bool view_changed = !view || !same_view(*view, now);
    if (!view_changed && !came_or_went && !lights_changed && !receivers_changed &&
        changed_casters.empty()) {
        if (!settled) settle();
        return;
    }
    forget_reasons();
    list.stats = {};
    view = now;
    screen.emplace(now);
    const bool infinite = now.projection == ProjectionKind::InfinitePerspective;
    const FarVertices far = infinite ? FarVertices::AtInfinity : FarVertices::Finite;
    const bool all = far != far_vertices || receivers_changed;
    if (receivers_changed) plant_receivers();
    far_vertices = far;
    casters.sort();
    lights.sort();
    collect_work(all);
    find_umbras(all);
    if (!all && view_changed) take_up_deferred();
    clips.clear();
    for (std::uint32_t l = 0; l < lights.end(); ++l) {
        clips.emplace_back(lights[l].light.position_world, now);
    }
    update_pairs();
    bool rearranged = place_results();
    const auto start = std::chrono::steady_clock::now();
    put_into_grids();
    rearranged = split_lights() || rearranged;
    list.stats.build_ms +=
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    rearranged = rearranged || came_or_went;
    if (rearranged) rearrange();
    const bool filled = fill(view_changed);
    if (rearranged || filled || list.revision == 0) list.revision = next_list_revision();
    count_draws();
    count_pairs();
    tidy_up();
    pool.trim();
}

// The first frame after a change in which nothing changes: nothing but the reasons does.
void ShadowSystem::State::settle() {
    forget_reasons();
    FrameStats& stats = list.stats;
    stats.pairs_redetected = 0;
    stats.caps_made = 0;
    stats.detection = {};
    stats.detect_ms = 0.0;
    stats.build_ms = 0.0;
    stats.reasons = {};
    count_pairs();
    settled = true;
    // Many thousand pairs that all changed once should not be paid for ever after.
    give_back(work);
    give_back(fills);
    give_back(drawn);
    pool.clear();
}

void ShadowSystem::State::forget_reasons() {
    for (const PairWork& item : work) {
        LightState& light = lights[item.light];
        if (item.caster >= light.pairs.size()) continue;  // gone, another in its place
        PairState& pair = light.pairs[item.caster];
        if (!internal::is_culled(pair.reason)) pair.reason = Reason::Unchanged;
        if (pair.draw != internal::no_draw) {
            list.draws[light.first + pair.draw].reason = Reason::Unchanged;
        }
        if (!light.pieces.empty()) light.worked_on = true;
    }
    work.clear();
    for (std::uint32_t l = 0; l < lights.end(); ++l) {
        LightState& light = lights[l];
        if (!light.worked_on) continue;
        for (std::uint32_t i = 0; i < light.count; ++i) {
            list.draws[light.first + i].reason = Reason::Unchanged;
        }
        light.worked_on = false;
    }
}

void ShadowSystem::State::collect_work(bool all) {
    std::vector<std::uint32_t>& changed = changed_casters;
    std::erase_if(changed, [&](std::uint32_t c) { return !casters[c].changed; });
    const auto by_key = [&](std::uint32_t a, std::uint32_t b) {
        return casters[a].key < casters[b].key;
    };
    if (!std::is_sorted(changed.begin(), changed.end(), by_key)) {
        std::sort(changed.begin(), changed.end(), by_key);
    }
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    for (const std::uint32_t l : lights.by_key()) {
        LightState& light = lights[l];
        light.pairs.resize(casters.end());
        light.layers.resize(casters.end());
        const bool whole_row = all || light.changed;
        // What is easier made anew than kept in step.
        if (whole_row || bounds_before.size() > casters.size() / 4) light.grid = nullptr;
        for (const std::uint32_t c : whole_row ? casters.by_key() : changed) {
            work.push_back({.light = l, .caster = c});
        }
    }
    for (const auto& [caster, bounds] : bounds_before) take_from_grids(caster, bounds);
    bounds_before.clear();
}

void ShadowSystem::State::plant_receivers() {
    receivers.sort();
    std::vector<internal::Aabb> boxes;
    boxes.reserve(receivers.size());
    for (const std::uint32_t r : receivers.by_key()) boxes.push_back(receivers[r].box);
    receiver_tree.build(boxes);
}

// Of those that could not be seen, some may be now.
void ShadowSystem::State::take_up_deferred() {
    std::erase_if(deferred, [&](const auto& place) {
        const auto [l, c] = place;
        if (c >= lights[l].pairs.size()) return true;
        return !waits(lights[l].pairs[c].reason);
    });
    // One that did not wait for a while, and then again, is there twice.
    std::sort(deferred.begin(), deferred.end());
    deferred.erase(std::unique(deferred.begin(), deferred.end()), deferred.end());
    for (const auto& [l, c] : deferred) {
        if (lights[l].changed || casters[c].changed) continue;  // has been taken up
        work.push_back({.light = l, .caster = c});
    }
}

void ShadowSystem::State::update_pairs() {
    // Tasks of a tenth of a millisecond or so: what one pair costs depends on its mesh.
    constexpr std::uint64_t cost_of_task = 32'768;
    constexpr std::uint64_t cost_of_pair = 64;
    chunks.assign(1, 0);
    std::uint64_t cost = 0;
    for (std::size_t i = 0; i < work.size(); ++i) {
        cost += cost_of_pair + casters[work[i].caster].mesh->faces().size();
        if (cost < cost_of_task && i + 1 < work.size()) continue;
        chunks.push_back(i + 1);
        cost = 0;
    }
    std::vector<FrameStats> parts(chunks.size() - 1);
    run(parts.size(), [&](std::size_t chunk) {
        Borrowed scratch(scratch_mutex, scratches);
        for (std::size_t i = chunks[chunk]; i < chunks[chunk + 1]; ++i) {
            update_one(work[i], *scratch, parts[chunk]);
        }
    });
    for (const FrameStats& part : parts) add(list.stats, part);
}

void ShadowSystem::State::update_one(PairWork& item, Scratch& scratch, FrameStats& stats) {
    LightState& light = lights[item.light];
    const CasterState& caster = casters[item.caster];
    PairState& pair = light.pairs[item.caster];
    const Volume* volume = volume_of(light, item.caster);
    item.was = pair.reason;
    item.had_volume = volume != nullptr;
    item.in_umbra = light.umbras.holds(item.caster);
    if (!caster.pose.finite || !internal::is_finite(light.light.position_world) ||
        internal::is_out_of_range(caster, light.light)) {
        pair = {};
        pair.reason = Reason::OutOfRange;
        return;
    }
    internal::FrameTerms its_terms = terms();
    its_terms.clip = &clips[item.light];
    internal::update_pair(pair, caster, light, its_terms, volume, quads_of(light, item.caster),
                          scratch, item, stats);
}

// In the order of the work, whoever did it: revisions are the same whatever the threads. True where
// draws come or go.
bool ShadowSystem::State::place_results() {
    bool rearranged = false;
    for (PairWork& item : work) {
        LightState& light = lights[item.light];
        PairState& pair = light.pairs[item.caster];
        const bool is_culled = internal::is_culled(pair.reason);
        if (internal::is_culled(item.was)) --light.culled[place_of(item.was)];
        if (is_culled) ++light.culled[place_of(pair.reason)];
        if (waits(pair.reason) && !waits(item.was)) {
            deferred.emplace_back(item.light, item.caster);
        }
        light.worked_on = true;
        const bool changes = is_culled ? item.had_volume : pair.reason != Reason::Unchanged;
        // Volumes that lay as they do may lie over others now.
        if (casters[item.caster].moved || light.moved) light.touched = true;
        if (changes) {
            light.touched = true;
            light.layers[item.caster] = item.layers;
            if (pair.extra != nullptr) pair.extra->parts.clear();
        }
        if (item.made != nullptr) place_volume(light, pair, item);
        const bool drawn = pair.draw != internal::no_draw;
        if (drawn) {
            DrawOrigin& origin = origins[light.first + pair.draw];
            origin.fill = DrawOrigin::Fill::All;
            origin.reach = item.reach;
            origin.reach_known = true;
            origin.technique_known = item.technique.has_value();
            if (item.technique) origin.technique = *item.technique;
            origin.bounds_known = item.shown.has_value();
            if (item.shown) list.draws[light.first + pair.draw].bounds = item.shown->bounds;
        }
        const bool has_volume = drawn || (pair.extra != nullptr && pair.extra->whole != nullptr);
        rearranged = rearranged || item.had_volume != has_volume;
        if (pair.extra == nullptr) continue;
        if (pair.extra->detector != nullptr && !pair.extra->watched) {
            pair.extra->watched = true;
            detectors.emplace_back(item.light, item.caster);
        }
        pair.release_idle_extra();
    }
    return rearranged;
}

void ShadowSystem::State::place_volume(LightState& light, PairState& pair, PairWork& item) {
    const std::uint64_t revision = internal::next_volume_revision();
    const bool empty =
        item.made->empty() && item.quads == nullptr;  // nothing faces anything: no shadow
    if (pair.draw != internal::no_draw) {
        VolumeDraw& draw = list.draws[light.first + pair.draw];
        if (empty) {
            pair.draw = internal::no_draw;
        } else {
            draw.volume = std::move(item.made);
            draw.quads.reset();
            if (item.quads != nullptr) draw.quads = std::move(*item.quads);
            draw.revision = revision;
        }
    } else if (!empty) {
        pair.more().whole = std::move(item.made);
        pair.extra->whole_quads = std::move(item.quads);
        pair.extra->whole_revision = revision;
        light.gained = true;
    } else if (pair.extra != nullptr) {
        pair.extra->whole = nullptr;
        pair.extra->whole_quads = nullptr;
    }
    item.made = nullptr;
    item.quads = nullptr;
}

// Of a caster as it was at the last finish(), by the bounds that it had.
void ShadowSystem::State::take_from_grids(std::uint32_t caster, const OrientedBounds& bounds) {
    for (std::uint32_t l = 0; l < lights.end(); ++l) {
        LightState& light = lights[l];
        if (caster >= light.layers.size()) continue;
        if (light.grid != nullptr) light.grid->remove(bounds, light.layers[caster]);
    }
}

void ShadowSystem::State::put_into_grids() {
    for (const std::uint32_t l : lights.by_key()) {
        LightState& light = lights[l];
        if (light.grid == nullptr) continue;
        for (const std::uint32_t c : changed_casters) {
            light.grid->add(bounds_of(casters[c]), light.layers[c]);
        }
    }
}

// Whether more layers than can be counted may lie over a point; asked of all pairs' bounds alone.
bool ShadowSystem::State::piles_up(LightState& light) {
    if (options.layer_bound == LayerBound::Promised) return false;
    const std::uint64_t sum =
        std::accumulate(light.layers.begin(), light.layers.end(), std::uint64_t{0});
    if (sum <= options.max_layers) {
        light.grid = nullptr;
        return false;
    }
    if (light.grid == nullptr) {
        std::vector<internal::Footprint> footprints;
        const glm::dvec4& position = light.light.position_world;
        for (const std::uint32_t c : casters.by_key()) {
            if (light.layers[c] == 0) continue;
            append_footprints(bounds_of(casters[c]), position, light.layers[c], footprints);
        }
        light.grid =
            std::make_unique<internal::LayerGrid>(position, footprints, options.max_layers);
    }
    if (light.grid->within_limit()) return false;
    light.grid = nullptr;  // bounds proper are to come, and other layers with them
    return true;
}

// What the pair was last brought up to date for.
PairWork ShadowSystem::State::work_for(const LightState& light, std::uint32_t caster) const {
    PairWork item{.caster = caster};
    if (!light.pairs[caster].is(PairFlag::FiniteFar)) return item;
    item.reach = fill_terms().reach(internal::ShadowHull(bounds_of(casters[caster]), light.light));
    item.far_vertices = item.reach.clamped ? FarVertices::OnPlane : FarVertices::Finite;
    return item;
}

// What the GPU finds has a coarse bound only. Where that piles up to more than can be counted, the
// CPU finds it after all: so a light that is split has no quads. True where draws go.
bool ShadowSystem::State::take_back_quads(LightState& light) {
    Borrowed scratch(scratch_mutex, scratches);
    const internal::NearClip clip(light.light.position_world, *view);
    internal::FrameTerms its_terms = terms();
    its_terms.clip = &clip;
    bool rearranged = false;
    for (const std::uint32_t c : casters.by_key()) {
        if (quads_of(light, c) == nullptr) continue;
        PairState& pair = light.pairs[c];
        PairWork item = work_for(light, c);
        internal::take_back_from_gpu(pair, casters[c], light, its_terms, *scratch, item,
                                     list.stats);
        light.layers[c] = item.layers;
        const bool was_drawn = pair.draw != internal::no_draw;
        place_volume(light, pair, item);
        if (pair.draw != internal::no_draw) {
            origins[light.first + pair.draw].fill = DrawOrigin::Fill::All;
        } else if (was_drawn) {
            rearranged = true;
        }
        pair.release_idle_extra();
    }
    return rearranged;
}

bool ShadowSystem::State::split_lights() {
    std::vector<LightState*> touched;
    for (const std::uint32_t l : lights.by_key()) {
        if (lights[l].touched || came_or_went) touched.push_back(&lights[l]);
    }
    std::vector<std::uint8_t> pile_up(touched.size());
    const auto ask = [&](std::size_t i) { pile_up[i] = piles_up(*touched[i]) ? 1 : 0; };
    if (casters.size() >= casters_of_task) {
        run(touched.size(), ask);
    } else {
        for (std::size_t i = 0; i < touched.size(); ++i) ask(i);
    }
    bool rearranged = false;
    for (std::size_t i = 0; i < touched.size(); ++i) {
        LightState& light = *touched[i];
        const bool was_split = !light.pieces.empty();
        if (pile_up[i] != 0) {
            gather_drawn(light);
            light.piled_up = true;
        }
        if (pile_up[i] != 0 && std::ranges::any_of(drawn, &internal::DrawnPair::quads)) {
            if (internal::fit_together(light, options.max_layers, drawn)) {
                pile_up[i] = 0;
            } else {
                rearranged = take_back_quads(light) || rearranged;
                pile_up[i] = piles_up(light) ? 1 : 0;
                if (pile_up[i] != 0) gather_drawn(light);
            }
        }
        if (pile_up[i] != 0) {
            internal::split_into_batches(light, options.max_layers, drawn);
        } else {
            light.pieces.clear();
            light.memory = {};
        }
        if (!was_split && light.pieces.empty()) continue;
        if (!was_split) lift_volumes(light);
        light.all_anew = true;
        rearranged = true;
    }
    return rearranged;
}

void ShadowSystem::State::tidy_up() {
    for (const std::uint32_t c : changed_casters) {
        CasterState& caster = casters[c];
        caster.changed = false;
        caster.moved = false;
        caster.mesh_before = caster.mesh->id();
    }
    changed_casters.clear();
    for (const std::uint32_t l : lights.by_key()) {
        LightState& light = lights[l];
        light.changed = light.moved = false;
        light.all_anew = light.gained = light.touched = light.worked_on = false;
    }
    lights_changed = false;
    receivers_changed = false;
    came_or_went = false;
    settled = false;
}

void ShadowSystem::State::let_detectors_rest() {
    std::erase_if(detectors, [&](const auto& place) {
        const auto [l, c] = place;
        if (c >= lights[l].pairs.size()) return true;
        PairState& pair = lights[l].pairs[c];
        if (pair.extra == nullptr || !pair.extra->watched) return true;
        if (frame - pair.extra->detected_frame < frames_to_rest) return false;
        pair.extra->detector = nullptr;
        pair.extra->watched = false;
        pair.release_idle_extra();
        return true;
    });
}

// Of what was not worked on, all is unchanged.
void ShadowSystem::State::count_pairs() {
    FrameStats& stats = list.stats;
    stats.silhouette = strategy != nullptr ? strategy->name : automatic_strategy().name;
    stats.casters = casters.size();
    stats.lights = lights.size();
    stats.pairs = stats.casters * stats.lights;
    stats.pairs_culled = 0;
    stats.pairs_in_umbra = 0;
    for (const std::uint32_t l : lights.by_key()) stats.pairs_in_umbra += lights[l].umbras.count();
    auto& reasons = stats.reasons;
    auto& unchanged = reasons[place_of(Reason::Unchanged)];
    for (const Reason culled :
         {Reason::OutOfRange, Reason::OutOfView, Reason::ReachesNothing, Reason::InUmbra}) {
        auto& pairs = reasons[place_of(culled)];
        pairs = 0;
        for (const std::uint32_t l : lights.by_key()) pairs += lights[l].culled[place_of(culled)];
        stats.pairs_culled += pairs;
    }
    stats.pairs_reused = stats.pairs - stats.pairs_culled - stats.pairs_redetected;
    unchanged = 0;
    unchanged = stats.pairs - std::accumulate(reasons.begin(), reasons.end(), std::uint64_t{0});
}

}  // namespace gnomon::shadows
