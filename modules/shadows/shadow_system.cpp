// SPDX-License-Identifier: MIT
//
// Submission: what is told is compared with what is known, and what differs is written down for
// finish().
#include <gnomon/shadows/shadow_system.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "internal/system_state.hpp"

namespace gnomon::shadows {

using internal::CasterState;
using internal::LightState;
using internal::PairState;

namespace {

// Bit for bit: -0 and +0 differ, and so do two not-a-numbers; that costs a detection, never a wrong
// shadow.
template <class T>
bool same_bits(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

// The sphere that ranges are judged by.
void enclose(CasterState& caster) {
    const auto corners = corners_of(internal::bounds_of(caster));
    caster.center = glm::dvec3(0.0);
    for (const auto& corner : corners) caster.center += corner * 0.125;
    caster.radius = 0.0;
    for (const auto& corner : corners) {
        caster.radius = std::max(caster.radius, glm::length(corner - caster.center));
    }
}

}  // namespace

std::string_view to_string(Reason reason) {
    switch (reason) {
        case Reason::Unchanged: return "unchanged";
        case Reason::WithinMargin: return "within margin";
        case Reason::New: return "new";
        case Reason::LightMoved: return "light moved";
        case Reason::CasterMoved: return "caster moved";
        case Reason::BothMoved: return "both moved";
        case Reason::MeshChanged: return "mesh changed";
        case Reason::ProjectionChanged: return "projection changed";
        case Reason::NearCapsChanged: return "near caps changed";
        case Reason::OutOfRange: return "out of range";
        case Reason::OutOfView: return "out of view";
        case Reason::ReachesNothing: return "reaches nothing";
        case Reason::InUmbra: return "in an umbra";
        case Reason::LeftStale: return "left stale";
    }
    return "";
}

void ShadowSystem::State::submit(const Caster& caster) {
    GNOMON_EXPECTS(caster.mesh != nullptr);
    const std::uint32_t slot = casters.submit(caster.key);
    CasterState& known = casters[slot];
    const bool same_pose = same_bits(known.pose.world_from_local, caster.world_from_local);
    const bool same_mesh = known.mesh == caster.mesh;
    if (same_pose && same_mesh && known.in_depth_buffer == caster.in_depth_buffer &&
        known.near_caps == caster.near_caps) {
        return;
    }
    const bool is_new = known.mesh == nullptr;
    if (is_new) came_or_went = true;
    if (!known.changed) {
        changed_casters.push_back(slot);
        if (!is_new) bounds_before.emplace_back(slot, internal::bounds_of(known));
    }
    known.changed = true;
    known.in_depth_buffer = caster.in_depth_buffer;
    known.near_caps = caster.near_caps;
    if (!same_mesh) known.mesh = caster.mesh;
    if (is_new || !same_pose) {
        known.pose = internal::make_pose(caster.world_from_local);
        known.pose_revision = next_revision++;
        known.moved = true;
    }
    enclose(known);
    known.hides_m2 = internal::most_hiding_area(known);
}

void ShadowSystem::State::submit(const Light& light) {
    const std::uint32_t slot = lights.submit(light.key);
    LightState& known = lights[slot];
    const bool is_new = known.revision == 0;
    const bool moved = is_new || !same_bits(known.light.position_world, light.position_world);
    if (!moved && known.light.range_m == light.range_m) return;
    if (is_new) came_or_went = true;
    known.light = light;
    known.changed = true;
    lights_changed = true;
    if (moved) {
        known.moved = true;
        known.revision = next_revision++;
    }
}

void ShadowSystem::State::submit(const Receiver& receiver) {
    GNOMON_EXPECTS(options.receivers == Receivers::Submitted);
    const std::size_t before = receivers.size();
    ReceiverState& known = receivers[receivers.submit(receiver.key)];
    if (before == receivers.size() && same_bits(known.bounds, receiver.bounds)) return;
    known.bounds = receiver.bounds;
    known.box = internal::aabb_of(receiver.bounds);
    receivers_changed = true;
}

void ShadowSystem::State::drop_receiver(std::uint32_t slot) {
    receivers.remove(slot);
    receivers_changed = true;
}

void ShadowSystem::State::drop_caster(std::uint32_t slot) {
    // Where it was at the last finish().
    OrientedBounds bounds = internal::bounds_of(casters[slot]);
    if (casters[slot].changed) {
        const auto found = std::ranges::find(bounds_before, slot,
                                             &std::pair<std::uint32_t, OrientedBounds>::first);
        if (found != bounds_before.end()) {
            bounds = found->second;
            bounds_before.erase(found);
        }
    }
    take_from_grids(slot, bounds);
    for (std::uint32_t l = 0; l < lights.end(); ++l) {
        LightState& light = lights[l];
        if (slot >= light.pairs.size()) continue;
        PairState& pair = light.pairs[slot];
        if (internal::is_culled(pair.reason)) {
            --light.culled[static_cast<std::size_t>(pair.reason)];
        }
        pair = {};
        light.layers[slot] = 0;
        light.umbras.forget(slot);
    }
    casters.remove(slot);
    came_or_went = true;
}

void ShadowSystem::State::drop_light(std::uint32_t slot) {
    lights.remove(slot);
    came_or_went = true;
}

void ShadowSystem::State::drop_unsubmitted() {
    for (std::uint32_t l = 0; !lights.all_submitted() && l < lights.end(); ++l) {
        if (lights[l].alive && !lights.is_submitted(l)) drop_light(l);
    }
    for (std::uint32_t r = 0; !receivers.all_submitted() && r < receivers.end(); ++r) {
        if (receivers[r].alive && !receivers.is_submitted(r)) drop_receiver(r);
    }
    for (std::uint32_t c = 0; !casters.all_submitted() && c < casters.end(); ++c) {
        if (casters[c].alive && !casters.is_submitted(c)) drop_caster(c);
    }
}

Result<ShadowSystem> ShadowSystem::create(const SystemOptions& options) {
    const SilhouetteStrategy* strategy = find_strategy(options.silhouette);
    if (strategy == nullptr) {
        std::string names = "auto";
        for (const auto& s : silhouette_strategies()) names += ", " + std::string(s.name);
        return fail(ErrorCode::InvalidInput, "There is no silhouette strategy named \"" +
                                                 std::string(options.silhouette) +
                                                 "\"; there are " + names + ".");
    }
    if (options.max_layers < 1 || options.max_layers > 255) {
        return fail(ErrorCode::InvalidInput,
                    "SystemOptions::max_layers is " + std::to_string(options.max_layers) +
                        "; it must lie within 1 and 255, what a stencil of eight bits counts.");
    }
    const StaleOptions& stale = options.stale;
    if (!(stale.pose_tolerance_rad >= 0.0 && stale.pose_tolerance_rad <= std::numbers::pi)) {
        return fail(ErrorCode::InvalidInput, "StaleOptions::pose_tolerance_rad is " +
                                                 std::to_string(stale.pose_tolerance_rad) +
                                                 "; it must lie within 0, which is exact, and pi.");
    }
    if (stale.detect_every < 1 || stale.detect_every > 1024) {
        return fail(ErrorCode::InvalidInput,
                    "StaleOptions::detect_every is " + std::to_string(stale.detect_every) +
                        "; it must lie within 1, which is exact, and 1024.");
    }
    auto state = std::make_unique<State>();
    state->options = options;
    state->strategy = strategy == &automatic_strategy() ? nullptr : strategy;
    return ShadowSystem(std::move(state));
}

ShadowSystem::ShadowSystem(std::unique_ptr<State> state) : state_(std::move(state)) {}
ShadowSystem::ShadowSystem(ShadowSystem&&) noexcept = default;
ShadowSystem& ShadowSystem::operator=(ShadowSystem&&) noexcept = default;
ShadowSystem::~ShadowSystem() = default;

ShadowSystem::Frame ShadowSystem::begin_frame(Submission submission) {
    state_->submission = submission;
    state_->casters.begin_frame();
    state_->lights.begin_frame();
    state_->receivers.begin_frame();
    return Frame(*this);
}

void ShadowSystem::Frame::caster(const Caster& caster) { system_->state_->submit(caster); }
void ShadowSystem::Frame::light(const Light& light) { system_->state_->submit(light); }
void ShadowSystem::Frame::receiver(const Receiver& receiver) { system_->state_->submit(receiver); }

void ShadowSystem::Frame::remove_caster(std::uint64_t key) {
    State& state = *system_->state_;
    const std::uint32_t slot = state.casters.find(key);
    if (slot != internal::no_slot) state.drop_caster(slot);
}

void ShadowSystem::Frame::remove_light(std::uint64_t key) {
    State& state = *system_->state_;
    const std::uint32_t slot = state.lights.find(key);
    if (slot != internal::no_slot) state.drop_light(slot);
}

bool ShadowSystem::Frame::takes_receivers() const {
    return system_->state_->options.receivers == Receivers::Submitted;
}

void ShadowSystem::Frame::remove_receiver(std::uint64_t key) {
    State& state = *system_->state_;
    const std::uint32_t slot = state.receivers.find(key);
    if (slot != internal::no_slot) state.drop_receiver(slot);
}

const DrawList& ShadowSystem::Frame::finish(const View& view) && {
    system_->state_->finish(view);
    return system_->state_->list;
}

SystemMemory ShadowSystem::memory() const {
    const State& s = *state_;
    SystemMemory memory;
    memory.casters = s.casters.memory_bytes() +
                     s.changed_casters.capacity() * sizeof(std::uint32_t) +
                     s.bounds_before.capacity() * sizeof(s.bounds_before[0]);
    memory.lights = s.lights.memory_bytes() + s.listed.capacity() * 4;
    memory.receivers = s.receivers.memory_bytes() + s.receiver_tree.memory_bytes();
    const auto size_of_quads = [](const QuadCasting& quads) -> std::size_t {
        if (quads.bits == nullptr) return 0;
        return sizeof(FaceBits) + quads.bits->capacity() * sizeof(std::uint32_t);
    };
    for (std::uint32_t l = 0; l < s.lights.end(); ++l) {
        const LightState& light = s.lights[l];
        memory.lights += light.memory.revisions.capacity() * sizeof(std::uint64_t) +
                         light.pieces.capacity() * sizeof(internal::Piece) +
                         (light.grid != nullptr ? light.grid->memory_bytes() : 0);
        memory.pairs += light.pairs.capacity() * sizeof(PairState) +
                        light.layers.capacity() * sizeof(std::uint32_t) +
                        light.umbras.memory_bytes();
        for (const PairState& pair : light.pairs) {
            if (pair.extra == nullptr) continue;
            const internal::PairExtra& extra = *pair.extra;
            memory.extras += sizeof extra + extra.parts.capacity() * sizeof(internal::VolumePart);
            if (extra.detector != nullptr) memory.extras += extra.detector->memory_bytes();
            if (extra.whole != nullptr) memory.extras += internal::bytes_of(*extra.whole);
            if (extra.whole_quads != nullptr) {
                memory.extras += sizeof(QuadCasting) + size_of_quads(*extra.whole_quads);
            }
        }
    }
    memory.draws = s.list.draws.capacity() * sizeof(VolumeDraw) +
                   s.list.lights.capacity() * sizeof(LightDraws) +
                   s.origins.capacity() * sizeof(DrawOrigin);
    for (const VolumeDraw& draw : s.list.draws) {
        memory.volumes +=
            draw.quads ? size_of_quads(*draw.quads) : internal::bytes_of(*draw.volume);
    }
    memory.scratch = s.pool.memory_bytes() + s.clips.capacity() * sizeof(internal::NearClip) +
                     s.work.capacity() * sizeof(internal::PairWork) +
                     s.drawn.capacity() * sizeof(internal::DrawnPair) +
                     s.fills.capacity() * sizeof(State::DrawToFill) +
                     s.chunks.capacity() * sizeof(std::size_t) +
                     (s.detectors.capacity() + s.deferred.capacity()) * sizeof(s.detectors[0]);
    for (const auto& scratch : s.scratches) {
        memory.scratch += sizeof *scratch + scratch->facing.weights.capacity() +
                          scratch->runs.capacity() * sizeof(FaceRun);
        for (const auto& [strategy, detector] : scratch->detectors) {
            memory.scratch += detector->memory_bytes();
        }
    }
    return memory;
}

}  // namespace gnomon::shadows
