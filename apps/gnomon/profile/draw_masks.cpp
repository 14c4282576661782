// SPDX-License-Identifier: MIT
#include "profile/draw_masks.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>

#include <unistd.h>

#include <fmt/format.h>

#include "devices.hpp"
#include "files.hpp"
#include "profile/mask_files.hpp"

namespace gnomon::cli {

namespace {

using MaskClock = std::chrono::steady_clock;

void tell_masks(std::size_t done, std::size_t all, MaskClock::time_point start,
                const std::string& what) {
    const double seconds = std::chrono::duration<double>(MaskClock::now() - start).count();
    const double left = seconds / static_cast<double>(done) * static_cast<double>(all - done);
    fmt::print(stderr, "\rmask {} of {}, {:.0f} s left: {}\x1b[K", done, all, left, what);
    if (done == all) fmt::print(stderr, "\r\x1b[K");
    std::fflush(stderr);
}

// Draws plans on a device, or asks about points; whatever it needs is made when it is first needed.
class MaskMaker {
public:
    MaskMaker(const Study& study, const MaskSubjects& subjects, const std::string& backend)
        : study_(study), subjects_(subjects), backend_(backend) {}

    Result<sun_study::PlanMask> mask(const MaskJob& job) {
        if (job.kind == MaskKind::Surface) {
            if (!queries_) queries_.emplace().update(subjects_.casters);
            return sun_study::lit_points(*queries_, subjects_.points, job.towards_sun, jobs_);
        }
        if (const Status made = make_ready(job.kind); !made) return forward_error(made);
        return (job.kind == MaskKind::Plan ? plan_ : before_)->lit(job.towards_sun);
    }

    // Makes the device and the plan that masks of this kind take.
    Status make_ready(MaskKind kind) {
        if (kind == MaskKind::Surface) return {};
        auto& plan = kind == MaskKind::Plan ? plan_ : before_;
        if (plan) return {};
        auto made = make_plan(kind == MaskKind::Plan ? subjects_.casters : subjects_.before);
        if (!made) return forward_error(made);
        plan = std::move(*made);
        return {};
    }

private:
    Result<sun_study::PlanShadows> make_plan(const std::vector<shadows::Caster>& casters) {
        if (!device_) {
            auto device = create_device({.backend = backend_});
            if (!device) return forward_error(device);
            if (device->caps().backend == "null") {
                return fail(ErrorCode::InvalidInput,
                            "--backend: \"null\" draws nothing, so that nothing would cast a "
                            "shadow.");
            }
            device_ = std::move(*device);
        }
        return sun_study::PlanShadows::create(*device_, casters, study_.grid, {.jobs = jobs_});
    }

    const Study& study_;
    const MaskSubjects& subjects_;
    std::string backend_;
    shadows::Jobs jobs_ = shadows::thread_jobs();
    std::optional<gpu::Device> device_;
    std::optional<sun_study::PlanShadows> plan_;
    std::optional<sun_study::PlanShadows> before_;
    std::optional<shadows::ShadowQueries> queries_;
};

}  // namespace

MaskShape shape_of(const Study& study, MaskKind kind) {
    if (kind == MaskKind::Surface) return {study.surface_points, 1};
    return {study.grid.columns, study.grid.rows};
}

Result<std::vector<MaskJob>> mask_jobs(const Study& study) {
    std::vector<MaskKind> kinds{MaskKind::Plan};
    if (!study.before.empty()) kinds.push_back(MaskKind::Before);
    if (study.surface_points > 0) kinds.push_back(MaskKind::Surface);
    std::vector<MaskJob> jobs;
    for (const MaskKind kind : kinds) {
        if (kind == MaskKind::Surface) continue;
        jobs.push_back(
            {.kind = kind, .file = open_mask_name(kind), .what = "roofs", .is_open_mask = true});
    }
    for (const sun::Date& date : study.dates) {
        const auto steps = steps_of(study, date);
        if (!steps) return forward_error(steps);
        for (const MaskKind kind : kinds) {
            for (const sun_study::Step& step : *steps) {
                if (!step.counts) continue;
                jobs.push_back(
                    {.kind = kind,
                     .file = mask_name(kind, date, step),
                     .what = fmt::format("{} {}", sun::to_text(date), sun::clock_text(step.clock)),
                     .towards_sun = towards_sun(study, step)});
            }
        }
    }
    return jobs;
}

Status draw_masks(const Study& study, const std::vector<MaskJob>& jobs,
                  const MaskSubjects& subjects, const ProfileOptions& options,
                  const std::filesystem::path& masks, bool takes_over,
                  const std::function<Status()>& before_writing) {
    const Shard shard = options.shard.value_or(Shard{});
    std::vector<const MaskJob*> missing;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        if (i % shard.count + 1 != shard.index) continue;
        const auto [columns, rows] = shape_of(study, jobs[i].kind);
        // A file that cannot be read as a mask is drawn again.
        if (!takes_over || !read_mask(masks / jobs[i].file, columns, rows)) {
            missing.push_back(&jobs[i]);
        }
    }
    if (missing.empty()) return before_writing();
    MaskMaker maker(study, subjects, options.backend);
    for (const MaskJob* job : missing) {
        if (const Status ready = maker.make_ready(job->kind); !ready) return ready;
    }
    const bool progress = !options.quiet && ::isatty(STDERR_FILENO) != 0;
    const auto start = MaskClock::now();
    for (std::size_t i = 0; i < missing.size(); ++i) {
        const MaskJob& job = *missing[i];
        const auto mask = maker.mask(job);
        if (!mask) return forward_error(mask);
        if (job.is_open_mask && std::ranges::count(*mask, 1) == 0) {
            return fail(ErrorCode::InvalidInput,
                        fmt::format("--plane: something lies above every cell of the grid at {:g} "
                                    "m; a higher plane or fewer casters (--casters) leave some "
                                    "open.",
                                    study.grid.height_m));
        }
        if (i == 0) {
            if (const Status ready = before_writing(); !ready) return ready;
        }
        const auto [columns, rows] = shape_of(study, job.kind);
        OutputFiles file;
        const Status added = file.add(masks / job.file, packed_mask(*mask, columns, rows));
        if (!added) return added;
        if (const Status kept = file.commit(); !kept) return kept;
        if (progress) tell_masks(i + 1, missing.size(), start, job.what);
    }
    return {};
}

}  // namespace gnomon::cli
