// SPDX-License-Identifier: MIT
#include "internal/face_filter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <vector>

#include "internal/face_plane.hpp"

namespace gnomon::shadows::internal {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float largest = std::numeric_limits<float>::max();

float filter_from(std::size_t first, const FacePlanes& planes, const FilterLight& light,
                  std::span<std::int8_t> sides, float nearest) {
    for (std::size_t f = first; f < sides.size(); ++f) {
        const float value = planes.normal_x[f] * light.towards.x +
                            planes.normal_y[f] * light.towards.y +
                            planes.normal_z[f] * light.towards.z + planes.offset[f] * light.w;
        const float certain = std::abs(value) - planes.error[f] * light.reach;
        // Neither not-a-number nor infinity (an overflow) may pass.
        const bool decided = certain > 0.0F && certain <= largest;
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
    return filter_from(0, planes, light, sides, infinity);
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
    const Floats unknown = Floats{} + infinity;
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
            const Words decided = (certain > 0.0F) & (certain <= largest);
            side[i] = decided & ((bits >> 31) | 1);  // the sign, spread out: -1 or 1
            const Floats distance = decided ? certain : unknown;
            nearest = distance < nearest ? distance : nearest;
        }
        const Bytes bytes = narrow(side[0], side[1], side[2], side[3]);
        std::memcpy(sides.data() + face, &bytes, sizeof bytes);
    }
    float result = infinity;
    for (std::size_t i = 0; i < lanes; ++i) result = std::min(result, nearest[i]);
    return filter_from(face, planes, light, sides, result);
}

#else

float filter_simd(const FacePlanes& planes, const FilterLight& light,
                  std::span<std::int8_t> sides) {
    return filter_scalar(planes, light, sides);
}

#endif

}  // namespace gnomon::shadows::internal
