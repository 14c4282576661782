// SPDX-License-Identifier: MIT
#include "internal/reach.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "internal/finite.hpp"
#include "internal/outline.hpp"

namespace gnomon::shadows::internal {

namespace {

// How far in front of the light a caster begins along a normal, as a part of its size: less, and
// far vertices would lose their places to rounding.
constexpr double least_front = 1e-3;
// Of a direction's cosine with a plane's normal.
constexpr double least_slope = 0.05;

struct Extent {
    double low = infinity;
    double high = -infinity;
};

Extent along(const ShadowHull& hull, const glm::dvec3& normal) {
    Extent e;
    for (const glm::dvec3& corner : hull.corners()) {
        const double x = glm::dot(corner, normal);
        e.low = std::min(e.low, x);
        e.high = std::max(e.high, x);
    }
    return e;
}

double size_of(const ShadowHull& hull) {
    double size2 = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 across = hull.corners()[7 - i] - hull.corners()[i];
        size2 = std::max(size2, glm::dot(across, across));
    }
    return std::sqrt(size2);
}

// Whether planes of this normal can end the shadow.
bool is_valid(const ShadowHull& hull, const glm::dvec3& normal, const Extent& caster, double size) {
    if (hull.light().w == 0.0) return glm::dot(hull.axis(), normal) >= least_slope;
    return caster.low - glm::dot(glm::dvec3(hull.light()), normal) > least_front * size;
}

// What far vertices are away from the caster's corners, in all.
double length_to(const ShadowHull& hull, const glm::dvec3& normal, double distance) {
    const glm::dvec3 light(hull.light());
    double sum = 0.0;
    for (const glm::dvec3& corner : hull.corners()) {
        const double below = distance - glm::dot(normal, corner);
        if (hull.light().w == 0.0) {
            sum += below / glm::dot(normal, hull.axis());
        } else {
            const glm::dvec3 ray = corner - light;
            sum += glm::length(ray) * below / glm::dot(normal, ray);
        }
    }
    return sum;
}

template <class Visit>
void for_each_normal(const ShadowHull& hull, Visit&& visit) {
    visit(hull.axis());
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 normal(0.0);
        normal[axis] = hull.axis()[axis] < 0.0 ? -1.0 : 1.0;
        visit(normal);
    }
}

void include_widest(Gaps& found, const Interval& gap, bool is_first) {
    const auto width = [](const Interval& g) { return g.high - g.low; };
    if (found.count == Gaps::most) {
        const auto narrowest = std::ranges::min_element(found.gaps, {}, width);
        if (width(*narrowest) >= width(gap)) return;
        if (narrowest == found.gaps.begin()) found.first = false;
        std::copy(narrowest + 1, found.gaps.end(), narrowest);
        --found.count;
    }
    found.first = found.first || is_first;
    found.gaps[found.count++] = gap;
}

std::shared_ptr<const Gaps> find_gaps(const ShadowHull& hull, const ReceiverTree& receivers,
                                      double last_of_caster, const Reach& reach) {
    Coverage along;
    receivers.cover(hull, reach.normal, along);
    Gaps found;
    // Narrow ones save nothing worth speaking of.
    const double narrow = (reach.distance - reach.first) / 32.0;
    double at = last_of_caster;
    bool any_before = false;
    for (const Interval& covered : along.covered()) {
        any_before = any_before || covered.low <= last_of_caster;
        const Interval gap{at, std::min(covered.low, reach.distance)};
        if (gap.high - gap.low > narrow) include_widest(found, gap, !any_before);
        any_before = true;
        at = std::max(at, covered.high);
    }
    if (found.count == 0) return nullptr;
    found.boxes.fill(Aabb::nothing());
    receivers.gather(hull, reach.normal, std::span(found.gaps).first(found.count),
                     std::span(found.boxes).first(found.count + 1));
    // The caster's own place counts, as it does for the whole.
    if (!found.first) {
        const Aabb& place = hull.caster();
        found.boxes[0].include(
            {glm::max(place.low, reach.box.low), glm::min(place.high, reach.box.high)});
    }
    return std::make_shared<const Gaps>(found);
}

}  // namespace

