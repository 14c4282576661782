// SPDX-License-Identifier: MIT
#include "profile/surface_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include <gnomon/shadows/view.hpp>

#include "profile/color_bar.hpp"

namespace gnomon::cli {

namespace {

constexpr double picture_width = 1280.0;
constexpr double picture_height = 860.0;
constexpr double fovy_rad = 0.6;
constexpr double nearest_share = 1e-3;  // of the distance from eye to target

struct SeenPatch {
    double distance = 0.0;
    std::array<glm::dvec2, 3> corners;
    Color color;
};

struct LookedAt {
    glm::dvec3 eye{0.0};
    glm::dvec3 target{0.0};
};

LookedAt look_of(const Study& study, const std::vector<sun_study::SurfacePoint>& points,
                 const SurfaceCamera& camera) {
    glm::dvec3 min = points.front().at_plan;
    glm::dvec3 max = min;
    for (const sun_study::SurfacePoint& point : points) {
        min = glm::min(min, point.at_plan);
        max = glm::max(max, point.at_plan);
    }
    LookedAt look;
    look.target = camera.target_plan.value_or((min + max) * 0.5);
    // From the south, or in the southern hemisphere from the north, and a little from the west.
    const double bearing =
        glm::radians(study.north_deg + (study.latitude_deg < 0.0 ? -25.0 : 205.0));
    const glm::dvec3 from(std::sin(bearing), std::cos(bearing), 0.55);
    const double distance = std::max(glm::distance(min, max), 1.0) * 0.5 / std::tan(fovy_rad / 2.0);
    look.eye = camera.eye_plan.value_or(look.target + glm::normalize(from) * distance * 1.2);
    return look;
}

}  // namespace

Result<std::vector<std::byte>> draw_surfaces(const Study& study, const SurfaceResult& surfaces,
                                             const sun::Date& date, double most_h,
                                             const SurfaceCamera& camera) {
    const LookedAt look = look_of(study, surfaces.points, camera);
    const glm::dvec3 sight = look.target - look.eye;
    const double distance = glm::length(sight);
    if (!(distance > 1e-9)) {
        return fail(ErrorCode::InvalidInput,
                    "--eye and --target are the same point: there is no direction to look in.");
    }
    const bool is_upright = std::hypot(sight.x, sight.y) > 1e-6 * distance;
    // About the target, so that coordinates of a map projection cost nothing.
    const glm::dmat4 view =
        shadows::look_at(look.eye - look.target, glm::dvec3(0.0),
                         is_upright ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(0.0, 1.0, 0.0));
    const double pixels = picture_height * 0.5 / std::tan(fovy_rad / 2.0);
    std::vector<SeenPatch> seen;
    for (std::size_t i = 0; i < surfaces.points.size(); ++i) {
        const sun_study::SurfacePoint& point = surfaces.points[i];
        if (glm::dot(point.normal_plan, look.eye - point.at_plan) <= 0.0) continue;
        SeenPatch patch;
        bool ahead = true;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec4 p = view * glm::dvec4(point.corners_plan[k] - look.target, 1.0);
            ahead = ahead && -p.z > nearest_share * distance;
            patch.corners[k] = {picture_width * 0.5 + pixels * p.x / -p.z,
                                picture_height * 0.5 - pixels * p.y / -p.z};
        }
        if (!ahead) continue;
        patch.distance = glm::distance(point.at_plan, look.eye);
        patch.color = ramp(heat_colors, surfaces.hours.hours(i) / most_h);
        seen.push_back(patch);
    }
    std::ranges::stable_sort(seen, std::greater{}, &SeenPatch::distance);
    Canvas canvas(static_cast<std::uint32_t>(picture_width) + 140,
                  static_cast<std::uint32_t>(picture_height), {0.93, 0.94, 0.95});
    for (const SeenPatch& patch : seen) canvas.solid_polygon(patch.corners, patch.color);
    canvas.text({24.0, 36.0}, "Sun hours on surfaces: " + study.model,
                {.size = 22.0, .bold = true});
    canvas.text(
        {24.0, 62.0},
        fmt::format("{}, {} to {} ({}); \u201c{}\u201d, {} points", sun::to_text(date),
                    sun::clock_text(study.from), sun::clock_text(study.to),
                    sun::offset_text(study.offset), study.receivers, surfaces.points.size()),
        {.size = 14.0, .color = {0.42, 0.43, 0.46}});
    color_bar(canvas, {picture_width + 20.0, 110.0}, 420.0, heat_colors, 0.0, most_h);
    return canvas.png();
}

}  // namespace gnomon::cli
