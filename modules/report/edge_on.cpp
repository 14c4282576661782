// SPDX-License-Identifier: MIT
#include "internal/edge_on.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace gnomon::report::internal {

namespace {

// Homogeneous places in the picture, in pixels: (x, y, 1) times w, at infinity as well.
class Projected {
public:
    Projected(const shadows::VolumeDraw& draw, const shadows::View& view, PictureSize size)
        : draw_(draw), view_(view), size_(size) {
        shadows::extrude(draw.mesh->positions(), draw.extrusion, far_);
    }
    [[nodiscard]] glm::dvec3 operator()(std::uint32_t index) const {
        const glm::dvec4 in_world =
            index % 2 == 1 ? draw_.world_from_far * glm::dvec4(far_[index / 2])
                           : draw_.world_from_local *
                                 glm::dvec4(glm::dvec3(draw_.mesh->positions()[index / 2]), 1.0);
        const glm::dvec4 p = view_.clip_from_world() * in_world;
        return {(p.w + p.x) * 0.5 * size_.width, (p.w - p.y) * 0.5 * size_.height, p.w};
    }

private:
    const shadows::VolumeDraw& draw_;
    const shadows::View& view_;
    PictureSize size_;
    std::vector<glm::vec4> far_;
};

}  // namespace

bool is_on_a_side_seen_edge_on(const shadows::DrawList& list, std::uint64_t light,
                               const shadows::View& view, PictureSize size, Pixel pixel) {
    const glm::dvec3 place(pixel.x + 0.5, pixel.y + 0.5, 1.0);
    return std::ranges::any_of(list.draws, [&](const shadows::VolumeDraw& draw) {
        if (draw.light != light || draw.volume == nullptr || draw.mesh == nullptr) return false;
        const Projected projected(draw, view, size);
        const std::vector<std::uint32_t>& indices = draw.volume->indices;
        const std::size_t end = draw.volume->sides.first + draw.volume->sides.count;
        for (std::size_t i = draw.volume->sides.first; i + 2 < end; i += 3) {
            const std::array<glm::dvec3, 3> corners{
                projected(indices[i]), projected(indices[i + 1]), projected(indices[i + 2])};
            double farthest = 0.0;
            int lines = 0;  // two equal corners make none
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::dvec3 line = glm::cross(corners[k], corners[(k + 1) % 3]);
                const double length = std::hypot(line.x, line.y);
                if (length > 0.0) {
                    ++lines;
                    farthest = std::max(farthest, std::abs(glm::dot(line, place)) / length);
                }
            }
            if (lines >= 2 && farthest < rounding_px) return true;
        }
        return false;
    });
}

}  // namespace gnomon::report::internal
