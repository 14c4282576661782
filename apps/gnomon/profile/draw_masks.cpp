// SPDX-License-Identifier: MIT
#include "profile/draw_masks.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <span>

#include <unistd.h>

#include <fmt/format.h>

#include <gnomon/machine/machine.hpp>
#include <gnomon/sun_study/plan_projection.hpp>
#include <gnomon/sun_study/plan_scan.hpp>
#include <gnomon/sun_study/plan_shadows.hpp>

#include "files.hpp"
#include "profile/batch_size.hpp"
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

// A plan, by any of the methods.
class PlanDrawer {
public:
    static Result<PlanDrawer> create(PlanMethod method, gpu::Device* device,
                                     const std::vector<shadows::Caster>& casters,
                                     const sun_study::PlanGrid& grid, const shadows::Jobs& jobs) {
        PlanDrawer drawer;
        if (method == PlanMethod::Scan) {
            drawer.scan_.emplace(casters, grid, jobs);
        } else if (method == PlanMethod::Projection) {
            auto made = sun_study::PlanProjection::create(*device, casters, grid, {.jobs = jobs});
            if (!made) return forward_error(made);
            drawer.projection_ = std::move(*made);
        } else {
            auto made = sun_study::PlanShadows::create(*device, casters, grid, {.jobs = jobs});
            if (!made) return forward_error(made);
            drawer.volumes_ = std::move(*made);
        }
        return drawer;
    }

    Result<std::vector<sun_study::PlanMask>> lit(std::span<const glm::dvec3> suns) {
        if (scan_) return scan_->lit(suns);
        if (projection_) return projection_->lit(suns);
        std::vector<sun_study::PlanMask> masks;
        for (const glm::dvec3& sun : suns) {
            auto mask = volumes_->lit(sun);
            if (!mask) return forward_error(mask);
            masks.push_back(std::move(*mask));
        }
        return masks;
    }

private:
    std::optional<sun_study::PlanScan> scan_;
    std::optional<sun_study::PlanProjection> projection_;
    std::optional<sun_study::PlanShadows> volumes_;
};

// Draws plans, or asks about points; whatever it needs is made when it is first needed.
class MaskMaker {
public:
    MaskMaker(const Study& study, MaskSubjects& subjects, std::uint32_t threads)
        : study_(study),
          subjects_(subjects),
          threads_(threads > 0 ? threads : machine::usable_cores()),
          jobs_(shadows::thread_jobs(threads_)),
          plan_batch_(side_by_side()) {}

    // Of one kind.
    Result<std::vector<sun_study::PlanMask>> masks(MaskKind kind,
                                                   std::span<const glm::dvec3> suns) {
        if (kind != MaskKind::Surface) {
            if (const Status made = make_ready(kind); !made) return forward_error(made);
            return (kind == MaskKind::Plan ? plan_ : before_)->lit(suns);
        }
        if (!queries_) queries_.emplace().update(subjects_.casters);
        std::vector<sun_study::PlanMask> masks;
        for (const glm::dvec3& sun : suns) {
            masks.push_back(sun_study::lit_points(*queries_, subjects_.points, sun, jobs_));
        }
        return masks;
    }

    // Makes the plan that masks of this kind take.
    Status make_ready(MaskKind kind) {
        if (kind == MaskKind::Surface) return {};
        auto& plan = kind == MaskKind::Plan ? plan_ : before_;
        if (plan) return {};
        auto made = PlanDrawer::create(
            study_.method, subjects_.device ? &*subjects_.device : nullptr,
            kind == MaskKind::Plan ? subjects_.casters : subjects_.before, study_.grid, jobs_);
        if (!made) return forward_error(made);
        plan = std::move(*made);
        return {};
    }

    // Of masks of this kind.
    [[nodiscard]] BatchSize& batch_size(MaskKind kind) {
        return kind == MaskKind::Surface ? surface_batch_ : plan_batch_;
    }
    [[nodiscard]] const shadows::Jobs& jobs() const { return jobs_; }

private:
    // So many plans are drawn at once.
    [[nodiscard]] std::size_t side_by_side() const {
        switch (study_.method) {
            case PlanMethod::Scan: return threads_;
            case PlanMethod::Projection: return sun_study::PlanProjection::steps_a_buffer;
            case PlanMethod::Volumes: break;
        }
        return 1;
    }

    const Study& study_;
    MaskSubjects& subjects_;
    std::uint32_t threads_;
    shadows::Jobs jobs_;
    BatchSize plan_batch_;
    BatchSize surface_batch_;  // one at a time, on all threads
    std::optional<PlanDrawer> plan_;
    std::optional<PlanDrawer> before_;
    std::optional<shadows::ShadowQueries> queries_;
};

// How many of the jobs, from the first on, are drawn, packed and written together. One kind has one
// drawer; what is open to the sky comes alone, since the plane may be refused by it before anything
// else is drawn; and all wait in memory to be written.
std::size_t batch_of(const Study& study, std::span<const MaskJob* const> jobs, std::size_t most) {
    constexpr std::size_t most_bytes = std::size_t{1} << 28U;
    const auto [columns, rows] = shape_of(study, jobs.front()->kind);
    most = std::clamp<std::size_t>(most_bytes / (std::size_t{columns} * rows), 1, most);
    std::size_t count = 1;
    while (count < std::min(most, jobs.size()) && !jobs.front()->is_open_mask &&
           !jobs[count]->is_open_mask && jobs[count]->kind == jobs.front()->kind) {
        ++count;
    }
    return count;
}

