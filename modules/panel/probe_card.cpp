// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <imgui.h>

#include <gnomon/panel/probe_card.hpp>
#include <gnomon/ui/context.hpp>

namespace gnomon::panel {

namespace {

/// Lights that the card names; the others it counts.
constexpr std::size_t most_answers = 8;

ImU32 ink_of(const glm::vec4& color, float alpha) {
    return ImGui::ColorConvertFloat4ToU32({color.r, color.g, color.b, color.a * alpha});
}

ImVec2 at(const glm::dvec2& pixel) {
    // Pixels' middles lie half a pixel within.
    return {static_cast<float>(pixel.x + 0.5), static_cast<float>(pixel.y + 0.5)};
}

void show_answers(const Probe& probe, std::span<const LightLine> lights) {
    const ui::Palette colors = ui::palette();
    std::size_t out_of_range = 0;
    std::size_t shown = 0;
    for (const Probe::Answer& answer : probe.answers) {
        const char* what = "lit";
        glm::vec4 color = colors.good;
        if (answer.exposure == shadows::Exposure::OutOfRange) {
            ++out_of_range;
            continue;
        }
        if (++shown > most_answers) continue;
        if (answer.exposure == shadows::Exposure::Shadowed) {
            what = "in shadow";
            color = colors.bad;
        } else if (answer.faces_away) {
            what = "faces away";
            color = colors.dim;
        }
        ImGui::TextColored({color.r, color.g, color.b, 1.0F}, "%s: %s",
                           lights[answer.light].name.c_str(), what);
        if (answer.surfaces > 0) {
            ImGui::SameLine();
            ImGui::TextDisabled("%u between", answer.surfaces);
        }
    }
    if (shown > most_answers) ImGui::TextDisabled("and %zu more", shown - most_answers);
    if (out_of_range > 0) ImGui::TextDisabled("%zu out of range", out_of_range);
}

}  // namespace

void show_probe(const Probe& probe, const scene::Registry& registry, const ProbeCard& card) {
    const auto pixel = pixel_of(card.view, probe.hit.point_world, card.size_px);
    if (!pixel) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const ui::Palette colors = ui::palette();
    for (const Probe::Answer& answer : probe.answers) {
        if (answer.exposure == shadows::Exposure::OutOfRange) continue;
        const auto light =
            pixel_of(card.view, handle_of(registry, card.lights[answer.light].entity, card.bounds),
                     card.size_px);
        if (!light) continue;
        const bool lit = answer.exposure == shadows::Exposure::Lit && !answer.faces_away;
        list.AddLine(at(*pixel), at(*light), ink_of(lit ? colors.good : colors.bad, 0.55F), 1.5F);
    }
    list.AddCircleFilled(at(*pixel), 3.5F, IM_COL32(255, 255, 255, 255));

    const ImVec2 mouse = at(card.cursor_px);
    // Towards the picture's middle.
    const ImVec2 pivot{mouse.x > 0.5F * static_cast<float>(card.size_px.x) ? 1.0F : 0.0F,
                       mouse.y > 0.7F * static_cast<float>(card.size_px.y) ? 1.0F : 0.0F};
    ImGui::SetNextWindowPos({mouse.x + 18.0F - 36.0F * pivot.x, mouse.y + 14.0F - 28.0F * pivot.y},
                            ImGuiCond_Always, pivot);
    ImGui::SetNextWindowBgAlpha(0.88F);
    ImGui::Begin("##probe", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing |
                     ImGuiWindowFlags_NoSavedSettings);
    const auto* name = registry.try_get<scene::Name>(probe.hit.entity);
    const bool has_name = name != nullptr && !name->value.empty();
    ImGui::TextUnformatted(has_name ? name->value.c_str() : "(no name)");
    // As many places as a ten thousandth of the scene is worth.
    const double size_m = std::max(card.bounds.diagonal(), 1e-12);
    const int places = std::clamp(static_cast<int>(std::ceil(4.0 - std::log10(size_m))), 0, 9);
    const auto rounded = [&](double value) {
        const double scale = std::pow(10.0, places);
        return std::round(value * scale) / scale + 0.0;  // no -0
    };
    const glm::dvec3& p = probe.hit.point_world;
    ImGui::TextDisabled("%.*f, %.*f, %.*f m", places, rounded(p.x), places, rounded(p.y), places,
                        rounded(p.z));
    show_answers(probe, card.lights);
    ImGui::End();
}

}  // namespace gnomon::panel
