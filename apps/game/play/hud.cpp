// SPDX-License-Identifier: MIT
#include "play/hud.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace gnomon::game {

namespace {

float faded(double from, double to, double value) {
    const double share = std::clamp((value - from) / (to - from), 0.0, 1.0);
    return static_cast<float>(share * share * (3.0 - 2.0 * share));
}

/// Where a point of the world is in the picture, in units; none where it is behind the eye.
std::optional<glm::vec2> place_of(const Canvas& canvas, const shadows::View& view,
                                  const glm::dvec3& point) {
    const glm::dvec4 clip = view.clip_from_view * view.view_from_world * glm::dvec4(point, 1.0);
    if (clip.w <= 0.0) return std::nullopt;
    const glm::dvec2 ndc = glm::dvec2(clip) / clip.w;
    return glm::vec2(glm::dvec2(0.5 + 0.5 * ndc.x, 0.5 - 0.5 * ndc.y)) * canvas.size();
}

// The picture's border goes red.
void draw_dread(const Canvas& canvas, double alarm) {
    if (alarm <= 0.0) return;
    const glm::vec2 size = canvas.size();
    const auto alpha = static_cast<float>(0.45 * alarm);
    const float deep = 150.0F;
    canvas.fade_across({0.0F, 0.0F}, {deep, size.y}, hue::alarm, alpha, 0.0F);
    canvas.fade_across({size.x - deep, 0.0F}, size, hue::alarm, 0.0F, alpha);
    canvas.fade_down({0.0F, 0.0F}, {size.x, deep * 0.7F}, hue::alarm, alpha, 0.0F);
    canvas.fade_down({0.0F, size.y - deep * 0.7F}, size, hue::alarm, 0.0F, alpha);
}

// Shut in the dark, wide open in the light.
void draw_eye(const Canvas& canvas, const glm::vec2& middle, float open, const glm::vec4& color) {
    ImDrawList& list = canvas.list();
    const float half = 17.0F;
    const float lid = std::max(7.0F, 19.0F * open);
    const ImVec2 left = canvas.px(middle - glm::vec2(half, 0.0F));
    const ImVec2 right = canvas.px(middle + glm::vec2(half, 0.0F));
    const ImU32 ink = packed_hue(color);
    const float thick = 2.2F * canvas.unit();
    list.PathLineTo(left);
    list.PathBezierQuadraticCurveTo(canvas.px(middle + glm::vec2(0.0F, lid)), right, 20);
    list.PathStroke(ink, ImDrawFlags_None, thick);
    if (open < 0.05F) {
        for (const float side : {-9.0F, 0.0F, 9.0F}) {  // lashes
            const glm::vec2 root = middle + glm::vec2(side, side == 0.0F ? 3.5F : 2.5F);
            list.AddLine(canvas.px(root), canvas.px(root + glm::vec2(side * 0.35F, 5.0F)), ink,
                         thick);
        }
        return;
    }
    list.PathLineTo(left);
    list.PathBezierQuadraticCurveTo(canvas.px(middle - glm::vec2(0.0F, lid)), right, 20);
    list.PathStroke(ink, ImDrawFlags_None, thick);
    list.AddCircleFilled(canvas.px(middle), std::min(6.0F, 0.42F * lid) * canvas.unit(), ink, 20);
}

void draw_meter(const Canvas& canvas, const Meter& meter) {
    const float width = 300.0F;
    const glm::vec2 middle(canvas.size().x * 0.5F, canvas.size().y - 46.0F);
    const glm::vec2 card_half(width * 0.5F + 64.0F, 30.0F);
    canvas.fill(middle - card_half, middle + card_half, hue::night, 0.72F, 14.0F);
    const glm::vec4 color =
        meter.alarm > 0.02
            ? glm::mix(hue::lamp, hue::alarm, static_cast<float>(std::min(1.0, 0.35 + meter.alarm)))
        : meter.is_seen ? hue::lamp
                        : hue::dim;
    const float left = middle.x - width * 0.5F + 6.0F;
    draw_eye(canvas, {left - 40.0F, middle.y}, static_cast<float>(meter.light), color);

    // Light: what the eyes get; beyond the notch they see.
    const auto bar = [&](float top, float height, double share, const glm::vec4& full) {
        const float right = left + width;
        canvas.fill({left, top}, {right, top + height}, hue::moon, 0.13F, height * 0.5F);
        const float end = left + width * static_cast<float>(std::clamp(share, 0.0, 1.0));
        if (end - left > 1.0F) {
            canvas.fill({left, top}, {std::max(end, left + height), top + height}, full, 1.0F,
                        height * 0.5F);
        }
    };
    const float top = middle.y - 11.0F;
    bar(top, 10.0F, meter.light, meter.is_seen ? hue::lamp : glm::mix(hue::dim, hue::lamp, 0.45F));
    const float notch = left + width * static_cast<float>(Meter::seen_from);
    canvas.fill({notch - 1.0F, top - 4.0F}, {notch + 1.0F, top + 14.0F}, hue::moon, 0.75F);
    bar(top + 17.0F, 6.0F, meter.alarm, hue::alarm);
    const ImFont* font = canvas.letters().text;
    canvas.write(font, 13.0F, {left + width + 8.0F, top - 3.0F}, hue::dim, "light");
    canvas.write(font, 13.0F, {left + width + 8.0F, top + 12.0F}, hue::dim, "alarm");
}

void draw_exit(const Canvas& canvas, const Level& level, const shadows::View& view) {
    const glm::dvec3 over(level.exit.x, 1.5, level.exit.y);
    const auto place = place_of(canvas, view, over);
    const glm::vec2 size = canvas.size();
    const glm::vec2 margin(64.0F, 64.0F);
    if (place && place->x > margin.x && place->x < size.x - margin.x && place->y > margin.y &&
        place->y < size.y - 96.0F) {
        ImDrawList& list = canvas.list();
        const glm::vec2 tip = *place;
        list.AddTriangleFilled(canvas.px(tip), canvas.px(tip + glm::vec2(-8.0F, -11.0F)),
                               canvas.px(tip + glm::vec2(8.0F, -11.0F)),
                               packed_hue(hue::exit, 0.9F));
        return;
    }
    // Out of the picture: an arrow at its border, towards it as the ground is seen.
    const glm::dvec3 in_view(view.view_from_world * glm::dvec4(over, 1.0));
    glm::vec2 way(static_cast<float>(in_view.x), static_cast<float>(-in_view.y));
    if (place) way = *place - size * 0.5F;
    if (glm::length(way) < 1e-4F) return;
    way = glm::normalize(way);
    const glm::vec2 half = size * 0.5F - margin;
    const float reach = std::min(half.x / std::max(std::abs(way.x), 1e-4F),
                                 half.y / std::max(std::abs(way.y), 1e-4F));
    const glm::vec2 at = size * 0.5F + way * reach;
    const glm::vec2 across(-way.y, way.x);
    canvas.list().AddTriangleFilled(
        canvas.px(at + way * 16.0F), canvas.px(at - way * 7.0F + across * 11.0F),
        canvas.px(at - way * 7.0F - across * 11.0F), packed_hue(hue::exit, 0.9F));
}

}  // namespace

