// SPDX-License-Identifier: MIT
#include "play/settings.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "json_place.hpp"
#include "recording.hpp"

namespace gnomon::game {

namespace {

constexpr const char* settings_format = "gnomon-game-settings 1";
constexpr std::size_t most_won = 1000;

bool truth_of(const JsonPlace& place, const nlohmann::json& value) {
    if (!value.is_boolean()) place.must_be("true or false");
    return value.get<bool>();
}

Settings settings_of(const nlohmann::json& document, const std::string& file) {
    const JsonPlace root(document, file);
    root.only({"format", "backend", "fullscreen", "vsync", "scale_percent", "samples",
               "mouse_speed", "mouse_inverted", "won"});
    if (root.member("format").text(60) != settings_format) {
        root.member("format").must_be(fmt::format("\"{}\"", settings_format));
    }
    Settings settings;
    const auto truth = [&](const char* name, bool& into) {
        if (const auto place = root.find(name)) into = truth_of(*place, document.at(name));
    };
    truth("fullscreen", settings.fullscreen);
    truth("vsync", settings.vsync);
    truth("mouse_inverted", settings.mouse_inverted);
    if (const auto place = root.find("backend")) {
        settings.backend = place->text(60);
        if (settings.backend == "auto") settings.backend.clear();
        if (!settings.backend.empty() && settings.backend != "gl" && settings.backend != "vk") {
            place->must_be("\"auto\", \"gl\" or \"vk\"");
        }
    }
    if (const auto place = root.find("scale_percent")) {
        settings.scale_percent = place->whole(50, 100);
    }
    if (const auto place = root.find("samples")) {
        settings.samples = place->whole(1, 4);
        if (settings.samples != 1 && settings.samples != 4) place->must_be("1 or 4");
    }
    if (const auto place = root.find("mouse_speed")) settings.mouse_speed = place->number(0.2, 3.0);
    if (const auto place = root.find("won")) {
        for (const JsonPlace& entry : place->entries(0, most_won)) {
            const std::string& name = entry.text(60);
            if (!is_level_name(name)) entry.must_be("the name of a level");
            settings.won.push_back(name);
        }
    }
    return settings;
}

}  // namespace

Settings changed(Settings settings, Setting setting, int by) {
    if (by == 0) return settings;
    switch (setting) {
        case Setting::Backend: settings.backend = settings.backend == "vk" ? "gl" : "vk"; break;
        case Setting::Fullscreen: settings.fullscreen = !settings.fullscreen; break;
        case Setting::Vsync: settings.vsync = !settings.vsync; break;
        case Setting::Scale:
            settings.scale_percent = static_cast<std::uint32_t>(
                std::clamp(static_cast<int>(settings.scale_percent) + 10 * by, 50, 100));
            break;
        case Setting::Samples: settings.samples = settings.samples == 4 ? 1 : 4; break;
        case Setting::MouseSpeed:
            // Tenths, so that the file has no digits that nobody chose.
            settings.mouse_speed = std::round((settings.mouse_speed + 0.1 * by) * 10.0) / 10.0;
            settings.mouse_speed = std::clamp(settings.mouse_speed, 0.2, 3.0);
            break;
        case Setting::MouseInverted: settings.mouse_inverted = !settings.mouse_inverted; break;
    }
    return settings;
}

std::string to_text(const Settings& settings) {
    nlohmann::ordered_json document;
    document["format"] = settings_format;
    document["backend"] = settings.backend.empty() ? "auto" : settings.backend;
    document["fullscreen"] = settings.fullscreen;
    document["vsync"] = settings.vsync;
    document["scale_percent"] = settings.scale_percent;
    document["samples"] = settings.samples;
    document["mouse_speed"] = settings.mouse_speed;
    document["mouse_inverted"] = settings.mouse_inverted;
    document["won"] = settings.won;
    return document.dump(2) + "\n";
}

Result<Settings> read_settings(std::string_view text, const std::string& file) {
    try {
        return settings_of(parse_level_json(text, file), file);
    } catch (const BadLevel& bad) {
        return fail(ErrorCode::InvalidInput, bad.sentence);
    }
}

}  // namespace gnomon::game
