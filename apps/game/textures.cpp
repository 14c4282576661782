// SPDX-License-Identifier: MIT
#include "textures.hpp"

#include <algorithm>
#include <array>
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

std::int32_t floor_of(double x) {
    const auto towards_zero = static_cast<std::int32_t>(x);
    return x < towards_zero ? towards_zero - 1 : towards_zero;
}

/// Noise between whole numbers. Asked from pixel to pixel it mostly stays within one square.
class SmoothNoise {
public:
    double operator()(double x, double y) {
        const std::int32_t ix = floor_of(x);
        const std::int32_t iy = floor_of(y);
        if (ix != x_ || iy != y_ || !knows_) {
            corners_ = {noise_at(ix, iy), noise_at(ix + 1, iy), noise_at(ix, iy + 1),
                        noise_at(ix + 1, iy + 1)};
            x_ = ix;
            y_ = iy;
            knows_ = true;
        }
        const auto ease = [](double t) { return t * t * (3.0 - 2.0 * t); };
        const double u = ease(x - ix);
        return glm::mix(glm::mix(corners_[0], corners_[1], u),
                        glm::mix(corners_[2], corners_[3], u), ease(y - iy));
    }

private:
    std::int32_t x_ = 0;
    std::int32_t y_ = 0;
    bool knows_ = false;
    std::array<double, 4> corners_{};
};

/// From linear to sRGB bytes, for millions of pixels: from which value on a byte is reached is
/// looked for once.
class SrgbBytes {
public:
    SrgbBytes() {
        for (std::size_t byte = 1; byte < first_.size(); ++byte) {
            double below = first_[byte - 1];
            double reached = 1.0;
            for (double middle = 0.5 * (below + reached); middle > below && middle < reached;
                 middle = 0.5 * (below + reached)) {
                (encoded(middle) >= byte ? reached : below) = middle;
            }
            first_[byte] = reached;
        }
        for (std::size_t i = 0; i < guess_.size(); ++i) {
            const double from = static_cast<double>(i) / parts;
            const auto above = std::ranges::upper_bound(first_, from);
            guess_[i] = static_cast<std::uint8_t>(above - first_.begin() - 1);
        }
    }
    [[nodiscard]] std::uint8_t operator()(double linear) const {
        const double x = std::clamp(linear, 0.0, 1.0);
        const auto place = static_cast<std::size_t>(x * parts);
        std::size_t byte = guess_[std::min(place, guess_.size() - 1)];
        while (byte + 1 < first_.size() && x >= first_[byte + 1]) ++byte;
        return static_cast<std::uint8_t>(byte);
    }

private:
    static std::size_t encoded(double x) {
        const double value = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
        return static_cast<std::size_t>(std::lround(value * 255.0));
    }
    static constexpr int parts = 4096;
    std::array<double, 256> first_{};          // the least value of each byte
    std::array<std::uint8_t, parts> guess_{};  // the byte of the least value of each part of 0 to 1
};

/// Stones in rows, every other row shifted; how bright a place is, 1 on average. `grains` is asked
/// nine times a metre.
double flagstones(double x_m, double z_m, SmoothNoise& grains) {
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
    const double grain = 0.90 + 0.20 * grains(x_m * 9.0, z_m * 9.0);
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
    const SrgbBytes srgb;
    SmoothNoise border, wear, lumps, crumbs, grains;
    for (std::uint32_t row = 0; row < side; ++row) {
        for (std::uint32_t column = 0; column < side; ++column) {
            const glm::dvec2 at =
                (glm::dvec2(column + 0.5, row + 0.5) / double{side} - 0.5) * whole;
            const glm::dvec2 beyond = glm::abs(at) - level.size_m * 0.5;
            // Its border is ragged by a quarter of a metre; farther off there is one or the other.
            const double outside_m = std::max(beyond.x, beyond.y);
            double paved = outside_m < 0.0 ? 1.0 : 0.0;
            if (std::abs(outside_m) < 0.45) {
                const double ragged = 0.5 * border(at.x * 1.7, at.y * 1.7) - 0.25;
                paved = std::clamp(0.5 - (outside_m + ragged) / 0.3, 0.0, 1.0);
            }
            const double worn = 0.80 + 0.4 * wear(at.x * 0.35 + 11.0, at.y * 0.35);
            const auto soil = [&] {
                return 0.70 + 0.24 * lumps(at.x * 1.3, at.y * 1.3) +
                       0.20 * crumbs(at.x * 4.1, at.y * 4.1 + 5.0) +
                       0.16 * noise_at(static_cast<std::int32_t>(column),
                                       static_cast<std::int32_t>(row));
            };
            glm::dvec3 color(0.0);
            if (paved < 1.0) color += (1.0 - paved) * earth * soil();
            if (paved > 0.0) color += paved * floor * flagstones(at.x, at.y, grains);
            color *= worn;
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
    const SrgbBytes srgb;
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
