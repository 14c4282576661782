// SPDX-License-Identifier: MIT
#include "profile/study_files.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <span>
#include <system_error>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include "profile/mask_files.hpp"
#include "profile/plan_pictures.hpp"
#include "profile/study_page.hpp"
#include "profile/sun_path.hpp"

namespace gnomon::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::array<double, 4> share_hours{1.5, 2.0, 3.0, 4.0};

// Of one model, over the cells that are open under it.
nlohmann::json figures_of(const Study& study, const DayResult& day) {
    nlohmann::json shares = nlohmann::json::array();
    for (const double h : share_hours) {
        shares.push_back({{"hours", h}, {"share", sun_study::share_with(day.hours, day.open, h)}});
    }
    const double cell_m2 = study.grid.cell_m * study.grid.cell_m;
    return {{"open_cells", day.summary.open_cells},
            {"open_m2", static_cast<double>(day.summary.open_cells) * cell_m2},
            {"hours",
             {{"possible", day.most_hours()},
              {"min", day.summary.min_h},
              {"mean", day.summary.mean_h},
              {"max", day.summary.max_h}}},
            {"share_at_least", std::move(shares)}};
}

// By area, as a wall is judged: patches differ in size.
nlohmann::json figures_of(const SurfaceResult& surfaces) {
    double area = 0.0;
    double sum = 0.0;
    std::array<double, share_hours.size()> enough{};
    for (std::size_t i = 0; i < surfaces.points.size(); ++i) {
        const double patch = surfaces.points[i].area_m2;
        const double hours = surfaces.hours.hours(i);
        area += patch;
        sum += patch * hours;
        for (std::size_t k = 0; k < share_hours.size(); ++k) {
            enough[k] += hours >= share_hours[k] ? patch : 0.0;
        }
    }
    nlohmann::json shares = nlohmann::json::array();
    for (std::size_t k = 0; k < share_hours.size(); ++k) {
        shares.push_back({{"hours", share_hours[k]}, {"share", enough[k] / area}});
    }
    return {{"points", surfaces.points.size()},
            {"area_m2", area},
            {"mean_hours", sum / area},
            {"share_at_least", std::move(shares)}};
}

std::string surfaces_csv(const SurfaceResult& surfaces) {
    fmt::memory_buffer text;
    fmt::format_to(std::back_inserter(text), "x_m,y_m,height_m,nx,ny,nz,area_m2,hours\n");
    for (std::size_t i = 0; i < surfaces.points.size(); ++i) {
        const sun_study::SurfacePoint& p = surfaces.points[i];
        fmt::format_to(std::back_inserter(text),
                       "{:.3f},{:.3f},{:.3f},{:.4f},{:.4f},{:.4f},{:.5g},{:.6g}\n", p.at_plan.x,
                       p.at_plan.y, p.at_plan.z, p.normal_plan.x, p.normal_plan.y, p.normal_plan.z,
                       p.area_m2, surfaces.hours.hours(i));
    }
    return fmt::to_string(text);
}

