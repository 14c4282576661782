// SPDX-License-Identifier: MIT
#include "internal/pair.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "internal/displacement.hpp"
#include "internal/quad_pair.hpp"
#include "internal/strategies.hpp"

namespace gnomon::shadows::internal {

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double, std::milli>(to - from).count();
}

Reason what_moved(const CasterState& caster, const LightState& light) {
    if (caster.moved && light.moved) return Reason::BothMoved;
    return light.moved ? Reason::LightMoved : Reason::CasterMoved;
}

float not_above(double x) {
    const auto rounded = static_cast<float>(x);
    return static_cast<double>(rounded) > x ? std::nextafter(rounded, 0.0F) : rounded;
}

// A pose without an inverse: decided where it leads to, relative to its own origin.
const Detection& detect_flattened(const CasterState& caster, const LightState& light,
                                  Scratch& scratch) {
    const ShadowMesh& mesh = *caster.mesh;
    glm::dmat4 parent_from_local = caster.pose.world_from_local;
    const glm::dvec3 origin(parent_from_local[3]);
    parent_from_local[3] = glm::dvec4(0.0, 0.0, 0.0, 1.0);
    const glm::dvec4 world = light.light.position_world;
    Facing& facing = scratch.facing;
    classify_faces_flattened(mesh, parent_from_local, world - glm::dvec4(world.w * origin, 0.0),
                             facing);
    Detection& found = scratch.flattened;
    pack_weights(facing.weights, found.casting);
    find_silhouette(mesh, facing.weights, found.silhouette);
    found.solid_averted = facing.solid_averted;
    found.margin = facing.margin;
    found.stats = {.faces_tested = facing.stats.faces,
                   .edges_tested = mesh.edges().size(),
                   .double_tests = facing.stats.double_tests,
                   .exact_tests = facing.stats.exact_tests};
    return found;
}

// How far a point light outside of the mesh's bounds may go for certain without entering them.
double distance_to_bounds(const ShadowMesh& mesh, LightLocal light) {
    const glm::dvec3 l(light.position);
    const glm::dvec3 within =
        glm::clamp(l, glm::dvec3(mesh.bounds_min()), glm::dvec3(mesh.bounds_max()));
    return glm::length(l - within) * (1.0 - 1e-9);
}

// What the pair's volume was decided for.
void remember(PairState& pair, const CasterState& caster, LightLocal light, FarVertices far,
              double margin) {
    pair.set(PairFlag::Known, true);
    pair.set(PairFlag::FiniteFar, far != FarVertices::AtInfinity);
    pair.set(PairFlag::AvertedCaps, caster.near_caps == NearCaps::Averted);
    pair.set(PairFlag::Flattened, caster.pose.singular);
    pair.detected = glm::vec3(light.position);
    pair.margin = not_above(margin);
    if (pair.extra != nullptr) pair.extra->nearest_face = -1.0;
}

SilhouetteDetector& detector_of(PairState& pair, const SilhouetteStrategy& strategy,
                                std::uint64_t frame, Scratch& scratch) {
    if (strategy.keeps_state) {
        PairExtra& extra = pair.more();
        if (extra.detector == nullptr || extra.strategy != &strategy) {
            extra.detector = strategy.create();
            extra.strategy = &strategy;
        }
        extra.detected_frame = frame;
        return *extra.detector;
    }
    for (auto& [of, detector] : scratch.detectors) {
        if (of == &strategy) return *detector;
    }
    return *scratch.detectors.emplace_back(&strategy, strategy.create()).second;
}

