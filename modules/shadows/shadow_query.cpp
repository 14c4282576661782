// SPDX-License-Identifier: MIT
#include <gnomon/shadows/shadow_query.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <unordered_map>

#include <gnomon/core/expects.hpp>

#include "internal/caster_space.hpp"
#include "internal/crossing.hpp"
#include "internal/finite.hpp"
#include "internal/light_fan.hpp"

namespace gnomon::shadows {

using internal::Box;
using internal::CasterSpace;
using internal::Corners;
using internal::is_finite;
using internal::LightFan;
using internal::SegmentPart;
using internal::Sight;

namespace {

// A caster, and what does not change while it keeps its pose.
struct Entry {
    Caster caster;
    CasterSpace space;
    std::uint64_t update = 0;  // last submitted in
};

bool beyond_range(const Light& light, const glm::dvec3& point) {
    return light.range_m && light.position_world.w != 0.0 &&
           glm::length(glm::dvec3(light.position_world) - point) > *light.range_m;
}

// Calls visit(face, corners) for the caster's faces on the way until it returns true.
template <class Visit>
bool each_face_crossed(const CasterSpace& space, const Sight& sight, Visit&& visit) {
    const auto enters = [&](const Box<float>& box) { return sight.enters(space.box(box)); };
    return space.faces().tree().walk(enters, [&](std::uint32_t face) {
        const Corners corners = space.corners(space.faces().triangles()[face]);
        return sight.crosses(corners) && visit(face, corners);
    });
}

// Appends the shadows that one caster casts on a segment, both in its own space.
void add_shadows(const CasterSpace& space, const LightFan& fan, const glm::dvec4& light,
                 std::vector<SegmentPart>& shadows) {
    const auto enters = [&](const Box<float>& box) { return fan.enters(space.box(box)); };
    space.faces().tree().walk(enters, [&](std::uint32_t face) {
        const Corners corners = space.corners(space.faces().triangles()[face]);
        if (space.facing(corners, light) == 0) return false;
        if (const auto shadow = fan.shadow_of(corners)) shadows.push_back(*shadow);
        return false;
    });
}

// Appends where the segment itself passes through the caster's faces.
void add_passages(const CasterSpace& space, const glm::dvec3& from, const glm::dvec3& to,
                  std::vector<double>& at) {
    each_face_crossed(space, Sight(from, glm::dvec4(to, 1.0)),
                      [&](std::uint32_t, const Corners& face) {
                          const glm::dvec3 n = glm::cross(face[1] - face[0], face[2] - face[0]);
                          const double before = std::abs(glm::dot(n, from - face[0]));
                          const double behind = std::abs(glm::dot(n, to - face[0]));
                          at.push_back(before / (before + behind));
                          return false;
                      });
}

// Appends the ends of the intervals' union.
void add_ends(std::vector<SegmentPart>& intervals, std::vector<double>& at) {
    std::sort(intervals.begin(), intervals.end(),
              [](const SegmentPart& a, const SegmentPart& b) { return a.begin < b.begin; });
    for (std::size_t i = 0; i < intervals.size();) {
        double end = intervals[i].end;
        at.push_back(intervals[i].begin);
        for (++i; i < intervals.size() && intervals[i].begin <= end; ++i) {
            end = std::max(end, intervals[i].end);
        }
        at.push_back(end);
    }
}

// Appends where the segment enters and leaves the light's range.
void add_range(const Light& light, const glm::dvec3& from, const glm::dvec3& to,
               std::vector<double>& at) {
    if (!light.range_m || light.position_world.w == 0.0) return;
    const glm::dvec3 along = to - from;
    const glm::dvec3 start = from - glm::dvec3(light.position_world);
    const double a = glm::dot(along, along);
    const double b = glm::dot(along, start);
    const double root = b * b - a * (glm::dot(start, start) - *light.range_m * *light.range_m);
    if (!(root > 0.0) || !(a > 0.0)) return;
    at.push_back((-b - std::sqrt(root)) / a);
    at.push_back((-b + std::sqrt(root)) / a);
}

// A face that was found in the way: what comes next to it is likely to be shadowed by it as well.
struct Blocker {
    std::uint32_t entry = 0;
    std::uint32_t face = 0;
    bool known = false;
};

}  // namespace

struct ShadowQueries::State {
    std::vector<Entry> entries;
    std::unordered_map<std::uint64_t, std::uint32_t> entry_of;  // by key
    std::uint64_t updates = 0;

