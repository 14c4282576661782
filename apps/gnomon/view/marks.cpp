// SPDX-License-Identifier: MIT
#include "view/marks.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include <gnomon/panel/figures.hpp>
#include <gnomon/panel/probe_card.hpp>
#include <gnomon/ui/context.hpp>

#include "view/panel.hpp"

namespace gnomon::cli {

namespace {

ImU32 packed(const glm::vec4& color, float alpha = 1.0F) {
    return ImGui::ColorConvertFloat4ToU32({color.r, color.g, color.b, color.a * alpha});
}

ImVec2 at(const glm::dvec2& pixel) {
    // Pixels' middles lie half a pixel within.
    return {static_cast<float>(pixel.x + 0.5), static_cast<float>(pixel.y + 0.5)};
}

glm::vec4 hue_of(const glm::vec3& color) {
    const float largest = std::max({color.r, color.g, color.b, 1e-6F});
    return {glm::sqrt(color / largest), 1.0F};
}

void draw_sun(ImDrawList& list, const ImVec2& c, float radius, ImU32 color, float width) {
    for (int ray = 0; ray < 8; ++ray) {
        const float angle = static_cast<float>(ray) * 0.785398F;
        const glm::vec2 d(std::cos(angle), std::sin(angle));
        list.AddLine({c.x + d.x * (radius + 3.0F), c.y + d.y * (radius + 3.0F)},
                     {c.x + d.x * (radius + 7.0F), c.y + d.y * (radius + 7.0F)}, color, width);
    }
}

void show_handles(ImDrawList& list, const ViewState& state, const Stage& stage,
                  const shadows::View& view, const glm::uvec2& size_px) {
    const auto hovered = stage.light_under(view, size_px, state.cursor_px);
    for (std::size_t i = 0; i < stage.lights().size(); ++i) {
        const panel::LightLine& light = stage.lights()[i];
        const scene::Registry& registry = stage.shot().scene.registry;
        const bool directional = panel::is_directional(registry, light.entity);
        const auto pixel = panel::pixel_of(view, stage.handle_of(light), size_px);
        if (!pixel) continue;
        const bool selected = state.selection.kind == Selection::Kind::Light &&
                              state.selection.entity == light.entity;
        const ImVec2 c = at(*pixel);
        const glm::vec4 color = light.on ? hue_of(panel::color_of_light(registry, light.entity))
                                         : glm::vec4(0.5F, 0.5F, 0.5F, 1.0F);
        // Of many lights, dots.
        const float radius = directional ? 7.0F : (stage.lights().size() > 16 ? 3.5F : 5.5F);
        list.AddCircleFilled(c, radius + 2.0F, IM_COL32(15, 17, 21, 200));
        list.AddCircleFilled(c, radius, packed(color));
        if (directional) draw_sun(list, c, radius, packed(color), 2.0F);
        if (selected || hovered == i) {
            list.AddCircle(c, 14.0F, packed(ui::palette().accent, selected ? 1.0F : 0.6F), 0, 2.0F);
            const ImVec2 size = ImGui::CalcTextSize(light.name.c_str());
            const ImVec2 text{c.x + 20.0F, c.y - size.y / 2.0F};
            list.AddRectFilled({text.x - 5.0F, text.y - 2.0F},
                               {text.x + size.x + 5.0F, text.y + size.y + 2.0F},
                               IM_COL32(15, 17, 21, 190), 4.0F);
            list.AddText(text, IM_COL32(235, 238, 242, 255), light.name.c_str());
        }
    }
}

// The eight corners' box in the picture; its edges are drawn where both ends are before the eye.
void show_selected(ImDrawList& list, const ViewState& state, const Stage& stage,
                   const shadows::View& view, const glm::uvec2& size_px) {
    if (state.selection.kind != Selection::Kind::Caster) return;
    const scene::Bounds bounds = stage.bounds_of(state.selection.entity);
    if (bounds.empty()) return;
    const auto corner = [&](unsigned i) {
        return panel::pixel_of(view,
                               {(i & 1U) != 0 ? bounds.max.x : bounds.min.x,
                                (i & 2U) != 0 ? bounds.max.y : bounds.min.y,
                                (i & 4U) != 0 ? bounds.max.z : bounds.min.z},
                               size_px);
    };
    for (unsigned i = 0; i < 8; ++i) {
        for (const unsigned bit : {1U, 2U, 4U}) {
            if ((i & bit) != 0) continue;
            const auto from = corner(i);
            const auto to = corner(i | bit);
            if (from && to) list.AddLine(at(*from), at(*to), packed(ui::palette().accent), 1.5F);
        }
    }
}

// One line below: what the mouse does now, and what there was to say.
void show_hints(ImDrawList& list, const ViewState& state, const Stage& stage,
                const glm::uvec2& size_px) {
    std::string text;
    if (state.note_s > 0.0) {
        text = state.note;
    } else if (state.help) {
        const char* verb = state.mode == MoveMode::Rotate ? "turns" : "moves";
        std::string what = "the camera";
        if (state.selection.kind == Selection::Kind::Light) {
            if (const auto light = stage.light_of(state.selection.entity)) {
                what = stage.lights()[*light].name;
            }
        } else if (state.selection.kind == Selection::Kind::Caster) {
            what = stage.name_of(state.selection.entity);
        }
        text = fmt::format(
            "Drag {} {}   ·   T move, R turn, C camera   ·   Right drag pans, wheel zooms   ·   "
            "Tab panel   ·   F1 hints",
            verb, what);
    }
    if (text.empty()) return;
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const auto left = static_cast<float>(panel_width_px(state));
    const float width = static_cast<float>(size_px.x) - left;
    const ImVec2 corner{left + std::max(8.0F, (width - size.x) / 2.0F),
                        static_cast<float>(size_px.y) - size.y - 16.0F};
    list.AddRectFilled({corner.x - 12.0F, corner.y - 6.0F},
                       {corner.x + size.x + 12.0F, corner.y + size.y + 6.0F},
                       IM_COL32(18, 20, 25, 200), 6.0F);
    list.AddText(corner,
                 state.note_s > 0.0 ? packed(ui::palette().accent) : packed(ui::palette().dim),
                 text.c_str());
}

}  // namespace

void show_marks(const ViewState& state, const Stage& stage, const shadows::View& view,
                const glm::uvec2& size_px) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    panel::show_bounds(state.marks, stage.draw_list(), size_px);
    show_selected(list, state, stage, view, size_px);
    if (state.probe) {
        panel::show_probe(*state.probe, stage.shot().scene.registry,
                          {.view = view,
                           .size_px = size_px,
                           .cursor_px = state.cursor_px,
                           .bounds = stage.shot().bounds,
                           .lights = stage.lights()});
    }
    show_handles(list, state, stage, view, size_px);
    show_hints(list, state, stage, size_px);
}

}  // namespace gnomon::cli
