// SPDX-License-Identifier: MIT
#include "level.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "json_place.hpp"

namespace gnomon::game {

namespace {

constexpr double farthest_m = 200.0;
constexpr std::size_t most_things = 200;
constexpr std::size_t most_points = 64;
constexpr double least_step_m = 0.05;  // of paths and walls

glm::vec3 color_of(const JsonPlace& place) { return glm::vec3(place.vec3(0.0, 4.0)); }

void read_color(const JsonPlace& in, const char* name, glm::vec3& into) {
    if (const auto place = in.find(name)) into = color_of(*place);
}
void read_number(const JsonPlace& in, const char* name, double min, double max, double& into) {
    if (const auto place = in.find(name)) into = place->number(min, max);
}
void read_angle(const JsonPlace& in, const char* name, double min_deg, double max_deg,
                double& into_rad) {
    if (const auto place = in.find(name)) into_rad = glm::radians(place->number(min_deg, max_deg));
}
glm::dvec2 plan_place(const JsonPlace& place) { return place.vec2(-farthest_m, farthest_m); }

template <class Read>
void for_entries(const JsonPlace& in, const char* name, const Read& read) {
    const auto list = in.find(name);
    if (!list) return;
    for (const JsonPlace& entry : list->entries(0, most_things)) read(entry);
}

/// A closed path: two points at least, and neighbours, the last and the first as well, so far apart
/// that what goes along it has a direction.
std::vector<glm::dvec2> path_of(const JsonPlace& in) {
    const std::vector<JsonPlace> entries = in.entries(2, most_points);
    std::vector<glm::dvec2> path;
    for (const JsonPlace& entry : entries) {
        path.push_back(plan_place(entry));
        if (path.size() < 2) continue;
        const double step_m = glm::length(path.back() - path[path.size() - 2]);
        if (!(step_m >= least_step_m)) {
            entry.refuse(
                fmt::format("is {} m from the entry before it; a path must go on by {} m at least",
                            step_m, least_step_m));
        }
    }
    const double step_m = glm::length(path.front() - path.back());
    if (!(step_m >= least_step_m)) {
        entries.back().refuse(fmt::format(
            "is {} m from where the path began, but must be {} m or more from there: a path closes "
            "by itself",
            step_m, least_step_m));
    }
    return path;
}

void read_mood(const JsonPlace& in, Mood& mood) {
    in.only({"sky", "ground", "background", "exposure", "floor", "walls", "outside"});
    read_color(in, "sky", mood.sky);
    read_color(in, "ground", mood.ground);
    read_color(in, "background", mood.background);
    read_color(in, "floor", mood.floor);
    read_color(in, "walls", mood.walls);
    read_color(in, "outside", mood.outside);
    if (const auto place = in.find("exposure"))
        mood.exposure = static_cast<float>(place->number(0.001, 100.0));
}

void read_camera(const JsonPlace& in, CameraRig& camera) {
    in.only({"pitch_deg", "yaw_deg", "distance_m", "fovy_deg"});
    read_angle(in, "pitch_deg", 20.0, 85.0, camera.pitch_rad);
    read_angle(in, "yaw_deg", -180.0, 180.0, camera.yaw_rad);
    read_number(in, "distance_m", 3.0, 60.0, camera.distance_m);
    read_angle(in, "fovy_deg", 15.0, 90.0, camera.fovy_rad);
}

/// From one point to another, as builders think of it, with a pier at either end: where walls meet,
/// their upper sides would lie in one plane, and the pier covers that.
void read_wall(const JsonPlace& in, const glm::vec3& color, std::vector<Block>& walls,
               std::vector<Block>& piers) {
    in.only({"from", "to", "height_m", "thickness_m", "base_m"});
    const glm::dvec2 from = plan_place(in.member("from"));
    const glm::dvec2 to = plan_place(in.member("to"));
    const double length = glm::length(to - from);
    if (!(length >= least_step_m))
        in.member("to").refuse("is where the wall begins; it has no length");
    double height = 2.4;
    double thickness = 0.35;
    Block wall;
    read_number(in, "height_m", 0.1, 20.0, height);
    read_number(in, "thickness_m", 0.05, 10.0, thickness);
    read_number(in, "base_m", 0.0, 20.0, wall.base_m);
    wall.at = (from + to) * 0.5;
    wall.size_m = {length, height, thickness};
    // Along its own x.
    wall.turn_rad = std::atan2(-(to - from).y, (to - from).x);
    wall.is_wall = true;
    wall.color = color;
    walls.push_back(wall);
    if (wall.base_m > 0.0) return;
    for (const glm::dvec2& end : {from, to}) {
        Block pier = wall;
        pier.at = end;
        pier.size_m = {thickness + 0.14, height + 0.12, thickness + 0.14};
        const auto same = std::ranges::find(piers, end, &Block::at);
        if (same == piers.end()) {
            piers.push_back(pier);
        } else {
            same->size_m = glm::max(same->size_m, pier.size_m);
        }
    }
}

Block read_block(const JsonPlace& in) {
    in.only({"at", "size_m", "turn_deg", "base_m", "color"});
    Block block;
    block.at = plan_place(in.member("at"));
    block.size_m = in.member("size_m").vec3(0.05, 60.0);
    read_angle(in, "turn_deg", -360.0, 360.0, block.turn_rad);
    read_number(in, "base_m", 0.0, 20.0, block.base_m);
    block.color = glm::vec3(0.42F, 0.29F, 0.17F);
    read_color(in, "color", block.color);
    return block;
}

Sun read_sun(const JsonPlace& in) {
    in.only({"from_deg", "to_deg", "period_s", "lux", "color"});
    const auto sky_place = [](const JsonPlace& place) {
        const glm::dvec2 angles = place.vec2(-360.0, 360.0);
        if (angles.y < 3.0 || angles.y > 90.0) {
            place.refuse(fmt::format("has the elevation {}, but that must be a number from 3 to 90",
                                     angles.y));
        }
        return glm::radians(angles);
    };
    Sun sun;
    sun.from_rad = sky_place(in.member("from_deg"));
    const auto to = in.find("to_deg");
    sun.to_rad = to ? sky_place(*to) : sun.from_rad;
    read_number(in, "period_s", 5.0, 3600.0, sun.period_s);
    read_number(in, "lux", 0.0, 1e5, sun.lux);
    read_color(in, "color", sun.color);
    return sun;
}

template <class Light>
void read_brightness(const JsonPlace& in, Light& light) {
    read_number(in, "candela", 0.0, 1e5, light.candela);
    read_number(in, "range_m", 0.5, 200.0, light.range_m);
    read_color(in, "color", light.color);
}

/// A place in space, `least_m` or more above the ground: what is there stands on something.
glm::dvec3 place_above(const JsonPlace& place, double least_m) {
    const glm::dvec3 at = place.vec3(-farthest_m, farthest_m);
    if (at.y < least_m) {
        place.refuse(fmt::format("is {} m above the ground, but must be {} m or more above it",
                                 at.y, least_m));
    }
    return at;
}

Lamp read_lamp(const JsonPlace& in) {
    in.only({"at", "candela", "range_m", "color"});
    Lamp lamp;
    lamp.at = place_above(in.member("at"), 0.5);
    read_brightness(in, lamp);
    return lamp;
}

Searchlight read_searchlight(const JsonPlace& in) {
    in.only({"at", "path", "period_s", "candela", "range_m", "cone_deg", "color"});
    Searchlight light;
    light.at = place_above(in.member("at"), 2.0);
    light.path = path_of(in.member("path"));
    read_number(in, "period_s", 2.0, 600.0, light.period_s);
    read_angle(in, "cone_deg", 1.0, 45.0, light.cone_rad);
    read_brightness(in, light);
    return light;
}

Guard read_guard(const JsonPlace& in) {
    in.only(
        {"path", "speed_m_s", "pause_s", "hearing_m", "candela", "range_m", "cone_deg", "color"});
    Guard guard;
    guard.path = path_of(in.member("path"));
    read_number(in, "speed_m_s", 0.1, 4.0, guard.speed_m_s);
    read_number(in, "pause_s", 0.0, 60.0, guard.pause_s);
    read_number(in, "hearing_m", 0.0, 50.0, guard.hearing_m);
    read_angle(in, "cone_deg", 5.0, 80.0, guard.cone_rad);
    read_brightness(in, guard);
    return guard;
}

Door read_door(const JsonPlace& in) {
    in.only({"hinge", "width_m", "height_m", "turn_deg", "open_deg"});
    Door door;
    door.hinge = plan_place(in.member("hinge"));
    read_number(in, "width_m", 0.5, 5.0, door.width_m);
    read_number(in, "height_m", 0.5, 6.0, door.height_m);
    read_angle(in, "turn_deg", -360.0, 360.0, door.turn_rad);
    read_angle(in, "open_deg", -170.0, 170.0, door.open_rad);
    return door;
}

Crane read_crane(const JsonPlace& in) {
    in.only({"at", "height_m", "arm_m", "swing_deg", "period_s", "load_m", "load_base_m"});
    Crane crane;
    crane.at = plan_place(in.member("at"));
    read_number(in, "height_m", 4.0, 40.0, crane.height_m);
    read_number(in, "arm_m", 1.0, 40.0, crane.arm_m);
    if (const auto place = in.find("swing_deg"))
        crane.swing_rad = glm::radians(place->vec2(-720.0, 720.0));
    read_number(in, "period_s", 4.0, 600.0, crane.period_s);
    if (const auto place = in.find("load_m")) crane.load_m = place->vec3(0.2, 20.0);
    read_number(in, "load_base_m", 2.0, 30.0, crane.load_base_m);
    if (crane.load_base_m + crane.load_m.y >= crane.height_m) {
        in.refuse(fmt::format(
            "has a load whose top hangs {} m above the ground, but that must be below its height_m "
            "of {}",
            crane.load_base_m + crane.load_m.y, crane.height_m));
    }
    return crane;
}

Wheel read_wheel(const JsonPlace& in) {
    in.only({"at", "radius_m", "spokes", "turn_deg", "period_s"});
    Wheel wheel;
    wheel.at = plan_place(in.member("at"));
    read_number(in, "radius_m", 0.5, 20.0, wheel.radius_m);
    if (const auto place = in.find("spokes")) wheel.spokes = place->whole(2, 64);
    read_angle(in, "turn_deg", -360.0, 360.0, wheel.turn_rad);
    read_number(in, "period_s", 2.0, 600.0, wheel.period_s);
    return wheel;
}

/// A place that somebody must be able to stand at.
void must_be_on_ground(const JsonPlace& place, const glm::dvec2& at, const glm::dvec2& size_m) {
    if (std::abs(at.x) <= size_m.x * 0.5 && std::abs(at.y) <= size_m.y * 0.5) return;
    place.refuse(fmt::format("is [{}, {}], but must lie on the ground, which reaches to [{}, {}]",
                             at.x, at.y, size_m.x * 0.5, size_m.y * 0.5));
}

Level level_of(const JsonPlace& in) {
    in.only({"format", "name",         "hint",           "size_m", "mood",   "camera", "player",
             "exit",   "seen_lux",     "caught_after_s", "sun",    "walls",  "blocks", "columns",
             "lamps",  "searchlights", "guards",         "doors",  "cranes", "wheels"});
    const JsonPlace format = in.member("format");
    if (format.text(100) != "gnomon-level 1") format.must_be("\"gnomon-level 1\"");
    Level level;
    level.name = in.member("name").text(60);
    if (const auto hint = in.find("hint")) level.hint = hint->text(300);
    level.size_m = in.member("size_m").vec2(4.0, farthest_m);
    if (const auto mood = in.find("mood")) read_mood(*mood, level.mood);
    if (const auto camera = in.find("camera")) read_camera(*camera, level.camera);

    const JsonPlace player = in.member("player").only({"at", "facing_deg"});
    level.start = plan_place(player.member("at"));
    must_be_on_ground(player.member("at"), level.start, level.size_m);
    read_angle(player, "facing_deg", -360.0, 360.0, level.start_facing_rad);
    const JsonPlace exit = in.member("exit").only({"at", "half_m"});
    level.exit = plan_place(exit.member("at"));
    must_be_on_ground(exit.member("at"), level.exit, level.size_m);
    if (const auto half = exit.find("half_m")) level.exit_half_m = half->vec2(0.3, 20.0);
    read_number(in, "seen_lux", 0.01, 1e5, level.seen_lux);
    read_number(in, "caught_after_s", 0.1, 60.0, level.caught_after_s);

    if (const auto sun = in.find("sun")) level.sun = read_sun(*sun);
    std::vector<Block> piers;
    for_entries(in, "walls", [&](const JsonPlace& entry) {
        read_wall(entry, level.mood.walls, level.blocks, piers);
    });
    level.blocks.insert(level.blocks.end(), piers.begin(), piers.end());
    for_entries(in, "blocks",
                [&](const JsonPlace& entry) { level.blocks.push_back(read_block(entry)); });
    for_entries(in, "columns", [&](const JsonPlace& entry) {
        entry.only({"at", "radius_m", "height_m"});
        Column column;
        column.at = plan_place(entry.member("at"));
        read_number(entry, "radius_m", 0.05, 10.0, column.radius_m);
        read_number(entry, "height_m", 0.5, 20.0, column.height_m);
        level.columns.push_back(column);
    });
    for_entries(in, "lamps",
                [&](const JsonPlace& entry) { level.lamps.push_back(read_lamp(entry)); });
    for_entries(in, "searchlights", [&](const JsonPlace& entry) {
        level.searchlights.push_back(read_searchlight(entry));
    });
    for_entries(in, "guards",
                [&](const JsonPlace& entry) { level.guards.push_back(read_guard(entry)); });
    for_entries(in, "doors",
                [&](const JsonPlace& entry) { level.doors.push_back(read_door(entry)); });
    for_entries(in, "cranes",
                [&](const JsonPlace& entry) { level.cranes.push_back(read_crane(entry)); });
    for_entries(in, "wheels",
                [&](const JsonPlace& entry) { level.wheels.push_back(read_wheel(entry)); });
    return level;
}

}  // namespace

Result<Level> read_level(std::string_view text, const std::string& file) {
    try {
        const nlohmann::json document = parse_level_json(text, file);
        return level_of(JsonPlace(document, file));
    } catch (const BadLevel& bad) {
        return fail(ErrorCode::InvalidInput, bad.sentence);
    }
}

}  // namespace gnomon::game
