// SPDX-License-Identifier: MIT
#include "game/given_input.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace gnomon::web {

namespace {

using Json = nlohmann::json;

/// A number of an array; 0 where there is none.
double number_at(const Json& list, std::size_t place) {
    if (!list.is_array() || place >= list.size() || !list[place].is_number()) return 0.0;
    const double value = list[place].get<double>();
    return std::isfinite(value) ? value : 0.0;
}

const Json& member(const Json& of, const char* name) {
    static const Json nothing;
    if (!of.is_object()) return nothing;
    const auto found = of.find(name);
    return found == of.end() ? nothing : *found;
}

glm::vec2 stick_of(const Json& axes) {
    return glm::clamp(glm::vec2(number_at(axes, 0), number_at(axes, 1)), -1.0F, 1.0F);
}

input::Gamepad gamepad_of(const Json& given) {
    input::Gamepad pad;
    pad.left_stick = stick_of(member(given, "left"));
    pad.right_stick = stick_of(member(given, "right"));
    pad.left_trigger = static_cast<float>(number_at(member(given, "triggers"), 0));
    pad.right_trigger = static_cast<float>(number_at(member(given, "triggers"), 1));
    for (const Json& button : member(given, "buttons")) {
        if (!button.is_number_unsigned()) continue;
        const auto place = button.get<std::size_t>();
        if (place < pad.buttons.size()) pad.buttons.set(place);
    }
    return pad;
}

void take_key(const Json& event, input::Input& input) {
    if (!event.is_array() || event.size() != 2 || !event[0].is_string()) return;
    const auto key = input::key_named(event[0].get_ref<const std::string&>());
    if (!key) return;
    if (event[1] != true) {
        input.release(*key);
    } else if (input.is_down(*key)) {
        input.repeat(*key);
    } else {
        input.press(*key);
    }
}

}  // namespace

void take(const Json& given, input::Input& input) {
    input.begin_frame();
    for (const Json& event : member(given, "keys")) take_key(event, input);
    const Json& turn = member(given, "turn");
    input.move_cursor(input.cursor_px() + glm::dvec2(number_at(turn, 0), number_at(turn, 1)));
    const Json& scroll = member(given, "scroll");
    if (scroll.is_number()) input.scroll.y = std::clamp(scroll.get<double>(), -20.0, 20.0);
    const Json& gamepad = member(given, "gamepad");
    std::optional<input::Gamepad> pad;
    if (gamepad.is_object()) pad = gamepad_of(gamepad);
    input.see_gamepad(pad, true);
    if (member(given, "lost") == true) input.lose_focus();
}

void take_choice(const Json& given, game::MenuPress& press) {
    const Json& point = member(given, "point");
    if (!point.is_number_unsigned()) return;
    press.pointed = point.get<std::size_t>();
    press.accept = press.accept || member(given, "accept") == true;
    const Json& step = member(given, "step");
    if (step.is_number_integer()) press.right = std::clamp(step.get<int>(), -1, 1);
}

}  // namespace gnomon::web
