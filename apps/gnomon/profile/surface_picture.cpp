// SPDX-License-Identifier: MIT
#include "profile/surface_picture.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "profile/color_bar.hpp"

namespace gnomon::cli {

namespace {

constexpr Color under_a_roof{0.62, 0.64, 0.67};
constexpr Color beyond_the_grid{0.86, 0.87, 0.88};
constexpr Color title_grey{0.42, 0.43, 0.46};
// Of the distance: a patch before the face that it is a piece of.
constexpr double patch_lift = 1e-5;

class Bounds {
public:
    void add(const glm::dvec3& point) {
        min_ = is_empty_ ? point : glm::min(min_, point);
        max_ = is_empty_ ? point : glm::max(max_, point);
        is_empty_ = false;
    }
    [[nodiscard]] const glm::dvec3& min() const { return min_; }
    [[nodiscard]] const glm::dvec3& max() const { return max_; }

private:
    glm::dvec3 min_{0.0};
    glm::dvec3 max_{0.0};
    bool is_empty_ = true;
};

void add_patches(Perspective& picture, const SurfaceResult& surfaces, double most_h) {
    for (std::size_t i = 0; i < surfaces.points.size(); ++i) {
        const sun_study::SurfacePoint& point = surfaces.points[i];
        if (glm::dot(point.normal_plan, picture.eye() - point.at_plan) <= 0.0) continue;
        picture.triangle(point.corners_plan, heat_color(surfaces.hours.hours(i), most_h),
                         patch_lift);
    }
}

// By a light that comes over the left shoulder of whoever looks north.
void add_casters(Perspective& picture, std::span<const PlanCorners> casters) {
    const glm::dvec3 light = glm::normalize(glm::dvec3(-0.5, -0.7, 0.9));
    for (const PlanCorners& corners : casters) {
        glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double length = glm::length(normal);
        if (!(length > 0.0)) continue;
        if (glm::dot(normal, picture.eye() - corners[0]) < 0.0) normal = -normal;
        const double shade = 0.62 + 0.26 * glm::dot(normal, light) / length;
        picture.triangle(corners, {shade, shade, shade * 1.02});
    }
}

Result<std::vector<std::byte>> with_legend(const Perspective& picture, const std::string& title,
                                           const std::string& subtitle, double most_h,
                                           bool has_grey) {
    Canvas canvas(Perspective::width + 140, Perspective::height, {0.93, 0.94, 0.95});
    canvas.cells({0.0, 0.0}, picture.pixels(), Perspective::width, 1.0);
    canvas.rectangle({0.0, 0.0}, {Perspective::width, 76.0}, Color{0.93, 0.94, 0.95, 0.8});
    canvas.text({24.0, 36.0}, title, {.size = 22.0, .bold = true});
    canvas.text({24.0, 62.0}, subtitle, {.size = 14.0, .color = title_grey});
    const glm::dvec2 legend(Perspective::width + 20.0, 110.0);
    const double bar = most_h > 0.0 ? 420.0 : 0.0;
    color_bar(canvas, legend, bar, heat_colors, 0.0, most_h);
    if (bar == 0.0) canvas.text(legend, "no sun on this day", {.size = 11.0});
    if (has_grey) {
        canvas.text(legend + glm::dvec2(0.0, bar + 32.0), "grey: under a roof,", {.size = 11.0});
        canvas.text(legend + glm::dvec2(0.0, bar + 48.0), "or not asked", {.size = 11.0});
    }
    return canvas.png();
}

std::string time_text(const Study& study, const sun::Date& date) {
    return fmt::format("{}, {} to {} ({})", sun::to_text(date), sun::clock_text(study.from),
                       sun::clock_text(study.to), sun::offset_text(study.offset));
}

}  // namespace

Result<std::vector<std::byte>> draw_surfaces(const Study& study, const SurfaceResult& surfaces,
                                             const sun::Date& date, double most_h,
                                             const PictureCamera& camera) {
    Bounds bounds;
    for (const sun_study::SurfacePoint& point : surfaces.points) bounds.add(point.at_plan);
    auto picture = Perspective::create(study, bounds.min(), bounds.max(), camera);
    if (!picture) return forward_error(picture);
    add_patches(*picture, surfaces, most_h);
    return with_legend(*picture, "Sun hours on surfaces: " + study.model,
                       fmt::format("{}; \u201c{}\u201d, {} points", time_text(study, date),
                                   study.receivers, surfaces.points.size()),
                       most_h, false);
}

Result<std::vector<std::byte>> draw_scene(const Study& study, const DayResult& day,
                                          const SurfaceResult* surfaces,
                                          std::span<const PlanCorners> casters,
                                          const PictureCamera& camera) {
    Bounds bounds;
    for (const PlanCorners& corners : casters) {
        for (const glm::dvec3& corner : corners) bounds.add(corner);
    }
    auto picture = Perspective::create(study, bounds.min(), bounds.max(), camera);
    if (!picture) return forward_error(picture);
    const sun_study::PlanGrid& grid = study.grid;
    const double most_h = day.most_hours();
    picture->plane(grid.height_m, [&](const glm::dvec2& at) {
        const double column = std::floor((at.x - grid.min_m.x) / grid.cell_m);
        const double row = std::floor((grid.max_m().y - at.y) / grid.cell_m);
        if (!(column >= 0.0 && column < grid.columns && row >= 0.0 && row < grid.rows)) {
            return beyond_the_grid;
        }
        const std::size_t cell =
            static_cast<std::size_t>(row) * grid.columns + static_cast<std::size_t>(column);
        return day.open[cell] == 0 ? under_a_roof : heat_color(day.hours.hours(cell), most_h);
    });
    add_casters(*picture, casters);
    if (surfaces != nullptr) add_patches(*picture, *surfaces, most_h);
    return with_legend(
        *picture, "Sun hours: " + study.model,
        fmt::format("{}; plane at {:.2f} m", time_text(study, day.date), grid.height_m), most_h,
        true);
}

}  // namespace gnomon::cli
