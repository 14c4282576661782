// SPDX-License-Identifier: MIT
#include "textures.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gnomon::game {

namespace {

/// 0 to 1 from two whole numbers; the integer hash is prospector32 by C. Wellons (hash-prospector).
double noise_at(std::int32_t x, std::int32_t y) {
    std::uint32_t h =
        static_cast<std::uint32_t>(x) * 0x9E3779B1U ^ static_cast<std::uint32_t>(y) * 0x85EBCA77U;
    h ^= h >> 15U;
    h *= 0x2C1B3C6DU;
    h ^= h >> 12U;
    h *= 0x297A2D39U;
    h ^= h >> 15U;
    return static_cast<double>(h) / 4294967295.0;
}

/// Between whole numbers.
double smooth_noise(double x, double y) {
    const double fx = std::floor(x);
    const double fy = std::floor(y);
    const auto ease = [](double t) { return t * t * (3.0 - 2.0 * t); };
    const double u = ease(x - fx);
    const double v = ease(y - fy);
    const auto ix = static_cast<std::int32_t>(fx);
    const auto iy = static_cast<std::int32_t>(fy);
    const double top = glm::mix(noise_at(ix, iy), noise_at(ix + 1, iy), u);
    const double bottom = glm::mix(noise_at(ix, iy + 1), noise_at(ix + 1, iy + 1), u);
    return glm::mix(top, bottom, v);
}

std::uint8_t srgb(double linear) {
    const double x = std::clamp(linear, 0.0, 1.0);
    const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(encoded * 255.0));
}

/// Stones in rows, every other row shifted; how bright a place is, 1 on average.
double flagstones(double x_m, double z_m) {
    constexpr double stone_x_m = 0.95;
    constexpr double stone_z_m = 0.62;
    const double row = std::floor(z_m / stone_z_m);
    const double shift = noise_at(static_cast<std::int32_t>(row), 77) * stone_x_m;
    const double column = std::floor((x_m + shift) / stone_x_m);
    const double in_x = x_m + shift - column * stone_x_m;
    const double in_z = z_m - row * stone_z_m;
    const double to_joint =
        std::min(std::min(in_x, stone_x_m - in_x), std::min(in_z, stone_z_m - in_z));
    const double stone =
        0.82 + 0.36 * noise_at(static_cast<std::int32_t>(column), static_cast<std::int32_t>(row));
    const double joint = std::clamp((to_joint - 0.012) / 0.03, 0.0, 1.0);
    const double grain = 0.90 + 0.20 * smooth_noise(x_m * 9.0, z_m * 9.0);
    return stone * grain * (0.45 + 0.55 * joint);
}

/// How bright a brick wall is at a place of its tile, 0 to 1.
double bricks(double u_m, double v_m) {
    constexpr int columns = 4;
    constexpr int rows = 12;
    constexpr double brick_m = grain_tile_m / columns;
    constexpr double course_m = grain_tile_m / rows;
    const int row = static_cast<int>(v_m / course_m) % rows;
    const double shifted = u_m + (row % 2 == 0 ? 0.0 : brick_m * 0.5);
    const int column = static_cast<int>(shifted / brick_m) % columns;
    const double in_u = std::fmod(shifted, brick_m);
    const double in_v = v_m - row * course_m;
    const double to_joint =
        std::min(std::min(in_u, brick_m - in_u), std::min(in_v, course_m - in_v));
    const double joint = std::clamp((to_joint - 0.004) / 0.014, 0.0, 1.0);
    return (0.74 + 0.26 * noise_at(column, row)) * (0.62 + 0.38 * joint);
}

/// Boards that lie on each other.
double planks(double u_m, double v_m) {
    constexpr int rows = 8;
    constexpr double board_m = grain_tile_m / rows;
    const int row = static_cast<int>(v_m / board_m) % rows;
    const double in_v = v_m - row * board_m;
    const double joint = std::clamp((std::min(in_v, board_m - in_v) - 0.003) / 0.010, 0.0, 1.0);
    // Fibres run along the boards; their period is the tile's.
    const double fibre = std::sin((u_m / grain_tile_m + 0.13 * noise_at(row, 3)) * 6.2831853 * 2.0 +
                                  in_v * 90.0 + 5.0 * noise_at(row, 9));
    return (0.76 + 0.18 * noise_at(row, 5) + 0.05 * fibre) * (0.45 + 0.55 * joint);
}