    // The entries that cast, their bounds, and a tree over these.
    std::vector<std::uint32_t> casting;
    std::vector<Box<double>> bounds;
    internal::BoxTree<double> tree;
    double area_when_built = 0.0;
    // For what rounding does to lights: the worst of it, and where the casters' origins are.
    double light_rounding = 0.0;
    Box<double> origins;

    bool submit(const Caster& caster, bool& moved);
    bool drop_unsubmitted();
    bool drop(std::uint64_t key);
    void rebuild();
    void place();

    [[nodiscard]] double slack(const Light& light, const glm::dvec3& point) const;
    template <class Enters, class Visit>
    bool each_caster(const QueryOptions& options, Enters&& enters, Visit&& visit) const;
    template <class Visit>
    bool each_crossed(const Light& light, const glm::dvec3& point, const QueryOptions& options,
                      Visit&& visit) const;
    [[nodiscard]] bool in_shadow(const Light& light, const glm::dvec3& point,
                                 const QueryOptions& options, Blocker& blocker) const;
    [[nodiscard]] Exposure exposure(const Light& light, const glm::dvec3& point,
                                    const QueryOptions& options, Blocker& blocker) const {
        if (beyond_range(light, point)) return Exposure::OutOfRange;
        return in_shadow(light, point, options, blocker) ? Exposure::Shadowed : Exposure::Lit;
    }
    void borders(const Light& light, const glm::dvec3& from, const glm::dvec3& to,
                 const QueryOptions& options, std::vector<double>& at) const;
};

// ---------------------------------------------------------------------------------------------
// Updates

// True when the set of casters, or a mesh, is another one.
bool ShadowQueries::State::submit(const Caster& caster, bool& moved) {
    GNOMON_EXPECTS(caster.mesh != nullptr);
    const auto [known, is_new] =
        entry_of.try_emplace(caster.key, static_cast<std::uint32_t>(entries.size()));
    if (is_new) entries.emplace_back();
    Entry& entry = entries[known->second];
    entry.update = updates;
    const bool other_mesh = is_new || entry.caster.mesh != caster.mesh;
    const bool other_pose = is_new || std::memcmp(&entry.caster.world_from_local,
                                                  &caster.world_from_local, sizeof(glm::dmat4));
    entry.caster = caster;
    if (!other_mesh && !other_pose) return false;
    const bool cast = entry.space.casts();
    entry.space = CasterSpace(*caster.mesh, caster.world_from_local);
    moved = true;
    return other_mesh || cast != entry.space.casts();
}

bool ShadowQueries::State::drop(std::uint64_t key) {
    const auto found = entry_of.find(key);
    if (found == entry_of.end()) return false;
    const std::uint32_t at = found->second;
    entry_of.erase(found);
    if (at + 1 < entries.size()) {
        entries[at] = std::move(entries.back());
        entry_of[entries[at].caster.key] = at;
    }
    entries.pop_back();
    return true;
}

bool ShadowQueries::State::drop_unsubmitted() {
    bool dropped = false;
    for (std::size_t i = entries.size(); i-- > 0;) {
        if (entries[i].update != updates) dropped = drop(entries[i].caster.key) || dropped;
    }
    return dropped;
}

void ShadowQueries::State::place() {
    light_rounding = 0.0;
    origins = {};
    for (std::size_t i = 0; i < casting.size(); ++i) {
        const CasterSpace& space = entries[casting[i]].space;
        bounds[i] = space.world_bounds();
        light_rounding = std::max(light_rounding, space.light_rounding());
        origins.add(space.origin_world());
    }
}

void ShadowQueries::State::rebuild() {
    casting.clear();
    for (std::uint32_t i = 0; i < entries.size(); ++i) {
        if (entries[i].space.casts()) casting.push_back(i);
    }
    bounds.resize(casting.size());
    place();
    tree = internal::BoxTree<double>(bounds, 1);
    area_when_built = tree.area();
}

TreeUpdate ShadowQueries::update(std::span<const Caster> casters, Submission submission,
                                 std::span<const std::uint64_t> removed) {
    State& state = *state_;
    ++state.updates;
    bool moved = false;
    bool others = false;
    for (const std::uint64_t key : removed) others = state.drop(key) || others;
    for (const Caster& caster : casters) others = state.submit(caster, moved) || others;
    if (submission == Submission::Full) others = state.drop_unsubmitted() || others;
    if (!others && !moved) return TreeUpdate::Unchanged;
    if (!others) {
        state.place();
        state.tree.refit(state.bounds);
        // Nodes that have grown to twice the area are searched about twice as often.
        if (state.tree.area() <= 2.0 * state.area_when_built) return TreeUpdate::Refitted;
    }
    state.rebuild();
    return TreeUpdate::Rebuilt;
}

// ---------------------------------------------------------------------------------------------
// Points

// How far the ways to the light that the casters see, each in its own space, may be from the way in
// the world: lights are rounded to single precision there, and points to double.
double ShadowQueries::State::slack(const Light& light, const glm::dvec3& point) const {
    const bool point_light = light.position_world.w != 0.0;
    const glm::dvec3 l(light.position_world);
    const Box<double>& far = point_light ? origins : tree.bounds();
    const double distance =
        glm::length((point_light ? l : point) - far.center()) + glm::length(far.half());
    const double coordinates = glm::length(point) + (point_light ? glm::length(l) : 0.0) +
                               glm::length(origins.center()) + glm::length(origins.half());
    return light_rounding * distance + 0x1p-46 * (1.0 + 0x1p24 * light_rounding) * coordinates;
}

// Calls visit(entry) for casters whose bounds are entered until it returns true.
template <class Enters, class Visit>
bool ShadowQueries::State::each_caster(const QueryOptions& options, Enters&& enters,
                                       Visit&& visit) const {
    const auto& ignored = options.ignored_casters;
    return tree.walk(enters, [&](std::uint32_t place) {
        const std::uint32_t entry = casting[tree.order()[place]];
        const std::uint64_t key = entries[entry].caster.key;
        return std::find(ignored.begin(), ignored.end(), key) == ignored.end() && visit(entry);
    });
}

// Calls visit(entry, face) for the faces between point and light until it returns true.
template <class Visit>
bool ShadowQueries::State::each_crossed(const Light& light, const glm::dvec3& point,
                                        const QueryOptions& options, Visit&& visit) const {
    if (tree.empty() || !is_finite(light.position_world)) return false;
    const Sight in_world(point, light.position_world, slack(light, point));
    const auto enters = [&](const Box<double>& box) { return in_world.enters(box); };
    return each_caster(options, enters, [&](std::uint32_t entry) {
        const CasterSpace& space = entries[entry].space;
        const auto point_here = space.point(point);
        const auto light_here = space.light(light.position_world);
        if (!point_here || !light_here) return false;
        const Sight sight(*point_here, *light_here);
        return each_face_crossed(space, sight, [&](std::uint32_t face, const Corners& corners) {
            return space.facing(corners, *light_here) != 0 && visit(entry, face);
        });
    });
}

bool ShadowQueries::State::in_shadow(const Light& light, const glm::dvec3& point,
                                     const QueryOptions& options, Blocker& blocker) const {
    if (blocker.known) {
        const CasterSpace& space = entries[blocker.entry].space;
        const auto point_here = space.point(point);
        const auto light_here = space.light(light.position_world);
        if (point_here && light_here) {
            const Corners face = space.corners(space.faces().triangles()[blocker.face]);
            if (Sight(*point_here, *light_here).crosses(face) &&
                space.facing(face, *light_here) != 0) {
                return true;
            }
        }
    }
    return each_crossed(light, point, options, [&](std::uint32_t entry, std::uint32_t face) {
        blocker = {entry, face, true};
        return true;
    });
}

ShadowQueries::ShadowQueries() : state_(std::make_unique<State>()) {}
ShadowQueries::ShadowQueries(ShadowQueries&&) noexcept = default;
ShadowQueries& ShadowQueries::operator=(ShadowQueries&&) noexcept = default;
ShadowQueries::~ShadowQueries() = default;

Exposure ShadowQueries::at(const Light& light, const glm::dvec3& point_world,
                           const QueryOptions& options) const {
    GNOMON_EXPECTS(is_finite(point_world));
    Blocker unknown;
    return state_->exposure(light, point_world, options, unknown);
}

void ShadowQueries::at(const Light& light, std::span<const glm::dvec3> points_world,
                       std::span<Exposure> exposures, const QueryOptions& options) const {
    GNOMON_EXPECTS(points_world.size() == exposures.size());
    Blocker last;
    for (std::size_t i = 0; i < points_world.size(); ++i) {
        GNOMON_EXPECTS(is_finite(points_world[i]));
        exposures[i] = state_->exposure(light, points_world[i], options, last);
    }
}

std::uint32_t ShadowQueries::surfaces_between(const Light& light, const glm::dvec3& point_world,
                                              const QueryOptions& options) const {
    GNOMON_EXPECTS(is_finite(point_world));
    std::uint32_t count = 0;
    state_->each_crossed(light, point_world, options, [&](std::uint32_t, std::uint32_t) {
        ++count;
        return false;
    });
    return count;
}

// ---------------------------------------------------------------------------------------------
// Segments

// Every parameter at which something may change, in order, with 0 and 1.
void ShadowQueries::State::borders(const Light& light, const glm::dvec3& from, const glm::dvec3& to,
                                   const QueryOptions& options, std::vector<double>& at) const {
    at = {0.0, 1.0};
    if (!tree.empty() && is_finite(light.position_world)) {
        std::vector<SegmentPart> shadows;
        const double beside = std::max(slack(light, from), slack(light, to));
        const LightFan fan(from, to, light.position_world, beside);
        each_caster(
            options, [&](const Box<double>& box) { return fan.enters(box); },
            [&](std::uint32_t entry) {
                const CasterSpace& space = entries[entry].space;
                const auto from_here = space.point(from);
                const auto to_here = space.point(to);
                const auto light_here = space.light(light.position_world);
                if (!from_here || !to_here || !light_here) return false;
                const LightFan fan_here(*from_here, *to_here, *light_here);
                if (!fan_here.flat()) add_shadows(space, fan_here, *light_here, shadows);
                add_passages(space, *from_here, *to_here, at);
                return false;
            });
        add_ends(shadows, at);
    }
    add_range(light, from, to, at);
    std::erase_if(at, [](double t) { return !(t >= 0.0 && t <= 1.0); });
    std::sort(at.begin(), at.end());
    at.erase(std::unique(at.begin(), at.end()), at.end());
}

void ShadowQueries::along(const Light& light, const glm::dvec3& from_world,
                          const glm::dvec3& to_world, std::vector<SegmentPiece>& pieces,
                          const QueryOptions& options) const {
    GNOMON_EXPECTS(is_finite(from_world) && is_finite(to_world));
    std::vector<double> borders;
    state_->borders(light, from_world, to_world, options, borders);
    pieces.clear();
    Blocker last;
    for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
        const double middle = 0.5 * (borders[i] + borders[i + 1]);
        const Exposure exposure =
            state_->exposure(light, glm::mix(from_world, to_world, middle), options, last);
        if (!pieces.empty() && pieces.back().exposure == exposure) {
            pieces.back().end = borders[i + 1];
        } else {
            pieces.push_back({borders[i], borders[i + 1], exposure});
        }
    }
}

glm::dvec3 lifted(const glm::dvec3& point_world, const glm::dvec3& normal_world, const Light& light,
                  double lift_m) {
    const double length = glm::length(normal_world);
    if (!(length > 0.0)) return point_world;
    const glm::dvec3 to_light =
        glm::dvec3(light.position_world) - light.position_world.w * point_world;
    const double side = glm::dot(normal_world, to_light) < 0.0 ? -1.0 : 1.0;
    return point_world + normal_world * (side * lift_m / length);
}

}  // namespace gnomon::shadows
