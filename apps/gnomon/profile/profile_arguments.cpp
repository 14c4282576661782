// SPDX-License-Identifier: MIT
#include "profile/profile_arguments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "arguments.hpp"
#include "devices.hpp"
#include "scene_arguments.hpp"

namespace gnomon::cli {

namespace {

constexpr const char* footer =
    "MODEL is anything that gnomon render takes. Writes into DIR profile.png (the shadows of all "
    "steps over\n"
    "the plan), hours.png and hours.csv (how long the sun reaches each cell), summary.json, "
    "report.html,\n"
    "sun-path.png, a world file beside each plan, and masks/*.npy, one a step; in a folder a date "
    "where there\n"
    "are several. Azimuths run from true north clockwise; the plan has x to the right and, for a "
    "model that is\n"
    "+Y up, -Z up the plan. What was drawn is kept: an interrupted run goes on where it was.\n\n"
    "  gnomon profile house.glb --lat 48.306 --lon 14.286 --date 2026-03-21 --from 06:00 --to "
    "19:00 --tz +01:00 \\\n"
    "    --grid 0.25m --out house-study\n"
    "  gnomon profile site.glb … --shard 2/8 --out part2     and on other machines the other "
    "parts, then\n"
    "  gnomon profile --merge part1 part2 … --out study";

// A length in metres, with or without the letter m.
Result<double> parse_length(const std::string& text, const char* what, double min, double max) {
    const bool has_unit = text.size() > 1 && text.back() == 'm';
    return parse_number(has_unit ? std::string_view(text).substr(0, text.size() - 1) : text, what,
                        min, max);
}

Result<std::array<double, 4>> parse_area(const std::string& text) {
    std::array<double, 4> area{};
    std::size_t count = 0;
    for (std::size_t at = 0; at <= text.size() && count <= 4; ++count) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        if (count == 4) {
            ++count;
            break;
        }
        const auto number = parse_number(text.substr(at, end - at), "--area", -1e9, 1e9);
        if (!number) return forward_error(number);
        area[count] = *number;
        at = end + 1;
    }
    if (count != 4) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("--area: \"{}\" is not four numbers, as in 0,0,100,80.", text));
    }
    if (area[2] <= area[0] || area[3] <= area[1]) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("--area: \"{}\" is empty: it goes from the lower left corner to "
                                "the upper right one.",
                                text));
    }
    return area;
}

Result<Shard> parse_shard(const std::string& text) {
    const auto slash = text.find('/');
    const auto bad = [&] {
        return fail(
            ErrorCode::InvalidInput,
            fmt::format("--shard: \"{}\" is not I/N with I from 1 to N and N at most 100000.",
                        text));
    };
    if (slash == std::string::npos) return bad();
    const auto index = parse_number(text.substr(0, slash), "--shard", 1.0, 1e5);
    const auto count = parse_number(text.substr(slash + 1), "--shard", 1.0, 1e5);
    if (!index || !count || *index > *count || *index != std::floor(*index) ||
        *count != std::floor(*count)) {
        return bad();
    }
    return Shard{static_cast<std::uint32_t>(*index), static_cast<std::uint32_t>(*count)};
}

template <class T>
auto optional_of(Result<T> (*parse)(std::string_view)) {
    return [parse](const std::string& text) -> Result<std::optional<T>> {
        auto value = parse(text);
        if (!value) return forward_error(value);
        return std::optional<T>(std::move(*value));
    };
}

