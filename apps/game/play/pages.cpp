// SPDX-License-Identifier: MIT
#include "play/pages.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "play/words.hpp"

namespace gnomon::game {

namespace {

using Kind = MenuItem::Kind;

constexpr float title_left = 84.0F;
constexpr float settings_half = 330.0F;
constexpr float pause_half = 420.0F;

std::string label_of(const MenuItem& item, const PageState& state) {
    const bool names_level = item.kind == Kind::Level;
    return label_of(item, names_level ? std::string_view(state.levels[item.level].name) : "");
}

float risen(double time_s, double from_s, double length_s) {
    const double share = std::clamp((time_s - from_s) / length_s, 0.0, 1.0);
    return static_cast<float>(share * share * (3.0 - 2.0 * share));
}

void draw_tick(const Canvas& canvas, const glm::vec2& at) {
    ImDrawList& list = canvas.list();
    list.PathLineTo(canvas.px(at + glm::vec2(-7.0F, 0.0F)));
    list.PathLineTo(canvas.px(at + glm::vec2(-2.0F, 6.0F)));
    list.PathLineTo(canvas.px(at + glm::vec2(8.0F, -7.0F)));
    list.PathStroke(packed_hue(hue::exit), ImDrawFlags_None, 2.6F * canvas.unit());
}

// A line of a menu; what is chosen has light on it.
void draw_item(const Canvas& canvas, const ItemBox& box, const std::string& label, bool chosen,
               bool centred) {
    const float size = 23.0F;
    const float top = (box.min.y + box.max.y) * 0.5F - size * 0.60F;
    if (chosen) {
        const glm::vec2 middle((box.min.x + box.max.x) * 0.5F, 0.0F);
        if (centred) {
            canvas.fade_across(box.min, {middle.x, box.max.y}, hue::lamp, 0.0F, 0.20F);
            canvas.fade_across({middle.x, box.min.y}, box.max, hue::lamp, 0.20F, 0.0F);
        } else {
            canvas.fade_across(box.min, box.max, hue::lamp, 0.26F, 0.0F);
            canvas.fill(box.min, {box.min.x + 4.0F, box.max.y}, hue::lamp);
        }
    }
    const glm::vec4 color = chosen ? hue::lamp : hue::moon;
    if (centred) {
        canvas.write(canvas.letters().text, size, {(box.min.x + box.max.x) * 0.5F, top}, color,
                     label, 0.5F);
    } else {
        canvas.write(canvas.letters().text, size, {box.min.x + 22.0F, top}, color, label);
    }
}

// The name stands like a gnomon: its shadow goes round it.
void draw_name(const Canvas& canvas, const glm::vec2& at, double time_s) {
    constexpr float gap = 14.0F;
    constexpr int steps = 48;
    const double turn = 0.75 + 0.45 * std::sin(time_s * 0.22);
    const glm::vec2 way(static_cast<float>(std::cos(turn)), static_cast<float>(std::sin(turn)));
    for (int i = steps; i > 0; --i) {
        const float far = static_cast<float>(i) / steps;
        canvas.write_spaced(canvas.letters().title, Lettering::title_size, at + way * (far * 74.0F),
                            {0.0F, 0.0F, 0.01F, 1.0F}, words::name, gap, 0.0F,
                            0.22F * (1.0F - far));
    }
    canvas.write_spaced(canvas.letters().title, Lettering::title_size, at, hue::lamp, words::name,
                        gap);
}

void draw_title(const Canvas& canvas, const Screens& screens, const PageState& state,
                std::span<const ItemBox> boxes) {
    const Lettering& letters = canvas.letters();
    const glm::vec2 size = canvas.size();
    const float deep = std::min(720.0F, size.x);
    canvas.fade_across({0.0F, 0.0F}, {deep, size.y}, hue::night, 0.80F, 0.0F);
    canvas.fade_down({0.0F, size.y - 160.0F}, size, hue::night, 0.0F, 0.8F);
    draw_name(canvas, {title_left - 6.0F, 120.0F}, state.time_s);
    canvas.write(letters.text, 21.0F, {title_left, 236.0F}, hue::moon, words::promise);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const MenuItem& item = screens.items()[i];
        draw_item(canvas, boxes[i], label_of(item, state), i == screens.selected(), false);
        if (item.kind == Kind::Level && state.levels[item.level].won) {
            const float y = (boxes[i].min.y + boxes[i].max.y) * 0.5F;
            draw_tick(canvas, {boxes[i].min.x + 300.0F, y});
        }
    }
    canvas.write(letters.text, 16.0F, {title_left, size.y - 46.0F}, hue::dim,
                 "Up, Down and Enter, a gamepad, or the mouse");
    canvas.write(letters.text, 16.0F, {size.x - 28.0F, size.y - 46.0F}, hue::dim,
                 fmt::format("{}  ·  F2 switches", state.backend == "vk" ? "Vulkan" : "OpenGL"),
                 1.0F);
}

void draw_heading(const Canvas& canvas, float top, Screen screen, const glm::vec4& color,
                  float alpha) {
    canvas.write_spaced(canvas.letters().title, 62.0F, {canvas.size().x * 0.5F, top}, color,
                        heading_of(screen), 6.0F, 0.5F, alpha);
}

void draw_pause(const Canvas& canvas, const Screens& screens, const PageState& state,
                std::span<const ItemBox> boxes) {
    const Lettering& letters = canvas.letters();
    const glm::vec2 size = canvas.size();
    const float middle = size.x * 0.5F;
    canvas.fill({0.0F, 0.0F}, size, hue::night, 0.66F);
    draw_heading(canvas, 104.0F, Screen::Paused, hue::moon, 1.0F);
    if (state.session != nullptr) {
        const World& world = state.session->world();
        canvas.write(letters.text, 19.0F, {middle, 186.0F}, hue::dim,
                     fmt::format("{}, {}", world.level().name, clock_text(world.now())), 0.5F);
    }
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        draw_item(canvas, boxes[i], label_of(screens.items()[i], state), i == screens.selected(),
                  false);
    }
    const float left = middle - 90.0F;
    float top = 254.0F;
    canvas.fill({left - 28.0F, top - 18.0F}, {middle + pause_half, top + 9.0F * 31.0F + 12.0F},
                hue::night, 0.6F, 12.0F);
    for (const KeyLine& line : key_lines) {
        canvas.write(letters.text, 17.0F, {left, top}, hue::lamp, line.keys);
        canvas.write(letters.text, 17.0F, {left + 262.0F, top}, hue::moon, line.deed);
        top += 31.0F;
    }
}

