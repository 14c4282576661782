// SPDX-License-Identifier: MIT
//
// gnomon-plan-bench: steps of a sun study a second, by every way that gnomon has to draw a plan and
// by Embree's rays in every packing, on the same grid and the same cores. Days are spread over a
// year and all their steps taken, in batches; each batch is drawn by every way, the first of them
// another each time. Writes one JSON object: for each way its steps a second over all and the
// batches' median, tenth and ninetieth percentile; the same of the ratio to the fastest rays, batch
// by batch; and how many cells differ from rays' and from the scan's.
//
//   gnomon-plan-bench ../shared/models/scenes/linz-old-town.glb --grid 1 --out plan.json
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <gnomon/machine/machine.hpp>
#include <gnomon/scene/scene_description.hpp>
#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/scene/transforms.hpp>
#include <gnomon/sun_study/plan_projection.hpp>
#include <gnomon/sun_study/plan_scan.hpp>
#include <gnomon/sun_study/plan_shadows.hpp>
#include <gnomon/sun_study/steps.hpp>

#include "devices.hpp"
#include "plan_rays.hpp"

namespace {

using namespace gnomon;
using Clock = std::chrono::steady_clock;

struct Options {
    std::string model;
    std::string out;
    std::string only;
    double cell_m = 1.0;
    double height_m = 0.1;
    int days = 12;
    int step_min = 10;
    std::size_t batch = 16;
    unsigned threads = 0;
};

using Suns = std::span<const glm::dvec3>;
using Masks = std::vector<sun_study::PlanMask>;

struct Way {
    std::string name;
    std::function<Result<Masks>(Suns)> lit;
    bool is_rays = false;
    std::vector<double> seconds = {};  // a batch
    std::uint64_t unlike_rays = 0;
    std::uint64_t unlike_scan = 0;
};

template <class T>
T must(Result<T> result) {
    if (!result) throw std::runtime_error(result.error().message);
    return std::move(*result);
}

sun_study::PlanGrid grid_over(const std::vector<shadows::Caster>& casters, const Options& o) {
    glm::dvec3 min(1e30);
    glm::dvec3 max(-1e30);
    for (const shadows::Caster& caster : casters) {
        const shadows::OrientedBounds box{caster.world_from_local, caster.mesh->bounds_min(),
                                          caster.mesh->bounds_max()};
        for (const glm::dvec3& world : shadows::corners_of(box)) {
            const glm::dvec3 plan = sun_study::plan_from_world(world);
            min = glm::min(min, plan);
            max = glm::max(max, plan);
        }
    }
    return must(
        sun_study::make_grid(glm::dvec2(min), glm::dvec2(max), o.cell_m, o.height_m, 16384));
}

// Days spread over a year, each from midnight to midnight: the steps at which the sun is up.
std::vector<glm::dvec3> suns_of(const Options& o) {
    constexpr double degree = std::numbers::pi / 180.0;
    const sun::Place linz{48.306 * degree, 14.286 * degree, 260.0};
    std::vector<glm::dvec3> suns;
    for (int i = 0; i < o.days; ++i) {
        const auto day = std::chrono::sys_days(must(sun::parse_date("2026-01-01"))) +
                         std::chrono::days(365 * i / o.days);
        const auto steps = must(sun_study::make_steps({.date = sun::Date(day),
                                                       .to = std::chrono::hours(24),
                                                       .step = std::chrono::minutes(o.step_min),
                                                       .offset = std::chrono::hours(1)},
                                                      linz, {}, {}));
        for (const sun_study::Step& step : steps) {
            if (!step.counts) continue;
            suns.push_back(sun::towards_sun(step.sun.azimuth_rad, step.sun.altitude_rad));
        }
    }
    return suns;
}

// By all devices that there are.
class Plans {
public:
    Plans(const std::vector<shadows::Caster>& casters, const sun_study::PlanGrid& grid,
          const shadows::Jobs& jobs)
        : rays_(casters, grid, jobs), scan_(casters, grid, jobs) {
        devices_.reserve(4);
        for (const std::string& backend : cli::backend_names()) {
            if (backend == "null") continue;
            auto device = cli::create_device({.backend = backend});
            if (!device) {
                std::fprintf(stderr, "%s is left out: %s\n", backend.c_str(),
                             device.error().message.c_str());
                continue;
            }
            devices_.push_back({backend, std::move(*device), {}, {}});
            Drawn& drawn = devices_.back();
            drawn.projection = must(
                sun_study::PlanProjection::create(drawn.device, casters, grid, {.jobs = jobs}));
            drawn.volumes =
                must(sun_study::PlanShadows::create(drawn.device, casters, grid, {.jobs = jobs}));
        }
    }

