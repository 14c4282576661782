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

#include <gnomon/shadows/detector.hpp>
#include <gnomon/ui/context.hpp>

namespace gnomon::cli {

namespace {

constexpr float margin_px = 12.0F;
constexpr float width_px = 312.0F;

constexpr std::array<ui::ChartSeries, 3> shadow_series{{
    {"detect", {0.96F, 0.74F, 0.30F, 1.0F}},
    {"build", {0.90F, 0.45F, 0.35F, 1.0F}},
    {"record", {0.35F, 0.72F, 0.80F, 1.0F}},
}};
constexpr std::array<ui::ChartSeries, 2> frame_series{{
    {"CPU", {0.96F, 0.74F, 0.30F, 1.0F}},
    {"device", {0.45F, 0.55F, 0.72F, 1.0F}},
}};

std::string with_thousands(std::uint64_t number) {
    std::string digits = std::to_string(number);
    for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3) {
        digits.insert(static_cast<std::size_t>(at), ",");
    }
    return digits;
}

void row(const char* name, const std::string& value) {
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", name);
    ImGui::TableNextColumn();
    const float free = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(value.c_str()).x;
    if (free > 0.0F) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + free);
    ImGui::TextUnformatted(value.c_str());
}

bool section(const char* name, bool open = true) {
    ImGui::Spacing();
    return ImGui::CollapsingHeader(name, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

void show_title(ViewState& state, const Stage& stage) {
    const std::string name = std::filesystem::path(state.source).filename().string();
    ImGui::TextUnformatted(name.c_str());
    const auto counted = [](std::uint64_t number, const char* what) {
        return fmt::format("{} {}{}", with_thousands(number), what, number == 1 ? "" : "s");
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
    if (!section("Times")) return;
    ui::draw_chart("shadow times", state.shadow_times, shadow_series, "ms, shadows on the CPU",
                   38.0F);
    ImGui::Spacing();
    ui::draw_chart("frame times", state.frame_times, frame_series, "ms, frame", 38.0F * state.unit);
}

void show_overlays(ViewState& state, Stage& stage) {
    if (!section("Show")) return;
    render::Overlays& show = stage.options().overlays;
    if (!ImGui::BeginTable("overlays", 2, ImGuiTableFlags_SizingStretchSame)) return;
    const auto box = [](const char* name, bool& on, const char* what) {
        ImGui::TableNextColumn();
        ImGui::Checkbox(name, &on);
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", what);
    };
    box("volumes", show.volumes, "The volumes' sides (1)");
    box("silhouettes", show.silhouettes, "Silhouette edges (2)");
    box("caps", show.caps, "Near caps (3)");
    box("wireframe", show.wireframe, "All triangles (4)");
    box("count", show.count, "The stencil count as a heat map (5)");
    box("fill", show.fill, "Stencil fragments as a heat map of powers of two (6)");
    box("scissors", state.scissors, "What each volume is cut to");
    box("reasons", state.reasons, "Why each volume was made or kept, as colours");
    bool ground = stage.has_ground();
    box("ground", ground, "A floor below everything (G)");
    if (ground != stage.has_ground()) stage.show_ground(ground);
    box("probe", state.probes, "What the shadow queries say of the point under the mouse (Q)");
    ImGui::EndTable();
}

// A choice among names; true where it changed.
template <class Names>
bool choose(const char* label, const Names& names, int& chosen) {
    bool changed = false;
    const auto text = [&](int i) { return names[static_cast<std::size_t>(i)].c_str(); };
    ImGui::SetNextItemWidth(-ImGui::CalcTextSize("silhouettes  ").x);
    if (!ImGui::BeginCombo(label, text(chosen))) return false;
    for (int i = 0; i < static_cast<int>(names.size()); ++i) {
        ImGui::PushID(i);  // names may be equal
        if (ImGui::Selectable(text(i), i == chosen) && i != chosen) {
            chosen = i;
            changed = true;
        }
        ImGui::PopID();
    }
    ImGui::EndCombo();
    return changed;
}

void show_choices(Stage& stage) {
    if (!section("Shadows")) return;
    RenderOptions& o = stage.options();
    bool changed = false;

    static const std::vector<std::string> techniques{"auto", "depth-pass", "depth-fail"};
    int technique = o.technique ? static_cast<int>(*o.technique) + 1 : 0;
    if (choose("technique", techniques, technique)) {
        o.technique = technique == 0
                          ? std::nullopt
                          : std::optional(static_cast<shadows::Technique>(technique - 1));
        changed = true;
    }
    static const std::vector<std::string> strategies = [] {
        std::vector<std::string> names{std::string(shadows::automatic_strategy().name)};
        for (const auto& s : shadows::silhouette_strategies()) names.emplace_back(s.name);
        return names;
    }();
    const auto found = std::ranges::find(strategies, o.silhouette);
    int strategy = found == strategies.end() ? 0 : static_cast<int>(found - strategies.begin());
    if (choose("silhouettes", strategies, strategy)) {
        o.silhouette = strategies[static_cast<std::size_t>(strategy)];
        changed = true;
    }
    if (ImGui::TreeNodeEx("caps and savings", ImGuiTreeNodeFlags_NoTreePushOnOpen)) {
        static const std::vector<std::string> caps{"facing", "averted"};
        int near_caps = o.near_caps == shadows::NearCaps::Averted ? 1 : 0;
        if (choose("near caps", caps, near_caps)) {
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
    if (!section("Lights")) return;
    constexpr std::size_t most_rows = 8;
    const bool scrolls = stage.lights().size() > most_rows;
    const float height =
        scrolls ? static_cast<float>(most_rows) * ImGui::GetFrameHeightWithSpacing() : 0.0F;
    const ImGuiTableFlags flags =
        ImGuiTableFlags_SizingFixedFit | (scrolls ? ImGuiTableFlags_ScrollY : 0);
    if (!ImGui::BeginTable("lights", 3, flags, {0.0F, height})) return;
    const glm::vec4 accent = ui::palette().accent;
    ImGui::PushStyleColor(ImGuiCol_Header, {accent.r, accent.g, accent.b, 0.30F});
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
    for (std::size_t i = 0; i < stage.lights().size(); ++i) {
        const StageLight& light = stage.lights()[i];
        ImGui::PushID(static_cast<int>(i));
        ImGui::TableNextColumn();
        ImGui::AlignTextToFramePadding();
        const Selection this_one{Selection::Kind::Light, light.entity};
        if (ImGui::Selectable(light.name.c_str(), state.selection == this_one)) {
            state.selection = this_one;
        }
        ImGui::TableNextColumn();
        bool on = light.on;
        if (ImGui::Checkbox("on", &on)) stage.switch_light(i, on);
        ImGui::TableNextColumn();
        bool casts = light.casts;
        ImGui::BeginDisabled(!light.on);
        if (ImGui::Checkbox("shadow", &casts)) stage.switch_shadow(i, casts);
        ImGui::EndDisabled();
        ImGui::PopID();
    }
    ImGui::PopStyleColor();
    ImGui::EndTable();
}

Status show_animation(ViewState& state, Stage& stage) {
    const auto& animations = stage.shot().scene.animations;
    if (animations.empty() || !section("Animation")) return {};
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
        if (choose("plays", names, chosen)) {
            stage.play(chosen == 0 ? scene::find_animations(stage.shot().scene)
                                   : std::vector{static_cast<std::size_t>(chosen - 1)});
            moved = true;
        }
    }
    return moved ? stage.set_time(state.time_s) : Status();
}

void show_counters(const ViewState& state, const Stage& stage) {
    if (!section("Counters", false)) return;
    const FrameFigures& f = stage.figures();
    const shadows::FrameStats& s = f.shadows;
    if (ImGui::BeginTable("counters", 2, ImGuiTableFlags_SizingStretchProp)) {
        row("pairs drawn / of", fmt::format("{} / {}", s.zpass_pairs + s.zfail_pairs, s.pairs));
        row("depth-pass / depth-fail", fmt::format("{} / {}", s.zpass_pairs, s.zfail_pairs));
        row("found anew / kept", fmt::format("{} / {}", s.pairs_redetected, s.pairs_reused));
        row("culled, hidden", fmt::format("{}, {}", s.pairs_culled, s.pairs_hidden));
        row("ends clamped", with_thousands(s.pairs_clamped));
        row("silhouette edges", with_thousands(s.silhouette_edges));
        row("faces tested", with_thousands(s.detection.faces_tested));
        row("uploaded", fmt::format("{} B", with_thousands(f.upload_bytes)));
        row("draw calls", with_thousands(f.draw_calls));
        ImGui::EndTable();
    }
    if (state.reasons || s.pairs_redetected > 0) {
        for (std::size_t i = 0; i < s.reasons.size(); ++i) {
            if (s.reasons[i] == 0) continue;
            const auto reason = static_cast<shadows::Reason>(i);
            const glm::vec4 color = color_of(reason);
            ImGui::TextColored({color.r, color.g, color.b, 1.0F}, "%s",
                               std::string(shadows::to_string(reason)).c_str());
            ImGui::SameLine();
            ImGui::Text("%s", with_thousands(s.reasons[i]).c_str());
        }
    }
}

}  // namespace

void ViewState::add_times(const FrameFigures& f) {
    const auto number = [](double value) { return static_cast<float>(std::max(value, 0.0)); };
    shadow_times.add(std::array{number(f.detect_ms), number(f.build_ms), number(f.record_ms)});
    frame_times.add(std::array{number(f.frame_ms - f.device_ms), number(f.device_ms)});
}

glm::vec4 color_of(shadows::Reason reason) {
    using shadows::Reason;
    switch (reason) {
        case Reason::Unchanged: return {0.45F, 0.80F, 0.50F, 1.0F};
        case Reason::WithinMargin:
        case Reason::LeftStale: return {0.70F, 0.85F, 0.35F, 1.0F};
        case Reason::LightMoved: return {0.98F, 0.80F, 0.30F, 1.0F};
        case Reason::CasterMoved: return {0.98F, 0.60F, 0.25F, 1.0F};
        case Reason::BothMoved: return {0.95F, 0.42F, 0.30F, 1.0F};
        case Reason::MeshChanged: return {0.90F, 0.35F, 0.60F, 1.0F};
        case Reason::New: return {0.50F, 0.70F, 1.0F, 1.0F};
        case Reason::ProjectionChanged:
        case Reason::NearCapsChanged: return {0.70F, 0.55F, 0.95F, 1.0F};
        case Reason::OutOfRange:
        case Reason::OutOfView:
        case Reason::ReachesNothing:
        case Reason::InUmbra: return {0.60F, 0.62F, 0.66F, 1.0F};
    }
    return glm::vec4(1.0F);
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
