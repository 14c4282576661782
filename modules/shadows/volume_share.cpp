// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <numbers>

#include <gnomon/core/expects.hpp>
#include <gnomon/shadows/shadow_query.hpp>

namespace gnomon::shadows {

namespace {

// The finalizer of SplitMix64 (S. Vigna's public-domain generator), for a place within a cell that
// is the same on every machine.
std::uint64_t mixed(std::uint64_t x) {
    x += 0x9E3779B97F4A7C15ULL;
    x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    x = (x ^ (x >> 27U)) * 0x94D049BB133111EBULL;
    return x ^ (x >> 31U);
}

// A point in each of n^3 cells of the unit cube, x fastest.
std::vector<glm::dvec3> stratified(std::uint32_t n) {
    std::vector<glm::dvec3> points;
    points.reserve(std::size_t{n} * n * n);
    for (std::uint32_t z = 0; z < n; ++z) {
        for (std::uint32_t y = 0; y < n; ++y) {
            for (std::uint32_t x = 0; x < n; ++x) {
                std::uint64_t bits = mixed(points.size());
                glm::dvec3 within;
                for (int i = 0; i < 3; ++i) {
                    within[i] = static_cast<double>(bits & 0x1FFFFFU) * 0x1p-21;
                    bits >>= 21U;
                }
                points.push_back((glm::dvec3(x, y, z) + within) / static_cast<double>(n));
            }
        }
    }
    return points;
}

// Whether the cells' third axis closes on itself.
enum class LastAxis : bool { Open, Round };

VolumeShare shares(std::span<const Exposure> cells, std::size_t n, LastAxis last_axis) {
    const auto at = [&](std::size_t x, std::size_t y, std::size_t z) {
        return cells[(z * n + y) * n + x];
    };
    std::size_t shadowed = 0;
    std::size_t out_of_range = 0;
    std::size_t uncertain = 0;
    for (std::size_t z = 0; z < n; ++z) {
        for (std::size_t y = 0; y < n; ++y) {
            for (std::size_t x = 0; x < n; ++x) {
                const Exposure here = at(x, y, z);
                shadowed += here == Exposure::Shadowed ? 1U : 0U;
                out_of_range += here == Exposure::OutOfRange ? 1U : 0U;
                const bool round = last_axis == LastAxis::Round;
                const bool differs =
                    (x > 0 && at(x - 1, y, z) != here) || (x + 1 < n && at(x + 1, y, z) != here) ||
                    (y > 0 && at(x, y - 1, z) != here) || (y + 1 < n && at(x, y + 1, z) != here) ||
                    ((z > 0 || round) && at(x, y, (z + n - 1) % n) != here) ||
                    ((z + 1 < n || round) && at(x, y, (z + 1) % n) != here);
                uncertain += differs ? 1U : 0U;
            }
        }
    }
    const auto count = static_cast<double>(cells.size());
    return {static_cast<double>(shadowed) / count, static_cast<double>(out_of_range) / count,
            static_cast<double>(uncertain) / count, static_cast<std::uint32_t>(cells.size())};
}

}  // namespace

VolumeShare ShadowQueries::share_of(const Light& light, const Sphere& sphere,
                                    std::uint32_t cells_per_side,
                                    const QueryOptions& options) const {
    GNOMON_EXPECTS(cells_per_side >= 1 && cells_per_side <= 256);
    std::vector<glm::dvec3> points = stratified(cells_per_side);
    for (glm::dvec3& p : points) {
        // Shells, zones and sectors of equal volume.
        const double radius = sphere.radius_m * std::cbrt(p.x);
        const double height = 2.0 * p.y - 1.0;
        const double angle = 2.0 * std::numbers::pi * p.z;
        const double out = std::sqrt(1.0 - height * height);
        p = sphere.center_world +
            radius * glm::dvec3(out * std::cos(angle), height, out * std::sin(angle));
    }
    std::vector<Exposure> exposures(points.size());
    at(light, points, exposures, options);
    return shares(exposures, cells_per_side, LastAxis::Round);
}

VolumeShare ShadowQueries::share_of(const Light& light, const OrientedBounds& box,
                                    std::uint32_t cells_per_side,
                                    const QueryOptions& options) const {
    GNOMON_EXPECTS(cells_per_side >= 1 && cells_per_side <= 256);
    std::vector<glm::dvec3> points = stratified(cells_per_side);
    for (glm::dvec3& p : points) {
        p = glm::dvec3(box.world_from_local * glm::dvec4(box.min + p * (box.max - box.min), 1.0));
    }
    std::vector<Exposure> exposures(points.size());
    at(light, points, exposures, options);
    return shares(exposures, cells_per_side, LastAxis::Open);
}

}  // namespace gnomon::shadows