Reach reach_of(const ShadowHull& hull, const ReceiverTree* receivers, const FillOptions& options) {
    Reach reach;
    if (receivers == nullptr) {
        reach.box = hull.bounds();
        return reach;
    }
    ReceiverTree::Reached reached;
    receivers->reach(hull, reached);
    reach.box = reached.box;
    reach.any = reached.any();
    if (!options.clamp || hull.everything()) return reach;

    const double size = size_of(hull);
    double best = infinity;
    double last_of_caster = 0.0;
    for_each_normal(hull, [&](const glm::dvec3& normal) {
        const Extent caster = along(hull, normal);
        if (!is_valid(hull, normal, caster, size)) return;
        double distance = caster.high;
        if (reach.any) {
            const bool is_axis = normal == hull.axis();
            distance =
                std::max(distance, is_axis ? reached.along_axis : support(reached.box, normal));
        }
        const double length = length_to(hull, normal, distance);
        if (!(length < best)) return;
        best = length;
        reach.clamped = true;
        reach.normal = normal;
        reach.distance = distance;
        reach.first = caster.low;
        reach.least_room = 1e-5 * size;
        last_of_caster = caster.high;
    });
    if (reach.clamped) {
        reach.plane_is_last =
            receivers->empty() || support(receivers->bounds(), reach.normal) <= reach.distance;
        if (reach.any && options.slabs) {
            reach.gaps = find_gaps(hull, *receivers, last_of_caster, reach);
        }
    }
    return reach;
}

double plane_room(const Reach& reach, double distance, const glm::dvec3& eye) {
    // Receivers may lie on the plane itself. A rasteriser moves vertices by up to 1/512 of a pixel,
    // theirs and the far vertices: k pixels below the plane's horizon its depth is known to
    // 1/(256 k) of its distance from the eye. So much for 16 pixels: nearer to its horizon
    // little is seen of it, and more costs fill.
    const double from_eye = std::abs(distance - glm::dot(reach.normal, eye));
    return std::max(1e-3 * (distance - reach.first), reach.least_room) + from_eye / 4096.0;
}

double plane_distance(const Reach& reach, const glm::dvec3& eye) {
    return reach.distance + plane_room(reach, reach.distance, eye);
}

glm::dvec4 plane_in(const glm::dmat4& world_from_local, const glm::dvec3& normal, double distance) {
    return {glm::transpose(glm::dmat3(world_from_local)) * normal,
            glm::dot(normal, glm::dvec3(world_from_local[3])) - distance};
}

glm::dmat4 projection_onto(const glm::dvec4& plane, const glm::dvec4& light) {
    // dot(plane, light) * p - dot(plane, p) * light, with the sign that makes w positive.
    const double at_light = glm::dot(plane, light);
    const double scale = -1.0 / at_light;
    glm::dmat4 projection;
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
            projection[c][r] = scale * (plane[c] * light[r] - (c == r ? at_light : 0.0));
        }
    }
    return projection;
}

Screen::Screen(const View& view) : eye_(glm::inverse(view.view_from_world)[3]) {
    glm::dmat4 rotation = view.view_from_world;
    rotation[3] = glm::dvec4(0.0, 0.0, 0.0, 1.0);
    clip_from_world_ = view.clip_from_view * rotation;
    nearest_ = infinity;
    near_ = near_corners(view);
    for (const glm::dvec3& corner : near_) {
        const glm::dvec4 clip = clip_from_world_ * glm::dvec4(corner - eye_, 1.0);
        nearest_ = std::min(nearest_, clip.w);
    }
    nearest_ *= 0.999;
    const glm::dmat4& clip = view.clip_from_view;
    const bool is_plain =
        clip[0][2] == 0.0 && clip[1][2] == 0.0 && clip[0][3] == 0.0 && clip[1][3] == 0.0;
    if (!is_plain) return;  // depth is not a matter of distance alone
    forward_ = -glm::dvec3(glm::transpose(view.view_from_world)[2]);
    z_ = {clip[3][2], -clip[2][2]};
    w_ = {clip[3][3], -clip[2][3]};
    across_ = 1.0 / std::min(std::abs(clip[0][0]), std::abs(clip[1][1]));
    if (!std::isfinite(across_) || !is_finite(forward_)) across_ = 0.0;
}

bool Screen::begins_below(const glm::dvec3& normal, double distance) const {
    return std::ranges::all_of(near_,
                               [&](const auto& p) { return glm::dot(normal, p) < distance; });
}

