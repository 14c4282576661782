// SPDX-License-Identifier: MIT
#include <gnomon/shadows/shadow_system.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <map>
#include <string>
#include <unordered_map>

#include "internal/batches.hpp"
#include "internal/finite.hpp"
#include "internal/pair.hpp"

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

OrientedBounds bounds_of(const CasterState& caster) {
    return {caster.pose.world_from_local, glm::dvec3(caster.caster.mesh->bounds_min()),
            glm::dvec3(caster.caster.mesh->bounds_max())};
}

bool out_of_range(const CasterState& caster, const Light& light) {
    if (!light.range_m || light.position_world.w == 0.0) return false;
    const auto corners = corners_of(bounds_of(caster));
    glm::dvec3 center(0.0);
    for (const auto& corner : corners) center += corner * 0.125;
    double radius = 0.0;
    for (const auto& corner : corners) radius = std::max(radius, glm::length(corner - center));
    const double distance = glm::length(glm::dvec3(light.position_world) - center);
    return distance - radius * (1.0 + 1e-9) > *light.range_m;
}

// How far far vertices must go so that the far cap lies beyond everything the view can see: a
// factor for a point light (the cap is the caster scaled about the light), metres per length of the
// direction for a directional one.
double finite_reach(PairState& pair, const CasterState& caster, const Light& light,
                    const View& view) {
    std::array<glm::dvec3, 8> seen;
    const auto near = near_corners(view);
    const auto far = far_corners(view);
    std::copy(near.begin(), near.end(), seen.begin());
    std::copy(far.begin(), far.end(), seen.begin() + 4);
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
    if (pair.nearest_face < 0.0) {
        pair.nearest_face =
            internal::nearest_face(*pair.volume, *pair.mesh, caster.pose.world_from_local, l);
    }
    constexpr double most = 1e12;  // keeps single-precision coordinates finite
    const double reach = 1.01 * farthest / pair.nearest_face;
    return std::clamp(std::isfinite(reach) ? reach : 1.0, 1.01, most);
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
    }
    return "";
}

struct ShadowSystem::State {
    SystemOptions options;
    const SilhouetteStrategy* strategy = nullptr;
    Submission submission = Submission::Full;
    std::uint64_t frame = 0;
    std::uint64_t next_revision = 1;
    std::map<std::uint64_t, CasterState> casters;  // sorted: same input, same list
    std::map<std::uint64_t, LightState> lights;
    std::unordered_map<std::uint64_t, std::unordered_map<std::uint64_t, PairState>>
        pairs;  // light, then caster
    internal::Scratch scratch;
    std::vector<internal::DrawnPair> drawn;  // of the light at hand
    std::vector<VolumeDraw> draws;

    void drop_caster(std::uint64_t key) {
        casters.erase(key);
        for (auto& [light, of_light] : pairs) of_light.erase(key);
    }
    void drop_light(std::uint64_t key) {
        lights.erase(key);
        pairs.erase(key);
    }
    void drop_unsubmitted();
    void draw_pair(const CasterState& caster, const LightState& light, const View& view,
                   FrameStats& stats);
    void draw_light(LightState& light, const View& view, DrawList& list);
};

void ShadowSystem::State::drop_unsubmitted() {
    const auto gone = [&](const auto& entry) { return entry.second.frame != frame; };
    for (auto it = lights.begin(); it != lights.end();) {
        if (gone(*it)) {
            pairs.erase(it->first);
            it = lights.erase(it);
        } else {
            ++it;
        }
    }
    bool casters_left = false;
    for (auto it = casters.begin(); it != casters.end();) {
        casters_left = casters_left || gone(*it);
        it = gone(*it) ? casters.erase(it) : std::next(it);
    }
    if (!casters_left) return;
    for (auto& [light, of_light] : pairs) {
        std::erase_if(of_light, [&](const auto& entry) { return !casters.contains(entry.first); });
    }
}

