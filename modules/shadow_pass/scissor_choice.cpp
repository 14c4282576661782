// SPDX-License-Identifier: MIT
#include "internal/scissor_choice.hpp"

#include <algorithm>
#include <limits>

#include <glm/glm.hpp>

namespace gnomon::shadow_pass::internal {

namespace {

std::uint64_t area_of(const shadows::PixelRect& rect) {
    return std::uint64_t{rect.width} * rect.height;
}

// How many pixels of one side are in both.
std::uint64_t overlap(std::uint32_t a, std::uint32_t a_size, std::uint32_t b,
                      std::uint32_t b_size) {
    const std::uint32_t first = std::max(a, b);
    const std::uint32_t end = std::min(a + a_size, b + b_size);
    return end > first ? end - first : 0;
}

}  // namespace

shadows::PixelRect covered_pixels(const shadows::ShadowMesh& mesh, const VolumeInstance& instance,
                                  TargetSize target) {
    const glm::vec3 low = mesh.bounds_min();
    const glm::vec3 high = mesh.bounds_max();
    constexpr float infinite = std::numeric_limits<float>::infinity();
    shadows::ScreenBounds bounds{glm::vec2(infinite), glm::vec2(-infinite)};
    // Either map is linear, so that the corners' images have all others between them, as long as
    // they are before the eye.
    for (const bool far : {false, true}) {
        const glm::mat4& clip = far ? instance.clip_from_far : instance.clip_from_local;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 p((corner & 1) != 0 ? high.x : low.x,
                              (corner & 2) != 0 ? high.y : low.y,
                              (corner & 4) != 0 ? high.z : low.z);
            const glm::vec4 at =
                far ? glm::vec4(p * instance.far_scale + glm::vec3(instance.far_offset),
                                instance.far_offset.w)
                    : glm::vec4(p, 1.0F);
            const glm::vec4 c = clip * at;
            if (!(c.w > 0.0F)) return {0, 0, target.width, target.height};
            const glm::vec2 ndc = glm::vec2(c) / c.w;
            bounds.min = glm::min(bounds.min, ndc);
            bounds.max = glm::max(bounds.max, ndc);
        }
    }
    bounds = shadows::intersection(bounds, {});
    return shadows::pixels_of(bounds, target.width, target.height);
}

bool scissor_pays(const shadows::PixelRect& covered, const shadows::PixelRect& wanted) {
    constexpr std::uint64_t worth_pixels = 1024;
    const std::uint64_t kept = overlap(covered.x, covered.width, wanted.x, wanted.width) *
                               overlap(covered.y, covered.height, wanted.y, wanted.height);
    return area_of(covered) - kept > worth_pixels;
}

}  // namespace gnomon::shadow_pass::internal
