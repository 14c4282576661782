// SPDX-License-Identifier: MIT
#include "view/panel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include <gnomon/panel/choices.hpp>
#include <gnomon/panel/figures.hpp>
#include <gnomon/panel/light_table.hpp>
#include <gnomon/ui/context.hpp>

namespace gnomon::cli {

namespace {

constexpr float margin_px = 12.0F;
constexpr float width_px = 312.0F;

constexpr std::array<ui::ChartSeries, 2> frame_series{{
    {"CPU", {0.96F, 0.74F, 0.30F, 1.0F}},
    {"device", {0.45F, 0.55F, 0.72F, 1.0F}},
}};

void show_title(ViewState& state, const Stage& stage) {
    const std::string name = std::filesystem::path(state.source).filename().string();
    ImGui::TextUnformatted(name.c_str());
    const auto counted = [](std::uint64_t number, const char* what) {
        return fmt::format("{} {}{}", panel::with_thousands(number), what, number == 1 ? "" : "s");
    };
    ImGui::TextDisabled("%s, %s, %s", counted(stage.triangles(), "triangle").c_str(),
                        counted(stage.figures().shadows.casters, "caster").c_str(),
                        counted(stage.lights().size(), "light").c_str());
    const bool gl = state.backend == "gl";
    ImGui::BeginDisabled(!state.can_switch);
    if (ImGui::RadioButton("OpenGL", gl) && !gl) state.wishes.other_backend = true;
    ImGui::SameLine();
    if (ImGui::RadioButton("Vulkan", !gl) && gl) state.wishes.other_backend = true;
    ImGui::EndDisabled();
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s\nB switches", state.adapter.c_str());
    ImGui::SameLine();
    const float button = ImGui::CalcTextSize("Picture").x + 2.0F * ImGui::GetStyle().FramePadding.x;
    ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - button);
    if (ImGui::Button("Picture")) state.wishes.screenshot = true;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Saves what the window shows (P)");
}

void show_times(const ViewState& state) {
    if (!panel::section("Times")) return;
    panel::show_shadow_times(state.shadow_times, 38.0F * state.unit);
    ImGui::Spacing();
    ui::draw_chart("frame times", state.frame_times, frame_series, "ms, frame", 38.0F * state.unit);
}

void show_overlays(ViewState& state, Stage& stage) {
    if (!panel::section("Show")) return;
    panel::show_views(stage.options().overlays, state.marks, "Q", [&] {
        bool ground = stage.has_ground();
        panel::view_switch("ground", ground, "A floor below everything (G)");
        if (ground != stage.has_ground()) stage.show_ground(ground);
    });
}

void show_choices(Stage& stage) {
    if (!panel::section("Shadows")) return;
    RenderOptions& o = stage.options();
    bool changed = false;

    changed |= panel::choose_technique(o.technique);
    changed |= panel::choose_strategy(o.silhouette);
    if (ImGui::TreeNodeEx("caps and savings", ImGuiTreeNodeFlags_NoTreePushOnOpen)) {
        static const std::vector<std::string> caps{"facing", "averted"};
        int near_caps = o.near_caps == shadows::NearCaps::Averted ? 1 : 0;
        if (panel::choose("near caps", caps, near_caps)) {
            o.near_caps = near_caps == 1 ? shadows::NearCaps::Averted : shadows::NearCaps::Facing;
        }

        if (ImGui::BeginTable("savings", 2, ImGuiTableFlags_SizingStretchSame)) {
            const auto box = [&](const char* name, bool& on) {
                ImGui::TableNextColumn();
                changed |= ImGui::Checkbox(name, &on);
            };
            box("view cull", o.fill.cull_by_view);
            box("receiver cull", o.fill.cull_by_receivers);
            box("umbra cull", o.fill.cull_by_umbra);
            box("clamp", o.fill.clamp);
            box("slabs", o.fill.slabs);
            box("scissor", o.fill.scissor);
            box("depth bounds", o.fill.depth_bounds);
            ImGui::EndTable();
        }
    }
    bool four = o.samples == 4;
    if (ImGui::Checkbox("4 samples", &four)) o.samples = four ? 4 : 1;
    ImGui::SameLine();
    ImGui::Checkbox("cull back faces", &o.cull_back);
    if (changed) stage.shadows_changed();
}

void show_lights(ViewState& state, Stage& stage) {
    if (!panel::section("Lights")) return;
    const auto selected = state.selection.kind == Selection::Kind::Light
                              ? stage.light_of(state.selection.entity)
                              : std::nullopt;
    if (const auto clicked = panel::show_lights(stage.lights(), selected)) {
        state.selection = {Selection::Kind::Light, stage.lights()[*clicked].entity};
    }
}

Status show_animation(ViewState& state, Stage& stage) {
    const auto& animations = stage.shot().scene.animations;
    if (animations.empty() || !panel::section("Animation")) return {};
    if (ImGui::Button(state.playing ? "Pause" : "Play", {64.0F * state.unit, 0.0F})) {
        state.playing = !state.playing;
    }
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1.0F);
    const double duration_s = std::max(stage.duration_s(), 1e-3);
    auto time_s =
        static_cast<float>(state.time_s - std::floor(state.time_s / duration_s) * duration_s);
    bool moved = false;
    if (ImGui::SliderFloat("##time", &time_s, 0.0F, static_cast<float>(duration_s), "%.2f s")) {
        state.time_s = static_cast<double>(time_s);
        state.playing = false;
        moved = true;
    }
    auto speed = static_cast<float>(state.speed);
    ImGui::SetNextItemWidth(-ImGui::CalcTextSize("silhouettes  ").x);
    if (ImGui::SliderFloat("speed", &speed, 0.05F, 4.0F, "%.2f", ImGuiSliderFlags_Logarithmic)) {
        state.speed = static_cast<double>(speed);
    }
    if (animations.size() > 1) {
        std::vector<std::string> names{"first of each model"};
        for (const scene::Animation& a : animations) {
            const std::string name = a.name.empty() ? "animation" : one_line(a.name);
            names.push_back(fmt::format("{}: {}", names.size(), name));
        }
        const auto& played = stage.shot().animations;
        int chosen = played.size() == 1 ? static_cast<int>(played.front()) + 1 : 0;
        if (panel::choose("plays", names, chosen)) {
            stage.play(chosen == 0 ? scene::find_animations(stage.shot().scene)
                                   : std::vector{static_cast<std::size_t>(chosen - 1)});
            moved = true;
        }
    }
    return moved ? stage.set_time(state.time_s) : Status();
}

