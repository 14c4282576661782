// SPDX-License-Identifier: MIT
#include "internal/footprint.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "internal/finite.hpp"

namespace gnomon::shadows::internal {

namespace {

// Sums over places 0 .. size - 1: ranges are added to, the largest sum is asked for.
class Sums {
public:
    explicit Sums(std::size_t size)
        : leaves_(std::bit_ceil(std::max<std::size_t>(size, 1))), nodes_(2 * leaves_) {}

    void add(std::size_t first, std::size_t last, std::int64_t layers) {
        add(1, 0, leaves_ - 1, first, last, layers);
    }
    [[nodiscard]] std::int64_t most() const { return nodes_[1].most; }

private:
    struct Node {
        std::int64_t added = 0;  // to all places below
        std::int64_t most = 0;   // of them, `added` included
    };

    void add(std::size_t node, std::size_t low, std::size_t high, std::size_t first,
             std::size_t last, std::int64_t layers) {
        if (last < low || high < first) return;
        Node& n = nodes_[node];
        if (first <= low && high <= last) {
            n.added += layers;
            n.most += layers;
            return;
        }
        const std::size_t middle = low + (high - low) / 2;
        add(2 * node, low, middle, first, last, layers);
        add(2 * node + 1, middle + 1, high, first, last, layers);
        n.most = n.added + std::max(nodes_[2 * node].most, nodes_[2 * node + 1].most);
    }

    std::size_t leaves_;
    std::vector<Node> nodes_;
};

std::uint64_t most_in_one_picture(std::span<const Footprint* const> rectangles) {
    std::vector<double> heights;
    struct Event {
        double x;
        bool ends;  // after the beginnings at the same place: rectangles are closed
        const Footprint* rectangle;
    };
    std::vector<Event> events;
    heights.reserve(2 * rectangles.size());
    events.reserve(2 * rectangles.size());
    for (const Footprint* r : rectangles) {
        heights.insert(heights.end(), {r->low.y, r->high.y});
        events.push_back({r->low.x, false, r});
        events.push_back({r->high.x, true, r});
    }
    std::sort(heights.begin(), heights.end());
    heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
    std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
        return a.x != b.x ? a.x < b.x : a.ends < b.ends;
    });
    const auto place = [&](double y) {
        return static_cast<std::size_t>(std::lower_bound(heights.begin(), heights.end(), y) -
                                        heights.begin());
    };
    Sums sums(heights.size());
    std::int64_t most = 0;
    for (const Event& event : events) {
        const std::int64_t layers = event.rectangle->layers;
        sums.add(place(event.rectangle->low.y), place(event.rectangle->high.y),
                 event.ends ? -layers : layers);
        most = std::max(most, sums.most());
    }
    return static_cast<std::uint64_t>(most);
}

// Outward by more than the arithmetic of the corners rounds.
Footprint widened(std::uint32_t picture, const glm::dvec2& low, const glm::dvec2& high,
                  double magnitude, std::uint32_t layers) {
    const double room = 1e-9 * ((high.x - low.x) + (high.y - low.y)) + 1e-14 * magnitude;
    return {picture, low - room, high + room, layers};
}

}  // namespace

void append_footprints(const OrientedBounds& bounds, const glm::dvec4& light_world,
                       std::uint32_t layers, std::vector<Footprint>& out) {
    auto corners = corners_of(bounds);
    const glm::dvec3 light(light_world);
    double magnitude = light_world.w == 0.0 ? 0.0 : glm::length(light);
    for (const glm::dvec3& c : corners) magnitude = std::max(magnitude, glm::length(c));
    // A pose whose products overflow covers everything.
    const bool finite = std::all_of(corners.begin(), corners.end(),
                                    [](const glm::dvec3& c) { return is_finite(c); });
    if (!finite || !std::isfinite(magnitude)) {
        constexpr double most = std::numeric_limits<double>::max();
        for (std::uint32_t picture = 0; picture < (light_world.w == 0.0 ? 1U : 6U); ++picture) {
            out.push_back({picture, glm::dvec2(-most), glm::dvec2(most), layers});
        }
        return;
    }
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high(-low);

    if (light_world.w == 0.0) {
        const glm::dvec3 forward = glm::normalize(light);
        const glm::dvec3 other =
            std::abs(forward.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
        const glm::dvec3 right = glm::normalize(glm::cross(other, forward));
        const glm::dvec3 up = glm::cross(forward, right);
        for (const glm::dvec3& c : corners) {
            const glm::dvec2 p(glm::dot(c, right), glm::dot(c, up));
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        out.push_back(widened(0, low, high, magnitude, layers));
        return;
    }
    for (glm::dvec3& c : corners) c -= light;
    const double room = 1e-14 * magnitude;  // of the corners, and to call one in front
    for (std::uint32_t picture = 0; picture < 6; ++picture) {
        const int axis = static_cast<int>(picture % 3);
        const double sign = picture < 3 ? 1.0 : -1.0;
        double nearest = std::numeric_limits<double>::infinity();
        double farthest = -nearest;
        low = glm::dvec2(std::numeric_limits<double>::infinity());
        high = -low;
        for (const glm::dvec3& c : corners) {
            const double depth = sign * c[axis];
            nearest = std::min(nearest, depth);
            farthest = std::max(farthest, depth);
            const glm::dvec2 p = glm::dvec2(c[(axis + 1) % 3], c[(axis + 2) % 3]) / depth;
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        if (farthest < -room) continue;  // all of it is behind
        bool beside = false;
        for (const int across : {(axis + 1) % 3, (axis + 2) % 3}) {
            for (const double direction : {-1.0, 1.0}) {
                beside = beside || std::all_of(corners.begin(), corners.end(), [&](const auto& c) {
                             return direction * c[across] > sign * c[axis] + 4.0 * room;
                         });
            }
        }
        if (beside) continue;
        if (nearest <= 1e-6 * farthest || nearest <= 1e6 * room) {
            out.push_back({picture, glm::dvec2(-1.0), glm::dvec2(1.0), layers});
            continue;
        }
        const Footprint whole = widened(picture, low, high, 1e8, layers);
        const glm::dvec2 from = glm::max(whole.low, glm::dvec2(-1.0));
        const glm::dvec2 to = glm::min(whole.high, glm::dvec2(1.0));
        if (from.x <= to.x && from.y <= to.y) out.push_back({picture, from, to, layers});
    }
}

std::uint64_t most_layers(std::span<const Footprint> footprints) {
    std::uint64_t most = 0;
    for (std::uint32_t picture = 0; picture < 6; ++picture) {
        std::vector<const Footprint*> rectangles;
        for (const Footprint& f : footprints) {
            if (f.picture == picture) rectangles.push_back(&f);
        }
        if (!rectangles.empty()) most = std::max(most, most_in_one_picture(rectangles));
    }
    return most;
}

}  // namespace gnomon::shadows::internal