// `same_kind`: the volume that the pair has was made on the same terms, for another light. `volume`
// is null where that is empty.
void detect(PairState& pair, const CasterState& caster, const LightState& light,
            const FrameTerms& terms, const CapOptions& caps, const ChosenStrategy& chosen,
            bool same_kind, const Volume* volume, Scratch& scratch, PairWork& work,
            FrameStats& stats) {
    const ShadowMesh& mesh = *caster.mesh;
    const LightLocal current = current_light(pair, light);
    const auto start = Clock::now();
    SilhouetteDetector* detector =
        caster.pose.singular ? nullptr : &detector_of(pair, *chosen.strategy, terms.frame, scratch);
    const Detection& found = detector == nullptr
                                 ? detect_flattened(caster, light, scratch)
                                 : detector->detect(mesh, current, caster.near_caps);
    const auto detected = Clock::now();

    // A detector of the pair's own, which found what it had found for the volume that there is.
    const bool by_its_own = detector != nullptr && chosen.strategy->keeps_state;
    VolumeOptions options{light.light.position_world.w == 0.0, work.far_vertices, caps};
    double margin = found.margin;
    const bool on_plane = work.far_vertices == FarVertices::OnPlane;
    if (!on_plane && options.caps.far_cap == FarCap::Fan) {
        if (detector == nullptr || !fan_is_exact(mesh, current, work.far_vertices)) {
            options.caps.far_cap = FarCap::Faces;
        } else {
            margin = std::min(margin, distance_to_bounds(mesh, current));
        }
    }
    const bool same = same_kind && by_its_own && pair.extra->detector_is_current &&
                      !found.changed && volume != nullptr &&
                      volume->made_with.caps.far_cap == options.caps.far_cap;
    if (pair.extra != nullptr) pair.extra->detector_is_current = by_its_own;
    if (!same) {
        auto made = terms.pool != nullptr ? terms.pool->take() : std::make_shared<Volume>();
        runs_of(found.casting, scratch.runs);
        build_volume(mesh, scratch.runs, found.silhouette, options, *made, found.solid_averted);
        work.made = std::move(made);
        work.quads = nullptr;
    }
    remember(pair, caster, current, work.far_vertices, margin);

    stats.detect_ms += milliseconds(start, detected);
    stats.build_ms += milliseconds(detected, Clock::now());
    stats.detection.faces_tested += found.stats.faces_tested;
    stats.detection.edges_tested += found.stats.edges_tested;
    stats.detection.double_tests += found.stats.double_tests;
    stats.detection.exact_tests += found.stats.exact_tests;
    stats.detection.bytes_touched += found.stats.bytes_touched;
    const Choice by_detector = detector == nullptr ? Choice::ByName : detector->choice();
    ++stats.choices[static_cast<std::size_t>(by_detector == Choice::ByName ? chosen.choice
                                                                           : by_detector)];
    ++stats.pairs_redetected;
}

// False: the pair is not one of those that edge quads can draw; nothing happened.
bool leave_to_gpu(PairState& pair, const CasterState& caster, const LightState& light,
                  QuadFacing facing, Scratch& scratch, PairWork& work, FrameStats& stats) {
    if (caster.pose.singular) return false;
    const LightLocal current = current_light(pair, light);
    const auto start = Clock::now();
    std::optional<QuadMargin> found =
        cast_by_quads(*caster.mesh, current, caster.near_caps, facing, scratch.facing);
    if (!found) return false;
    if (facing == QuadFacing::Uploaded) {
        const FacingStats& looked_at = scratch.facing.stats;
        stats.detect_ms += milliseconds(start, Clock::now());
        stats.detection.faces_tested += looked_at.faces;
        stats.detection.double_tests += looked_at.double_tests;
        stats.detection.exact_tests += looked_at.exact_tests;
        stats.detection.bytes_touched += looked_at.faces * (5 * sizeof(float) + 2);
        ++stats.choices[static_cast<std::size_t>(Choice::ByName)];
        ++stats.pairs_redetected;
    }
    if (pair.extra != nullptr) pair.extra->detector_is_current = false;
    work.made = volume_of_quads();
    work.quads = std::make_unique<QuadCasting>(std::move(found->casting));
    remember(pair, caster, current, work.far_vertices, found->margin);
    return true;
}

// Squared distance to a triangle. After C. Ericson, "Real-Time Collision Detection" (2005),
// section 5.1.5.
double squared_distance(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b,
                        const glm::dvec3& c) {
    const auto to_segment = [&](const glm::dvec3& s, const glm::dvec3& e) {
        const glm::dvec3 d = e - s;
        const double length2 = glm::dot(d, d);
        const double t = length2 > 0.0 ? std::clamp(glm::dot(p - s, d) / length2, 0.0, 1.0) : 0.0;
        const glm::dvec3 q = s + t * d - p;
        return glm::dot(q, q);
    };
    double best = std::min({to_segment(a, b), to_segment(b, c), to_segment(c, a)});
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double area2 = glm::dot(n, n);
    if (area2 > 0.0) {
        const glm::dvec3 q = p - n * (glm::dot(p - a, n) / area2);
        const bool inside = glm::dot(glm::cross(b - a, q - a), n) >= 0.0 &&
                            glm::dot(glm::cross(c - b, q - b), n) >= 0.0 &&
                            glm::dot(glm::cross(a - c, q - c), n) >= 0.0;
        if (inside) best = std::min(best, glm::dot(p - q, p - q));
    }
    return best;
}

