// SPDX-License-Identifier: MIT
#include "profile/study.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

namespace gnomon::cli {

namespace {

constexpr int study_version = 3;
constexpr std::size_t most_dates = 400;
constexpr double farthest_m = 1e12;
constexpr std::array<std::pair<const char*, PlanMethod>, 3> methods{
    {{"scan", PlanMethod::Scan},
     {"projection", PlanMethod::Projection},
     {"volumes", PlanMethod::Volumes}}};

// Takes values out of an object and remembers the first that is not what it has to be.
class StudyReader {
public:
    explicit StudyReader(const nlohmann::json& object) : object_(object) {}

    std::string text(const char* key) {
        const auto* value = find(key);
        if (value != nullptr && value->is_string()) return value->get<std::string>();
        refuse(fmt::format("\"{}\" is no text", key));
        return {};
    }
    double number(const char* key, double min, double max) {
        const auto* value = find(key);
        return number_in(value, fmt::format("\"{}\"", key), min, max);
    }
    std::int64_t whole(const char* key, std::int64_t min, std::int64_t max) {
        const auto* value = find(key);
        // As a double first: no number that JSON can write is out of its range.
        const bool fits = value != nullptr && value->is_number_integer() &&
                          value->get<double>() >= static_cast<double>(min) &&
                          value->get<double>() <= static_cast<double>(max);
        if (fits) return value->get<std::int64_t>();
        refuse(fmt::format("\"{}\" is no whole number from {} to {}", key, min, max));
        return min;
    }
    std::uint32_t count(const char* key, std::uint32_t min, std::uint32_t max) {
        return static_cast<std::uint32_t>(whole(key, min, max));
    }
    glm::dvec2 point(const char* key, double most) {
        const auto* value = find(key);
        if (value == nullptr || !value->is_array() || value->size() != 2) {
            refuse(fmt::format("\"{}\" is no pair of numbers", key));
            return {};
        }
        const std::string what = fmt::format("\"{}\"", key);
        const double x = number_in(&(*value)[0], what, -most, most);
        return {x, number_in(&(*value)[1], what, -most, most)};
    }
    std::vector<sun::Date> dates(const char* key) {
        std::vector<sun::Date> all;
        const auto* value = find(key);
        if (value == nullptr || !value->is_array() || value->empty() ||
            value->size() > most_dates) {
            refuse(fmt::format("\"{}\" is no list of 1 to {} dates", key, most_dates));
            return all;
        }
        for (const auto& item : *value) {
            const auto date = sun::parse_date(item.is_string() ? item.get<std::string>() : "");
            if (!date || std::ranges::find(all, *date) != all.end()) {
                refuse(fmt::format("\"{}\" has something else than dates, or one twice", key));
                return all;
            }
            all.push_back(*date);
        }
        return all;
    }
    void refuse(std::string why) {
        if (wrong_.empty()) wrong_ = std::move(why);
    }
    [[nodiscard]] const std::string& wrong() const { return wrong_; }

private:
    const nlohmann::json* find(const char* key) const {
        if (!object_.is_object()) return nullptr;
        const auto at = object_.find(key);
        return at == object_.end() ? nullptr : &*at;
    }
    double number_in(const nlohmann::json* value, const std::string& what, double min, double max) {
        if (value != nullptr && value->is_number()) {
            const auto number = value->get<double>();
            if (number >= min && number <= max) return number;
        }
        refuse(fmt::format("{} is no number from {:g} to {:g}", what, min, max));
        return min;
    }

    const nlohmann::json& object_;
    std::string wrong_;
};

sun_study::Period period_of(const Study& s, const sun::Date& date) {
    return {.date = date, .from = s.from, .to = s.to, .step = s.step, .offset = s.offset};
}

nlohmann::json method_json(const Study& s) {
    const auto* const method =
        std::ranges::find(methods, s.method, [](const auto& m) { return m.second; });
    nlohmann::json json{{"name", method->first}};
    if (s.method != PlanMethod::Scan) json["backend"] = s.backend;
    return json;
}

void read_method(StudyReader& in, Study& s) {
    const std::string name = in.text("name");
    const auto* const method =
        std::ranges::find_if(methods, [&](const auto& m) { return name == m.first; });
    if (method == methods.end()) {
        in.refuse("\"method\" has a \"name\" that is none of scan, projection and volumes");
        return;
    }
    s.method = method->second;
    if (s.method != PlanMethod::Scan) s.backend = in.text("backend");
}

sun::Place place_of(const Study& s) {
    return {glm::radians(s.latitude_deg), glm::radians(s.longitude_deg), s.elevation_m};
}

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
            {"receivers_hash", s.receivers_hash},
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
              {"height_m", s.grid.height_m}}},
            {"method", method_json(s)}};
}