template <class Visit>
bool Screen::for_each_seen(std::span<const glm::dvec4> points, Visit&& visit) const {
    std::array<glm::dvec3, 32> clip;  // x, y, w
    bool any_before = false;
    bool any_behind = false;
    const auto is_before = [&](const glm::dvec3& c, double weight) {
        return c.z >= nearest_ * weight && c.z > 0.0;
    };
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec4 c = clip_from_world_ * points[i];
        if (!is_finite(c)) return false;
        clip[i] = {c.x, c.y, c.w};
        if (is_before(clip[i], points[i].w)) {
            any_before = true;
            visit(c.x, c.y, c.w);
        } else {
            any_behind = true;
        }
    }
    if (!any_behind || !any_before) return true;
    // Where lines between the two sides cross the near plane: all of the hull's edges are among
    // them.
    for (std::size_t a = 0; a < points.size(); ++a) {
        if (!is_before(clip[a], points[a].w)) continue;
        const double before = clip[a].z - nearest_ * points[a].w;
        for (std::size_t b = 0; b < points.size(); ++b) {
            if (is_before(clip[b], points[b].w)) continue;
            const double behind = nearest_ * points[b].w - clip[b].z;
            const double sum = before + behind;
            if (!(sum > 0.0)) continue;
            const glm::dvec3 c = (clip[a] * behind + clip[b] * before) / sum;
            if (!(c.z > 0.0)) return false;
            visit(c.x, c.y, c.z);
        }
    }
    return true;
}

ScreenBounds Screen::of(std::span<const glm::dvec4> points) const {
    glm::dvec2 low(infinity);
    glm::dvec2 high(-infinity);
    const bool known = for_each_seen(points, [&](double x, double y, double w) {
        const glm::dvec2 p(x / w, y / w);
        low = glm::min(low, p);
        high = glm::max(high, p);
    });
    if (!known) return {};
    if (low.x == infinity) return ScreenBounds::nothing();
    if (!is_finite(low) || !is_finite(high)) return {};
    const auto outward = [](const glm::dvec2& p, double by) {
        return glm::vec2(glm::clamp(p + by * (1e-6 + 1e-6 * glm::abs(p)), -2.0, 2.0));
    };
    const ScreenBounds bounds{outward(low, -1.0), outward(high, 1.0)};
    return intersection(bounds, {});
}

double Screen::area_of(std::span<const glm::dvec4> points, const ScreenBounds& within) const {
    std::array<glm::dvec2, 32 + 16 * 16> seen;
    std::size_t count = 0;
    const bool known = for_each_seen(points, [&](double x, double y, double w) {
        seen[count++] = {x / w, y / w};
    });
    const glm::dvec2 low(within.min);
    const glm::dvec2 high(within.max);
    if (!known) return (high.x - low.x) * (high.y - low.y);
    return hull_area_within(std::span(seen).first(count), low, high);
}

ScreenBounds Screen::of(const Aabb& box) const {
    if (box.empty()) return ScreenBounds::nothing();
    if (!is_finite(box.low) || !is_finite(box.high)) return {};
    std::array<glm::dvec4, 8> points;
    for (unsigned i = 0; i < 8; ++i) {
        points[i] = glm::dvec4(glm::dvec3((i & 1U) != 0 ? box.high.x : box.low.x,
                                          (i & 2U) != 0 ? box.high.y : box.low.y,
                                          (i & 4U) != 0 ? box.high.z : box.low.z) -
                                   eye_,
                               1.0);
    }
    return of(points);
}

namespace {

// What the hull of these points is, the shadow is within; relative to the eye, at infinity w = 0.
std::array<glm::dvec4, 16> points_of(const ShadowHull& hull, const Reach& reach, double plane,
                                     const glm::dvec3& eye) {
    std::array<glm::dvec4, 16> points;
    const glm::dvec3 light(hull.light());
    const bool directional = hull.light().w == 0.0;
    for (std::size_t i = 0; i < 8; ++i) {
        const glm::dvec3& corner = hull.corners()[i];
        points[i] = glm::dvec4(corner - eye, 1.0);
        const glm::dvec3 ray = directional ? hull.axis() : corner - light;
        if (reach.clamped) {
            const double t = (plane - glm::dot(reach.normal, corner)) / glm::dot(reach.normal, ray);
            points[8 + i] = glm::dvec4(corner + t * ray - eye, 1.0);
        } else {
            points[8 + i] = glm::dvec4(ray, 0.0);
        }
    }
    return points;
}

}  // namespace

ScreenBounds Screen::of(const ShadowHull& hull, const Reach& reach, double plane) const {
    if (!reach.any) return ScreenBounds::nothing();
    const ScreenBounds receivers = of(reach.box);
    if (hull.everything() || receivers.empty()) return receivers;
    return intersection(of(points_of(hull, reach, plane, eye_)), receivers);
}

