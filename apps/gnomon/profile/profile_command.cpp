// SPDX-License-Identifier: MIT
//
// gnomon profile: from a model, a place and a day to masks, and from masks to what is made of them.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "arguments.hpp"
#include "devices.hpp"
#include "files.hpp"
#include "profile/day_result.hpp"
#include "profile/draw_masks.hpp"
#include "profile/mask_files.hpp"
#include "profile/study_files.hpp"
#include "profile/study_folder.hpp"

namespace gnomon::cli {

namespace {

namespace fs = std::filesystem;

constexpr double above_lowest_m = 0.1;

Status need(bool given, const char* option) {
    if (given) return {};
    return fail(ErrorCode::InvalidInput,
                fmt::format("profile needs {}; see gnomon profile --help.", option));
}

// What study.json has to hold: JSON is UTF-8.
Status check_utf8(const std::string& text, const char* what) {
    using json = nlohmann::json;
    const auto written = [&](json::error_handler_t how) {
        return json(text).dump(-1, ' ', false, how);
    };
    if (written(json::error_handler_t::replace) == written(json::error_handler_t::ignore)) {
        return {};
    }
    return fail(ErrorCode::InvalidInput,
                fmt::format("{}: {} is not UTF-8, which study.json would have to hold.", what,
                            one_line(written(json::error_handler_t::replace))));
}

PlanMethod method_of(const ProfileOptions& o) {
    return o.method.value_or(o.backend.empty() ? PlanMethod::Scan : PlanMethod::Projection);
}

Status check_given(const ProfileOptions& o) {
    for (const Status& status :
         {need(!o.model.empty(), "a MODEL"), need(o.latitude_deg.has_value(), "--lat"),
          need(o.longitude_deg.has_value(), "--lon"), need(!o.dates.empty(), "--date"),
          need(o.from.has_value(), "--from"), need(o.to.has_value(), "--to")}) {
        if (!status) return status;
    }
    for (const Status& status : {check_utf8(fs::path(o.model).filename().string(), "MODEL"),
                                 check_utf8(fs::path(o.before).filename().string(), "--before"),
                                 check_utf8(o.casters.value_or(""), "--casters"),
                                 check_utf8(o.receivers.value_or(""), "--receivers")}) {
        if (!status) return status;
    }
    if (method_of(o) == PlanMethod::Scan && !o.backend.empty()) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("--backend: --method scan draws on the processor and has no use "
                                "for \"{}\".",
                                o.backend));
    }
    if (o.target_plan && !o.eye_plan && !o.receivers) {
        return fail(ErrorCode::InvalidInput,
                    "--target is for the pictures of --eye and --receivers, of which neither is "
                    "given.");
    }
    return {};
}

// None where the processor draws.
Result<std::optional<gpu::Device>> drawing_device(const ProfileOptions& o) {
    std::optional<gpu::Device> none;
    if (method_of(o) == PlanMethod::Scan) return none;
    auto device = create_device({.backend = o.backend});
    if (!device) return forward_error(device);
    if (device->caps().backend != "null") return std::optional(std::move(*device));
    return fail(ErrorCode::InvalidInput,
                "--backend: \"null\" draws nothing, so that nothing would cast a shadow.");
}

// All casters, and as much around them as shadows of 45 degrees are long.
Result<sun_study::PlanGrid> grid_of(const ProfileOptions& o, const SiteModel& site) {
    const double height = o.height_m.value_or(site.min_plan.z + above_lowest_m);
    glm::dvec2 min(site.min_plan);
    glm::dvec2 max(site.max_plan);
    if (o.area_m) {
        min = {(*o.area_m)[0], (*o.area_m)[1]};
        max = {(*o.area_m)[2], (*o.area_m)[3]};
    } else {
        const double margin = std::max(site.max_plan.z - height, o.cell_m);
        min = glm::floor((min - margin) / o.cell_m) * o.cell_m;
        max += margin;
    }
    return sun_study::make_grid(min, max, o.cell_m, height, most_cells_a_side, most_cells);
}

Result<Study> study_of(const ProfileOptions& o, const SiteModel& site) {
    const auto grid = grid_of(o, site);
    if (!grid) return forward_error(grid);
    Study study;
    study.model = fs::path(o.model).filename().string();
    study.model_hash = site.hash;
    study.casters = o.casters.value_or("");
    study.receivers = o.receivers.value_or("");
    study.spacing_m = o.receivers ? o.spacing_m : 0.0;
    study.latitude_deg = *o.latitude_deg;
    study.longitude_deg = *o.longitude_deg;
    study.elevation_m = o.elevation_m;
    study.air = {.pressure_mbar = o.pressure_mbar, .temperature_c = o.temperature_c};
    study.dates = o.dates;
    study.from = *o.from;
    study.to = *o.to;
    study.step = o.step;
    study.offset = o.offset;
    study.north_deg = o.north_deg;
    study.min_altitude_deg = o.min_altitude_deg;
    study.skip_after_sunrise_min = o.skip_after_sunrise_min;
    study.skip_before_sunset_min = o.skip_before_sunset_min;
    study.grid = *grid;
    study.method = method_of(o);
    return study;
}