void show_counters(const ViewState& state, const Stage& stage) {
    if (!panel::section("Counters", false)) return;
    const FrameFigures& f = stage.figures();
    panel::show_counters(
        {.shadows = f.shadows, .upload_bytes = f.upload_bytes, .draw_calls = f.draw_calls},
        state.marks.reasons);
}

}  // namespace

void ViewState::add_times(const FrameFigures& f) {
    const auto number = [](double value) { return static_cast<float>(std::max(value, 0.0)); };
    shadow_times.add(std::array{number(f.detect_ms), number(f.build_ms), number(f.record_ms)});
    frame_times.add(std::array{number(f.frame_ms - f.device_ms), number(f.device_ms)});
}

double panel_width_px(const ViewState& state) {
    return state.panel ? static_cast<double>((width_px + margin_px) * state.unit) : 0.0;
}

Status show_panel(ViewState& state, Stage& stage) {
    if (!state.panel) return {};
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float margin = margin_px * state.unit;
    const float width = width_px * state.unit;
    ImGui::SetNextWindowPos({margin, margin});
    ImGui::SetNextWindowSizeConstraints({width, margin}, {width, screen.y - 2.0F * margin});
    ImGui::Begin("gnomon", nullptr,
                 // A panel that is too high for the window scrolls by the wheel.
                 ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoTitleBar |
                     ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings);
    show_title(state, stage);
    show_times(state);
    show_overlays(state, stage);
    const Status animated = show_animation(state, stage);
    show_lights(state, stage);
    show_choices(stage);
    show_counters(state, stage);
    ImGui::End();
    return animated;
}

}  // namespace gnomon::cli