void add_place_and_time(CLI::App& app, ProfileOptions& o) {
    const auto number = [](const char* what, double min, double max) {
        return [=](const std::string& text) { return parse_number(text, what, min, max); };
    };
    app.add_option_function<std::string>("--lat",
                                         parsed_into(o.latitude_deg, number("--lat", -90.0, 90.0)),
                                         "Latitude in degrees, north positive")
        ->type_name("DEG");
    app.add_option_function<std::string>(
           "--lon", parsed_into(o.longitude_deg, number("--lon", -180.0, 180.0)),
           "Longitude in degrees, east positive")
        ->type_name("DEG");
    app.add_option_function<std::string>(
           "--elevation", parsed_into(o.elevation_m, number("--elevation", -500.0, 9000.0)),
           "Metres above the sea; default 0")
        ->type_name("METRES");
    app.add_option_function<std::string>(
           "--date",
           parsed_into(o.dates, [](const std::string& text) { return sun::parse_dates(text); }),
           "Days, with commas; A..B every day from A to B, A..B/N every N-th")
        ->type_name("YYYY-MM-DD[,…]");
    app.add_option_function<std::string>(
           "--from", parsed_into(o.from, optional_of(&sun::parse_clock)), "The first step")
        ->type_name("HH:MM");
    app.add_option_function<std::string>("--to", parsed_into(o.to, optional_of(&sun::parse_clock)),
                                         "No step is later")
        ->type_name("HH:MM");
    app.add_option_function<std::string>(
           "--step",
           parsed_into(o.step, [](const std::string& text) { return sun::parse_duration(text); }),
           "From one step to the next: 30s, 10m, 1h; default 10m")
        ->type_name("TIME");
    app.add_option_function<std::string>(
           "--tz",
           parsed_into(o.offset, [](const std::string& text) { return sun::parse_offset(text); }),
           "The clock's offset from UTC, daylight saving included; default Z")
        ->type_name("+HH:MM");
    app.add_option_function<std::string>(
           "--min-altitude", parsed_into(o.min_altitude_deg, number("--min-altitude", 0.0, 90.0)),
           "A lower sun does not count; default 0")
        ->type_name("DEG");
    app.add_option("--skip-after-sunrise", o.skip_after_sunrise_min,
                   "The sun does not count for so long")
        ->check(CLI::Range(0, 720))
        ->type_name("MINUTES");
    app.add_option("--skip-before-sunset", o.skip_before_sunset_min,
                   "The sun does not count for so long")
        ->check(CLI::Range(0, 720))
        ->type_name("MINUTES");
    app.add_option_function<std::string>(
           "--pressure", parsed_into(o.pressure_mbar, number("--pressure", 0.0, 1200.0)),
           "Of the air, for refraction; 0: none; default 1010")
        ->type_name("MBAR");
    app.add_option_function<std::string>(
           "--temperature", parsed_into(o.temperature_c, number("--temperature", -80.0, 60.0)),
           "Of the air, for refraction; default 10")
        ->type_name("CELSIUS");
}

void add_plan(CLI::App& app, ProfileOptions& o) {
    const auto length = [](const char* what, double min, double max) {
        return [=](const std::string& text) { return parse_length(text, what, min, max); };
    };
    app.add_option_function<std::string>("--grid",
                                         parsed_into(o.cell_m, length("--grid", 1e-3, 1e6)),
                                         "The side of a cell; default 0.5m")
        ->type_name("METRES");
    app.add_option_function<std::string>(
           "--plane", parsed_into(o.height_m, length("--plane", -1e6, 1e6)),
           "The height of the plane; default 0.1 m above the lowest point of what casts")
        ->type_name("METRES");
    app.add_option_function<std::string>(
           "--area", parsed_into(o.area_m, &parse_area),
           "Of the plan, in metres; default: what casts, and as much around it as it is high")
        ->type_name("x0,y0,x1,y1");
    app.add_option_function<std::string>(
           "--north",
           parsed_into(o.north_deg,
                       [](const std::string& text) {
                           return parse_number(text, "--north", -360.0, 360.0);
                       }),
           "Where true north is: clockwise from up the plan; default 0")
        ->type_name("DEG");
    app.add_option_function<std::string>(
           "--up", [&o](const std::string& text) { o.z_up = text == "z"; },
           "The model's axis towards the zenith; default y")
        ->check(CLI::IsMember({"y", "z"}));
    app.add_option_function<std::string>(
           "--unit",
           [&o](const std::string& text) {
               o.unit_m = text == "mm"   ? 1e-3
                          : text == "cm" ? 1e-2
                          : text == "in" ? 0.0254
                          : text == "ft" ? 0.3048
                          : text == "km" ? 1e3
                                         : 1.0;
           },
           "The model's unit; default m")
        ->check(CLI::IsMember({"m", "mm", "cm", "km", "ft", "in"}));
    app.add_option("--casters", o.casters,
                   "Only these cast: nodes whose name matches, or components of a mesh, NAME#K as "
                   "gnomon inspect numbers them")
        ->type_name("GLOB");
}