// Less than 0 or more than 1 before and behind the planes, as unclipped depth is clamped.
double Screen::stored_depth(double ahead) const {
    if (std::isinf(ahead) && ahead > 0.0) {
        const bool is_parallel = w_[1] == 0.0;
        return is_parallel ? z_[1] * ahead : z_[1] / w_[1];
    }
    const double w = w_[0] + w_[1] * ahead;
    if (!(w > 0.0)) return 1.0;
    return (z_[0] + z_[1] * ahead) / w;
}

namespace {

// Outward to one of few values: bounds that are alike are not set anew, and drivers that translate
// shaders for each pair of them (SwiftShader's does) have few to translate.
float coarsely(double depth, bool up) {
    constexpr int steps = 8;  // an octave
    if (!(depth > 0x1p-18)) return up ? 0x1p-18F : 0.0F;
    int exponent = 0;
    const double mantissa = 2.0 * std::frexp(depth, &exponent);  // 1 .. 2
    const double step = (mantissa - 1.0) * steps;
    const double kept = 1.0 + (up ? std::ceil(step) : std::floor(step)) / steps;
    return static_cast<float>(std::min(1.0, std::ldexp(kept, exponent - 1)));
}

}  // namespace

DepthBounds Screen::depth_of(const ShadowHull& hull, const Reach& reach, double plane) const {
    if (!(across_ > 0.0) || hull.everything() || !reach.any) return {};
    Extent shadow;
    for (const glm::dvec4& p : points_of(hull, reach, plane, eye_)) {
        const double ahead = glm::dot(forward_, glm::dvec3(p));
        if (!std::isfinite(ahead)) return {};
        if (p.w != 0.0) {
            shadow.low = std::min(shadow.low, ahead);
            shadow.high = std::max(shadow.high, ahead);
            continue;
        }
        const double none = 1e-9 * glm::length(glm::dvec3(p));
        if (ahead > -none) shadow.high = infinity;
        if (ahead < none) shadow.low = -infinity;
    }
    if (is_finite(reach.box.low) && is_finite(reach.box.high)) {
        const glm::dvec3 middle = 0.5 * (reach.box.low + reach.box.high) - eye_;
        const glm::dvec3 half = 0.5 * (reach.box.high - reach.box.low);
        const double ahead = glm::dot(forward_, middle);
        const double room = glm::dot(glm::abs(forward_), half);
        shadow.low = std::max(shadow.low, ahead - room);
        shadow.high = std::min(shadow.high, ahead + room);
    }
    if (!(shadow.low <= shadow.high)) return {};
    // A vertex that snaps to a rasteriser's grid takes its depth along, so that a pixel holds the
    // depth of a place beside it. On a pixel outside of the band along a shadow's edge it is still
    // one of the shadow's or none of them, however a surface lies: what moves it is less than what
    // it is away. Within the band a pixel's size, of pictures with 256 of them, keeps nearly all.
    const auto beside = [&](double ahead) {
        return across_ / 128.0 * std::max(0.0, w_[0] + w_[1] * ahead);
    };
    const double first = shadow.low - beside(shadow.low);
    const double last = std::isinf(shadow.high) ? infinity : shadow.high + beside(shadow.high);
    // Depth is interpolated in single precision, by planes through triangles of whatever depths.
    const auto rounded = [](double depth) { return 2e-6 + 1e-5 * depth; };
    const double farthest = std::clamp(stored_depth(last), 0.0, 1.0);
    const double nearest = std::clamp(stored_depth(first), 0.0, 1.0);
    return {coarsely(farthest - rounded(farthest), false),
            coarsely(nearest + rounded(nearest), true)};
}

Shown shown_of(const FillTerms& terms, const ShadowHull& hull, const Reach& reach) {
    if (terms.options.cull_by_receivers && !reach.any) {
        return {Hidden::ReachesNothing, ScreenBounds::nothing()};
    }
    const bool looks = terms.options.cull_by_view || terms.options.scissor;
    if (terms.screen == nullptr || !looks) return {};
    const ScreenBounds bounds =
        terms.screen->of(hull, reach, plane_distance(reach, terms.screen->eye()));
    if (terms.options.cull_by_view && bounds.empty()) return {Hidden::OutOfView, bounds};
    return {Hidden::No, terms.options.scissor ? bounds : ScreenBounds{}};
}

}  // namespace gnomon::shadows::internal
