// SPDX-License-Identifier: MIT
#include "profile/plan_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "profile/color_bar.hpp"
#include "profile/plan_frame.hpp"

namespace gnomon::cli {

namespace {

// From the morning to the evening.
constexpr std::array<Color, 5> day_colors{{{0.13, 0.30, 0.62},
                                           {0.10, 0.60, 0.62},
                                           {0.45, 0.69, 0.22},
                                           {0.95, 0.61, 0.14},
                                           {0.76, 0.20, 0.22}}};
// From hours lost to hours gained.
constexpr std::array<Color, 5> change_colors{{{0.45, 0.05, 0.10},
                                              {0.90, 0.45, 0.35},
                                              {0.97, 0.97, 0.97},
                                              {0.40, 0.62, 0.85},
                                              {0.05, 0.20, 0.50}}};
constexpr Color covered{0.62, 0.64, 0.67};
constexpr Color white{1.0, 1.0, 1.0};
constexpr Color ink{0.13, 0.13, 0.15};

std::string day_subtitle(const Study& study, const DayResult& day) {
    return fmt::format("{}, {} to {} ({}), every {:g} min, {:.5g}\u00b0 {}, {:.5g}\u00b0 {}",
                       sun::to_text(day.date), sun::clock_text(day.steps.front().clock),
                       sun::clock_text(day.steps.back().clock), sun::offset_text(study.offset),
                       static_cast<double>(study.step.count()) / 60.0, std::abs(study.latitude_deg),
                       study.latitude_deg < 0.0 ? "S" : "N", std::abs(study.longitude_deg),
                       study.longitude_deg < 0.0 ? "W" : "E");
}

void swatch(Canvas& canvas, const glm::dvec2& at, const Color& color, const std::string& text) {
    canvas.rectangle(at, {26.0, 14.0}, color);
    canvas.frame(at, {26.0, 14.0}, ink.with_alpha(0.4), 1.0);
    canvas.text(at + glm::dvec2(36.0, 12.0), text, {.size = 13.0});
}

// The sides between cells that are dark and cells that are not.
std::vector<glm::dvec2> outline_of(const PlanFrame& frame, const sun_study::PlanGrid& grid,
                                   const sun_study::PlanMask& lit) {
    std::vector<glm::dvec2> points;
    const auto at = [&](std::uint32_t column, std::uint32_t row) {
        return lit[std::size_t{row} * grid.columns + column];
    };
    const auto add = [&](double c0, double r0, double c1, double r1) {
        points.push_back(frame.pixel(c0, r0));
        points.push_back(frame.pixel(c1, r1));
    };
    for (std::uint32_t row = 0; row < grid.rows; ++row) {
        for (std::uint32_t column = 0; column < grid.columns; ++column) {
            if (column + 1 < grid.columns && at(column, row) != at(column + 1, row)) {
                add(column + 1, row, column + 1, row + 1);
            }
            if (row + 1 < grid.rows && at(column, row) != at(column, row + 1)) {
                add(column, row + 1, column + 1, row + 1);
            }
        }
    }
    return points;
}

// Marching squares between the cells' centres, where all four are open.
std::vector<glm::dvec2> contour_of(const PlanFrame& frame, const sun_study::PlanGrid& grid,
                                   const DayResult& day, double level_h) {
    std::vector<glm::dvec2> points;
    // A hair below: cells that have exactly as many hours as the level count as inside.
    const double level = level_h - 1e-6;
    for (std::uint32_t row = 0; row + 1 < grid.rows; ++row) {
        for (std::uint32_t column = 0; column + 1 < grid.columns; ++column) {
            const std::size_t i = std::size_t{row} * grid.columns + column;
            const std::array<std::size_t, 4> cells{i, i + 1, i + 1 + grid.columns,
                                                   i + grid.columns};
            if (std::ranges::any_of(cells, [&](std::size_t c) { return day.open[c] == 0; })) {
                continue;
            }
            constexpr std::array<glm::dvec2, 4> offsets{
                {{0.5, 0.5}, {1.5, 0.5}, {1.5, 1.5}, {0.5, 1.5}}};
            std::array<glm::dvec2, 4> crossings;
            std::size_t count = 0;
            for (std::size_t k = 0; k < 4; ++k) {
                const std::size_t n = (k + 1) % 4;
                const double a = day.hours.hours(cells[k]) - level;
                const double b = day.hours.hours(cells[n]) - level;
                if ((a >= 0.0) == (b >= 0.0)) continue;
                const glm::dvec2 p = glm::mix(offsets[k], offsets[n], a / (a - b));
                crossings[count++] = frame.pixel(column + p.x, row + p.y);
            }
            // Four crossings: a saddle, joined one way or the other.
            for (std::size_t k = 0; k + 1 < count; k += 2) {
                points.push_back(crossings[k]);
                points.push_back(crossings[k + 1]);
            }
        }
    }
    return points;
}

}  // namespace

std::optional<double> hours_gained(const DayResult& day, const DayResult& before,
                                   std::size_t cell) {
    if (day.open[cell] == 0 || before.open[cell] == 0) return std::nullopt;
    return day.hours.hours(cell) - before.hours.hours(cell);
}

Result<PlanPicture> draw_profile(const Study& study, const DayResult& day) {
    const sun_study::PlanGrid& grid = study.grid;
    const PlanFrame frame(grid);
    Canvas canvas = frame.canvas();
    std::vector<Color> colors(grid.cell_count(), white);
    for (std::size_t i = 0; i < colors.size(); ++i) {
        if (day.open[i] == 0) {
            colors[i] = covered;
        } else if (day.dark_steps[i] > 0) {
            const double share = day.dark_steps[i] / static_cast<double>(day.counted_steps);
            const double place = day.dark_places[i] / static_cast<double>(day.dark_steps[i]);
            colors[i] = mix(white, ramp(day_colors, place), 0.12 + 0.55 * share);
        }
    }
    canvas.cells(frame.corner(), colors, grid.columns, frame.scale());
    const glm::dvec2 legend = frame.legend();
    const bool has_sun = day.no_sun.empty();
    canvas.text(legend + glm::dvec2(0.0, 14.0),
                has_sun ? "Outline of the shadow at" : "No sun on this day",
                {.size = 13.0, .bold = true});
    double y = 28.0;
    for (const ProfileStep& outline : day.outlines) {
        const Color color = ramp(day_colors, day.place_of(outline.step));
        canvas.segments(outline_of(frame, grid, outline.lit), color, 1.6);
        swatch(canvas, legend + glm::dvec2(0.0, y), color,
               sun::clock_text(day.steps[outline.step].clock));
        y += 20.0;
    }
    y += 8.0;
    swatch(canvas, legend + glm::dvec2(0.0, y), covered, "under a roof");
    if (has_sun) {
        canvas.text(legend + glm::dvec2(0.0, y + 36.0), "Areas: the deeper the colour,",
                    {.size = 12.0});
        canvas.text(legend + glm::dvec2(0.0, y + 52.0), "the longer in shadow", {.size = 12.0});
    }
    frame.draw(canvas, study, "Shadow profile: " + study.model, day_subtitle(study, day));
    auto png = canvas.png();
    if (!png) return forward_error(png);
    return PlanPicture{std::move(*png), frame.world_file()};
}

Result<PlanPicture> draw_hours(const Study& study, const DayResult& day) {
    const sun_study::PlanGrid& grid = study.grid;
    const PlanFrame frame(grid);
    Canvas canvas = frame.canvas();
    const double most_h = day.most_hours();
    std::vector<Color> colors(grid.cell_count(), covered);
    for (std::size_t i = 0; i < colors.size(); ++i) {
        if (day.open[i] != 0) colors[i] = heat_color(day.hours.hours(i), most_h);
    }
    canvas.cells(frame.corner(), colors, grid.columns, frame.scale());
    const double tick = hour_tick(most_h);
    for (double h = tick; h <= most_h + 1e-9; h += tick) {
        canvas.segments(contour_of(frame, grid, day, h), white.with_alpha(0.55), 1.0);
    }
    const glm::dvec2 legend = frame.legend();
    canvas.text(legend + glm::dvec2(0.0, 14.0), "Hours of sun", {.size = 13.0, .bold = true});
    const double bar =
        most_h > 0.0 ? std::min(320.0, std::max(frame.size().y, 420.0) - 180.0) : 0.0;
    color_bar(canvas, legend + glm::dvec2(0.0, 30.0), bar, heat_colors, 0.0, most_h);
    swatch(canvas, legend + glm::dvec2(0.0, bar + 48.0), covered, "under a roof");
    canvas.text(legend + glm::dvec2(0.0, bar + 86.0),
                most_h > 0.0 ? fmt::format("lines every {:g} h", tick) : "no sun on this day",
                {.size = 12.0});
    canvas.text(legend + glm::dvec2(0.0, bar + 104.0),
                fmt::format("mean {:.2f} h", day.summary.mean_h), {.size = 12.0});
    frame.draw(canvas, study, "Sun hours: " + study.model, day_subtitle(study, day));
    auto png = canvas.png();
    if (!png) return forward_error(png);
    return PlanPicture{std::move(*png), frame.world_file()};
}

Result<PlanPicture> draw_difference(const Study& study, const DayResult& day,
                                    const DayResult& before) {
    const sun_study::PlanGrid& grid = study.grid;
    const PlanFrame frame(grid);
    Canvas canvas = frame.canvas();
    double most_h = 0.0;
    for (std::size_t i = 0; i < grid.cell_count(); ++i) {
        most_h = std::max(most_h, std::abs(hours_gained(day, before, i).value_or(0.0)));
    }
    most_h = std::max(std::ceil(most_h), 1.0);
    std::vector<Color> colors(grid.cell_count(), covered);
    for (std::size_t i = 0; i < colors.size(); ++i) {
        if (const auto gained = hours_gained(day, before, i)) {
            colors[i] = ramp(change_colors, 0.5 + 0.5 * *gained / most_h);
        }
    }
    canvas.cells(frame.corner(), colors, grid.columns, frame.scale());
    const glm::dvec2 legend = frame.legend();
    canvas.text(legend + glm::dvec2(0.0, 14.0), "Hours of sun gained",
                {.size = 13.0, .bold = true});
    const double bar = std::min(320.0, std::max(frame.size().y, 420.0) - 180.0);
    color_bar(canvas, legend + glm::dvec2(0.0, 30.0), bar, change_colors, -most_h, most_h);
    swatch(canvas, legend + glm::dvec2(0.0, bar + 48.0), covered, "under a roof,");
    canvas.text(legend + glm::dvec2(36.0, bar + 76.0), "before or now", {.size = 13.0});
    frame.draw(canvas, study, fmt::format("Change: {} against {}", study.model, study.before),
               day_subtitle(study, day));
    auto png = canvas.png();
    if (!png) return forward_error(png);
    return PlanPicture{std::move(*png), frame.world_file()};
}

}  // namespace gnomon::cli
