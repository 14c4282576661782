// SPDX-License-Identifier: MIT
#include <gnomon/shadows/screen_bounds.hpp>

#include <cmath>

namespace gnomon::shadows {

PixelRect pixels_of(const ScreenBounds& bounds, std::uint32_t width, std::uint32_t height) {
    if (bounds.empty()) return {};
    constexpr double room = 2.0;
    const auto place = [](double low, double high, std::uint32_t size) {
        const double half = 0.5 * size;
        const double first = std::floor((low + 1.0) * half - room);
        const double last = std::ceil((high + 1.0) * half + room);
        const auto from = static_cast<std::uint32_t>(std::clamp(first, 0.0, 1.0 * size));
        const auto to = static_cast<std::uint32_t>(std::clamp(last, 0.0, 1.0 * size));
        return glm::uvec2(from, to - from);
    };
    const glm::uvec2 x = place(bounds.min.x, bounds.max.x, width);
    const glm::uvec2 y = place(-bounds.max.y, -bounds.min.y, height);
    if (x[1] == 0 || y[1] == 0) return {};
    return {x[0], y[0], x[1], y[1]};
}

}  // namespace gnomon::shadows