/// Folded sheet metal, upright.
double ribs(double u_m, double v_m) {
    constexpr double fold_m = grain_tile_m / 10.0;
    const double in_fold = std::fmod(u_m, fold_m) / fold_m;
    const double slope = std::clamp(std::abs(in_fold - 0.5) * 6.0 - 1.0, 0.0, 1.0);
    const double rust =
        noise_at(static_cast<std::int32_t>(u_m * 16.0), static_cast<std::int32_t>(v_m * 16.0));
    return 0.68 + 0.26 * slope + 0.06 * rust;
}

}  // namespace

std::shared_ptr<const scene::Image> make_ground_image(const Level& level, double border_m) {
    constexpr std::uint32_t side = 2048;
    auto image = std::make_shared<scene::Image>();
    image->name = "ground";
    image->width = side;
    image->height = side;
    image->rgba.reserve(std::size_t{4} * side * side);
    const glm::dvec2 whole = level.size_m + 2.0 * border_m;
    const glm::dvec3 floor(level.mood.floor);
    const glm::dvec3 earth(level.mood.outside);
    for (std::uint32_t row = 0; row < side; ++row) {
        for (std::uint32_t column = 0; column < side; ++column) {
            const glm::dvec2 at =
                (glm::dvec2(column + 0.5, row + 0.5) / double{side} - 0.5) * whole;
            const glm::dvec2 beyond = glm::abs(at) - level.size_m * 0.5;
            const double ragged = 0.5 * smooth_noise(at.x * 1.7, at.y * 1.7) - 0.25;
            const double paved =
                std::clamp(0.5 - (std::max(beyond.x, beyond.y) + ragged) / 0.3, 0.0, 1.0);
            const double worn = 0.80 + 0.4 * smooth_noise(at.x * 0.35 + 11.0, at.y * 0.35);
            const double soil =
                0.70 + 0.24 * smooth_noise(at.x * 1.3, at.y * 1.3) +
                0.20 * smooth_noise(at.x * 4.1, at.y * 4.1 + 5.0) +
                0.16 * noise_at(static_cast<std::int32_t>(column), static_cast<std::int32_t>(row));
            const glm::dvec3 color =
                glm::mix(earth * soil, floor * flagstones(at.x, at.y), paved) * worn;
            image->rgba.push_back(srgb(color.r));
            image->rgba.push_back(srgb(color.g));
            image->rgba.push_back(srgb(color.b));
            image->rgba.push_back(255);
        }
    }
    return image;
}

std::shared_ptr<const scene::Image> make_grain_image(Grain grain) {
    constexpr std::uint32_t side = 512;
    auto image = std::make_shared<scene::Image>();
    image->name = "grain";
    image->width = side;
    image->height = side;
    image->rgba.reserve(std::size_t{4} * side * side);
    for (std::uint32_t row = 0; row < side; ++row) {
        for (std::uint32_t column = 0; column < side; ++column) {
            const double u_m = (column + 0.5) / side * grain_tile_m;
            const double v_m = (row + 0.5) / side * grain_tile_m;
            double bright = 1.0;
            switch (grain) {
                case Grain::Bricks: bright = bricks(u_m, v_m); break;
                case Grain::Planks: bright = planks(u_m, v_m); break;
                case Grain::Ribs: bright = ribs(u_m, v_m); break;
            }
            const double speck =
                noise_at(static_cast<std::int32_t>(column), static_cast<std::int32_t>(row));
            const std::uint8_t level = srgb(bright * (0.95 + 0.05 * speck));
            for (int channel = 0; channel < 3; ++channel) image->rgba.push_back(level);
            image->rgba.push_back(255);
        }
    }
    return image;
}

void lay_tiles(scene::Mesh& mesh) {
    mesh.texcoords.clear();
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const glm::vec3 p = mesh.positions[v] / static_cast<float>(grain_tile_m);
        const glm::vec3 n = glm::abs(mesh.normals[v]);
        if (n.y > n.x && n.y > n.z) {
            mesh.texcoords.emplace_back(p.x, p.z);
        } else if (n.x > n.z) {
            mesh.texcoords.emplace_back(p.z, -p.y);
        } else {
            mesh.texcoords.emplace_back(p.x, -p.y);
        }
    }
}

}  // namespace gnomon::game