Status take_over(const fs::path& from, const fs::path& to) {
    std::error_code error;
    if (fs::equivalent(from, to, error)) return {};
    const auto text = whole_text(from);
    if (!text) return forward_error(text);
    OutputFiles file;
    if (const Status added = file.add(to, *text); !added) return added;
    return file.commit();
}

// Where each of a study's masks is found, and what else is kept among them: name, and the whole
// path. Nothing is written before all of them are known to be there.
using Sources = std::vector<std::pair<std::string, fs::path>>;

Result<Sources> find_parts(const ProfileOptions& o, const Study& study) {
    const auto jobs = mask_jobs(study);
    if (!jobs) return forward_error(jobs);
    Sources sources;
    std::vector<std::string> missing;
    for (const MaskJob& job : *jobs) {
        const auto has_it = [&](const std::string& folder) {
            const auto [columns, rows] = shape_of(study, job.kind);
            return read_mask(fs::path(folder) / "masks" / job.file, columns, rows).has_value();
        };
        const auto found = std::ranges::find_if(o.merge, has_it);
        if (found == o.merge.end()) {
            missing.push_back(job.what);
        } else {
            sources.emplace_back(job.file, fs::path(*found) / "masks" / job.file);
        }
    }
    if (!missing.empty()) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("--merge: {} of {} masks are in none of the folders, the first of "
                                "them that of {}: a part is missing, or was cut off.",
                                missing.size(), jobs->size(), missing.front()));
    }
    if (o.eye_plan) {
        // Another's may be cut off.
        const auto has_casters = [](const std::string& folder) {
            const auto numbers =
                read_all_numbers(fs::path(folder) / "masks" / casters_name, numbers_a_face);
            return numbers.has_value() && !numbers->empty();
        };
        const auto found = std::ranges::find_if(o.merge, has_casters);
        if (found == o.merge.end()) {
            return fail(ErrorCode::InvalidInput,
                        fmt::format("--eye: none of the folders has a whole masks/{}, which a part "
                                    "has that was drawn with --eye; without it there is no "
                                    "scene.png.",
                                    casters_name));
        }
        sources.emplace_back(casters_name, fs::path(*found) / "masks" / casters_name);
    }
    if (study.surface_points > 0) {
        const auto has_points = [&](const std::string& folder) {
            return read_numbers(fs::path(folder) / "masks" / points_name, numbers_a_point,
                                study.surface_points)
                .has_value();
        };
        const auto found = std::ranges::find_if(o.merge, has_points);
        if (found == o.merge.end()) {
            return fail(
                ErrorCode::InvalidInput,
                fmt::format("--merge: none of the folders has a whole masks/{}.", points_name));
        }
        sources.emplace_back(points_name, fs::path(*found) / "masks" / points_name);
    }
    return sources;
}

void tell_days_without_sun(const Study& study) {
    constexpr std::size_t most = 3;
    const std::vector<std::string> days = days_without_sun(study);
    for (std::size_t i = 0; i < std::min(days.size(), most); ++i) {
        fmt::print(stderr, "{} It has no hours.\n", days[i]);
    }
    if (days.size() > most) {
        fmt::print(stderr, "So it is on {} more dates.\n", days.size() - most);
    }
}

Status merge(const ProfileOptions& o) {
    auto study = read_study(o.merge.front());
    if (!study) return forward_error(study);
    for (const std::string& folder : o.merge) {
        const auto other = read_study(folder);
        if (!other) return forward_error(other);
        if (const std::string key = first_difference(*study, *other); !key.empty()) {
            return fail(ErrorCode::InvalidInput,
                        fmt::format("--merge: {} and {} are not parts of one study: \"{}\" differs "
                                    "in their study.json.",
                                    o.merge.front(), folder, key));
        }
    }
    const auto sources = find_parts(o, *study);
    if (!sources) return forward_error(sources);
    if (!o.quiet) tell_days_without_sun(*study);
    if (const Status ready = prepare_folder(*study, o.out); !ready) return ready;
    for (const auto& [name, path] : *sources) {
        const Status taken = take_over(path, o.out / "masks" / name);
        if (!taken) return taken;
    }
    return write_study(*study, o.out, {o.eye_plan, o.target_plan});
}

