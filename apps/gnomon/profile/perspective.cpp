// SPDX-License-Identifier: MIT
#include "profile/perspective.hpp"

#include <algorithm>
#include <cmath>

#include <glm/trigonometric.hpp>

#include <gnomon/shadows/view.hpp>

namespace gnomon::cli {

namespace {

constexpr double fovy_rad = 0.6;
constexpr double nearest_share = 1e-3;  // of the distance from eye to target
constexpr Color sky{0.93, 0.94, 0.95};

std::array<std::uint8_t, 3> bytes_of(const Color& color) {
    const auto byte = [](double value) {
        return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255.0));
    };
    return {byte(color.r), byte(color.g), byte(color.b)};
}

}  // namespace

Result<Perspective> Perspective::create(const Study& study, const glm::dvec3& min,
                                        const glm::dvec3& max, const PictureCamera& camera) {
    const glm::dvec3 target = camera.target_plan.value_or((min + max) * 0.5);
    // From the south, or in the southern hemisphere from the north, and a little from the west.
    const double bearing =
        glm::radians(study.north_deg + (study.latitude_deg < 0.0 ? -25.0 : 205.0));
    const glm::dvec3 from(std::sin(bearing), std::cos(bearing), 0.55);
    const double usual = std::max(glm::distance(min, max), 1.0) * 0.5 / std::tan(fovy_rad / 2.0);
    Perspective picture;
    picture.eye_ = camera.eye_plan.value_or(target + glm::normalize(from) * usual * 1.2);
    const glm::dvec3 sight = target - picture.eye_;
    const double distance = glm::length(sight);
    if (!(distance > 1e-9)) {
        return fail(ErrorCode::InvalidInput,
                    "--eye and --target are the same point: there is no direction to look in.");
    }
    const bool is_upright = std::hypot(sight.x, sight.y) > 1e-6 * distance;
    // About the eye, so that coordinates of a map projection cost nothing.
    picture.view_ = glm::dmat3(
        shadows::look_at(glm::dvec3(0.0), sight,
                         is_upright ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(0.0, 1.0, 0.0)));
    picture.nearest_m_ = nearest_share * distance;
    return picture;
}

void Perspective::plane(double height_m, const std::function<Color(const glm::dvec2&)>& color_at) {
    const double drop = height_m - eye_.z;
    const glm::dmat3 plan_from_view = glm::transpose(view_);
    const double scale = 2.0 * std::tan(fovy_rad / 2.0) / rows;
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const glm::dvec3 ray =
                plan_from_view * glm::dvec3((column + 0.5 - columns * 0.5) * scale,
                                            (rows * 0.5 - row - 0.5) * scale, -1.0);
            // Along the line of sight the ray goes 1 a unit.
            const double distance = drop / ray.z;
            if (!(distance > nearest_m_) || !std::isfinite(distance)) continue;
            Sample& sample = samples_[std::size_t{row} * columns + column];
            const auto nearness = static_cast<float>(1.0 / distance);
            if (nearness <= sample.nearness) continue;
            sample = {nearness, bytes_of(color_at(glm::dvec2(eye_ + ray * distance)))};
        }
    }
}

// What is nearer than the nearest plane is cut off first.
void Perspective::triangle(const PlanCorners& corners, const Color& color, double lift) {
    std::array<glm::dvec3, 4> polygon{};
    std::size_t count = 0;
    std::array<glm::dvec3, 3> seen{};
    for (std::size_t i = 0; i < 3; ++i) seen[i] = view_ * (corners[i] - eye_);
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3& here = seen[i];
        const glm::dvec3& next = seen[(i + 1) % 3];
        const bool is_ahead = -here.z >= nearest_m_;
        if (is_ahead) polygon[count++] = here;
        if (is_ahead != (-next.z >= nearest_m_)) {
            polygon[count++] = glm::mix(here, next, (-nearest_m_ - here.z) / (next.z - here.z));
        }
    }
    const double pixels = rows * 0.5 / std::tan(fovy_rad / 2.0);
    for (std::size_t i = 0; i < count; ++i) {
        const double nearness = 1.0 / -polygon[i].z;
        polygon[i] = {columns * 0.5 + pixels * polygon[i].x * nearness,
                      rows * 0.5 - pixels * polygon[i].y * nearness, nearness};
    }
    for (std::size_t i = 2; i < count; ++i) {
        fill({polygon[0], polygon[i - 1], polygon[i]}, color, lift);
    }
}

// By edge functions at the samples' middles; nearness is linear on the picture.
void Perspective::fill(const std::array<glm::dvec3, 3>& corners, const Color& color, double lift) {
    const auto& [a, b, c] = corners;
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (area == 0.0 || !std::isfinite(area)) return;
    const auto range = [](double least, double most, std::uint32_t size) {
        const double last = size - 1.0;
        return std::array{
            static_cast<std::uint32_t>(std::clamp(std::ceil(least - 0.5), 0.0, last)),
            static_cast<std::uint32_t>(std::clamp(std::floor(most - 0.5), 0.0, last))};
    };
    const std::array<std::uint8_t, 3> rgb = bytes_of(color);
    const auto [first_column, last_column] =
        range(std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x}), columns);
    const auto [first_row, last_row] =
        range(std::min({a.y, b.y, c.y}), std::max({a.y, b.y, c.y}), rows);
    for (std::uint32_t row = first_row; row <= last_row; ++row) {
        for (std::uint32_t column = first_column; column <= last_column; ++column) {
            const glm::dvec2 at(column + 0.5, row + 0.5);
            const auto share = [&](const glm::dvec3& p, const glm::dvec3& q) {
                return ((q.x - p.x) * (at.y - p.y) - (at.x - p.x) * (q.y - p.y)) / area;
            };
            const double of_c = share(a, b);
            const double of_a = share(b, c);
            const double of_b = share(c, a);
            if (of_a < 0.0 || of_b < 0.0 || of_c < 0.0) continue;
            const auto nearness =
                static_cast<float>((of_a * a.z + of_b * b.z + of_c * c.z) * (1.0 + lift));
            Sample& sample = samples_[std::size_t{row} * columns + column];
            if (nearness > sample.nearness) sample = {nearness, rgb};
        }
    }
}

std::vector<Color> Perspective::pixels() const {
    std::vector<Color> colors(std::size_t{width} * height, {0.0, 0.0, 0.0});
    constexpr double share = 1.0 / (255.0 * samples_a_side * samples_a_side);
    const std::array<std::uint8_t, 3> nothing = bytes_of(sky);
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const Sample& sample = samples_[std::size_t{row} * columns + column];
            const auto& from = sample.nearness > 0.0F ? sample.rgb : nothing;
            Color& to = colors[std::size_t{row / samples_a_side} * width + column / samples_a_side];
            to.r += from[0] * share;
            to.g += from[1] * share;
            to.b += from[2] * share;
        }
    }
    return colors;
}

}  // namespace gnomon::cli