std::string summary_json(const Study& study, const DayResult& day, const DayResult* before,
                         const SurfaceResult* surfaces) {
    using nlohmann::json;
    json criteria = json::array();
    for (const sun_study::Criterion& c : day.criteria) {
        json one{{"id", c.id},
                 {"rule", c.rule},
                 {"hours", c.hours},
                 {"share", c.share},
                 {"applies", c.objection.empty()}};
        if (!c.objection.empty()) one["objection"] = c.objection;
        if (c.share_needed > 0.0) {
            one["share_needed"] = c.share_needed;
            if (c.objection.empty()) one["met"] = c.met;
        }
        criteria.push_back(std::move(one));
    }
    json steps = json::array();
    for (const sun_study::Step& step : day.steps) {
        json one{{"clock", sun::clock_text(step.clock)},
                 {"utc", sun::to_text(step.utc)},
                 {"azimuth_deg", glm::degrees(step.sun.azimuth_rad)},
                 {"altitude_deg", glm::degrees(step.sun.altitude_rad)},
                 {"hours", step.half_seconds / sun_study::half_seconds_an_hour},
                 {"counts", step.counts},
                 {"outlined", std::ranges::any_of(day.outlines, [&](const ProfileStep& outline) {
                      return &day.steps[outline.step] == &step;
                  })}};
        if (step.counts) one["mask"] = "masks/" + mask_name(MaskKind::Plan, day.date, step);
        steps.push_back(std::move(one));
    }
    json summary = figures_of(study, day);
    summary["date"] = sun::to_text(day.date);
    if (!day.no_sun.empty()) summary["no_sun"] = day.no_sun;
    summary["study"] = to_json(study);
    summary["cells"] = study.grid.cell_count();
    summary["criteria"] = std::move(criteria);
    summary["steps"] = std::move(steps);
    if (before != nullptr) summary["before"] = figures_of(study, *before);
    if (surfaces != nullptr) summary["surfaces"] = figures_of(*surfaces);
    return summary.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

// One line a row of cells, the uppermost first; nothing under a roof.
std::string hours_csv(const Study& study, const DayResult& day, const DayResult* before) {
    fmt::memory_buffer text;
    for (std::uint32_t row = 0; row < study.grid.rows; ++row) {
        for (std::uint32_t column = 0; column < study.grid.columns; ++column) {
            const std::size_t cell = std::size_t{row} * study.grid.columns + column;
            if (column > 0) text.push_back(',');
            if (before != nullptr) {
                if (const auto gained = hours_gained(day, *before, cell)) {
                    fmt::format_to(std::back_inserter(text), "{:.6g}", *gained);
                }
            } else if (day.open[cell] != 0) {
                fmt::format_to(std::back_inserter(text), "{:.6g}", day.hours.hours(cell));
            }
        }
        text.push_back('\n');
    }
    return fmt::to_string(text);
}

struct DayParts {
    DayResult day;
    std::optional<DayResult> before;
    std::optional<SurfaceResult> surfaces;
};

Result<DayParts> gather(const Study& study, const sun::Date& date, const fs::path& masks) {
    DayParts parts;
    auto day = gather_day(study, date, masks);
    if (!day) return forward_error(day);
    parts.day = std::move(*day);
    if (!study.before.empty()) {
        auto before = gather_day(study, date, masks, MaskKind::Before);
        if (!before) return forward_error(before);
        parts.before = std::move(*before);
    }
    if (study.surface_points > 0) {
        auto surfaces = gather_surface(study, date, masks);
        if (!surfaces) return forward_error(surfaces);
        parts.surfaces = std::move(*surfaces);
    }
    return parts;
}

Status add_picture(OutputFiles& files, const fs::path& folder, const std::string& name,
                   const Result<PlanPicture>& picture) {
    if (!picture) return forward_error(picture);
    const Status png = files.add(folder / (name + ".png"), picture->png);
    return png ? files.add(folder / (name + ".pgw"), picture->world_file) : png;
}

// For the whole scene: none where no such picture is asked for.
Result<std::vector<PlanCorners>> casters_for(const PictureCamera& camera, const fs::path& masks) {
    std::vector<PlanCorners> casters;
    std::error_code error;
    if (!camera.eye_plan || !fs::exists(masks / casters_name, error)) return casters;
    const auto numbers = read_all_numbers(masks / casters_name, numbers_a_face);
    if (!numbers) return forward_error(numbers);
    for (std::size_t i = 0; i + numbers_a_face <= numbers->size(); i += numbers_a_face) {
        const double* at = numbers->data() + i;
        casters.push_back({{{at[0], at[1], at[2]}, {at[3], at[4], at[5]}, {at[6], at[7], at[8]}}});
    }
    return casters;
}

Status write_day(const Study& study, const DayParts& parts, const fs::path& folder,
                 const PictureCamera& camera, std::span<const PlanCorners> casters) {
    const DayResult& day = parts.day;
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
        return fail(ErrorCode::Io,
                    fmt::format("{} cannot be made: {}.", folder.string(), error.message()));
    }
    OutputFiles files;
    for (const Status& added : {add_picture(files, folder, "profile", draw_profile(study, day)),
                                add_picture(files, folder, "hours", draw_hours(study, day)),
                                files.add(folder / "hours.csv", hours_csv(study, day, nullptr))}) {
        if (!added) return added;
    }
    const DayResult* before = parts.before ? &*parts.before : nullptr;
    if (before != nullptr) {
        for (const Status& added :
             {add_picture(files, folder, "difference", draw_difference(study, day, *before)),
              files.add(folder / "difference.csv", hours_csv(study, day, before))}) {
            if (!added) return added;
        }
    }
    const SurfaceResult* surfaces = parts.surfaces ? &*parts.surfaces : nullptr;
    if (surfaces != nullptr) {
        const auto picture = draw_surfaces(study, *surfaces, day.date, day.most_hours(), camera);
        if (!picture) return forward_error(picture);
        for (const Status& added : {files.add(folder / "surfaces.png", *picture),
                                    files.add(folder / "surfaces.csv", surfaces_csv(*surfaces))}) {
            if (!added) return added;
        }
    }
    if (!casters.empty()) {
        const auto picture = draw_scene(study, day, surfaces, casters, camera);
        if (!picture) return forward_error(picture);
        const Status added = files.add(folder / "scene.png", *picture);
        if (!added) return added;
    }
    const Status summary =
        files.add(folder / "summary.json", summary_json(study, day, before, surfaces));
    if (!summary) return summary;
    return files.commit();
}

}  // namespace

Status write_study(const Study& study, const fs::path& out, const PictureCamera& camera) {
    const auto casters = casters_for(camera, out / "masks");
    if (!casters) return forward_error(casters);
    std::vector<PageDay> page_days;
    for (const sun::Date& date : study.dates) {
        const auto parts = gather(study, date, out / "masks");
        if (!parts) return forward_error(parts);
        const std::string folder = folder_of_date(study, date);
        const Status written = write_day(study, *parts, out / folder, camera, *casters);
        if (!written) return written;
        page_days.push_back(page_day(parts->day, folder));
    }
    OutputFiles files;
    const auto path = draw_sun_path(study);
    if (!path) return forward_error(path);
    if (const Status added = files.add(out / "sun-path.png", *path); !added) return added;
    const Status page =
        files.add(out / "report.html", study_page(study, page_days, !casters->empty()));
    if (!page) return page;
    return files.commit();
}

}  // namespace gnomon::cli
