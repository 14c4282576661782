// SPDX-License-Identifier: MIT
//
// Keeps the system's draw list in step with its pairs. Draws stay where they are, or move, with
// their volumes; only those of pairs that changed are written.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "internal/quad_pair.hpp"
#include "internal/slabs.hpp"
#include "internal/system_state.hpp"

namespace gnomon::shadows {

using internal::CasterState;
using internal::LightState;
using internal::NearClip;
using internal::no_draw;
using internal::PairState;
using internal::Piece;

namespace {

using Corners = std::array<glm::dvec3, 8>;

// The corners of what the view sees; its near and far rectangle.
Corners seen_by(const View& view) {
    Corners seen;
    const auto near = near_corners(view);
    const auto far = far_corners(view);
    std::copy(near.begin(), near.end(), seen.begin());
    std::copy(far.begin(), far.end(), seen.begin() + 4);
    return seen;
}

// How far far vertices must go so that the far cap lies beyond everything the view can see: a
// factor for a point light (the cap is the caster scaled about the light), metres per length of the
// direction for a directional one.
double finite_reach(PairState& pair, const CasterState& caster, const Light& light,
                    const Volume& volume, const QuadCasting* quads, const Corners& seen) {
    const glm::dvec3 l(light.position_world);
    if (light.position_world.w == 0.0) {
        const double length = glm::length(l);
        const glm::dvec3 travel = -l / length;
        double last_seen = -std::numeric_limits<double>::infinity();
        double first_cast = std::numeric_limits<double>::infinity();
        for (const auto& p : seen) last_seen = std::max(last_seen, glm::dot(p, travel));
        for (const auto& p : corners_of(bounds_of(caster)))
            first_cast = std::min(first_cast, glm::dot(p, travel));
        const double scene = glm::length(seen[0] - seen[6]);
        return (std::max(0.0, last_seen - first_cast) + 0.01 * scene) / length;
    }
    double farthest = 0.0;
    for (const auto& p : seen) farthest = std::max(farthest, glm::length(p - l));
    double& nearest = pair.more().nearest_face;
    if (nearest < 0.0) {
        const Volume caps =
            quads != nullptr ? internal::casting_faces(*caster.mesh, *quads) : Volume{};
        nearest = internal::nearest_face(quads != nullptr ? caps : volume, *caster.mesh,
                                         caster.pose.world_from_local, l);
    }
    constexpr double most = 1e12;  // keeps single-precision coordinates finite
    const double reach = 1.01 * farthest / nearest;
    return std::clamp(std::isfinite(reach) ? reach : 1.0, 1.01, most);
}

void place_on_plane(VolumeDraw& draw, const PairState& pair, const LightState& light,
                    const internal::Reach& reach, double distance) {
    const glm::dvec4 plane = internal::plane_in(draw.world_from_local, reach.normal, distance);
    const LightLocal local = internal::current_light(pair, light);
    draw.world_from_far =
        draw.world_from_local * internal::projection_onto(plane, glm::dvec4(local.position));
    draw.extrusion = {1.0F, glm::vec4(0.0F, 0.0F, 0.0F, 1.0F)};
}

// `reach` is for finite far vertices alone.
void place_far_vertices(VolumeDraw& draw, const PairState& pair, const LightState& light,
                        bool infinite, double reach) {
    draw.world_from_far = draw.world_from_local;
    if (!pair.is(internal::PairFlag::Flattened)) {
        const LightLocal local = internal::current_light(pair, light);
        draw.extrusion = infinite ? infinite_extrusion(local) : finite_extrusion(local, reach);
        return;
    }
    // No local light: the far vertex is made in the world, from the point that the pose leads to.
    const glm::dvec4 l = light.light.position_world;
    glm::dmat4& far = draw.world_from_far;
    if (infinite) {
        far = l.w * far;
        far[3] -= glm::dvec4(glm::dvec3(l), l.w);
    } else if (l.w == 0.0) {
        far[3] -= glm::dvec4(reach * glm::dvec3(l), 0.0);
    } else {
        far = reach * far;
        far[3] += glm::dvec4((1.0 - reach) * glm::dvec3(l), 0.0);
        far[3].w = 1.0;
    }
    draw.extrusion = {1.0F, glm::vec4(0.0F, 0.0F, 0.0F, 1.0F)};
}

}  // namespace

const Volume* ShadowSystem::State::volume_of(const LightState& light, std::uint32_t caster) const {
    const PairState& pair = light.pairs[caster];
    if (pair.draw != no_draw) return list.draws[light.first + pair.draw].volume.get();
    return pair.extra != nullptr ? pair.extra->whole.get() : nullptr;
}

const QuadCasting* ShadowSystem::State::quads_of(const LightState& light,
                                                 std::uint32_t caster) const {
    const PairState& pair = light.pairs[caster];
    if (pair.draw != no_draw) {
        const VolumeDraw& draw = list.draws[light.first + pair.draw];
        return draw.quads ? &*draw.quads : nullptr;
    }
    return pair.extra != nullptr ? pair.extra->whole_quads.get() : nullptr;
}

void ShadowSystem::State::gather_drawn(const LightState& light) {
    drawn.clear();
    for (const std::uint32_t c : casters.by_key()) {
        const Volume* volume = volume_of(light, c);
        if (volume == nullptr) continue;
        const PairState& pair = light.pairs[c];
        const std::uint64_t revision = pair.draw != no_draw
                                           ? list.draws[light.first + pair.draw].revision
                                           : pair.extra->whole_revision;
        drawn.push_back({c, &casters[c], volume, revision, quads_of(light, c) != nullptr});
    }
}

// Off the draws, which will be of parts.
void ShadowSystem::State::lift_volumes(LightState& light) {
    for (std::uint32_t i = 0; i < light.count; ++i) {
        PairState& pair = light.pairs[origins[light.first + i].caster];
        if (pair.draw != i) continue;
        VolumeDraw& draw = list.draws[light.first + i];
        pair.draw = no_draw;
        pair.more().whole = std::move(draw.volume);
        pair.extra->whole_revision = draw.revision;
    }
}

void ShadowSystem::State::rearrange() {
    drop_draws();
    make_room(list.draws.size());
    list.lights.clear();
    listed = lights.by_key();
    for (const std::uint32_t l : listed) {
        LightState& light = lights[l];
        light.listed = true;
        list.lights.push_back({light.key, light.first, light.count, light.memory.batches});
        if (!light.gained && !light.all_anew) continue;
        for (std::uint32_t i = 0; light.pieces.empty() && i < light.count; ++i) {
            light.pairs[origins[light.first + i].caster].draw = i;
        }
    }
}

// Those that stay close up; their number stands in LightState::count.
void ShadowSystem::State::drop_draws() {
    std::size_t kept = 0;
    for (std::size_t e = 0; e < listed.size(); ++e) {
        LightState& light = lights[listed[e]];
        if (!light.listed) continue;  // gone, maybe with another in its place
        const std::size_t kept_before = kept;
        const std::uint32_t first = list.lights[e].first;
        const std::uint32_t count = list.lights[e].count;
        for (std::uint32_t i = 0; !light.all_anew && i < count; ++i) {
            const std::uint32_t caster = origins[first + i].caster;
            if (light.pieces.empty()) {
                PairState& pair = light.pairs[caster];
                if (pair.draw != i) continue;
                pair.draw = static_cast<std::uint32_t>(kept - kept_before);
            }
            if (kept != first + i) {
                list.draws[kept] = std::move(list.draws[first + i]);
                origins[kept] = origins[first + i];
            }
            ++kept;
        }
        light.count = static_cast<std::uint32_t>(kept - kept_before);
    }
    list.draws.resize(kept);
    origins.resize(kept);
}

// From the back, so that draws move out of each other's way.
void ShadowSystem::State::make_room(std::size_t kept) {
    const auto needs_draw = [](const PairState& pair) {
        return pair.draw == no_draw && pair.extra != nullptr && pair.extra->whole != nullptr;
    };
    std::size_t total = kept;
    for (const std::uint32_t l : lights.by_key()) {
        const LightState& light = lights[l];
        if (!light.pieces.empty()) {
            total += light.pieces.size() - light.count;
        } else if (light.gained || light.all_anew) {
            total += static_cast<std::size_t>(
                std::count_if(light.pairs.begin(), light.pairs.end(), needs_draw));
        }
    }
    list.draws.resize(total);
    origins.resize(total);
    std::size_t to = total;
    std::size_t from = kept;
    const auto move_one = [&] {
        --to;
        --from;
        if (to == from) return;
        list.draws[to] = std::move(list.draws[from]);
        origins[to] = origins[from];
    };
    const auto& order = lights.by_key();
    for (auto l = order.rbegin(); l != order.rend(); ++l) {
        LightState& light = lights[*l];
        const std::size_t end = to;
        if (!light.gained && !light.all_anew) {
            for (std::uint32_t i = 0; i < light.count; ++i) move_one();
        } else if (!light.pieces.empty()) {
            for (auto piece = light.pieces.rbegin(); piece != light.pieces.rend(); ++piece) {
                make_draw(--to, light, *piece);
            }
        } else {
            const auto& sorted = casters.by_key();
            for (auto c = sorted.rbegin(); c != sorted.rend(); ++c) {
                if (light.pairs[*c].draw != no_draw) {
                    move_one();
                } else if (needs_draw(light.pairs[*c])) {
                    make_draw(--to, light, {.caster = *c});
                }
            }
        }
        light.first = static_cast<std::uint32_t>(to);
        light.count = static_cast<std::uint32_t>(end - to);
    }
}

void ShadowSystem::State::make_draw(std::size_t at, LightState& light, const Piece& piece) {
    PairState& pair = light.pairs[piece.caster];
    VolumeDraw& draw = list.draws[at];
    draw = {};
    if (piece.part != Piece::whole) {
        draw.volume = pair.extra->parts[piece.part].volume;
        draw.revision = pair.extra->parts[piece.part].revision;
    } else {
        draw.revision = pair.extra->whole_revision;
        if (light.pieces.empty()) {
            draw.volume = std::move(pair.extra->whole);
            if (pair.extra->whole_quads != nullptr) {
                draw.quads = std::move(*pair.extra->whole_quads);
                pair.extra->whole_quads = nullptr;
            }
            pair.release_idle_extra();
        } else {
            draw.volume = pair.extra->whole;
        }
    }
    draw.batch = piece.batch;
    origins[at] = {.caster = piece.caster, .first = piece.first, .fill = DrawOrigin::Fill::All};
}

bool ShadowSystem::State::fill(bool view_changed) {
    constexpr std::size_t draws_of_task = 256;
    fills.clear();
    chunks.assign(1, 0);
    for (std::uint32_t e = 0; e < list.lights.size(); ++e) {
        const LightState& light = lights[listed[e]];
        const bool is_split = !light.pieces.empty();
        for (std::uint32_t i = light.first; i < light.first + light.count; ++i) {
            DrawOrigin::Fill& wanted = origins[i].fill;
            if (is_split && light.worked_on) wanted = DrawOrigin::Fill::All;
            if (wanted == DrawOrigin::Fill::Not) {
                if (!view_changed) continue;
                wanted = DrawOrigin::Fill::View;
            }
            fills.push_back({i, e});
            // Parts of one pair share what they find out, so that they are not divided.
            if (!is_split && fills.size() - chunks.back() >= draws_of_task) {
                chunks.push_back(fills.size());
            }
        }
        if (is_split && chunks.back() != fills.size()) chunks.push_back(fills.size());
    }
    if (chunks.back() != fills.size()) chunks.push_back(fills.size());

    const Corners seen = seen_by(*view);
    std::atomic<bool> differs{false};
    run(chunks.size() - 1, [&](std::size_t chunk) {
        bool any = false;
        for (std::size_t k = chunks[chunk]; k < chunks[chunk + 1]; ++k) {
            const auto [i, e] = fills[k];
            any = fill_draw(i, lights[listed[e]], clips[listed[e]], seen) || any;
        }
        if (any) differs = true;
    });
    renew_revisions();
    return differs;
}

// In the order of the draws, whoever made the caps.
void ShadowSystem::State::renew_revisions() {
    for (const auto [i, e] : fills) {
        DrawOrigin& origin = origins[i];
        if (!origin.caps_made) continue;
        origin.caps_made = false;
        VolumeDraw& draw = list.draws[i];
        draw.revision = internal::next_volume_revision();
        PairState& pair = lights[listed[e]].pairs[origin.caster];
        if (pair.extra != nullptr && pair.extra->whole == draw.volume) {
            pair.extra->whole_revision = draw.revision;
        }
        ++list.stats.caps_made;
    }
}

// Of a volume that was made for a view in which none were drawn.
void ShadowSystem::State::make_caps(VolumeDraw& draw, DrawOrigin& origin, PairState& pair) const {
    auto made = std::make_shared<const Volume>(with_caps(*draw.mesh, *draw.volume, options.caps));
    if (pair.extra != nullptr && pair.extra->whole == draw.volume) pair.extra->whole = made;
    draw.volume = std::move(made);
    origin.caps_made = true;
}

// Anew each time: they follow from the view, as scissors do.
void ShadowSystem::State::choose_slabs(VolumeDraw& draw, const PairState& pair,
                                       const LightState& light, const internal::ShadowHull& hull,
                                       const internal::Reach& reach) const {
    draw.slabs.clear();
    if (reach.gaps == nullptr || draw.quads || draw.bounds.empty()) return;
    const glm::dvec4 local(internal::current_light(pair, light).position);
    internal::slabs_of(draw, hull, reach, *screen, local, options.fill.scissor);
}

// True where it is another than before, reasons aside.
bool ShadowSystem::State::fill_draw(std::uint32_t index, LightState& light, const NearClip& clip,
                                    const Corners& seen) {
    VolumeDraw& draw = list.draws[index];
    DrawOrigin& origin = origins[index];
    const CasterState& caster = casters[origin.caster];
    PairState& pair = light.pairs[origin.caster];
    const bool all = origin.fill == DrawOrigin::Fill::All;
    origin.fill = DrawOrigin::Fill::Not;
    const bool infinite = far_vertices == FarVertices::AtInfinity;
    if (all) {
        draw.light = light.key;
        draw.caster = caster.key;
        if (draw.mesh != caster.mesh) draw.mesh = caster.mesh;
        draw.world_from_local = caster.pose.world_from_local;
        draw.mirrored = caster.pose.mirrored;
        draw.near_caps = !caster.in_depth_buffer;
        draw.reason = pair.reason;
        if (draw.quads) draw.quads->light = internal::current_light(pair, light);
        origin.quads = draw.quads.has_value();
    }
    const Volume& volume = light.pieces.empty() ? *draw.volume : *pair.extra->whole;
    if (all) origin.silhouette_edges = origin.first ? volume.silhouette_edges : 0;
    bool differs = all;
    const internal::ShadowHull hull(bounds_of(caster), light.light);
    if (!origin.reach_known) {
        origin.reach = {};
        if (!caster.pose.singular) {
            origin.reach = fill_terms().reach(hull);
        }
        origin.reach_known = true;
    }
    const internal::Reach& reaches = origin.reach;
    const double plane = internal::plane_distance(reaches, screen->eye());
    if (reaches.clamped) {
        place_on_plane(draw, pair, light, reaches, plane);
        differs = true;
    } else if (all || !infinite) {
        const QuadCasting* quads = draw.quads ? &*draw.quads : nullptr;
        const double reach =
            infinite ? 0.0 : finite_reach(pair, caster, light.light, volume, quads, seen);
        place_far_vertices(draw, pair, light, infinite, reach);
        differs = true;
    }
    const Technique technique = options.force_technique  ? *options.force_technique
                                : origin.technique_known ? origin.technique
                                                         : choose_technique(caster, clip);
    origin.technique_known = false;
    differs = differs || technique != draw.technique;
    draw.technique = origin.technique = technique;
    draw.far_caps =
        technique == Technique::DepthFail ||
        internal::depth_pass_has_far_caps(draw.extrusion.offset.w == 0.0F, reaches, *screen);
    if (!origin.bounds_known) {
        ScreenBounds bounds;
        if (light.umbras.holds(origin.caster)) {
            bounds = ScreenBounds::nothing();
        } else if (!caster.pose.singular) {
            bounds = shown_of(fill_terms(), hull, reaches).bounds;
        }
        differs = differs || bounds != draw.bounds;
        draw.bounds = bounds;
    }
    origin.bounds_known = false;
    origin.hidden = draw.bounds.empty();
    DepthBounds depth;
    if (options.fill.depth_bounds && !caster.pose.singular && !origin.hidden) {
        depth = screen->depth_of(hull, reaches, plane);
    }
    differs = differs || depth != draw.depth;
    draw.depth = depth;
    choose_slabs(draw, pair, light, hull, reaches);
    origin.in_slabs = !draw.slabs.empty();
    differs = differs || origin.in_slabs;
    const bool draws_caps = draw.far_caps || draw.near_caps || !draw.slabs.empty();
    if (draws_caps && !origin.hidden && draw.volume->made_with.caps.are_ranges_alone() &&
        !options.caps.are_ranges_alone()) {
        make_caps(draw, origin, pair);
        differs = true;
    }
    return differs;
}

void ShadowSystem::State::count_draws() {
    FrameStats& stats = list.stats;
    for (const DrawOrigin& origin : origins) {
        stats.silhouette_edges += origin.silhouette_edges;
        if (!origin.first) continue;
        stats.pairs_in_slabs += origin.in_slabs ? 1 : 0;
        stats.pairs_hidden += origin.hidden ? 1 : 0;
        stats.pairs_clamped += origin.reach.clamped ? 1 : 0;
        stats.quad_pairs += origin.quads ? 1 : 0;
        ++(origin.technique == Technique::DepthPass ? stats.zpass_pairs : stats.zfail_pairs);
    }
    for (std::size_t e = 0; e < listed.size(); ++e) {
        const LightState& light = lights[listed[e]];
        ScreenBounds& bounds = list.lights[e].bounds;
        bounds = ScreenBounds::nothing();
        bool any_clamped = false;
        bool any_other = view->projection != ProjectionKind::InfinitePerspective;
        for (std::uint32_t i = light.first; i < light.first + light.count; ++i) {
            const VolumeDraw& draw = list.draws[i];
            bounds = united(bounds, draw.bounds);
            const bool clamped = origins[i].reach.clamped;
            any_clamped = any_clamped || clamped;
            any_other = any_other || !clamped || !draw.far_caps;
        }
        list.lights[e].clear_background = any_clamped && any_other;
        stats.stencil_batches += light.count > 0 ? light.memory.batches : 0;
        stats.split_lights += light.pieces.empty() ? 0 : 1;
    }
}

}  // namespace gnomon::shadows
