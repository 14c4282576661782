// SPDX-License-Identifier: MIT
#include "internal/distance_transform.hpp"

#include <algorithm>
#include <limits>

#include <gnomon/core/expects.hpp>

namespace gnomon::truth::internal {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The lower envelope of the parabolas (x - q)^2 + f(q), one line after the other. Infinite f(q)
/// have no parabola, which also keeps infinities out of the intersections.
class LineTransform {
public:
    explicit LineTransform(std::size_t longest) : f_(longest), apex_(longest), from_(longest + 1) {}

    /// In place: values[i * stride] for i < count.
    void apply(double* values, std::size_t stride, std::size_t count) {
        std::size_t parabolas = 0;
        for (std::size_t q = 0; q < count; ++q) {
            f_[q] = values[q * stride];
            if (f_[q] == infinite) continue;
            double from = -infinite;
            while (parabolas > 0) {
                from = intersection(apex_[parabolas - 1], q);
                if (from > from_[parabolas - 1]) break;
                --parabolas;
                from = -infinite;
            }
            apex_[parabolas] = q;
            from_[parabolas] = from;
            ++parabolas;
        }
        if (parabolas == 0) return;
        from_[parabolas] = infinite;
        std::size_t k = 0;
        for (std::size_t x = 0; x < count; ++x) {
            const auto place = static_cast<double>(x);
            while (from_[k + 1] < place) ++k;
            const double away = place - static_cast<double>(apex_[k]);
            values[x * stride] = away * away + f_[apex_[k]];
        }
    }

private:
    [[nodiscard]] double intersection(std::size_t left, std::size_t right) const {
        const auto l = static_cast<double>(left);
        const auto r = static_cast<double>(right);
        return ((f_[right] + r * r) - (f_[left] + l * l)) / (2.0 * (r - l));
    }

    std::vector<double> f_;
    std::vector<std::size_t> apex_;  // of each parabola of the envelope
    std::vector<double> from_;       // where it begins to be the lowest
};

}  // namespace

std::vector<double> squared_distances(std::span<const std::uint8_t> sites, std::uint32_t width,
                                      std::uint32_t height) {
    GNOMON_EXPECTS(sites.size() == std::size_t{width} * height);
    std::vector<double> distances(sites.size());
    for (std::size_t i = 0; i < sites.size(); ++i) distances[i] = sites[i] != 0 ? 0.0 : infinite;
    LineTransform transform(std::max(width, height));
    for (std::size_t x = 0; x < width; ++x) transform.apply(&distances[x], width, height);
    for (std::size_t y = 0; y < height; ++y) transform.apply(&distances[y * width], 1, width);
    return distances;
}

}  // namespace gnomon::truth::internal