    std::vector<Way> ways() {
        std::vector<Way> ways;
        const auto add_rays = [&](const char* name, bench::RayPacking packing) {
            ways.push_back(
                {name, [this, packing](Suns suns) { return rays_.lit(suns, packing); }, true});
        };
        add_rays("rays, 16 of a row", bench::RayPacking::Rows16);
        add_rays("rays, 4 x 4", bench::RayPacking::Squares16);
        add_rays("rays, 8 of a row", bench::RayPacking::Rows8);
        add_rays("rays, 4 x 2", bench::RayPacking::Squares8);
        add_rays("rays, stream of 16 x 16", bench::RayPacking::Stream);
        add_rays("rays, one by one", bench::RayPacking::Single);
        ways.push_back({"scan", [this](Suns suns) { return scan_.lit(suns); }});
        for (Drawn& drawn : devices_) {
            ways.push_back({"projection, " + drawn.backend,
                            [&drawn](Suns suns) { return drawn.projection->lit(suns); }});
            ways.push_back({"volumes, " + drawn.backend, [&drawn](Suns suns) -> Result<Masks> {
                                Masks masks;
                                for (const glm::dvec3& sun : suns) {
                                    masks.push_back(must(drawn.volumes->lit(sun)));
                                }
                                return masks;
                            }});
        }
        return ways;
    }

