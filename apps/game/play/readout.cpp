// SPDX-License-Identifier: MIT
#include "play/readout.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::game {

namespace {

double faded(double from, double to, double value) {
    const double share = std::clamp((value - from) / (to - from), 0.0, 1.0);
    return share * share * (3.0 - 2.0 * share);
}

}  // namespace

Captions captions_at(double shown_s, bool waits, bool keeps_still) {
    Captions captions;
    captions.name = faded(0.1, 0.6, shown_s) * (waits ? 1.0 : 1.0 - faded(2.0, 2.8, shown_s));
    captions.hint = faded(0.3, 0.9, shown_s) * (waits ? 1.0 : 1.0 - faded(13.0, 14.5, shown_s));
    if (waits) {
        const double pulse = keeps_still ? 1.0 : 0.75 + 0.25 * std::sin(shown_s * 4.0);
        captions.first_step = faded(1.0, 1.6, shown_s) * pulse;
    }
    return captions;
}

double alarm_tint(const Meter& meter) {
    return meter.alarm > 0.02 ? std::min(1.0, 0.35 + meter.alarm) : 0.0;
}

std::optional<ExitMark> exit_mark(const Level& level, const shadows::View& view,
                                  const glm::vec2& size, float margin, float margin_below) {
    const glm::dvec4 over(level.exit.x, 1.5, level.exit.y, 1.0);
    const glm::dvec4 clip = view.clip_from_view * view.view_from_world * over;
    // Behind the eye it has no place, but a way.
    const bool is_ahead = clip.w > 0.0;
    glm::vec2 place(0.0F);
    if (is_ahead) {
        const glm::dvec2 ndc = glm::dvec2(clip) / clip.w;
        place = glm::vec2(glm::dvec2(0.5 + 0.5 * ndc.x, 0.5 - 0.5 * ndc.y)) * size;
        if (place.x > margin && place.x < size.x - margin && place.y > margin &&
            place.y < size.y - margin_below) {
            return ExitMark{.at = place, .way = std::nullopt};
        }
    }
    // As the ground is seen.
    const glm::dvec3 in_view(view.view_from_world * over);
    glm::vec2 way(static_cast<float>(in_view.x), static_cast<float>(-in_view.y));
    if (is_ahead) way = place - size * 0.5F;
    if (glm::length(way) < 1e-4F) return std::nullopt;
    way = glm::normalize(way);
    const glm::vec2 half = glm::max(size * 0.5F - margin, glm::vec2(1.0F));
    const float reach = std::min(half.x / std::max(std::abs(way.x), 1e-4F),
                                 half.y / std::max(std::abs(way.y), 1e-4F));
    return ExitMark{.at = size * 0.5F + way * reach, .way = way};
}

}  // namespace gnomon::game
