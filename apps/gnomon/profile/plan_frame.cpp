// SPDX-License-Identifier: MIT
#include "profile/plan_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

namespace gnomon::cli {

namespace {

constexpr double left = 28.0;
constexpr double top = 84.0;
constexpr double right = 232.0;
constexpr double bottom = 86.0;
constexpr double least_side = 420.0;
constexpr double usual_side = 1200.0;
constexpr Color ink{0.13, 0.13, 0.15};
constexpr Color grey{0.42, 0.43, 0.46};

// A disc with an arrow towards true north.
void north_arrow(Canvas& canvas, const glm::dvec2& center, double north_deg) {
    const double bearing = glm::radians(north_deg);
    const glm::dvec2 ahead(std::sin(bearing), -std::cos(bearing));
    const glm::dvec2 aside(-ahead.y, ahead.x);
    constexpr double radius = 30.0;
    canvas.circle(center, radius, grey, 1.0);
    const glm::dvec2 tip = center + ahead * (radius - 3.0);
    const glm::dvec2 tail = center - ahead * (radius - 12.0);
    const glm::dvec2 notch = center - ahead * 8.0;
    canvas.polygon(std::array{tip, tail + aside * 11.0, notch}, ink);
    canvas.polygon(std::array{tip, tail - aside * 11.0, notch}, grey);
    canvas.text(center + ahead * (radius + 13.0) + glm::dvec2(0.0, 5.0), "N",
                {.size = 15.0, .color = ink, .align = Align::Center, .bold = true});
}

// Four fields, dark and light in turn.
void scale_bar(Canvas& canvas, const glm::dvec2& at, double length_m, double pixels_a_metre) {
    constexpr double height = 8.0;
    const double field = length_m * pixels_a_metre / 4.0;
    for (int i = 0; i < 4; ++i) {
        canvas.rectangle(at + glm::dvec2(field * i, 0.0), {field, height},
                         i % 2 == 0 ? ink : Color{1.0, 1.0, 1.0});
    }
    canvas.frame(at, {field * 4.0, height}, ink, 1.0);
    const TextStyle style{.size = 12.0, .align = Align::Center};
    canvas.text(at + glm::dvec2(0.0, height + 16.0), "0", style);
    canvas.text(at + glm::dvec2(field * 2.0, height + 16.0), fmt::format("{:g}", length_m / 2.0),
                style);
    canvas.text(at + glm::dvec2(field * 4.0, height + 16.0), fmt::format("{:g} m", length_m),
                style);
}

}  // namespace

double round_length(double most) {
    const double power = std::pow(10.0, std::floor(std::log10(most)));
    const double factor = most / power;
    return power * (factor >= 5.0 ? 5.0 : factor >= 2.0 ? 2.0 : 1.0);
}

PlanFrame::PlanFrame(const sun_study::PlanGrid& grid) : grid_(grid) {
    const double longer = std::max(grid.columns, grid.rows);
    scale_ = std::max(1.0, std::round(usual_side / longer));
    size_ = glm::dvec2(grid.columns, grid.rows) * scale_;
    // A narrow plan stands in the middle of a picture that its title fits on.
    corner_ = {left + std::floor(std::max(0.0, least_side - size_.x) / 2.0), top};
}

Canvas PlanFrame::canvas() const {
    return {static_cast<std::uint32_t>(left + std::max(size_.x, least_side) + right),
            static_cast<std::uint32_t>(top + std::max(size_.y, least_side) + bottom),
            {1.0, 1.0, 1.0}};
}

glm::dvec2 PlanFrame::legend() const { return {left + std::max(size_.x, least_side) + 24.0, top}; }

void PlanFrame::draw(Canvas& canvas, const Study& study, const std::string& title,
                     const std::string& subtitle) const {
    canvas.frame(corner_, size_, grey, 1.0);
    canvas.text({left, 36.0}, title, {.size = 22.0, .bold = true});
    canvas.text({left, 62.0}, subtitle, {.size = 14.0, .color = grey});
    const double pixels_a_metre = scale_ / grid_.cell_m;
    const glm::dvec2 below = corner_ + glm::dvec2(0.0, size_.y);
    scale_bar(canvas, below + glm::dvec2(8.0, 20.0),
              round_length(std::max(size_.x / 3.0, 120.0) / pixels_a_metre), pixels_a_metre);
    const glm::dvec2 max = grid_.max_m();
    canvas.text(
        below + glm::dvec2(0.0, 66.0),
        fmt::format("x {:.1f} \u2026 {:.1f} m, y {:.1f} \u2026 {:.1f} m, plane at {:.2f} m, "
                    "cells of {:g} m",
                    grid_.min_m.x, max.x, grid_.min_m.y, max.y, grid_.height_m, grid_.cell_m),
        {.size = 12.0, .color = grey});
    north_arrow(canvas, legend() + glm::dvec2(60.0, std::max(size_.y, least_side) - 20.0),
                study.north_deg);
}

std::string PlanFrame::world_file() const {
    const double pixel_m = grid_.cell_m / scale_;
    return fmt::format("{:.12g}\n0\n0\n{:.12g}\n{:.9f}\n{:.9f}\n", pixel_m, -pixel_m,
                       grid_.min_m.x + (0.5 - corner_.x) * pixel_m,
                       grid_.max_m().y - (0.5 - corner_.y) * pixel_m);
}

}  // namespace gnomon::cli