    [[nodiscard]] nlohmann::json adapters() const {
        nlohmann::json names;
        for (const Drawn& drawn : devices_) names[drawn.backend] = drawn.device.caps().adapter;
        return names;
    }

private:
    struct Drawn {
        std::string backend;
        gpu::Device device;
        std::optional<sun_study::PlanProjection> projection;
        std::optional<sun_study::PlanShadows> volumes;
    };
    bench::PlanRays rays_;
    sun_study::PlanScan scan_;
    std::vector<Drawn> devices_;
};

std::uint64_t differences(const Masks& a, const Masks& b) {
    std::uint64_t count = 0;
    for (std::size_t m = 0; m < a.size(); ++m) {
        for (std::size_t i = 0; i < a[m].size(); ++i) count += a[m][i] != b[m][i] ? 1 : 0;
    }
    return count;
}

nlohmann::json spread(std::vector<double> values) {
    std::ranges::sort(values);
    const auto at = [&](double share) {
        return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
    };
    return {{"p10", at(0.1)}, {"median", at(0.5)}, {"p90", at(0.9)}};
}

double sum_of(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum;
}

void draw_batch(std::vector<Way>& ways, Suns suns, std::size_t number, bool is_timed) {
    std::vector<Masks> masks(ways.size());
    const Masks* rays = nullptr;
    const Masks* scan = nullptr;
    for (std::size_t turn = 0; turn < ways.size(); ++turn) {
        const std::size_t w = (turn + number) % ways.size();
        const auto start = Clock::now();
        masks[w] = must(ways[w].lit(suns));
        const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
        if (is_timed) ways[w].seconds.push_back(seconds);
    }
    if (!is_timed) return;
    for (std::size_t w = ways.size(); w-- > 0;) {
        if (ways[w].is_rays) rays = &masks[w];
        if (ways[w].name == "scan") scan = &masks[w];
    }
    for (std::size_t w = 0; w < ways.size(); ++w) {
        if (rays != nullptr) ways[w].unlike_rays += differences(masks[w], *rays);
        if (scan != nullptr) ways[w].unlike_scan += differences(masks[w], *scan);
    }
}

void run(const Options& o) {
    scene::Scene model = must(scene::load_scene(o.model));
    scene::update_world_transforms(model.registry);
    scene::ShadowAdapter adapter;
    const std::vector<shadows::Caster> casters = must(adapter.casters(model));
    const sun_study::PlanGrid grid = grid_over(casters, o);
    const std::vector<glm::dvec3> suns = suns_of(o);
    const unsigned threads = o.threads != 0 ? o.threads : machine::usable_cores();

    Plans plans(casters, grid, shadows::thread_jobs(threads));
    std::vector<Way> ways = plans.ways();
    std::erase_if(ways, [&](const Way& way) { return way.name.find(o.only) == way.name.npos; });
    if (ways.empty()) throw std::runtime_error("--only leaves no way to draw.");
    std::vector<std::size_t> sizes;
    draw_batch(ways, Suns(suns).first(std::min(o.batch, suns.size())), 0, false);
    for (std::size_t first = 0; first < suns.size(); first += o.batch) {
        sizes.push_back(std::min(o.batch, suns.size() - first));
        draw_batch(ways, Suns(suns).subspan(first, sizes.back()), sizes.size(), true);
        std::fprintf(stderr, "\rstep %zu of %zu \x1b[K", first + sizes.back(), suns.size());
    }
    std::fprintf(stderr, "\r\x1b[K");

    const auto steps = static_cast<double>(suns.size());
    const double cells = steps * static_cast<double>(grid.cell_count());
    const Way* fastest_rays = nullptr;
    for (const Way& way : ways) {
        if (!way.is_rays) continue;
        if (fastest_rays == nullptr || sum_of(way.seconds) < sum_of(fastest_rays->seconds)) {
            fastest_rays = &way;
        }
    }
    const machine::Machine found = machine::this_machine();
    nlohmann::json json{{"model", o.model},     {"columns", grid.columns},
                        {"rows", grid.rows},    {"cell_m", grid.cell_m},
                        {"days", o.days},       {"step_min", o.step_min},
                        {"steps", suns.size()}, {"batch", o.batch},
                        {"threads", threads},   {"processor", found.processor},
                        {"cores", found.cores}, {"adapters", plans.adapters()}};
    if (fastest_rays != nullptr) json["fastest_rays"] = fastest_rays->name;
    for (const Way& way : ways) {
        std::vector<double> rates;
        std::vector<double> ratios;
        for (std::size_t b = 0; b < sizes.size(); ++b) {
            rates.push_back(static_cast<double>(sizes[b]) / way.seconds[b]);
            if (fastest_rays != nullptr)
                ratios.push_back(fastest_rays->seconds[b] / way.seconds[b]);
        }
        nlohmann::json one{{"name", way.name},
                           {"steps_a_second", steps / sum_of(way.seconds)},
                           {"steps_a_second_by_batch", spread(rates)},
                           {"cells_unlike_rays", static_cast<double>(way.unlike_rays) / cells},
                           {"cells_unlike_scan", static_cast<double>(way.unlike_scan) / cells}};
        if (fastest_rays != nullptr) {
            one["times_as_fast_as_rays"] = sum_of(fastest_rays->seconds) / sum_of(way.seconds);
            one["times_as_fast_as_rays_by_batch"] = spread(ratios);
        }
        json["ways"].push_back(std::move(one));
    }
    const std::string text = json.dump(2) + "\n";
    std::printf("%s", text.c_str());
    if (!o.out.empty()) std::ofstream(o.out) << text;
}

}  // namespace

int main(int argc, char** argv) {
    Options o;
    CLI::App app("Steps of a sun study a second, by all ways to draw a plan and by Embree's rays.",
                 "gnomon-plan-bench");
    app.add_option("model", o.model, "The model, in metres and +Y up")->required();
    app.add_option("--out", o.out, "Write the JSON here as well");
    app.add_option("--grid", o.cell_m, "Metres a cell")->check(CLI::Range(1e-3, 1e3));
    app.add_option("--plane", o.height_m, "Height of the plane in metres");
    app.add_option("--days", o.days, "Days, spread over a year")->check(CLI::Range(1, 365));
    app.add_option("--step", o.step_min, "Minutes")->check(CLI::Range(1, 360));
    app.add_option("--threads", o.threads, "Default: all");
    app.add_option("--batch", o.batch, "Steps that are drawn and timed together")
        ->check(CLI::Range(1, 1024));
    app.add_option("--only", o.only, "Ways with this in their name alone");
    CLI11_PARSE(app, argc, argv);
    try {
        run(o);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "gnomon-plan-bench: %s\n", error.what());
        return 1;
    }
    return 0;
}