void bound_quickly(PairState& pair, const CasterState& caster, const LightState& light,
                   const Volume& volume, const QuadCasting* quads, PairWork& work) {
    const bool outside = seen_from_outside(*caster.mesh, space_of(pair, caster, light));
    pair.set(PairFlag::FromOutside, outside);
    work.layers = quads != nullptr ? quad_layer_bound(*caster.mesh, *quads)
                                   : quick_layer_bound(volume, outside);
    if (quads == nullptr && light.piled_up && work.layers > 1) {
        work.layers = coarse_layer_bound(*caster.mesh, volume, space_of(pair, caster, light));
    }
}

Reason reason_of(Hidden hidden) {
    switch (hidden) {
        case Hidden::No: return Reason::Unchanged;
        case Hidden::OutOfView: return Reason::OutOfView;
        case Hidden::ReachesNothing: return Reason::ReachesNothing;
        case Hidden::InUmbra: return Reason::InUmbra;
    }
    return Reason::Unchanged;
}

// Whether a cap of the pair's volume may be drawn in this frame; the technique, where that says so.
bool may_draw_caps(const CasterState& caster, const FrameTerms& terms, PairWork& work) {
    if (!terms.caps.when_drawn || terms.clip == nullptr || !caster.in_depth_buffer ||
        caster.near_caps == NearCaps::Averted || caster.pose.singular ||
        work.far_vertices == FarVertices::Finite) {
        return true;
    }
    if (depth_pass_has_far_caps(work.far_vertices == FarVertices::AtInfinity, work.reach,
                                *terms.fill.screen)) {
        return true;
    }
    work.technique =
        terms.force_technique ? *terms.force_technique : choose_technique(caster, *terms.clip);
    return *work.technique == Technique::DepthFail;
}

CapOptions caps_for(const CasterState& caster, const FrameTerms& terms, PairWork& work) {
    return may_draw_caps(caster, terms, work) ? terms.caps
                                              : CapOptions::ranges_alone(terms.caps.far_cap);
}

// Whether the silhouette that was found for `detected` will do for `current` (StaleOptions).
bool may_stay_stale(const StaleOptions& stale, const ShadowMesh& mesh, LightLocal detected,
                    LightLocal current, std::uint64_t turn) {
    if (stale.none()) return false;
    const glm::dvec3 low(mesh.bounds_min());
    const glm::dvec3 high(mesh.bounds_max());
    const double w = current.is_directional() ? 0.0 : 1.0;
    // From within, other faces cast and other caps close a volume.
    for (const LightLocal& light : {detected, current}) {
        const glm::dvec3 p(light.position);
        const bool inside =
            glm::all(glm::greaterThanEqual(p, low)) && glm::all(glm::lessThanEqual(p, high));
        if (w != 0.0 && inside) return false;
    }
    if (stale.detect_every > 1 && turn % stale.detect_every != 0) return true;
    const glm::dvec3 middle = w * 0.5 * (low + high);
    const glm::dvec3 before = glm::dvec3(detected.position) - middle;
    const glm::dvec3 now = glm::dvec3(current.position) - middle;
    const double angle_rad =
        std::atan2(glm::length(glm::cross(before, now)), glm::dot(before, now));
    return angle_rad <= stale.pose_tolerance_rad;
}

}  // namespace

std::uint64_t next_volume_revision() {
    static std::atomic<std::uint64_t> next{1};
    return next.fetch_add(1);
}

OrientedBounds bounds_of(const CasterState& caster) {
    return {caster.pose.world_from_local, glm::dvec3(caster.mesh->bounds_min()),
            glm::dvec3(caster.mesh->bounds_max())};
}

bool is_out_of_range(const CasterState& caster, const Light& light) {
    if (!light.range_m || light.position_world.w == 0.0) return false;
    const double distance = glm::length(glm::dvec3(light.position_world) - caster.center);
    return distance - caster.radius * (1.0 + 1e-9) > *light.range_m;
}

LightLocal current_light(const PairState& pair, const LightState& light) {
    return {
        glm::vec4(glm::vec3(pair.light_exact), static_cast<float>(light.light.position_world.w))};
}

