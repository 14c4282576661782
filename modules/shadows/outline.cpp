// SPDX-License-Identifier: MIT
#include "internal/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace gnomon::shadows::internal {

namespace {

// Of as many points as may come: those of two planes' boxes, and their lines through a third.
constexpr std::size_t most_points = 32 + 16 * 16;

double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Where one coordinate, times a sign, is no more than a limit.
class HalfPlane {
public:
    HalfPlane(int axis, double sign, double limit) : axis_(axis), sign_(sign), limit_(limit) {}
    [[nodiscard]] double beyond(const glm::dvec2& p) const { return sign_ * p[axis_] - limit_; }

private:
    int axis_;
    double sign_;
    double limit_;
};

class Outline {
public:
    // Counter-clockwise, from sorted points.
    explicit Outline(std::span<const glm::dvec2> sorted) {
        for (const glm::dvec2& p : sorted) add_convex(p, 0);
        const std::size_t lower = count_ > 0 ? count_ - 1 : 0;
        for (std::size_t i = sorted.size(); i-- > 0;) add_convex(sorted[i], lower);
        if (count_ > 0) --count_;  // the first, again
    }

    // After I. E. Sutherland and G. W. Hodgman, "Reentrant Polygon Clipping" (1974).
    void cut(const HalfPlane& half) {
        std::array<glm::dvec2, capacity> whole;
        const std::size_t count = count_;
        std::copy_n(points_.begin(), count, whole.begin());
        count_ = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec2& a = whole[i];
            const glm::dvec2& b = whole[(i + 1) % count];
            const double of_a = half.beyond(a);
            const double of_b = half.beyond(b);
            if (of_a <= 0.0) points_[count_++] = a;
            if ((of_a < 0.0 && of_b > 0.0) || (of_a > 0.0 && of_b < 0.0)) {
                points_[count_++] = a + (b - a) * (of_a / (of_a - of_b));
            }
        }
    }

    [[nodiscard]] double area() const {
        double twice = 0.0;
        for (std::size_t i = 2; i < count_; ++i) {
            twice += turn(points_[0], points_[i - 1], points_[i]);
        }
        return 0.5 * twice;
    }

private:
    void add_convex(const glm::dvec2& p, std::size_t keep) {
        while (count_ >= keep + 2 && !(turn(points_[count_ - 2], points_[count_ - 1], p) > 0.0)) {
            --count_;
        }
        points_[count_++] = p;
    }

    static constexpr std::size_t capacity = 2 * most_points + 8;
    std::array<glm::dvec2, capacity> points_;
    std::size_t count_ = 0;
};

}  // namespace

double hull_area_within(std::span<glm::dvec2> points, const glm::dvec2& low,
                        const glm::dvec2& high) {
    points = points.first(std::min(points.size(), most_points));
    std::ranges::sort(points, [](const glm::dvec2& a, const glm::dvec2& b) {
        return a.x != b.x ? a.x < b.x : a.y < b.y;
    });
    Outline outline(points);
    outline.cut({0, -1.0, -low.x});
    outline.cut({0, 1.0, high.x});
    outline.cut({1, -1.0, -low.y});
    outline.cut({1, 1.0, high.y});
    return outline.area();
}

}  // namespace gnomon::shadows::internal
