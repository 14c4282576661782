// SPDX-License-Identifier: MIT
#include "profile/color_bar.hpp"

#include <cmath>

#include <fmt/format.h>

namespace gnomon::cli {

double hour_tick(double hours) { return hours <= 6.0 ? 1.0 : hours <= 16.0 ? 2.0 : 4.0; }

Color heat_color(double hours, double most_h) {
    return most_h > 0.0 ? ramp(heat_colors, hours / most_h) : heat_colors.front();
}

void color_bar(Canvas& canvas, const glm::dvec2& at, double height, std::span<const Color> colors,
               double least_h, double most_h) {
    if (!(most_h > least_h)) return;
    constexpr double width = 26.0;
    constexpr Color ink{0.13, 0.13, 0.15};
    const int pieces = static_cast<int>(height);
    for (int i = 0; i < pieces; ++i) {
        canvas.rectangle(at + glm::dvec2(0.0, i), {width, 1.5},
                         ramp(colors, 1.0 - (i + 0.5) / pieces));
    }
    canvas.frame(at, {width, height}, ink, 1.0);
    const double tick = hour_tick(most_h - least_h);
    for (double h = std::ceil(least_h / tick) * tick; h <= most_h + 1e-9; h += tick) {
        const double y = at.y + height * (most_h - h) / (most_h - least_h);
        canvas.segments(std::array{glm::dvec2(at.x + width, y), glm::dvec2(at.x + width + 5.0, y)},
                        ink, 1.0);
        canvas.text({at.x + width + 10.0, y + 5.0}, fmt::format("{:g} h", h + 0.0), {.size = 13.0});
    }
}

}  // namespace gnomon::cli
