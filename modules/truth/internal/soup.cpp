// SPDX-License-Identifier: MIT
#include "internal/soup.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <fmt/format.h>

namespace gnomon::truth::internal {

namespace {

struct Posed {
    std::vector<glm::dvec3> positions;  // relative to the origin
    double reach_m = 0.0;
};

double largest(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// Embree's boxes end near 1.8e18. The comparison is false for what is not a number, too.
constexpr double farthest_m = 1e18;
bool within_reach(const glm::dvec3& v) {
    return std::abs(v.x) <= farthest_m && std::abs(v.y) <= farthest_m &&
           std::abs(v.z) <= farthest_m;
}

Result<Posed> pose(const Instance& instance, std::size_t number, const glm::dvec3& origin) {
    Posed posed;
    posed.positions.reserve(instance.positions.size());
    const glm::dmat3 linear(instance.world_from_local);
    // The two large numbers cancel first, before anything small is added.
    const glm::dvec3 translation = glm::dvec3(instance.world_from_local[3]) - origin;
    for (std::size_t i = 0; i < instance.positions.size(); ++i) {
        const glm::dvec3 offset = linear * glm::dvec3(instance.positions[i]);
        posed.positions.push_back(offset + translation);
        if (!within_reach(posed.positions.back())) {
            return fail(
                ErrorCode::InvalidInput,
                fmt::format(
                    "Instance {} has position {} at ({}, {}, {}), which its pose takes to ({}, "
                    "{}, {}), farther than {} m from the origin.",
                    number, i, instance.positions[i].x, instance.positions[i].y,
                    instance.positions[i].z, posed.positions.back().x, posed.positions.back().y,
                    posed.positions.back().z, farthest_m));
        }
        posed.reach_m = std::max(posed.reach_m, glm::length(offset));
    }
    return posed;
}

/// Numbers positions: the same number for those that agree within a cell.
class Welder {
public:
    explicit Welder(double cell) : per_metre_(cell > 0.0 ? 1.0 / cell : 0.0) {}

    std::uint32_t number_of(const glm::dvec3& p) {
        const glm::dvec3 scaled = p * per_metre_;
        const Cell cell{std::llround(scaled.x), std::llround(scaled.y), std::llround(scaled.z)};
        return numbers_.try_emplace(cell, static_cast<std::uint32_t>(numbers_.size()))
            .first->second;
    }

private:
    using Cell = std::array<long long, 3>;
    struct Hash {
        std::size_t operator()(const Cell& cell) const {
            std::uint64_t h = 0;
            for (const long long c : cell) {
                h = (h ^ static_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15U;
                h ^= h >> 29U;
            }
            return h;
        }
    };
    double per_metre_;
    std::unordered_map<Cell, std::uint32_t, Hash> numbers_;
};

Status add_triangles(const Instance& instance, std::size_t number,
                     const std::vector<glm::dvec3>& positions, Welder& welder, Soup& soup) {
    if (instance.indices.size() % 3 != 0) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("Instance {} has {} indices, which is not a multiple of three.",
                                number, instance.indices.size()));
    }
    std::vector<std::uint32_t> ids;
    ids.reserve(positions.size());
    for (const glm::dvec3& p : positions) ids.push_back(welder.number_of(p));
    for (std::size_t i = 0; i < instance.indices.size(); i += 3) {
        Triangle triangle;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t index = instance.indices[i + k];
            if (index >= positions.size()) {
                return fail(
                    ErrorCode::InvalidInput,
                    fmt::format("Instance {} has index {} at place {}, but only {} positions.",
                                number, index, i + k, positions.size()));
            }
            triangle.corners[k] = positions[index];
            triangle.corner_ids[k] = ids[index];
        }
        const glm::dvec3 a = triangle.corners[1] - triangle.corners[0];
        const glm::dvec3 b = triangle.corners[2] - triangle.corners[0];
        const glm::dvec3 normal = glm::cross(a, b);
        const double area = glm::length(normal);
        // Thinner than this its plane is rounding alone, and no pixel could tell it from a line.
        if (!(area > 1e-12 * std::max(glm::dot(a, a), glm::dot(b, b)))) continue;
        triangle.normal = normal / area;
        triangle.instance = static_cast<std::uint32_t>(number);
        triangle.casts = instance.casts;
        triangle.receives = instance.receives;
        soup.triangles.push_back(triangle);
    }
    return {};
}

}  // namespace

Result<Soup> make_soup(std::span<const Instance> instances, const glm::dvec3& origin) {
    Soup soup;
    std::vector<Posed> all;
    double magnitude = largest(origin);
    for (std::size_t i = 0; i < instances.size(); ++i) {
        Result<Posed> posed = pose(instances[i], i, origin);
        if (!posed) return forward_error(posed);
        for (const glm::dvec3& p : posed->positions) magnitude = std::max(magnitude, largest(p));
        if (!posed->positions.empty()) {
            magnitude = std::max(magnitude, largest(glm::dvec3(instances[i].world_from_local[3])));
        }
        soup.reach_m.push_back(posed->reach_m);
        soup.farthest_reach_m = std::max(soup.farthest_reach_m, posed->reach_m);
        all.push_back(std::move(*posed));
    }
    constexpr double ulps_64 = 0x1p-47;
    soup.noise_m = ulps_64 * magnitude;
    Welder welder(soup.noise_m);
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const Status added = add_triangles(instances[i], i, all[i].positions, welder, soup);
        if (!added) return forward_error(added);
    }
    return soup;
}

}  // namespace gnomon::truth::internal
