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
                                  const glm::vec2& size, const Margins& margins) {
    const glm::dvec4 over(level.exit.x, 1.5, level.exit.y, 1.0);
    const glm::dvec4 clip = view.clip_from_view * view.view_from_world * over;
    const glm::vec2 middle = size * 0.5F;
    // How far it is from the middle to the border, up to the left and down to the right.
    const glm::vec2 least = glm::max(middle - glm::vec2(margins.side, margins.above), 1.0F);
    const glm::vec2 most = glm::max(middle - glm::vec2(margins.side, margins.below), 1.0F);
    glm::vec2 way(0.0F);
    if (clip.w > 0.0) {
        const glm::dvec2 ndc = glm::dvec2(clip) / clip.w;
        way = glm::vec2(glm::dvec2(ndc.x, -ndc.y)) * middle;
        const bool is_inside =
            way.x > -least.x && way.x < most.x && way.y > -least.y && way.y < most.y;
        if (is_inside) return ExitMark{.at = middle + way, .way = std::nullopt};
    } else {
        // Behind the eye it has no place, but a way, as the ground is seen.
        const glm::dvec3 in_view(view.view_from_world * over);
        way = {static_cast<float>(in_view.x), static_cast<float>(-in_view.y)};
    }
    if (glm::length(way) < 1e-4F) return std::nullopt;
    way = glm::normalize(way);
    const glm::vec2 reach = glm::mix(least, most, glm::greaterThan(way, glm::vec2(0.0F))) /
                            glm::max(glm::abs(way), 1e-4F);
    return ExitMark{.at = middle + way * std::min(reach.x, reach.y), .way = way};
}

}  // namespace gnomon::game
