// SPDX-License-Identifier: MIT
#include "internal/face_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <vector>

#include "internal/face_plane.hpp"
#include "internal/processor.hpp"

namespace gnomon::shadows::internal {

namespace {

constexpr float float_infinity = std::numeric_limits<float>::infinity();
constexpr float largest_finite = std::numeric_limits<float>::max();

float filter_from(std::size_t first, const FacePlanes& planes, const FilterLight& light,
                  std::span<std::int8_t> sides, float nearest) {
    for (std::size_t f = first; f < sides.size(); ++f) {
        const float value = planes.normal_x[f] * light.towards.x +
                            planes.normal_y[f] * light.towards.y +
                            planes.normal_z[f] * light.towards.z + planes.offset[f] * light.w;
        const float certain = std::abs(value) - planes.error[f] * light.reach;
        // Neither not-a-number nor infinity (an overflow) may pass.
        const bool decided = certain > 0.0F && certain <= largest_finite;
        sides[f] = static_cast<std::int8_t>(decided ? (value > 0.0F ? 1 : -1) : 0);
        if (decided && certain < nearest) nearest = certain;
    }
    return nearest;
}

}  // namespace

FilterLight filter_light(const FacePlanes& planes, LightLocal light) {
    FilterLight result;
    glm::dvec3 towards(light.position);
    if (!light.is_directional()) towards -= glm::dvec3(planes.origin);
    result.towards = glm::vec3(towards);
    result.w = light.position.w;
    // 2^-100, times the smallest error there is, is above all that can underflow.
    result.reach =
        round_up(std::abs(towards.x) + std::abs(towards.y) + std::abs(towards.z) +
                 static_cast<double>(planes.radius) * static_cast<double>(result.w) + 0x1p-100);
    return result;
}

float filter_scalar(const FacePlanes& planes, const FilterLight& light,
                    std::span<std::int8_t> sides) {
    return filter_from(0, planes, light, sides, float_infinity);
}

// GCC 12 and clang have vectors as types of the language; their shuffles below count bytes from the
// low end.
#if defined(__GNUC__) && __has_builtin(__builtin_shufflevector) && \
    __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__

namespace {

// Four lanes, which every 64-bit processor has without asking.
using Floats = float __attribute__((vector_size(16)));
using Words = std::int32_t __attribute__((vector_size(16)));
using Halves = std::int16_t __attribute__((vector_size(16)));
using Bytes = std::int8_t __attribute__((vector_size(16)));
constexpr std::size_t lanes = 4;
constexpr std::size_t step = 16;  // faces whose sides fill one vector of bytes

Floats load(const std::vector<float>& values, std::size_t at) {
    Floats result;
    std::memcpy(&result, values.data() + at, sizeof result);
    return result;
}

// The low byte of each word, in order.
Bytes narrow(Words a, Words b, Words c, Words d) {
    const Halves ab = __builtin_shufflevector(
        reinterpret_cast<Halves>(a), reinterpret_cast<Halves>(b), 0, 2, 4, 6, 8, 10, 12, 14);
    const Halves cd = __builtin_shufflevector(
        reinterpret_cast<Halves>(c), reinterpret_cast<Halves>(d), 0, 2, 4, 6, 8, 10, 12, 14);
    return __builtin_shufflevector(reinterpret_cast<Bytes>(ab), reinterpret_cast<Bytes>(cd), 0, 2,
                                   4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
}

}  // namespace

float filter_simd(const FacePlanes& planes, const FilterLight& light,
                  std::span<std::int8_t> sides) {
    const Floats unknown = Floats{} + float_infinity;
    Floats nearest = unknown;
    std::size_t face = 0;
    for (; face + step <= sides.size(); face += step) {
        Words side[step / lanes];
        for (std::size_t i = 0; i < step / lanes; ++i) {
            const std::size_t f = face + i * lanes;
            const Floats value = load(planes.normal_x, f) * light.towards.x +
                                 load(planes.normal_y, f) * light.towards.y +
                                 load(planes.normal_z, f) * light.towards.z +
                                 load(planes.offset, f) * light.w;
            const Words bits = reinterpret_cast<Words>(value);
            const Floats magnitude = reinterpret_cast<Floats>(bits & 0x7FFFFFFF);
            const Floats certain = magnitude - load(planes.error, f) * light.reach;
            const Words decided = (certain > 0.0F) & (certain <= largest_finite);
            side[i] = decided & ((bits >> 31) | 1);  // the sign, spread out: -1 or 1
            const Floats distance = decided ? certain : unknown;
            nearest = distance < nearest ? distance : nearest;
        }
        const Bytes bytes = narrow(side[0], side[1], side[2], side[3]);
        std::memcpy(sides.data() + face, &bytes, sizeof bytes);
    }
    float result = float_infinity;
    for (std::size_t i = 0; i < lanes; ++i) result = std::min(result, nearest[i]);
    return filter_from(face, planes, light, sides, result);
}

#else

float filter_simd(const FacePlanes& planes, const FilterLight& light,
                  std::span<std::int8_t> sides) {
    return filter_scalar(planes, light, sides);
}

#endif

void filter_blocks_plain(const FacePlanes& planes, const FilterLight& light,
                         std::size_t first_block, std::span<FilteredBlock> out) {
    constexpr std::size_t size = 16;
    for (std::size_t b = 0; b < out.size(); ++b) {
        const std::size_t first = (first_block + b) * size;
        std::array<float, size> values;
        std::array<float, size> certain;
        for (std::size_t i = 0; i < size; ++i) {
            const std::size_t f = first + i;
            values[i] = planes.normal_x[f] * light.towards.x +
                        planes.normal_y[f] * light.towards.y +
                        planes.normal_z[f] * light.towards.z + planes.offset[f] * light.w;
            certain[i] = std::abs(values[i]) - planes.error[f] * light.reach;
        }
        FilteredBlock block{0, 0, float_infinity};
        for (std::size_t i = 0; i < size; ++i) {
            const bool decided = certain[i] > 0.0F && certain[i] <= largest_finite;
            const bool facing = decided && values[i] > 0.0F;
            block.decided = static_cast<std::uint16_t>(block.decided | (decided ? 1U << i : 0U));
            block.facing = static_cast<std::uint16_t>(block.facing | (facing ? 1U << i : 0U));
            if (decided && certain[i] < block.nearest) block.nearest = certain[i];
        }
        out[b] = block;
    }
}

#ifdef GNOMON_HAS_AVX2

namespace {

[[gnu::target("avx2")]] void filter_blocks_avx2(const FacePlanes& planes, const FilterLight& light,
                                                std::size_t first_block,
                                                std::span<FilteredBlock> out) {
    const __m256 x = _mm256_set1_ps(light.towards.x);
    const __m256 y = _mm256_set1_ps(light.towards.y);
    const __m256 z = _mm256_set1_ps(light.towards.z);
    const __m256 w = _mm256_set1_ps(light.w);
    const __m256 reach = _mm256_set1_ps(light.reach);
    const __m256 sign = _mm256_set1_ps(-0.0F);
    const __m256 zero = _mm256_setzero_ps();
    const __m256 most = _mm256_set1_ps(largest_finite);
    const __m256 unknown = _mm256_set1_ps(float_infinity);
    const float* nx = planes.normal_x.data() + first_block * 16;
    const float* ny = planes.normal_y.data() + first_block * 16;
    const float* nz = planes.normal_z.data() + first_block * 16;
    const float* d = planes.offset.data() + first_block * 16;
    const float* e = planes.error.data() + first_block * 16;
    for (FilteredBlock& block : out) {
        __m256 nearest = unknown;
        unsigned decided_bits = 0;
        unsigned facing_bits = 0;
        for (unsigned half = 0; half < 16; half += 8) {
            const __m256 value = _mm256_add_ps(
                _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(_mm256_loadu_ps(nx + half), x),
                                            _mm256_mul_ps(_mm256_loadu_ps(ny + half), y)),
                              _mm256_mul_ps(_mm256_loadu_ps(nz + half), z)),
                _mm256_mul_ps(_mm256_loadu_ps(d + half), w));
            const __m256 certain = _mm256_sub_ps(_mm256_andnot_ps(sign, value),
                                                 _mm256_mul_ps(_mm256_loadu_ps(e + half), reach));
            const __m256 decided = _mm256_and_ps(_mm256_cmp_ps(certain, zero, _CMP_GT_OQ),
                                                 _mm256_cmp_ps(certain, most, _CMP_LE_OQ));
            const auto bits = static_cast<unsigned>(_mm256_movemask_ps(decided));
            decided_bits |= bits << half;
            facing_bits |= (bits & ~static_cast<unsigned>(_mm256_movemask_ps(value))) << half;
            nearest = _mm256_min_ps(nearest, _mm256_blendv_ps(unknown, certain, decided));
        }
        __m128 least =
            _mm_min_ps(_mm256_castps256_ps128(nearest), _mm256_extractf128_ps(nearest, 1));
        least = _mm_min_ps(least, _mm_movehl_ps(least, least));
        least = _mm_min_ss(least, _mm_shuffle_ps(least, least, 1));
        block = {static_cast<std::uint16_t>(decided_bits), static_cast<std::uint16_t>(facing_bits),
                 _mm_cvtss_f32(least)};
        nx += 16;
        ny += 16;
        nz += 16;
        d += 16;
        e += 16;
    }
}

}  // namespace

void filter_blocks(const FacePlanes& planes, const FilterLight& light, std::size_t first_block,
                   std::span<FilteredBlock> out) {
    static const bool avx2 = has_avx2();
    (avx2 ? filter_blocks_avx2 : filter_blocks_plain)(planes, light, first_block, out);
}

#else

void filter_blocks(const FacePlanes& planes, const FilterLight& light, std::size_t first_block,
                   std::span<FilteredBlock> out) {
    filter_blocks_plain(planes, light, first_block, out);
}

#endif

}  // namespace gnomon::shadows::internal