void draw_end(const Canvas& canvas, const Screens& screens, const PageState& state,
              std::span<const ItemBox> boxes) {
    const Lettering& letters = canvas.letters();
    const glm::vec2 size = canvas.size();
    const float middle = size.x * 0.5F;
    const bool won = screens.now() == Screen::Won;
    const float alpha = risen(state.shown_s, 0.0, 0.5);
    const float band = 0.5F * size.y;
    const glm::vec4 tint = won ? hue::night : glm::vec4(0.10F, 0.012F, 0.015F, 1.0F);
    canvas.fill({0.0F, 0.0F}, size, tint, 0.25F * alpha);
    canvas.fade_down({0.0F, band - 280.0F}, {size.x, band - 130.0F}, tint, 0.0F, 0.66F * alpha);
    canvas.fill({0.0F, band - 130.0F}, {size.x, band + 200.0F}, tint, 0.66F * alpha);
    canvas.fade_down({0.0F, band + 200.0F}, {size.x, band + 330.0F}, tint, 0.66F * alpha, 0.0F);
    draw_heading(canvas, band - 140.0F, screens.now(), won ? hue::exit : hue::alarm, alpha);
    if (state.session != nullptr) {
        canvas.write(letters.text, 21.0F, {middle, band - 52.0F}, hue::moon, end_of(*state.session),
                     0.5F, alpha);
    }
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        draw_item(canvas, boxes[i], label_of(screens.items()[i], state), i == screens.selected(),
                  true);
    }
}

