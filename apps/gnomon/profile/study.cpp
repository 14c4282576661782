// SPDX-License-Identifier: MIT
#include "profile/study.hpp"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

namespace gnomon::cli {

namespace {

constexpr int study_version = 1;

}  // namespace

nlohmann::json to_json(const Study& s) {
    std::vector<std::string> dates;
    for (const sun::Date& date : s.dates) dates.push_back(sun::to_text(date));
    return {{"version", study_version},
            {"model", s.model},
            {"model_hash", s.model_hash},
            {"casters", s.casters},
            {"before", s.before},
            {"before_hash", s.before_hash},
            {"receivers", s.receivers},
            {"spacing_m", s.spacing_m},
            {"surface_points", s.surface_points},
            {"latitude_deg", s.latitude_deg},
            {"longitude_deg", s.longitude_deg},
            {"elevation_m", s.elevation_m},
            {"pressure_mbar", s.air.pressure_mbar},
            {"temperature_c", s.air.temperature_c},
            {"dates", dates},
            {"from_min", s.from.count()},
            {"to_min", s.to.count()},
            {"step_s", s.step.count()},
            {"utc_offset_min", s.offset.count()},
            {"north_deg", s.north_deg},
            {"min_altitude_deg", s.min_altitude_deg},
            {"skip_after_sunrise_min", s.skip_after_sunrise_min},
            {"skip_before_sunset_min", s.skip_before_sunset_min},
            {"grid",
             {{"min_m", {s.grid.min_m.x, s.grid.min_m.y}},
              {"cell_m", s.grid.cell_m},
              {"columns", s.grid.columns},
              {"rows", s.grid.rows},
              {"height_m", s.grid.height_m}}}};
}

Result<Study> study_from_json(const std::string& text, const std::string& place) {
    const auto refused = [&](const std::string& why) {
        return fail(
            ErrorCode::InvalidInput,
            fmt::format("{} is no study of this version of gnomon profile: {}.", place, why));
    };
    try {
        const auto json = nlohmann::json::parse(text);
        if (json.at("version") != study_version) return refused("its version is another");
        Study s;
        s.model = json.at("model");
        s.model_hash = json.at("model_hash");
        s.casters = json.at("casters");
        s.before = json.at("before");
        s.before_hash = json.at("before_hash");
        s.receivers = json.at("receivers");
        s.spacing_m = json.at("spacing_m");
        s.surface_points = json.at("surface_points");
        s.latitude_deg = json.at("latitude_deg");
        s.longitude_deg = json.at("longitude_deg");
        s.elevation_m = json.at("elevation_m");
        s.air.pressure_mbar = json.at("pressure_mbar");
        s.air.temperature_c = json.at("temperature_c");
        for (const auto& item : json.at("dates")) {
            const auto date = sun::parse_date(item.get<std::string>());
            if (!date) return forward_error(date);
            s.dates.push_back(*date);
        }
        s.from = std::chrono::minutes(json.at("from_min").get<int>());
        s.to = std::chrono::minutes(json.at("to_min").get<int>());
        s.step = std::chrono::seconds(json.at("step_s").get<int>());
        s.offset = std::chrono::minutes(json.at("utc_offset_min").get<int>());
        s.north_deg = json.at("north_deg");
        s.min_altitude_deg = json.at("min_altitude_deg");
        s.skip_after_sunrise_min = json.at("skip_after_sunrise_min");
        s.skip_before_sunset_min = json.at("skip_before_sunset_min");
        const auto& grid = json.at("grid");
        s.grid.min_m = {grid.at("min_m").at(0).get<double>(), grid.at("min_m").at(1).get<double>()};
        s.grid.cell_m = grid.at("cell_m");
        s.grid.columns = grid.at("columns");
        s.grid.rows = grid.at("rows");
        s.grid.height_m = grid.at("height_m");
        constexpr std::uint32_t most = 1U << 20U;
        if (s.dates.empty() || s.step.count() < 1 || s.grid.columns < 1 || s.grid.rows < 1 ||
            s.grid.columns > most || s.grid.rows > most) {
            return refused("a number in it is out of range");
        }
        return s;
    } catch (const nlohmann::json::exception& error) {
        return refused(error.what());
    }
}

Result<std::vector<sun_study::Step>> steps_of(const Study& s, const sun::Date& date) {
    return sun_study::make_steps(
        {.date = date, .from = s.from, .to = s.to, .step = s.step, .offset = s.offset},
        {glm::radians(s.latitude_deg), glm::radians(s.longitude_deg), s.elevation_m}, s.air,
        {.min_altitude_rad = glm::radians(s.min_altitude_deg),
         .skip_after_sunrise = std::chrono::minutes(s.skip_after_sunrise_min),
         .skip_before_sunset = std::chrono::minutes(s.skip_before_sunset_min)});
}

glm::dvec3 towards_sun(const Study& study, const sun_study::Step& step) {
    return sun::towards_sun(step.sun.azimuth_rad, step.sun.altitude_rad,
                            glm::radians(study.north_deg));
}

}  // namespace gnomon::cli
