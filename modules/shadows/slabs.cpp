// SPDX-License-Identifier: MIT
#include "internal/slabs.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>

namespace gnomon::shadows::internal {

namespace {

// What another draw costs in fragments, as a part of the picture, which is 4.
constexpr double worth_a_draw = 4.0 / 1024.0;

// Where a slab begins or ends: the caster's box, or what it casts onto a plane.
struct Section {
    std::optional<double> distance;
    std::array<glm::dvec4, 8> points;  // relative to the eye
};

constexpr std::size_t most_parts = Gaps::most + 1;

// The parts of a volume between gaps, ascending, and what it costs to draw neighbours as one.
class Parts {
public:
    Parts(const VolumeDraw& draw, const ShadowHull& hull, const Reach& reach, const Screen& screen)
        : draw_(draw), hull_(hull), reach_(reach), screen_(screen) {
        begins_[0] = section({});
        const Gaps& gaps = *reach.gaps;
        boxes_[0] = gaps.boxes[0];
        for (std::size_t g = 0; g < gaps.count; ++g) {
            const Interval& gap = gaps.gaps[g];
            const double end = gap.low + plane_room(reach, gap.low, screen.eye());
            const double begin = gap.high - plane_room(reach, gap.high, screen.eye());
            if (!(end < begin)) {
                boxes_[count_ - 1].include(gaps.boxes[g + 1]);
                continue;
            }
            first_is_empty_ = first_is_empty_ || (g == 0 && gaps.first);
            boxes_[count_] = gaps.boxes[g + 1];
            ends_[count_ - 1] = section(end);
            begins_[count_] = section(begin);
            ++count_;
        }
        ends_[count_ - 1] = section(plane_distance(reach, screen.eye()));
    }

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] const Section& begin(std::size_t i) const { return begins_[i]; }
    [[nodiscard]] const Section& end(std::size_t i) const { return ends_[i]; }
    [[nodiscard]] bool is_whole(std::size_t first, std::size_t last) const {
        return first == 0 && last + 1 == count_;
    }
    // Nothing is in what nothing receives.
    [[nodiscard]] bool is_empty(std::size_t first, std::size_t last) const {
        return first_is_empty_ && first == 0 && last == 0;
    }
    [[nodiscard]] bool has_near_caps(std::size_t first) const {
        return first > 0 || draw_.near_caps;
    }
    [[nodiscard]] bool has_far_caps(std::size_t last) const {
        return last + 1 < count_ || draw_.far_caps;
    }
    [[nodiscard]] ScreenBounds bounds(std::size_t first, std::size_t last) const {
        Aabb box = Aabb::nothing();
        for (std::size_t i = first; i <= last; ++i) box.include(boxes_[i]);
        // Less is received than by all, and so the light's way ends sooner.
        box = hull_.bounds_in(box);
        const ScreenBounds seen = intersection(screen_.of(points(first, last)), draw_.bounds);
        return intersection(screen_.of(box), seen);
    }

    // Of a convex volume every pixel of its picture meets two of its surfaces, once in front and
    // once behind: the sides are what the two ends leave.
    [[nodiscard]] double cost(std::size_t first, std::size_t last) const {
        if (is_empty(first, last)) return 0.0;
        const bool whole = is_whole(first, last);
        const ScreenBounds within = whole ? draw_.bounds : bounds(first, last);
        if (within.empty()) return 0.0;
        const double near = screen_.area_of(begins_[first].points, within);
        const double far = screen_.area_of(ends_[last].points, within);
        const double both = screen_.area_of(points(first, last), within);
        const bool fails = draw_.technique == Technique::DepthFail;
        return std::max(0.0, 2.0 * both - near - far) +
               (fails || has_near_caps(first) ? near : 0.0) + (has_far_caps(last) ? far : 0.0) +
               (whole ? 0.0 : worth_a_draw);
    }

private:
    [[nodiscard]] Section section(std::optional<double> distance) const {
        Section made{distance, {}};
        const glm::dvec3 light(hull_.light());
        for (std::size_t i = 0; i < 8; ++i) {
            const glm::dvec3& corner = hull_.corners()[i];
            glm::dvec3 p = corner;
            if (distance) {
                const glm::dvec3 ray = hull_.light().w == 0.0 ? hull_.axis() : corner - light;
                p += ray *
                     ((*distance - glm::dot(reach_.normal, corner)) / glm::dot(reach_.normal, ray));
            }
            made.points[i] = glm::dvec4(p - screen_.eye(), 1.0);
        }
        return made;
    }
    [[nodiscard]] std::array<glm::dvec4, 16> points(std::size_t first, std::size_t last) const {
        std::array<glm::dvec4, 16> both;
        std::ranges::copy(begins_[first].points, both.begin());
        std::ranges::copy(ends_[last].points, both.begin() + 8);
        return both;
    }

    const VolumeDraw& draw_;
    const ShadowHull& hull_;
    const Reach& reach_;
    const Screen& screen_;
    std::array<Section, most_parts> begins_;
    std::array<Section, most_parts> ends_;
    std::array<Aabb, most_parts> boxes_;  // of what receives
    std::size_t count_ = 1;
    bool first_is_empty_ = false;
};

// For each number of parts, from the first, where the last of the slabs begins that cost least.
std::array<std::size_t, most_parts + 1> cheapest(const Parts& parts) {
    std::array<double, most_parts + 1> least;
    std::array<std::size_t, most_parts + 1> begin{};
    least.fill(std::numeric_limits<double>::infinity());
    least[0] = 0.0;
    for (std::size_t last = 0; last < parts.count(); ++last) {
        // The fewer slabs, the better: from the longest on.
        for (std::size_t first = 0; first <= last; ++first) {
            const double cost = least[first] + parts.cost(first, last);
            if (!(cost < least[last + 1])) continue;
            least[last + 1] = cost;
            begin[last + 1] = first;
        }
    }
    return begin;
}

}  // namespace

void slabs_of(VolumeDraw& draw, const ShadowHull& hull, const Reach& reach, const Screen& screen,
              const glm::dvec4& light, bool scissor) {
    const glm::vec2 shown = draw.bounds.max - draw.bounds.min;
    // Two surfaces everywhere are the most that it draws of itself.
    if (2.0 * shown.x * shown.y < worth_a_draw) return;
    const Parts parts(draw, hull, reach, screen);
    if (parts.count() == 1) return;
    const auto begin = cheapest(parts);
    const auto onto = [&](double distance) {
        return draw.world_from_local *
               projection_onto(plane_in(draw.world_from_local, reach.normal, distance), light);
    };
    for (std::size_t end = parts.count(); end > 0; end = begin[end]) {
        const std::size_t first = begin[end];
        const std::size_t last = end - 1;
        if (parts.is_whole(first, last)) return;
        const ScreenBounds bounds = parts.bounds(first, last);
        if (parts.is_empty(first, last) || bounds.empty()) continue;
        VolumeSlab slab{.world_from_near = draw.world_from_local,
                        .world_from_far = draw.world_from_far,
                        .from_plane = first > 0,
                        .near_caps = parts.has_near_caps(first),
                        .far_caps = parts.has_far_caps(last),
                        .bounds = scissor ? bounds : draw.bounds};
        if (first > 0) slab.world_from_near = onto(*parts.begin(first).distance);
        if (end < parts.count()) slab.world_from_far = onto(*parts.end(last).distance);
        draw.slabs.push_back(slab);
    }
    std::ranges::reverse(draw.slabs);
}

}  // namespace gnomon::shadows::internal
