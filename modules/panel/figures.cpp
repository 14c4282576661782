// SPDX-License-Identifier: MIT
#include <array>
#include <cstddef>

#include <fmt/format.h>
#include <imgui.h>

#include <gnomon/panel/figures.hpp>

namespace gnomon::panel {

namespace {

constexpr std::array<ui::ChartSeries, 3> shadow_series{{
    {"detect", {0.96F, 0.74F, 0.30F, 1.0F}},
    {"build", {0.90F, 0.45F, 0.35F, 1.0F}},
    {"record", {0.35F, 0.72F, 0.80F, 1.0F}},
}};

void row(const char* name, const std::string& value) {
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", name);
    ImGui::TableNextColumn();
    const float free = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(value.c_str()).x;
    if (free > 0.0F) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + free);
    ImGui::TextUnformatted(value.c_str());
}

ImU32 packed(const glm::vec4& color, float alpha) {
    return ImGui::ColorConvertFloat4ToU32({color.r, color.g, color.b, color.a * alpha});
}

}  // namespace

std::string with_thousands(std::uint64_t number) {
    std::string digits = std::to_string(number);
    for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3) {
        digits.insert(static_cast<std::size_t>(at), ",");
    }
    return digits;
}

void show_counters(const Counters& counters, bool reasons) {
    const shadows::FrameStats& s = counters.shadows;
    if (ImGui::BeginTable("counters", 2, ImGuiTableFlags_SizingStretchProp)) {
        row("pairs drawn / of", fmt::format("{} / {}", s.zpass_pairs + s.zfail_pairs, s.pairs));
        row("depth-pass / depth-fail", fmt::format("{} / {}", s.zpass_pairs, s.zfail_pairs));
        row("found anew / kept", fmt::format("{} / {}", s.pairs_redetected, s.pairs_reused));
        row("culled, hidden", fmt::format("{}, {}", s.pairs_culled, s.pairs_hidden));
        row("ends clamped", with_thousands(s.pairs_clamped));
        row("silhouette edges", with_thousands(s.silhouette_edges));
        row("faces tested", with_thousands(s.detection.faces_tested));
        row("uploaded", fmt::format("{} B", with_thousands(counters.upload_bytes)));
        row("draw calls", with_thousands(counters.draw_calls));
        ImGui::EndTable();
    }
    if (!reasons && s.pairs_redetected == 0) return;
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

void show_shadow_times(const ui::ChartHistory& history, float height_px) {
    ui::draw_chart("shadow times", history, shadow_series, "ms, shadows on the CPU", height_px);
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

void show_bounds(const Marks& marks, const shadows::DrawList& draws, const glm::uvec2& size_px) {
    if (!marks.scissors && !marks.reasons) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    for (const shadows::VolumeDraw& draw : draws.draws) {
        if (draw.bounds.empty()) continue;
        const shadows::PixelRect rect = shadows::pixels_of(draw.bounds, size_px.x, size_px.y);
        if (rect.width == 0 || rect.height == 0) continue;
        const ImVec2 min{static_cast<float>(rect.x), static_cast<float>(rect.y)};
        const ImVec2 max{min.x + static_cast<float>(rect.width),
                         min.y + static_cast<float>(rect.height)};
        const glm::vec4 color =
            marks.reasons ? color_of(draw.reason) : glm::vec4(0.4F, 0.8F, 1.0F, 1.0F);
        // What stayed as it was is outlined alone, or it would cover what did not.
        if (marks.reasons && draw.reason != shadows::Reason::Unchanged) {
            list.AddRectFilled(min, max, packed(color, 0.12F));
        }
        list.AddRect(min, max, packed(color, 0.75F));
    }
}

}  // namespace gnomon::panel