void add_surfaces(CLI::App& app, ProfileOptions& o) {
    app.add_option("--before", o.before,
                   "A model to compare with, in the same coordinates: difference.png and .csv say "
                   "what MODEL gives and takes")
        ->check(not_empty())
        ->type_name("MODEL");
    auto* receivers =
        app.add_option("--receivers", o.receivers,
                       "Ask about points on walls and roofs of these as well, named as --casters "
                       "has it: surfaces.png and .csv")
            ->type_name("GLOB");
    app.add_option_function<std::string>(
           "--spacing",
           parsed_into(
               o.spacing_m,
               [](const std::string& text) { return parse_length(text, "--spacing", 1e-3, 1e6); }),
           "Such points are no farther apart; default 0.5m")
        ->needs(receivers)
        ->type_name("METRES");
    const auto point = [](const char* what) {
        return [what](const std::string& text) -> Result<std::optional<glm::dvec3>> {
            auto value = parse_vector(text, what);
            if (!value) return forward_error(value);
            return std::optional<glm::dvec3>(*value);
        };
    };
    app.add_option_function<std::string>("--eye", parsed_into(o.eye_plan, point("--eye")),
                                         "Make scene.png, the plane and all that casts as seen "
                                         "from here, in the plan's coordinates; surfaces.png looks "
                                         "from here too, else from the sunny side, above")
        ->type_name("x,y,height");
    app.add_option_function<std::string>("--target", parsed_into(o.target_plan, point("--target")),
                                         "And at what; default: the middle of what is drawn")
        ->type_name("x,y,height");
}

// A merged study is that of its parts: what would ask for another is refused, not passed over.
void check_merge(const CLI::App& profile) {
    constexpr std::array<std::string_view, 5> allowed{"--merge", "--out", "--quiet", "--eye",
                                                      "--target"};
    for (const CLI::Option* option : profile.get_options()) {
        const std::string name = option->get_positional() ? "MODEL" : option->get_name();
        if (option->count() == 0 || std::ranges::find(allowed, name) != allowed.end()) continue;
        throw CLI::ValidationError(
            "",
            fmt::format("--merge: {} has no say there; the parts' study.json has it all", name));
    }
}

}  // namespace

const CLI::App* add_profile(CLI::App& app, ProfileOptions& o) {
    auto* profile = app.add_subcommand(
        "profile", "Sun study: which places lie in shadow when, and how long the sun reaches them");
    profile->footer(footer);
    profile->add_option("model", o.model, "The model")->type_name("MODEL");
    add_place_and_time(*profile, o);
    add_plan(*profile, o);
    add_surfaces(*profile, o);
    profile
        ->add_option_function<std::string>(
            "--out",
            [&o](const std::string& text) {
                if (text.empty()) throw CLI::ValidationError("", "--out: the name is empty");
                o.out = text;
            },
            "Write into this folder; it is made where it is not there")
        ->type_name("DIR");
    auto* shard = profile
                      ->add_option_function<std::string>(
                          "--shard", parsed_into(o.shard, &parse_shard),
                          "Draw part I of N alone: masks, and nothing that is made of them")
                      ->type_name("I/N");
    profile
        ->add_option("--merge", o.merge,
                     "Join the parts of one study, each in its folder, and write what is made of "
                     "them; needs no MODEL")
        ->excludes(shard)
        ->type_name("DIR…");
    profile
        ->add_option_function<std::string>(
            "--method",
            [&o](const std::string& text) {
                o.method.reset();
                if (text == "scan") o.method = PlanMethod::Scan;
                if (text == "projection") o.method = PlanMethod::Projection;
                if (text == "volumes") o.method = PlanMethod::Volumes;
            },
            "How plans are drawn: casters flattened onto the plane by the processor (scan) or by a "
            "device (projection), or shadow volumes; default auto: scan, or projection where "
            "--backend is given")
        ->check(CLI::IsMember({"auto", "scan", "projection", "volumes"}));
    profile
        ->add_option("--backend", o.backend,
                     fmt::format("One of {}", fmt::join(backend_names(), ", ")))
        ->check(CLI::IsMember(backend_names()));
    profile
        ->add_option("--threads", o.threads,
                     "Of the processor, to draw on; default: as many as the process may run on")
        ->check(CLI::Range(1, 1024))
        ->type_name("N");
    profile->add_flag("--quiet", o.quiet, "No notes and no progress line");
    profile->final_callback([profile, &o] {
        if (!o.merge.empty()) check_merge(*profile);
    });
    return profile;
}

}  // namespace gnomon::cli