Result<Study> study_from_json(const std::string& text, const std::string& place) {
    const auto refused = [&](const std::string& why) {
        return fail(
            ErrorCode::InvalidInput,
            fmt::format("{} is no study of this version of gnomon profile: {}.", place, why));
    };
    const auto json = nlohmann::json::parse(text, nullptr, false);
    if (json.is_discarded()) return refused("it is no JSON");
    StudyReader in(json);
    if (in.whole("version", 0, INT32_MAX) != study_version) {
        return refused(in.wrong().empty() ? "its version is another" : in.wrong());
    }
    Study s;
    s.model = in.text("model");
    s.model_hash = in.text("model_hash");
    s.casters = in.text("casters");
    s.before = in.text("before");
    s.before_hash = in.text("before_hash");
    s.receivers = in.text("receivers");
    s.receivers_hash = in.text("receivers_hash");
    s.spacing_m = in.number("spacing_m", 0.0, 1e6);
    s.surface_points = in.count("surface_points", 0, most_surface_points);
    s.latitude_deg = in.number("latitude_deg", -90.0, 90.0);
    s.longitude_deg = in.number("longitude_deg", -180.0, 180.0);
    s.elevation_m = in.number("elevation_m", -500.0, 9000.0);
    s.air.pressure_mbar = in.number("pressure_mbar", 0.0, 1200.0);
    s.air.temperature_c = in.number("temperature_c", -80.0, 60.0);
    s.dates = in.dates("dates");
    s.from = std::chrono::minutes(in.whole("from_min", 0, 1440));
    s.to = std::chrono::minutes(in.whole("to_min", 0, 1440));
    s.step = std::chrono::seconds(in.whole("step_s", 1, 86400));
    s.offset = std::chrono::minutes(in.whole("utc_offset_min", -840, 840));
    s.north_deg = in.number("north_deg", -360.0, 360.0);
    s.min_altitude_deg = in.number("min_altitude_deg", 0.0, 90.0);
    s.skip_after_sunrise_min = in.count("skip_after_sunrise_min", 0, 720);
    s.skip_before_sunset_min = in.count("skip_before_sunset_min", 0, 720);
    if (s.from >= s.to) in.refuse("\"to_min\" is not after \"from_min\"");
    if (!json.contains("grid")) return refused("it has no \"grid\"");
    StudyReader grid(json.at("grid"));
    s.grid.min_m = grid.point("min_m", farthest_m);
    s.grid.cell_m = grid.number("cell_m", 1e-3, 1e6);
    s.grid.columns = grid.count("columns", 1, most_cells_a_side);
    s.grid.rows = grid.count("rows", 1, most_cells_a_side);
    s.grid.height_m = grid.number("height_m", -farthest_m, farthest_m);
    if (s.grid.cell_count() > most_cells) {
        grid.refuse(fmt::format("its grid has more than {} cells", most_cells));
    }
    if (!json.contains("method")) return refused("it has no \"method\"");
    StudyReader method(json.at("method"));
    read_method(method, s);
    for (const std::string& wrong : {grid.wrong(), method.wrong()}) in.refuse(wrong);
    if (!in.wrong().empty()) return refused(in.wrong());
    return s;
}

Result<std::vector<sun_study::Step>> steps_of(const Study& s, const sun::Date& date) {
    return sun_study::make_steps(
        period_of(s, date), place_of(s), s.air,
        {.min_altitude_rad = glm::radians(s.min_altitude_deg),
         .skip_after_sunrise = std::chrono::minutes(s.skip_after_sunrise_min),
         .skip_before_sunset = std::chrono::minutes(s.skip_before_sunset_min)});
}

std::string why_no_sun(const Study& study, const sun::Date& date,
                       std::span<const sun_study::Step> steps) {
    return sun_study::why_no_sun(steps, period_of(study, date), place_of(study));
}

glm::dvec3 towards_sun(const Study& study, const sun_study::Step& step) {
    return sun::towards_sun(step.sun.azimuth_rad, step.sun.altitude_rad,
                            glm::radians(study.north_deg));
}

}  // namespace gnomon::cli