std::string clock_text(Tick ticks) {
    const Tick tenths = ticks * 10 / ticks_a_second;
    return fmt::format("{}:{:02}.{}", tenths / 600, tenths / 10 % 60, tenths % 10);
}

void draw_hud(const Canvas& canvas, const Session& session, const shadows::View& view,
              const HudState& state) {
    const World& world = session.world();
    const Level& level = world.level();
    const Lettering& letters = canvas.letters();
    const glm::vec2 size = canvas.size();
    draw_dread(canvas, world.meter().alarm);
    draw_exit(canvas, level, view);
    draw_meter(canvas, world.meter());

    canvas.fade_down({0.0F, 0.0F}, {size.x, 70.0F}, hue::night, 0.55F, 0.0F);
    canvas.write(letters.text, 19.0F, {24.0F, 18.0F}, hue::moon, level.name);
    canvas.write(letters.text, 19.0F, {size.x - 24.0F, 18.0F}, hue::dim, clock_text(world.now()),
                 1.0F);
    if (state.watches) {
        canvas.write(letters.text, 15.0F, {24.0F, 42.0F}, hue::lamp, "a recording");
    }

    // The name first, large; then, for a while, what the level has to say.
    const float name_alpha = faded(0.1, 0.6, state.shown_s) *
                             (state.waits ? 1.0F : 1.0F - faded(2.0, 2.8, state.shown_s));
    if (name_alpha > 0.0F) {
        canvas.write(letters.bold, 40.0F, {size.x * 0.5F, size.y * 0.24F}, hue::moon, level.name,
                     0.5F, name_alpha);
    }
    if (state.waits) {
        const auto pulse = static_cast<float>(0.75 + 0.25 * std::sin(state.shown_s * 4.0));
        canvas.write(letters.text, 19.0F, {size.x * 0.5F, size.y * 0.24F + 54.0F}, hue::lamp,
                     "Your first step begins it", 0.5F, faded(1.0, 1.6, state.shown_s) * pulse);
    }
    // Until there was time to read it, and somebody has moved.
    const float hint_alpha = faded(0.3, 0.9, state.shown_s) *
                             (state.waits ? 1.0F : 1.0F - faded(13.0, 14.5, state.shown_s));
    if (hint_alpha > 0.0F && !level.hint.empty()) {
        const float most = std::min(720.0F, size.x - 110.0F);
        // As many lines as it takes, all about as long.
        const float length = canvas.width(letters.text, 19.0F, level.hint);
        const float even = length / std::ceil(length / most) * 1.06F;
        const auto lines = Canvas::lines_of(letters.text, 19.0F, std::min(even, most), level.hint);
        const float height = 27.0F * static_cast<float>(lines.size());
        const float middle = size.x * 0.5F;
        float top = size.y - 108.0F - height;
        const glm::vec2 half(most * 0.5F + 26.0F, 0.0F);
        canvas.fill(glm::vec2(middle, top - 13.0F) - half,
                    glm::vec2(middle, top + height + 10.0F) + half, hue::night, 0.72F * hint_alpha,
                    12.0F);
        for (const std::string_view line : lines) {
            canvas.write(letters.text, 19.0F, {middle, top}, hue::moon, line, 0.5F, hint_alpha);
            top += 27.0F;
        }
    }
}

}  // namespace gnomon::game
