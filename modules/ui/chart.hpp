// SPDX-License-Identifier: MIT
//
// A chart of the last frames: values stacked upon each other, newest at the right, as wide as the
// window. What "how long does it take, and what takes it" needs; no plotting library.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace gnomon::ui {

struct ChartSeries {
    const char* name = "";
    glm::vec4 color{1.0F};
};

/// Some numbers a frame, those of the last `capacity` frames.
class ChartHistory {
public:
    ChartHistory(std::size_t series, std::size_t capacity);
    /// One value a series; the oldest frame is forgotten.
    void add(std::span<const float> values);
    void clear();
    [[nodiscard]] std::size_t frames() const { return frames_; }
    [[nodiscard]] std::size_t capacity() const { return capacity_; }
    [[nodiscard]] std::size_t series() const { return series_; }
    /// Age 0 is the newest.
    [[nodiscard]] float at(std::size_t age, std::size_t series) const;
    /// The largest sum of a frame.
    [[nodiscard]] float largest_sum() const;
    /// The median of one series; 0 without frames.
    [[nodiscard]] float median(std::size_t series) const;

private:
    std::size_t series_;
    std::size_t capacity_;
    std::size_t next_ = 0;
    std::size_t frames_ = 0;
    std::vector<float> values_;
};

/// Within a window of the current Dear ImGui context: the chart, its scale in `unit` (a round
/// number that holds the largest sum), and below it a legend in one line, with
/// each series' median.
void draw_chart(const char* id, const ChartHistory& history, std::span<const ChartSeries> series,
                const char* unit, float height_px);

/// The smallest of 1, 2 and 5 times a power of ten that is not less than `value`; 1e-3 at least.
[[nodiscard]] float round_scale(float value);

}  // namespace gnomon::ui