Status write_masks(const Study& study, std::span<const MaskJob* const> jobs,
                   std::span<const sun_study::PlanMask> masks, const shadows::Jobs& threads,
                   const std::filesystem::path& folder) {
    const auto [columns, rows] = shape_of(study, jobs.front()->kind);
    std::vector<Status> written(jobs.size());
    threads(jobs.size(), [&, columns = columns, rows = rows](std::size_t i) {
        OutputFiles file;
        written[i] = file.add(folder / jobs[i]->file, packed_mask(masks[i], columns, rows));
        if (written[i]) written[i] = file.commit();
    });
    for (const Status& status : written) {
        if (!status) return status;
    }
    return {};
}

}  // namespace

std::vector<std::string> days_without_sun(const Study& study) {
    std::vector<std::string> sentences;
    for (const sun::Date& date : study.dates) {
        const auto steps = steps_of(study, date);
        if (!steps) continue;
        std::string why = why_no_sun(study, date, *steps);
        if (!why.empty()) sentences.push_back(std::move(why));
    }
    return sentences;
}

MaskShape shape_of(const Study& study, MaskKind kind) {
    if (kind == MaskKind::Surface) return {study.surface_points, 1};
    return {study.grid.columns, study.grid.rows};
}

Result<std::vector<MaskJob>> mask_jobs(const Study& study) {
    std::vector<MaskKind> kinds{MaskKind::Plan};
    if (!study.before.empty()) kinds.push_back(MaskKind::Before);
    if (study.surface_points > 0) kinds.push_back(MaskKind::Surface);
    const auto steps_a_date = static_cast<std::size_t>(
        std::max<std::int64_t>((study.to - study.from) / study.step + 1, 0));
    if (const std::size_t most = steps_a_date * study.dates.size() * kinds.size();
        most > most_masks) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("{} steps on {} dates would take {} masks, and {} is the most at a "
                                "time: a longer --step, a shorter time from --from to --to or "
                                "fewer dates fit.",
                                steps_a_date, study.dates.size(), most, most_masks));
    }
    std::vector<MaskJob> jobs;
    for (const MaskKind kind : kinds) {
        if (kind == MaskKind::Surface) continue;
        jobs.push_back(
            {.kind = kind, .file = open_mask_name(kind), .what = "roofs", .is_open_mask = true});
    }
    std::string no_sun;
    bool any = false;
    for (const sun::Date& date : study.dates) {
        const auto steps = steps_of(study, date);
        if (!steps) return forward_error(steps);
        const std::string why = why_no_sun(study, date, *steps);
        any = any || why.empty();
        if (no_sun.empty()) no_sun = why;
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
    if (any) return jobs;
    if (study.dates.size() == 1) return fail(ErrorCode::InvalidInput, no_sun);
    return fail(ErrorCode::InvalidInput, fmt::format("The sun counts on none of the {} dates. {}",
                                                     study.dates.size(), no_sun));
}

Status draw_masks(const Study& study, const std::vector<MaskJob>& jobs, MaskSubjects& subjects,
                  const ProfileOptions& options, const std::filesystem::path& masks_folder,
                  bool takes_over, const std::function<Status()>& before_writing) {
    const Shard shard = options.shard.value_or(Shard{});
    std::vector<const MaskJob*> missing;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        if (i % shard.count + 1 != shard.index) continue;
        const auto [columns, rows] = shape_of(study, jobs[i].kind);
        // A file that cannot be read as a mask is drawn again.
        if (!takes_over || !read_mask(masks_folder / jobs[i].file, columns, rows)) {
            missing.push_back(&jobs[i]);
        }
    }
    if (missing.empty()) return before_writing();
    MaskMaker maker(study, subjects, options.threads);
    for (const MaskJob* job : missing) {
        if (const Status ready = maker.make_ready(job->kind); !ready) return ready;
    }
    const bool progress = !options.quiet && ::isatty(STDERR_FILENO) != 0;
    const auto start = MaskClock::now();
    for (std::size_t first = 0; first < missing.size();) {
        const std::span left = std::span<const MaskJob* const>(missing).subspan(first);
        BatchSize& size = maker.batch_size(left.front()->kind);
        const std::span batch = left.first(batch_of(study, left, size.next()));
        std::vector<glm::dvec3> suns;
        for (const MaskJob* job : batch) suns.push_back(job->towards_sun);
        const auto batch_start = MaskClock::now();
        const auto masks = maker.masks(batch.front()->kind, suns);
        if (!masks) return forward_error(masks);
        const std::chrono::duration<double> taken = MaskClock::now() - batch_start;
        size.took(batch.size(), taken.count());
        if (batch.front()->is_open_mask && std::ranges::count(masks->front(), 1) == 0) {
            return fail(ErrorCode::InvalidInput,
                        fmt::format("--plane: something lies above every cell of the grid at {:g} "
                                    "m; a higher plane or fewer casters (--casters) leave some "
                                    "open.",
                                    study.grid.height_m));
        }
        if (first == 0) {
            if (const Status ready = before_writing(); !ready) return ready;
        }
        const Status written = write_masks(study, batch, *masks, maker.jobs(), masks_folder);
        if (!written) return written;
        first += batch.size();
        if (progress) tell_masks(first, missing.size(), start, batch.back()->what);
    }
    return {};
}

}  // namespace gnomon::cli