// The model before and the receivers, where they are asked for.
Status add_subjects(const ProfileOptions& o, Study& study, MaskSubjects& subjects) {
    if (!o.before.empty()) {
        auto before = load_site(o, o.before, o.casters, "--casters", true);
        if (!before) return forward_error(before);
        study.before = fs::path(o.before).filename().string();
        study.before_hash = before->hash;
        subjects.before = std::move(before->casters);
    }
    if (!o.receivers) return {};
    const auto receivers = load_site(o, o.model, o.receivers, "--receivers");
    if (!receivers) return forward_error(receivers);
    auto points = sun_study::sample_surfaces(receivers->casters, o.spacing_m, most_surface_points);
    if (!points) return forward_error(points);
    if (points->empty()) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("--receivers: what \"{}\" matches in {} has no wall and no roof.",
                                *o.receivers, o.model));
    }
    study.receivers_hash = receivers->hash;
    study.surface_points = static_cast<std::uint32_t>(points->size());
    subjects.points = std::move(*points);
    return {};
}

std::vector<double> corners_of_faces(const std::vector<shadows::Caster>& casters) {
    std::vector<double> numbers;
    for (const shadows::Caster& caster : casters) {
        for (const auto& face : caster.mesh->faces()) {
            for (const std::uint32_t corner : face) {
                const glm::dvec3 local(caster.mesh->positions()[corner]);
                const glm::dvec3 plan = sun_study::plan_from_world(
                    glm::dvec3(caster.world_from_local * glm::dvec4(local, 1.0)));
                numbers.insert(numbers.end(), {plan.x, plan.y, plan.z});
            }
        }
    }
    return numbers;
}

// The study's folder, ready for masks.
Status begin_folder(const Study& study, const MaskSubjects& subjects, const ProfileOptions& o) {
    if (const Status ready = prepare_folder(study, o.out); !ready) return ready;
    OutputFiles files;
    if (!subjects.points.empty()) {
        const Status added = files.add(o.out / "masks" / points_name,
                                       number_matrix(numbers_of(subjects.points), numbers_a_point));
        if (!added) return added;
    }
    if (o.eye_plan) {
        const Status added =
            files.add(o.out / "masks" / casters_name,
                      number_matrix(corners_of_faces(subjects.casters), numbers_a_face));
        if (!added) return added;
    }
    return files.commit();
}

Status draw(const ProfileOptions& o) {
    if (const Status given = check_given(o); !given) return given;
    auto site = load_site(o, o.model, o.casters, "--casters");
    if (!site) return forward_error(site);
    auto study = study_of(o, *site);
    if (!study) return forward_error(study);
    MaskSubjects subjects;
    auto device = drawing_device(o);
    if (!device) return forward_error(device);
    subjects.device = std::move(*device);
    if (subjects.device) study->backend = subjects.device->caps().backend;
    if (const Status added = add_subjects(o, *study, subjects); !added) return added;
    subjects.casters = std::move(site->casters);
    const auto jobs = mask_jobs(*study);
    if (!jobs) return forward_error(jobs);
    const auto state = state_of_folder(*study, o.out);
    if (!state) return forward_error(state);
    if (!o.quiet) {
        for (const std::string& note : site->notes) fmt::print(stderr, "{}\n", one_line(note));
        if (!o.height_m) {
            fmt::print(stderr,
                       "The plane is at {:g} m, {:g} m above the lowest point of what casts; "
                       "--plane puts it elsewhere.\n",
                       study->grid.height_m, above_lowest_m);
        }
    }
    // Of parts, it is said once: where they are joined.
    if (!o.quiet && !o.shard) tell_days_without_sun(*study);
    const Status drawn =
        draw_masks(*study, *jobs, subjects, o, o.out / "masks", *state == FolderState::Same,
                   [&] { return begin_folder(*study, subjects, o); });
    if (!drawn || o.shard) return drawn;
    return write_study(*study, o.out, {o.eye_plan, o.target_plan});
}

}  // namespace

Status run_profile(const ProfileOptions& options) {
    if (const Status given = need(!options.out.empty(), "--out"); !given) return given;
    const Status done = options.merge.empty() ? draw(options) : merge(options);
    if (!done || options.quiet) return done;
    const fs::path result = options.out / (options.shard ? "masks" : "report.html");
    fmt::print(stderr, "{}\n", result.string());
    return done;
}

}  // namespace gnomon::cli
