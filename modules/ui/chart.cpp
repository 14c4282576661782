// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <imgui.h>

#include <gnomon/core/expects.hpp>
#include <gnomon/ui/chart.hpp>

namespace gnomon::ui {

namespace {

ImU32 packed(const glm::vec4& color) {
    return ImGui::ColorConvertFloat4ToU32({color.r, color.g, color.b, color.a});
}

void draw_legend(const ChartHistory& history, std::span<const ChartSeries> series) {
    const float size = ImGui::GetFontSize();
    const float column = ImGui::GetContentRegionAvail().x / static_cast<float>(series.size());
    const float left = ImGui::GetCursorPosX();
    for (std::size_t i = 0; i < series.size(); ++i) {
        if (i > 0) ImGui::SameLine(left + column * static_cast<float>(i));
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float inset = size * 0.25F;
        ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + inset},
                                                  {at.x + size - 2 * inset, at.y + size - inset},
                                                  packed(series[i].color), 2.0F);
        ImGui::Dummy({size - 2 * inset, size});
        ImGui::SameLine(0.0F, inset);
        ImGui::Text("%s %.2f", series[i].name, static_cast<double>(history.median(i)));
    }
}

}  // namespace

ChartHistory::ChartHistory(std::size_t series, std::size_t capacity)
    : series_(series), capacity_(capacity), values_(series * capacity) {
    GNOMON_EXPECTS(series > 0 && capacity > 0);
}

void ChartHistory::add(std::span<const float> values) {
    GNOMON_EXPECTS(values.size() == series_);
    std::ranges::copy(values, values_.begin() + static_cast<std::ptrdiff_t>(next_ * series_));
    next_ = (next_ + 1) % capacity_;
    frames_ = std::min(frames_ + 1, capacity_);
}

void ChartHistory::clear() {
    next_ = 0;
    frames_ = 0;
}

float ChartHistory::at(std::size_t age, std::size_t series) const {
    GNOMON_EXPECTS(age < frames_ && series < series_);
    return values_[(next_ + capacity_ - 1 - age) % capacity_ * series_ + series];
}

float ChartHistory::largest_sum() const {
    float largest = 0.0F;
    for (std::size_t age = 0; age < frames_; ++age) {
        float sum = 0.0F;
        for (std::size_t i = 0; i < series_; ++i) sum += at(age, i);
        largest = std::max(largest, sum);
    }
    return largest;
}

float ChartHistory::median(std::size_t series) const {
    if (frames_ == 0) return 0.0F;
    std::vector<float> all(frames_);
    for (std::size_t age = 0; age < frames_; ++age) all[age] = at(age, series);
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(frames_ / 2);
    std::ranges::nth_element(all, middle);
    return *middle;
}

float round_scale(float value) {
    float scale = 1e-3F;
    while (scale < value && scale < 1e30F) {
        if (2.0F * scale >= value) return 2.0F * scale;
        if (5.0F * scale >= value) return 5.0F * scale;
        scale *= 10.0F;
    }
    return scale;
}

void draw_chart(const char* id, const ChartHistory& history, std::span<const ChartSeries> series,
                const char* unit, float height_px) {
    GNOMON_EXPECTS(series.size() == history.series());
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = std::max(1.0F, ImGui::GetContentRegionAvail().x);
    ImGui::InvisibleButton(id, {width, height_px});
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 end{corner.x + width, corner.y + height_px};
    list.AddRectFilled(corner, end, ImGui::GetColorU32(ImGuiCol_FrameBg, 0.6F), 4.0F);
    const float scale = round_scale(history.largest_sum());
    const float step = width / static_cast<float>(history.capacity());
    for (std::size_t age = 0; age < history.frames(); ++age) {
        const float right = end.x - static_cast<float>(age) * step;
        float base = end.y;
        for (std::size_t i = 0; i < series.size(); ++i) {
            const float top = base - history.at(age, i) / scale * height_px;
            // Whole pixels: neighbours neither overlap nor leave gaps.
            list.AddRectFilled({std::floor(right - step), std::round(top)},
                               {std::floor(right), std::round(base)}, packed(series[i].color));
            base = top;
        }
    }
    const ImU32 line = ImGui::GetColorU32(ImGuiCol_TextDisabled, 0.35F);
    const float half = std::round((corner.y + end.y) / 2.0F);
    list.AddLine({corner.x, half}, {end.x, half}, line);
    char text[32];
    std::snprintf(text, sizeof text, "%g %s", static_cast<double>(scale), unit);
    list.AddText({corner.x + 5.0F, corner.y + 2.0F}, ImGui::GetColorU32(ImGuiCol_TextDisabled),
                 text);
    draw_legend(history, series);
}

}  // namespace gnomon::ui