void draw_settings(const Canvas& canvas, const Screens& screens, const PageState& state,
                   std::span<const ItemBox> boxes) {
    const Lettering& letters = canvas.letters();
    const glm::vec2 size = canvas.size();
    const float middle = size.x * 0.5F;
    canvas.fill({0.0F, 0.0F}, size, hue::night, 0.72F);
    draw_heading(canvas, 72.0F, Screen::Settings, hue::moon, 1.0F);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const MenuItem& item = screens.items()[i];
        const bool chosen = i == screens.selected();
        draw_item(canvas, boxes[i], label_of(item, state), chosen, false);
        if (item.kind != Kind::Setting) continue;
        const float top = (boxes[i].min.y + boxes[i].max.y) * 0.5F - 14.0F;
        const std::string value = value_of(item.setting, state.settings, state.backend);
        const std::string shown = chosen ? "‹  " + value + "  ›" : value;
        canvas.write(letters.text, 23.0F, {boxes[i].max.x - 22.0F, top},
                     chosen ? hue::lamp : hue::dim, shown, 1.0F);
    }
    canvas.write(letters.text, 16.0F, {middle, size.y - 46.0F}, hue::dim, state.adapter, 0.5F);
}

}  // namespace

std::vector<ItemBox> item_boxes(const Screens& screens, const glm::vec2& size) {
    std::vector<ItemBox> boxes;
    const float middle = size.x * 0.5F;
    glm::vec2 at(0.0F);
    glm::vec2 extent(360.0F, 42.0F);
    float step = 46.0F;
    switch (screens.now()) {
        case Screen::Playing: return boxes;
        case Screen::Title: at = {title_left - 22.0F, 306.0F}; break;
        case Screen::Paused:
            at = {middle - pause_half, 248.0F};
            extent.x = 270.0F;
            break;
        case Screen::Won:
        case Screen::Caught: at = {middle - 0.5F * extent.x, 0.5F * size.y + 4.0F}; break;
        case Screen::Settings:
            at = {middle - settings_half, 178.0F};
            extent.x = 2.0F * settings_half;
            step = 50.0F;
            break;
    }
    Kind before = Kind::Back;
    for (const MenuItem& item : screens.items()) {
        // What is something else stands a little apart.
        const bool apart = (before == Kind::Level && item.kind != Kind::Level) ||
                           (before == Kind::Setting && item.kind == Kind::Back);
        if (apart) at.y += 18.0F;
        before = item.kind;
        boxes.push_back({at, at + extent});
        at.y += step;
    }
    return boxes;
}

std::optional<std::size_t> item_at(std::span<const ItemBox> boxes, const glm::vec2& point) {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const ItemBox& box = boxes[i];
        if (point.x >= box.min.x && point.x < box.max.x && point.y >= box.min.y &&
            point.y < box.max.y) {
            return i;
        }
    }
    return std::nullopt;
}

void draw_page(const Canvas& canvas, const Screens& screens, const PageState& state) {
    const std::vector<ItemBox> boxes = item_boxes(screens, canvas.size());
    switch (screens.now()) {
        case Screen::Playing: break;
        case Screen::Title: draw_title(canvas, screens, state, boxes); break;
        case Screen::Paused: draw_pause(canvas, screens, state, boxes); break;
        case Screen::Won:
        case Screen::Caught: draw_end(canvas, screens, state, boxes); break;
        case Screen::Settings: draw_settings(canvas, screens, state, boxes); break;
    }
}

void draw_note(const Canvas& canvas, const std::string& note, float alpha) {
    if (note.empty() || alpha <= 0.0F) return;
    const Lettering& letters = canvas.letters();
    const float middle = canvas.size().x * 0.5F;
    const float half =
        std::min(0.5F * canvas.width(letters.text, 17.0F, note), 0.5F * canvas.size().x - 40.0F);
    canvas.fill({middle - half - 18.0F, 14.0F}, {middle + half + 18.0F, 48.0F}, hue::night,
                0.85F * alpha, 10.0F);
    canvas.write(letters.text, 17.0F, {middle, 20.0F}, hue::moon, note, 0.5F, alpha);
}

}  // namespace gnomon::game
