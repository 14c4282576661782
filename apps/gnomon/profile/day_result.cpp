// SPDX-License-Identifier: MIT
#include "profile/day_result.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "profile/mask_files.hpp"

namespace gnomon::cli {

namespace {

constexpr std::size_t most_outlines = 16;

// Which steps have an outline: those at whole multiples of the least of these minutes that gives
// few enough; where a study begins at an odd minute and none of them gives any, every n-th.
std::vector<bool> outlined_steps(const std::vector<sun_study::Step>& steps) {
    std::vector<bool> outlined(steps.size());
    for (const int minutes : {1, 5, 10, 15, 20, 30, 60, 120, 180}) {
        std::size_t count = 0;
        for (std::size_t s = 0; s < steps.size(); ++s) {
            outlined[s] = steps[s].counts && steps[s].clock.count() % (minutes * 60) == 0;
            count += outlined[s] ? 1 : 0;
        }
        if (count > 1 && count <= most_outlines) return outlined;
    }
    const auto counted = static_cast<std::size_t>(
        std::ranges::count_if(steps, [](const sun_study::Step& step) { return step.counts; }));
    const std::size_t every = (counted + most_outlines - 1) / most_outlines;
    std::size_t number = 0;
    for (std::size_t s = 0; s < steps.size(); ++s) {
        outlined[s] = steps[s].counts && number % every == 0;
        number += steps[s].counts ? 1 : 0;
    }
    return outlined;
}

const char* prefix_of(MaskKind kind) {
    switch (kind) {
        case MaskKind::Before: return "before-";
        case MaskKind::Surface: return "surface-";
        case MaskKind::Plan: break;
    }
    return "";
}

std::vector<sun_study::SurfacePoint> points_of(const std::vector<double>& numbers) {
    std::vector<sun_study::SurfacePoint> points(numbers.size() / numbers_a_point);
    const double* at = numbers.data();
    const auto next = [&] {
        const glm::dvec3 v(at[0], at[1], at[2]);
        at += 3;
        return v;
    };
    for (sun_study::SurfacePoint& point : points) {
        point.at_plan = next();
        point.normal_plan = next();
        point.area_m2 = *at++;
        for (glm::dvec3& corner : point.corners_plan) corner = next();
    }
    return points;
}

}  // namespace

double DayResult::place_of(std::size_t step) const {
    const auto counts = [](const sun_study::Step& s) { return s.counts; };
    const auto first = std::ranges::find_if(steps, counts);
    const auto last = std::find_if(steps.rbegin(), steps.rend(), counts);
    if (first == steps.end() || last->clock == first->clock) return 0.0;
    return static_cast<double>((steps[step].clock - first->clock).count()) /
           static_cast<double>((last->clock - first->clock).count());
}

double DayResult::most_hours() const {
    std::uint64_t sum = 0;
    for (const sun_study::Step& step : steps) sum += step.counts ? step.half_seconds : 0;
    return static_cast<double>(sum) / sun_study::half_seconds_an_hour;
}

std::string mask_name(MaskKind kind, const sun::Date& date, const sun_study::Step& step) {
    std::string clock = sun::clock_text(step.clock);
    std::erase(clock, ':');
    return fmt::format("{}{}T{}.npy", prefix_of(kind), sun::to_text(date), clock);
}

std::string open_mask_name(MaskKind kind) { return fmt::format("{}open.npy", prefix_of(kind)); }

std::string folder_of_date(const Study& study, const sun::Date& date) {
    return study.dates.size() == 1 ? "" : sun::to_text(date);
}

std::vector<double> numbers_of(const std::vector<sun_study::SurfacePoint>& points) {
    std::vector<double> numbers;
    numbers.reserve(points.size() * numbers_a_point);
    const auto add = [&](const glm::dvec3& v) { numbers.insert(numbers.end(), {v.x, v.y, v.z}); };
    for (const sun_study::SurfacePoint& point : points) {
        add(point.at_plan);
        add(point.normal_plan);
        numbers.push_back(point.area_m2);
        for (const glm::dvec3& corner : point.corners_plan) add(corner);
    }
    return numbers;
}

Result<DayResult> gather_day(const Study& study, const sun::Date& date,
                             const std::filesystem::path& masks, MaskKind kind) {
    const sun_study::PlanGrid& grid = study.grid;
    auto steps = steps_of(study, date);
    if (!steps) return forward_error(steps);
    auto open = read_mask(masks / open_mask_name(kind), grid.columns, grid.rows);
    if (!open) return forward_error(open);
    DayResult day;
    day.date = date;
    day.steps = std::move(*steps);
    day.no_sun = why_no_sun(study, date, day.steps);
    day.open = std::move(*open);
    day.hours = sun_study::SunHours(grid.cell_count());
    // A day may have as many steps as seconds.
    static_assert(std::numeric_limits<decltype(day.dark_steps)::value_type>::max() > 86400);
    day.dark_steps.assign(grid.cell_count(), 0);
    day.dark_places.assign(grid.cell_count(), 0.0F);
    const std::vector<bool> outlined = outlined_steps(day.steps);
    for (std::size_t s = 0; s < day.steps.size(); ++s) {
        const sun_study::Step& step = day.steps[s];
        if (!step.counts) continue;
        auto lit = read_mask(masks / mask_name(kind, date, step), grid.columns, grid.rows);
        if (!lit) return forward_error(lit);
        ++day.counted_steps;
        day.hours.add(*lit, step);
        const auto place = static_cast<float>(day.place_of(s));
        for (std::size_t i = 0; i < lit->size(); ++i) {
            if ((*lit)[i] != 0) continue;
            ++day.dark_steps[i];
            day.dark_places[i] += place;
        }
        if (outlined[s]) day.outlines.push_back({s, std::move(*lit)});
    }
    day.summary = sun_study::summarise(day.hours, day.open);
    day.criteria = sun_study::judge_criteria(day.hours, day.open, date, day.steps);
    return day;
}

Result<SurfaceResult> gather_surface(const Study& study, const sun::Date& date,
                                     const std::filesystem::path& masks) {
    const auto steps = steps_of(study, date);
    if (!steps) return forward_error(steps);
    const auto numbers = read_numbers(masks / points_name, numbers_a_point, study.surface_points);
    if (!numbers) return forward_error(numbers);
    SurfaceResult result;
    result.points = points_of(*numbers);
    result.hours = sun_study::SunHours(result.points.size());
    for (const sun_study::Step& step : *steps) {
        if (!step.counts) continue;
        const auto lit =
            read_mask(masks / mask_name(MaskKind::Surface, date, step), study.surface_points, 1);
        if (!lit) return forward_error(lit);
        result.hours.add(*lit, step);
    }
    return result;
}

}  // namespace gnomon::cli
