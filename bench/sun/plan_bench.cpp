// SPDX-License-Identifier: MIT
//
// gnomon-plan-bench: steps of a sun study a second, by stencil shadow volumes and by Embree rays on
// the same grid and the same cores, in turns: each step by every way, the first of them another
// each time. Writes one JSON object: steps a second of each, ratios to rays, and the share of cells
// in which masks differ from rays (edges, and what single precision does to either).
//
//   gnomon-plan-bench ../shared/models/scenes/linz-old-town.glb --out bench/results/plan.json
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <thread>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <gnomon/scene/scene_description.hpp>
#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/scene/transforms.hpp>
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
    double cell_m = 1.0;
    double height_m = 0.1;
    int days = 12;
    int step_min = 10;
    unsigned threads = 0;
};

struct Way {
    std::string name;
    std::function<Result<sun_study::PlanMask>(const glm::dvec3&)> lit;
    double seconds = 0.0;
    std::uint64_t differing = 0;
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

void run(const Options& o) {
    scene::Scene model = must(scene::load_scene(o.model));
    scene::update_world_transforms(model.registry);
    scene::ShadowAdapter adapter;
    const std::vector<shadows::Caster> casters = must(adapter.casters(model));
    const sun_study::PlanGrid grid = grid_over(casters, o);
    const std::vector<glm::dvec3> suns = suns_of(o);
    const unsigned threads = o.threads != 0 ? o.threads : std::thread::hardware_concurrency();

    bench::PlanRays rays(casters, grid, threads);
    std::vector<gpu::Device> devices;
    devices.reserve(2);
    std::vector<sun_study::PlanShadows> plans;
    plans.reserve(8);
    std::vector<Way> ways;
    ways.push_back({"rays", [&](const glm::dvec3& sun) {
                        return Result<sun_study::PlanMask>(rays.lit(sun));
                    }});
    for (const std::string& backend : cli::backend_names()) {
        if (backend == "null") continue;
        auto device = cli::create_device({.backend = backend});
        if (!device) {
            std::fprintf(stderr, "%s is left out: %s\n", backend.c_str(),
                         device.error().message.c_str());
            continue;
        }
        devices.push_back(std::move(*device));
        for (const char* silhouette : {"certificates", "auto"}) {
            plans.push_back(must(sun_study::PlanShadows::create(
                devices.back(), casters, grid,
                {.silhouette = silhouette, .jobs = shadows::thread_jobs(threads)})));
            sun_study::PlanShadows* plan = &plans.back();
            ways.push_back({backend + ", " + silhouette,
                            [plan](const glm::dvec3& sun) { return plan->lit(sun); }});
        }
    }
    for (std::size_t step = 0; step < suns.size(); ++step) {
        std::vector<sun_study::PlanMask> masks(ways.size());
        for (std::size_t turn = 0; turn < ways.size(); ++turn) {
            const std::size_t w = (turn + step) % ways.size();
            const auto start = Clock::now();
            masks[w] = must(ways[w].lit(suns[step]));
            ways[w].seconds += std::chrono::duration<double>(Clock::now() - start).count();
        }
        for (std::size_t w = 0; w < ways.size(); ++w) {
            for (std::size_t i = 0; i < masks[w].size(); ++i) {
                ways[w].differing += masks[w][i] != masks[0][i] ? 1 : 0;
            }
        }
        std::fprintf(stderr, "\rstep %zu of %zu \x1b[K", step + 1, suns.size());
    }
    std::fprintf(stderr, "\r\x1b[K");
    const auto steps = static_cast<double>(suns.size());
    nlohmann::json json{{"model", o.model},      {"columns", grid.columns}, {"rows", grid.rows},
                        {"cell_m", grid.cell_m}, {"steps", suns.size()},    {"threads", threads}};
    for (const Way& way : ways) {
        json["ways"].push_back(
            {{"name", way.name},
             {"steps_a_second", steps / way.seconds},
             {"times_as_fast_as_rays", ways[0].seconds / way.seconds},
             {"cells_unlike_rays", static_cast<double>(way.differing) /
                                       (steps * static_cast<double>(grid.cell_count()))}});
    }
    const std::string text = json.dump(2) + "\n";
    std::printf("%s", text.c_str());
    if (!o.out.empty()) std::ofstream(o.out) << text;
}

}  // namespace

int main(int argc, char** argv) {
    Options o;
    CLI::App app("Steps of a sun study a second, by stencil shadow volumes and by Embree rays.",
                 "gnomon-plan-bench");
    app.add_option("model", o.model, "The model, in metres and +Y up")->required();
    app.add_option("--out", o.out, "Write the JSON here as well");
    app.add_option("--grid", o.cell_m, "Metres a cell")->check(CLI::Range(1e-3, 1e3));
    app.add_option("--plane", o.height_m, "Height of the plane in metres");
    app.add_option("--days", o.days, "Days, spread over a year")->check(CLI::Range(1, 365));
    app.add_option("--step", o.step_min, "Minutes")->check(CLI::Range(1, 360));
    app.add_option("--threads", o.threads, "Default: all");
    CLI11_PARSE(app, argc, argv);
    try {
        run(o);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "gnomon-plan-bench: %s\n", error.what());
        return 1;
    }
    return 0;
}