Technique choose_technique(const CasterState& caster, const NearClip& clip) {
    // More faces would cost more to look at than depth-fail costs to draw.
    constexpr std::size_t most_faces = 512;
    const bool valid = clip.is_clear_of_sphere(caster.center, caster.radius) ||
                       clip.is_clear_of(bounds_of(caster)) ||
                       (caster.mesh->faces().size() <= most_faces &&
                        clip.is_clear_of(*caster.mesh, caster.pose.world_from_local));
    return valid ? Technique::DepthPass : Technique::DepthFail;
}

bool depth_pass_has_far_caps(bool far_at_infinity, const Reach& reach, const Screen& screen) {
    return !far_at_infinity &&
           !(reach.plane_is_last &&
             screen.begins_below(reach.normal, plane_distance(reach, screen.eye())));
}

ChosenStrategy choose_strategy(const SilhouetteStrategy* wanted, const ShadowMesh& mesh,
                               const PairHistory& history) {
    if (wanted != nullptr) return {wanted, Choice::ByName};
    // So few that remembering anything of them costs more than looking at them.
    constexpr std::size_t a_handful = 512;
    const bool moves_on = !history.is_new && history.frames_at_rest == 0;
    if (moves_on && !mesh.is_deformed() && mesh.faces().size() >= a_handful) {
        return {&automatic_strategy(), Choice::ByName};
    }
    static const SilhouetteStrategy* const all = find_strategy("simd");
    static const SilhouetteStrategy* const search = find_strategy("dual_bvh");
    const Choice choice = choose_for_jump(mesh);
    return {choice == Choice::Jump ? search : all, choice};
}

void update_pair(PairState& pair, const CasterState& caster, const LightState& light,
                 const FrameTerms& terms, const Volume* volume, const QuadCasting* quads,
                 Scratch& scratch, PairWork& work, FrameStats& stats) {
    if (work.in_umbra && !pair.is(PairFlag::Known)) {
        pair = {};
        pair.reason = Reason::InUmbra;
        return;
    }
    std::optional<ShadowHull> hull;
    work.far_vertices = terms.far_vertices;
    if (!caster.pose.singular) {
        hull.emplace(bounds_of(caster), light.light);
        work.reach = terms.fill.reach(*hull);
        if (work.reach.clamped) work.far_vertices = FarVertices::OnPlane;
    }
    const bool is_new = !pair.is(PairFlag::Known);
    const glm::dvec4& light_world = light.light.position_world;
    const bool directional = light_world.w == 0.0;
    const bool finite_far = work.far_vertices != FarVertices::AtInfinity;
    const bool other_far_vertices = pair.is(PairFlag::FiniteFar) != finite_far ||
                                    (finite_far && volume != nullptr && quads == nullptr &&
                                     volume->made_with.far_vertices != work.far_vertices);
    const bool averted = caster.near_caps == NearCaps::Averted;
    const bool comparable = !is_new && !caster.pose.singular && !pair.is(PairFlag::Flattened) &&
                            pair.is(PairFlag::Directional) == directional;
    Reason reason = Reason::Unchanged;
    bool light_is_new = is_new;

    if (!is_new && caster.mesh_before != caster.mesh->id()) {
        reason = Reason::MeshChanged;
    } else if (!is_new && other_far_vertices) {
        reason = Reason::ProjectionChanged;
    } else if (!is_new && pair.is(PairFlag::AvertedCaps) != averted) {
        reason = Reason::NearCapsChanged;
    }
    const bool asked_anew = reason != Reason::Unchanged;

    if (caster.moved || light.moved || is_new) {
        if (caster.pose.singular) {
            pair.light_exact = glm::dvec3(light_world);
            if (reason == Reason::Unchanged) reason = what_moved(caster, light);
            light_is_new = true;
        } else {
            const LocalLight local = local_light(caster.pose, light_world);
            // Indistinguishable from where it was: the difference is what composing the poses
            // rounds. The reference stays, so that nothing can drift.
            const bool unmoved =
                comparable &&
                indistinguishable(caster.pose, local, glm::dvec4(pair.light_exact, light_world.w));
            if (!unmoved) {
                pair.light_exact = glm::dvec3(local.position);
                const LightLocal detected{
                    glm::vec4(pair.detected, static_cast<float>(light_world.w))};
                const bool certified =
                    comparable && displacement(detected, current_light(pair, light)) <=
                                      static_cast<double>(pair.margin);
                const bool stale =
                    comparable && !certified &&
                    may_stay_stale(terms.stale, *caster.mesh, detected, current_light(pair, light),
                                   terms.frame + work.caster);
                if (!certified && !stale) light_is_new = true;
                if (reason == Reason::Unchanged) {
                    reason = certified ? Reason::WithinMargin
                             : stale   ? Reason::LeftStale
                                       : what_moved(caster, light);
                }
            }
        }
        pair.set(PairFlag::Directional, directional);
        // In metres: a caster scaled about the light changes it as well.
        if (pair.extra != nullptr) pair.extra->nearest_face = -1.0;
    }
    if (is_new) reason = Reason::New;
    if (light_is_new || asked_anew) {
        if (work.in_umbra) {
            work.shown = Shown{Hidden::InUmbra, ScreenBounds::nothing()};
        } else if (hull) {
            work.shown = shown_of(terms.fill, *hull, work.reach);
        }
        if (work.shown && work.shown->hidden != Hidden::No) {
            pair = {};
            pair.reason = reason_of(work.shown->hidden);
            return;
        }
        const PairHistory history{
            .is_new = is_new,
            .frames_at_rest = static_cast<std::uint16_t>(terms.frame - pair.changed - 1)};
        const ChosenStrategy chosen = choose_strategy(terms.strategy, *caster.mesh, history);
        const QuadFacing facing = chosen.strategy->quads;
        if (facing == QuadFacing::None ||
            !leave_to_gpu(pair, caster, light, facing, scratch, work, stats)) {
            detect(pair, caster, light, terms, caps_for(caster, terms, work), chosen,
                   comparable && !asked_anew, volume, scratch, work, stats);
        }
    } else {
        ++stats.pairs_reused;
    }
    pair.reason = reason;
    ++stats.reasons[static_cast<std::size_t>(reason)];
    if (reason == Reason::Unchanged) return;

    pair.changed = static_cast<std::uint16_t>(terms.frame);
    pair.set_bounded(Bounded::Quickly);
    const Volume* now = work.made != nullptr ? work.made.get() : volume;
    if (now == nullptr) return;
    if (work.made != nullptr) quads = work.quads.get();
    bound_quickly(pair, caster, light, *now, quads, work);
}