void ShadowSystem::State::draw_pair(const CasterState& caster, const LightState& light,
                                    const View& view, FrameStats& stats) {
    ++stats.pairs;
    auto& of_light = pairs[light.light.key];
    if (!caster.pose.finite || !internal::is_finite(light.light.position_world) ||
        out_of_range(caster, light.light)) {
        of_light.erase(caster.caster.key);
        ++stats.pairs_culled;
        ++stats.reasons[static_cast<std::size_t>(Reason::OutOfRange)];
        return;
    }
    const bool infinite = view.projection == ProjectionKind::InfinitePerspective;
    PairState& pair = of_light[caster.caster.key];
    VolumeDraw draw;
    draw.reason = internal::update_pair(pair, caster, light,
                                        infinite ? FarVertices::AtInfinity : FarVertices::Finite,
                                        *strategy, scratch, stats);
    ++stats.reasons[static_cast<std::size_t>(draw.reason)];
    if (pair.volume->indices.empty()) return;  // nothing faces anything: no shadow

    draw.light = light.light.key;
    draw.caster = caster.caster.key;
    draw.mesh = pair.mesh;
    draw.volume = pair.volume;
    draw.revision = pair.volume_revision;
    draw.world_from_local = caster.pose.world_from_local;
    draw.world_from_far = caster.pose.world_from_local;
    draw.mirrored = caster.pose.mirrored;
    if (pair.flattened) {
        // No local light: the far vertex is made in the world, from the point that the pose leads
        // to.
        const glm::dvec4 l = light.light.position_world;
        glm::dmat4& far = draw.world_from_far;
        if (infinite) {
            far = l.w * far;
            far[3] -= glm::dvec4(glm::dvec3(l), l.w);
        } else {
            const double reach = finite_reach(pair, caster, light.light, view);
            if (l.w == 0.0) {
                far[3] -= glm::dvec4(reach * glm::dvec3(l), 0.0);
            } else {
                far = reach * far;
                far[3] += glm::dvec4((1.0 - reach) * glm::dvec3(l), 0.0);
                far[3].w = 1.0;
            }
        }
        draw.extrusion = {1.0F, glm::vec4(0.0F, 0.0F, 0.0F, 1.0F)};
    } else {
        draw.extrusion = infinite ? infinite_extrusion(pair.current)
                                  : finite_extrusion(pair.current,
                                                     finite_reach(pair, caster, light.light, view));
    }
    draw.near_caps = !caster.caster.in_depth_buffer;
    draw.technique = options.force_technique.value_or(
        depth_pass_is_valid(bounds_of(caster), light.light.position_world, view)
            ? Technique::DepthPass
            : Technique::DepthFail);
    ++(draw.technique == Technique::DepthPass ? stats.zpass_pairs : stats.zfail_pairs);
    stats.silhouette_edges += draw.volume->silhouette_edges;
    drawn.push_back({&pair, bounds_of(caster)});
    draws.push_back(std::move(draw));
}

void ShadowSystem::State::draw_light(LightState& light, const View& view, DrawList& list) {
    drawn.clear();
    draws.clear();
    for (const auto& [key, caster] : casters) draw_pair(caster, light, view, list.stats);
    const auto start = std::chrono::steady_clock::now();
    const std::uint32_t batches =
        internal::split_into_batches(light, options.max_layers, drawn, draws);
    list.stats.build_ms +=
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    list.stats.stencil_batches += batches;
    list.stats.split_lights += batches > 1 ? 1 : 0;
    list.lights.push_back({light.light.key, static_cast<std::uint32_t>(list.draws.size()),
                           static_cast<std::uint32_t>(draws.size()),
                           std::max<std::uint32_t>(batches, 1)});
    list.draws.insert(list.draws.end(), std::make_move_iterator(draws.begin()),
                      std::make_move_iterator(draws.end()));
}

Result<ShadowSystem> ShadowSystem::create(const SystemOptions& options) {
    const std::string_view name = options.silhouette == "auto" ? "brute_force" : options.silhouette;
    const SilhouetteStrategy* strategy = find_strategy(name);
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
    auto state = std::make_unique<State>();
    state->options = options;
    state->strategy = strategy;
    return ShadowSystem(std::move(state));
}

ShadowSystem::ShadowSystem(std::unique_ptr<State> state) : state_(std::move(state)) {}
ShadowSystem::ShadowSystem(ShadowSystem&&) noexcept = default;
ShadowSystem& ShadowSystem::operator=(ShadowSystem&&) noexcept = default;
ShadowSystem::~ShadowSystem() = default;

ShadowSystem::Frame ShadowSystem::begin_frame(Submission submission) {
    ++state_->frame;
    state_->submission = submission;
    return Frame(*this);
}

void ShadowSystem::Frame::caster(const Caster& caster) {
    State& state = *system_->state_;
    GNOMON_EXPECTS(caster.mesh != nullptr);
    CasterState& known = state.casters[caster.key];
    if (known.pose_revision == 0 ||
        !same_bits(known.caster.world_from_local, caster.world_from_local)) {
        known.pose = internal::make_pose(caster.world_from_local);
        known.pose_revision = state.next_revision++;
    }
    known.caster = caster;
    known.frame = state.frame;
}

void ShadowSystem::Frame::light(const Light& light) {
    State& state = *system_->state_;
    LightState& known = state.lights[light.key];
    if (known.revision == 0 || !same_bits(known.light.position_world, light.position_world)) {
        known.revision = state.next_revision++;
    }
    known.light = light;
    known.frame = state.frame;
}

void ShadowSystem::Frame::remove_caster(std::uint64_t key) { system_->state_->drop_caster(key); }
void ShadowSystem::Frame::remove_light(std::uint64_t key) { system_->state_->drop_light(key); }

DrawList ShadowSystem::Frame::finish(const View& view) && {
    State& state = *system_->state_;
    if (state.submission == Submission::Full) state.drop_unsubmitted();
    DrawList list;
    list.stats.casters = state.casters.size();
    list.stats.lights = state.lights.size();
    list.stats.silhouette = state.strategy->name;
    for (auto& [key, light] : state.lights) state.draw_light(light, view, list);
    return list;
}

}  // namespace gnomon::shadows
