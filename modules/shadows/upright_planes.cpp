// SPDX-License-Identifier: MIT
#include "internal/upright_planes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "internal/processor.hpp"

namespace gnomon::shadows::internal {

namespace {

constexpr int bins = 128;
// Where an edge enters and where it leaves again, one bin further.
using Changes = std::array<std::int32_t, bins + 1>;

// From a vertex to its bin: ((p - light) . right) / ((p - light) . forward), in the plane of two
// axes, for a point light; p . right for a direction.
struct Sheaf {
    int i = 0;
    int j = 1;
    bool directional = false;
    float light_i = 0.0F, light_j = 0.0F;
    float right_i = 1.0F, right_j = 0.0F;
    float forward_i = 0.0F, forward_j = 0.0F;
    float low = 0.0F;
    float scale = 1.0F;
    float room = 0.0F;  // in bins: more than everything rounds
};

// right = (-forward_j, forward_i), to the bit: the planes are those of just these numbers. So what
// rounds is what comes after. Each difference does by half an ulp, a dot product by three of
// |p - light| |forward|, which is at most 1 / narrow of what is divided by.
std::optional<Sheaf> sheaf_of(const ShadowMesh& mesh, LightLocal light) {
    constexpr double ulp = 0x1p-23;
    constexpr double narrow = 0.15;
    const glm::dvec3 l(light.position);
    const glm::dvec3 box_low(mesh.bounds_min());
    const glm::dvec3 box_high(mesh.bounds_max());
    Sheaf sheaf;
    sheaf.directional = light.is_directional();
    const glm::dvec3 way = sheaf.directional ? l : 0.5 * (box_low + box_high) - l;
    // The axis that is least along the way is left out.
    const glm::dvec3 a = glm::abs(way);
    const int out = a.x <= a.y && a.x <= a.z ? 0 : a.y <= a.z ? 1 : 2;
    sheaf.i = out == 0 ? 1 : 0;
    sheaf.j = out == 2 ? 1 : 2;
    const double length = std::hypot(way[sheaf.i], way[sheaf.j]);
    if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
    sheaf.forward_i = static_cast<float>(way[sheaf.i] / length);
    sheaf.forward_j = static_cast<float>(way[sheaf.j] / length);
    sheaf.right_i = -sheaf.forward_j;
    sheaf.right_j = sheaf.forward_i;
    if (!sheaf.directional) {
        sheaf.light_i = light.position[sheaf.i];
        sheaf.light_j = light.position[sheaf.j];
    }

    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    double farthest = 0.0;
    for (const double x : {box_low[sheaf.i], box_high[sheaf.i]}) {
        for (const double y : {box_low[sheaf.j], box_high[sheaf.j]}) {
            const double di = x - static_cast<double>(sheaf.light_i);
            const double dj = y - static_cast<double>(sheaf.light_j);
            double at =
                di * static_cast<double>(sheaf.right_i) + dj * static_cast<double>(sheaf.right_j);
            farthest = std::max(farthest, std::hypot(di, dj));
            if (!sheaf.directional) {
                const double depth = di * static_cast<double>(sheaf.forward_i) +
                                     dj * static_cast<double>(sheaf.forward_j);
                if (!(depth > narrow * std::hypot(di, dj))) return std::nullopt;
                at /= depth;
            }
            low = std::min(low, at);
            high = std::max(high, at);
        }
    }
    const double largest = std::max(std::abs(low), std::abs(high));
    const double error = sheaf.directional ? 8.0 * ulp * farthest : ulp * (32.0 + 64.0 * largest);
    const double scale = bins / (high - low);
    // Less than a quarter of a bin, and nothing that leaves what floats are good for. Also refuses
    // what is not a number.
    if (!(error * scale < 0.25) || !(farthest < 1e18) || !(farthest > 1e-18)) return std::nullopt;
    sheaf.low = static_cast<float>(low);
    sheaf.scale = static_cast<float>(scale);
    sheaf.room = static_cast<float>(error * scale + 0.01);
    return sheaf;
}

float place(const Sheaf& sheaf, const glm::vec3& p) {
    const float di = p[sheaf.i] - sheaf.light_i;
    const float dj = p[sheaf.j] - sheaf.light_j;
    const float right = di * sheaf.right_i + dj * sheaf.right_j;
    const float at =
        sheaf.directional ? right : right / (di * sheaf.forward_i + dj * sheaf.forward_j);
    return (at - sheaf.low) * sheaf.scale;
}

void add_edges(const Sheaf& sheaf, std::span<const glm::vec3> positions, const SideIndices& sides,
               std::size_t first, Changes& changes) {
    constexpr auto last = static_cast<float>(bins - 1);
    for (std::size_t s = first; s < sides.indices.size(); s += sides.stride) {
        const float a = place(sheaf, positions[sides.indices[s] / 2]);
        const float b = place(sheaf, positions[sides.indices[s + 1] / 2]);
        const float from = std::clamp(std::min(a, b) - sheaf.room, 0.0F, last);
        const float to = std::clamp(std::max(a, b) + sheaf.room, 0.0F, last);
        ++changes[static_cast<std::size_t>(from)];
        --changes[static_cast<std::size_t>(to) + 1];
    }
}

std::uint32_t most_layers_of(const Changes& changes) {
    std::int32_t most = 0;
    std::int32_t now = 0;
    for (const std::int32_t change : changes) most = std::max(most, now += change);
    return static_cast<std::uint32_t>(most / 2);
}

#ifdef GNOMON_HAS_AVX2

// Eight sides at a time, by the operations of place(). Returns where those begin that are left.
[[gnu::target("avx2")]] std::size_t add_edges_avx2(const Sheaf& sheaf,
                                                   std::span<const glm::vec3> positions,
                                                   const SideIndices& sides, Changes& changes) {
    static_assert(sizeof(glm::vec3) == 12);
    const auto stride = static_cast<int>(sides.stride);
    const __m256i steps =
        _mm256_mullo_epi32(_mm256_set1_epi32(stride), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
    const auto* at_i = reinterpret_cast<const float*>(positions.data()) + sheaf.i;
    const auto* at_j = reinterpret_cast<const float*>(positions.data()) + sheaf.j;
    const __m256 light_i = _mm256_set1_ps(sheaf.light_i);
    const __m256 light_j = _mm256_set1_ps(sheaf.light_j);
    const __m256 right_i = _mm256_set1_ps(sheaf.right_i);
    const __m256 right_j = _mm256_set1_ps(sheaf.right_j);
    const __m256 forward_i = _mm256_set1_ps(sheaf.forward_i);
    const __m256 forward_j = _mm256_set1_ps(sheaf.forward_j);
    const __m256 low = _mm256_set1_ps(sheaf.low);
    const __m256 scale = _mm256_set1_ps(sheaf.scale);
    const __m256 room = _mm256_set1_ps(sheaf.room);
    const __m256 last = _mm256_set1_ps(static_cast<float>(bins - 1));
    alignas(32) std::array<std::int32_t, 8> from;
    alignas(32) std::array<std::int32_t, 8> to;
    std::size_t s = 0;
    for (; s + 7 * sides.stride + 2 <= sides.indices.size(); s += 8 * sides.stride) {
        const auto* indices = reinterpret_cast<const int*>(sides.indices.data() + s);
        const auto places_of = [&](const int* vertices) __attribute__((target("avx2"))) {
            const __m256i vertex = _mm256_srli_epi32(_mm256_i32gather_epi32(vertices, steps, 4), 1);
            const __m256i offset = _mm256_add_epi32(vertex, _mm256_slli_epi32(vertex, 1));
            const __m256 di = _mm256_sub_ps(_mm256_i32gather_ps(at_i, offset, 4), light_i);
            const __m256 dj = _mm256_sub_ps(_mm256_i32gather_ps(at_j, offset, 4), light_j);
            __m256 at = _mm256_add_ps(_mm256_mul_ps(di, right_i), _mm256_mul_ps(dj, right_j));
            if (!sheaf.directional) {
                at = _mm256_div_ps(
                    at, _mm256_add_ps(_mm256_mul_ps(di, forward_i), _mm256_mul_ps(dj, forward_j)));
            }
            return _mm256_mul_ps(_mm256_sub_ps(at, low), scale);
        };
        const __m256 a = places_of(indices);
        const __m256 b = places_of(indices + 1);
        const auto bins_of = [&](__m256 x) __attribute__((target("avx2"))) {
            return _mm256_cvttps_epi32(_mm256_min_ps(_mm256_max_ps(x, _mm256_setzero_ps()), last));
        };
        _mm256_store_si256(reinterpret_cast<__m256i*>(from.data()),
                           bins_of(_mm256_sub_ps(_mm256_min_ps(a, b), room)));
        _mm256_store_si256(reinterpret_cast<__m256i*>(to.data()),
                           bins_of(_mm256_add_ps(_mm256_max_ps(a, b), room)));
        for (std::size_t i = 0; i < 8; ++i) {
            ++changes[static_cast<std::size_t>(from[i])];
            --changes[static_cast<std::size_t>(to[i]) + 1];
        }
    }
    return s;
}

#endif

}  // namespace

std::optional<std::uint32_t> bound_by_upright_planes_plain(const ShadowMesh& mesh, LightLocal light,
                                                           const SideIndices& sides) {
    const std::optional<Sheaf> sheaf = sheaf_of(mesh, light);
    if (!sheaf) return std::nullopt;
    Changes changes{};
    add_edges(*sheaf, mesh.positions(), sides, 0, changes);
    return most_layers_of(changes);
}

std::optional<std::uint32_t> bound_by_upright_planes(const ShadowMesh& mesh, LightLocal light,
                                                     const SideIndices& sides) {
#ifdef GNOMON_HAS_AVX2
    // Offsets of positions are 32 bits wide.
    static const bool avx2 = has_avx2();
    if (avx2 && mesh.positions().size() < std::numeric_limits<std::int32_t>::max() / 3) {
        const std::optional<Sheaf> sheaf = sheaf_of(mesh, light);
        if (!sheaf) return std::nullopt;
        Changes changes{};
        const std::size_t rest = add_edges_avx2(*sheaf, mesh.positions(), sides, changes);
        add_edges(*sheaf, mesh.positions(), sides, rest, changes);
        return most_layers_of(changes);
    }
#endif
    return bound_by_upright_planes_plain(mesh, light, sides);
}

}  // namespace gnomon::shadows::internal