void take_back_from_gpu(PairState& pair, const CasterState& caster, const LightState& light,
                        const FrameTerms& terms, Scratch& scratch, PairWork& work,
                        FrameStats& stats) {
    FrameStats own;
    detect(pair, caster, light, terms, caps_for(caster, terms, work),
           {terms.strategy, Choice::ByName}, false, nullptr, scratch, work, own);
    bound_quickly(pair, caster, light, *work.made, nullptr, work);
    pair.set_bounded(Bounded::Quickly);
    stats.detection.faces_tested += own.detection.faces_tested;
    stats.detection.edges_tested += own.detection.edges_tested;
    stats.detection.double_tests += own.detection.double_tests;
    stats.detection.exact_tests += own.detection.exact_tests;
    stats.detection.bytes_touched += own.detection.bytes_touched;
    stats.detect_ms += own.detect_ms;
    stats.build_ms += own.build_ms;
    // Where faces were looked at for the GPU, the pair has been counted.
    if (terms.strategy->quads != QuadFacing::InShader) return;
    for (std::size_t i = 0; i < choice_count; ++i) stats.choices[i] += own.choices[i];
    stats.pairs_redetected += own.pairs_redetected;
}

LayerSpace space_of(const PairState& pair, const CasterState& caster, const LightState& light) {
    if (pair.is(PairFlag::Flattened)) {
        return {caster.pose.world_from_local, light.light.position_world};
    }
    return {glm::dmat4(1.0), glm::dvec4(current_light(pair, light).position)};
}

double nearest_face(const Volume& volume, const ShadowMesh& mesh,
                    const glm::dmat4& world_from_local, const glm::dvec3& point_world) {
    double best = std::numeric_limits<double>::infinity();
    const auto place = [&](std::uint32_t vertex) {
        return glm::dvec3(world_from_local * glm::dvec4(glm::dvec3(mesh.positions()[vertex]), 1.0));
    };
    for (const CapList& list : volume.near_caps()) {
        for_each_cap_face(mesh, volume, list, [&](const std::array<std::uint32_t, 3>& face) {
            best = std::min(best, squared_distance(point_world, place(face[0]), place(face[1]),
                                                   place(face[2])));
        });
    }
    return std::sqrt(best);
}

}  // namespace gnomon::shadows::internal
