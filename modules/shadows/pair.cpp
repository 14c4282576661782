// SPDX-License-Identifier: MIT
#include "internal/pair.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>

namespace gnomon::shadows::internal {

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double, std::milli>(to - from).count();
}

// How far the light went, in the measure of Facing::margin: metres for a point, on the unit sphere
// for a direction.
double displacement(const LightLocal& from, const LightLocal& to) {
    const glm::dvec3 a(from.position);
    const glm::dvec3 b(to.position);
    if (!from.is_directional()) return glm::length(b - a);
    const double length_a = glm::length(a);
    const double length_b = glm::length(b);
    if (!(length_a > 0.0) || !(length_b > 0.0)) return std::numeric_limits<double>::infinity();
    return glm::length(b / length_b - a / length_a) + 4.0 * std::numeric_limits<double>::epsilon();
}

Reason what_moved(const PairState& pair, const CasterState& caster, const LightState& light) {
    const bool caster_moved = pair.pose_revision != caster.pose_revision;
    const bool light_moved = pair.light_revision != light.revision;
    if (caster_moved && light_moved) return Reason::BothMoved;
    return light_moved ? Reason::LightMoved : Reason::CasterMoved;
}

// A pose without an inverse: decided where it leads to, relative to its own origin.
const Detection& detect_flattened(const CasterState& caster, const LightState& light,
                                  Scratch& scratch) {
    const ShadowMesh& mesh = *caster.caster.mesh;
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

SilhouetteDetector& detector_of(PairState& pair, const SilhouetteStrategy& strategy,
                                Scratch& scratch) {
    auto& detector = strategy.keeps_state ? pair.detector : scratch.detector;
    if (detector == nullptr) detector = strategy.create();
    return *detector;
}

void detect(PairState& pair, const CasterState& caster, const LightState& light,
            FarVertices far_vertices, const SilhouetteStrategy& strategy, Scratch& scratch,
            FrameStats& stats) {
    const ShadowMesh& mesh = *caster.caster.mesh;
    const auto start = Clock::now();
    const Detection& found = caster.pose.singular
                                 ? detect_flattened(caster, light, scratch)
                                 : detector_of(pair, strategy, scratch)
                                       .detect(mesh, pair.current, caster.caster.near_caps);
    const auto detected = Clock::now();

    auto volume = std::make_shared<Volume>();
    scratch.weights.resize(mesh.faces().size());
    runs_of(found.casting, scratch.runs);
    weights_of(scratch.runs, scratch.weights);
    build_volume(mesh, scratch.weights, found.silhouette, light.light.position_world.w == 0.0,
                 far_vertices, *volume, found.solid_averted);
    pair.mesh = caster.caster.mesh;
    pair.volume = std::move(volume);
    pair.volume_revision = next_volume_revision();
    pair.far_vertices = far_vertices;
    pair.near_caps = caster.caster.near_caps;
    pair.flattened = caster.pose.singular;
    pair.detected = pair.current;
    pair.margin = found.margin;
    pair.nearest_face = -1.0;

    stats.detect_ms += milliseconds(start, detected);
    stats.build_ms += milliseconds(detected, Clock::now());
    stats.detection.faces_tested += found.stats.faces_tested;
    stats.detection.edges_tested += found.stats.edges_tested;
    stats.detection.double_tests += found.stats.double_tests;
    stats.detection.exact_tests += found.stats.exact_tests;
    stats.detection.bytes_touched += found.stats.bytes_touched;
    ++stats.pairs_redetected;
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

}  // namespace

std::uint64_t next_volume_revision() {
    static std::atomic<std::uint64_t> next{1};
    return next.fetch_add(1);
}

Reason update_pair(PairState& pair, const CasterState& caster, const LightState& light,
                   FarVertices far_vertices, const SilhouetteStrategy& strategy, Scratch& scratch,
                   FrameStats& stats) {
    const bool is_new = pair.volume == nullptr;
    const bool same_poses =
        pair.pose_revision == caster.pose_revision && pair.light_revision == light.revision;
    Reason reason = Reason::Unchanged;
    bool light_is_new = is_new;

    if (!is_new && (pair.mesh != caster.caster.mesh)) {
        reason = Reason::MeshChanged;
    } else if (!is_new && pair.far_vertices != far_vertices) {
        reason = Reason::ProjectionChanged;
    } else if (!is_new && pair.near_caps != caster.caster.near_caps) {
        reason = Reason::NearCapsChanged;
    }
    const bool asked_anew = reason != Reason::Unchanged;

    if (!same_poses || is_new) {
        if (caster.pose.singular) {
            pair.current_exact = light.light.position_world;
            pair.current.position = glm::vec4(light.light.position_world);
            if (reason == Reason::Unchanged) reason = what_moved(pair, caster, light);
            light_is_new = true;
        } else {
            const LocalLight local = local_light(caster.pose, light.light.position_world);
            const bool comparable =
                !is_new && !pair.flattened && pair.current_exact.w == local.position.w;
            // Indistinguishable from where it was: the difference is what composing the poses
            // rounds. The reference stays, so that nothing can drift.
            const bool unmoved =
                comparable && indistinguishable(caster.pose, local, pair.current_exact);
            if (!unmoved) {
                pair.current_exact = local.position;
                pair.current.position = glm::vec4(local.position);
                const bool certified =
                    comparable && displacement(pair.detected, pair.current) <= pair.margin;
                if (!certified) light_is_new = true;
                if (reason == Reason::Unchanged) {
                    reason = certified ? Reason::WithinMargin : what_moved(pair, caster, light);
                }
            }
        }
        pair.nearest_face = -1.0;  // in metres: a caster scaled about the light changes it as well
    }
    if (is_new) reason = Reason::New;
    if (light_is_new || asked_anew) {
        detect(pair, caster, light, far_vertices, strategy, scratch, stats);
    } else {
        ++stats.pairs_reused;
    }
    if (reason != Reason::Unchanged) pair.layers = {};
    pair.pose_revision = caster.pose_revision;
    pair.light_revision = light.revision;
    return reason;
}

double nearest_face(const Volume& volume, const ShadowMesh& mesh,
                    const glm::dmat4& world_from_local, const glm::dvec3& point_world) {
    double best = std::numeric_limits<double>::infinity();
    const auto place = [&](std::uint32_t index) {
        return glm::dvec3(world_from_local *
                          glm::dvec4(glm::dvec3(mesh.positions()[index / 2]), 1.0));
    };
    for (const IndexRange& range : {volume.near_cap, volume.near_cap_flipped}) {
        for (std::uint32_t i = range.first; i < range.first + range.count; i += 3) {
            best = std::min(
                best, squared_distance(point_world, place(volume.indices[i]),
                                       place(volume.indices[i + 1]), place(volume.indices[i + 2])));
        }
    }
    return std::sqrt(best);
}

}  // namespace gnomon::shadows::internal
