// SPDX-License-Identifier: MIT
#include "internal/layer_grid.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::shadows::internal {

LayerGrid::LayerGrid(const glm::dvec4& light_world, std::span<const Footprint> all,
                     std::uint32_t limit)
    : light_(light_world), limit_(limit), cells_(light_world.w == 0.0 ? 64 : 32) {
    glm::dvec2 half(1.0);
    if (light_world.w == 0.0) {
        // Where most are: a few that lie far away, or are huge, must not make cells of all large.
        glm::dvec2 mean(0.0);
        glm::dvec2 squares(0.0);
        double count = 0.0;
        for (const Footprint& f : all) {
            const glm::dvec2 center = 0.5 * f.low + 0.5 * f.high;
            count += 1.0;
            const glm::dvec2 step = center - mean;
            mean += step / count;
            squares += step * (center - mean);
        }
        half = 2.0 * glm::sqrt(squares / std::max(count, 1.0));
        for (int i = 0; i < 2; ++i) {
            if (!std::isfinite(mean[i])) mean[i] = 0.0;
            if (!(half[i] > 1e-6) || !std::isfinite(half[i])) half[i] = 1.0;
        }
        origin_ = mean - half;
    }
    cells_per_unit_ = 0.5 * static_cast<double>(cells_) / half;
    for (const Footprint& f : all) change(f, 1);
}

glm::uvec2 LayerGrid::cell_of(const glm::dvec2& place) const {
    const glm::dvec2 at = (place - origin_) * cells_per_unit_;
    return glm::uvec2(glm::clamp(at, glm::dvec2(0.0), glm::dvec2(cells_ - 1.0)));
}

void LayerGrid::change(const Footprint& footprint, std::int64_t sign) {
    std::vector<std::uint32_t>& picture = pictures_[footprint.picture];
    if (picture.empty()) picture.resize(std::size_t{cells_} * cells_);
    const glm::uvec2 low = cell_of(footprint.low);
    const glm::uvec2 high = cell_of(footprint.high);
    // One alone that exceeds the limit does so however much: so that cells never overflow.
    const std::int64_t by = sign * std::min<std::int64_t>(footprint.layers, limit_ + 1);
    for (std::uint32_t y = low.y; y <= high.y; ++y) {
        for (std::uint32_t x = low.x; x <= high.x; ++x) {
            std::uint32_t& layers = picture[std::size_t{y} * cells_ + x];
            const std::int64_t before = layers;
            const std::int64_t now = before + by;
            layers = static_cast<std::uint32_t>(now);
            cells_over_ += (now > limit_ ? 1U : 0U);
            cells_over_ -= (before > limit_ ? 1U : 0U);
        }
    }
}

void LayerGrid::change(const OrientedBounds& bounds, std::uint32_t layers, std::int64_t sign) {
    if (layers == 0) return;
    footprints_.clear();
    append_footprints(bounds, light_, layers, footprints_);
    for (const Footprint& f : footprints_) change(f, sign);
}

std::size_t LayerGrid::memory_bytes() const {
    std::size_t bytes = sizeof *this + footprints_.capacity() * sizeof(Footprint);
    for (const auto& picture : pictures_) bytes += picture.capacity() * sizeof(picture[0]);
    return bytes;
}

}  // namespace gnomon::shadows::internal
