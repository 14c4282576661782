// SPDX-License-Identifier: MIT
#include "play/hud.hpp"

#include <algorithm>
#include <cmath>

#include "play/readout.hpp"
#include "play/words.hpp"

namespace gnomon::game {

namespace {

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
    const double tint = alarm_tint(meter);
    const glm::vec4 color = tint > 0.0 ? glm::mix(hue::lamp, hue::alarm, static_cast<float>(tint))
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
    canvas.write(font, 13.0F, {left + width + 8.0F, top - 3.0F}, hue::dim, words::light);
    canvas.write(font, 13.0F, {left + width + 8.0F, top + 12.0F}, hue::dim, words::alarm);
}

void draw_exit(const Canvas& canvas, const Level& level, const shadows::View& view) {
    const auto mark = exit_mark(level, view, canvas.size());
    if (!mark) return;
    ImDrawList& list = canvas.list();
    const glm::vec2 at = mark->at;
    if (!mark->way) {
        list.AddTriangleFilled(canvas.px(at), canvas.px(at + glm::vec2(-8.0F, -11.0F)),
                               canvas.px(at + glm::vec2(8.0F, -11.0F)),
                               packed_hue(hue::exit, 0.9F));
        return;
    }
    // Out of the picture: an arrow at its border.
    const glm::vec2 way = *mark->way;
    const glm::vec2 across(-way.y, way.x);
    list.AddTriangleFilled(canvas.px(at + way * 16.0F), canvas.px(at - way * 7.0F + across * 11.0F),
                           canvas.px(at - way * 7.0F - across * 11.0F),
                           packed_hue(hue::exit, 0.9F));
}

}  // namespace

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
        canvas.write(letters.text, 15.0F, {24.0F, 42.0F}, hue::lamp, words::recording);
    }

    // The name first, large; then, for a while, what the level has to say.
    const Captions captions = captions_at(state.shown_s, state.waits);
    const auto name_alpha = static_cast<float>(captions.name);
    if (name_alpha > 0.0F) {
        canvas.write(letters.bold, 40.0F, {size.x * 0.5F, size.y * 0.24F}, hue::moon, level.name,
                     0.5F, name_alpha);
    }
    if (state.waits) {
        canvas.write(letters.text, 19.0F, {size.x * 0.5F, size.y * 0.24F + 54.0F}, hue::lamp,
                     words::first_step, 0.5F, static_cast<float>(captions.first_step));
    }
    const auto hint_alpha = static_cast<float>(captions.hint);
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
