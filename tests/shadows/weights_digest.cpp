// SPDX-License-Identifier: MIT
//
// Prints what classify_faces makes of a fixed corpus, in a few lines, and which kind of build it
// is. The build makes this program several times, with the sources of gnomon::shadows compiled by
// different flags; their weights must not differ (compare_digests.cmake). The corpus is made of
// integers and bits alone, so that no flag can change it.
#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <span>
#include <vector>

#include <gnomon/shadows/facing.hpp>

namespace {

using namespace gnomon::shadows;

// S. Vigna's splitmix64.
struct Bits {
    std::uint64_t state = 1977;
    std::uint64_t next() {
        std::uint64_t z = (state += 0x9E3779B97F4A7C15ULL);
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
        return z ^ (z >> 31U);
    }
    std::uint32_t below(std::size_t n) { return static_cast<std::uint32_t>(next() % n); }
};

// Any sign and mantissa, an exponent of `low` to `low + spread`.
float float_of_bits(Bits& bits, std::uint32_t low, std::uint32_t spread) {
    const std::uint32_t exponent = low + 127U + bits.below(spread + 1U);
    return std::bit_cast<float>((exponent << 23U) |
                                (static_cast<std::uint32_t>(bits.next()) & 0x807FFFFFU));
}

glm::vec3 place(Bits& bits, unsigned kind) {
    glm::vec3 p(0.0F);
    for (int i = 0; i < 3; ++i) {
        switch (kind) {
            case 0: p[i] = static_cast<float>(static_cast<int>(bits.below(7)) - 3); break;
            case 1: p[i] = float_of_bits(bits, 0, 1); break;
            case 2: p[i] = float_of_bits(bits, static_cast<std::uint32_t>(-20), 40); break;
            case 3: {  // a few steps of the last place about one point far away
                const float far = i == 1 ? 100000.0F : 70000.0F;
                p[i] = std::bit_cast<float>(std::bit_cast<std::uint32_t>(far) + bits.below(64));
                break;
            }
            default: p[i] = std::bit_cast<float>(bits.below(5));  // the smallest floats there are
        }
    }
    return p;
}

// One step of the last place along one axis.
glm::vec3 beside(Bits& bits, glm::vec3 p) {
    float& x = p[static_cast<int>(bits.below(3))];
    x = std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) ^ 1U);
    return p;
}

struct Digest {
    std::uint64_t hash = 0xCBF29CE484222325ULL;
    void add(std::uint64_t value) {  // FNV-1a, a byte at a time
        for (int i = 0; i < 8; ++i, value >>= 8U)
            hash = (hash ^ (value & 0xFFU)) * 0x100000001B3ULL;
    }
};

// Whether the compiler fuses a product with what it is added to: what is left of a * b beside its
// own rounding is then not zero.
bool fuses() {
    const volatile double a = 1.0 + 0x1p-30;
    const volatile double b = 1.0 - 0x1p-30;
    const volatile double rounded = a * b;
    const double x = a;
    const double y = b;
    return x * y - rounded != 0.0;
}

}  // namespace

int main() {
    Bits bits;
    Digest weights;
    Digest margins;
    std::uint64_t faces = 0;
    std::uint64_t in_double = 0;
    std::uint64_t exact = 0;
    Facing facing;
    for (unsigned i = 0; i < 3000; ++i) {
        const unsigned kind = i % 5;
        std::vector<glm::vec3> positions;
        for (int v = 0; v < 14; ++v) positions.push_back(place(bits, kind));
        // Slivers: corners that are all but equal to others.
        for (int v = 0; v < 4; ++v) positions.push_back(beside(bits, positions[bits.below(14)]));
        std::vector<std::uint32_t> indices;
        for (int v = 0; v < 3 * 40; ++v) indices.push_back(bits.below(positions.size()));
        const auto mesh =
            ShadowMesh::build({.positions = std::as_bytes(std::span(positions)).data(),
                               .vertex_count = positions.size(),
                               .indices = indices});
        if (!mesh) {
            std::fprintf(stderr, "%s\n", mesh.error().message.c_str());
            return 1;
        }
        const std::array<glm::vec3, 4> places{positions[bits.below(14)],
                                              beside(bits, positions[bits.below(14)]),
                                              place(bits, kind), place(bits, 1)};
        for (const glm::vec3& light : places) {
            for (const float w : {0.0F, 1.0F}) {
                for (const FacingFilter filter : {FacingFilter::Simd, FacingFilter::Scalar}) {
                    classify_faces(**mesh, {glm::vec4(light, w)}, facing, NearCaps::Facing, filter);
                    for (const std::int8_t weight : facing.weights) {
                        weights.add(static_cast<std::uint8_t>(weight));
                    }
                    margins.add(std::bit_cast<std::uint64_t>(facing.margin));
                    faces += facing.stats.faces;
                    in_double += facing.stats.double_tests;
                    exact += facing.stats.exact_tests;
                }
            }
        }
    }
    std::printf("fuses %s\n", fuses() ? "yes" : "no");
    std::printf("weights %016llx\n", static_cast<unsigned long long>(weights.hash));
    std::printf("margins %016llx\n", static_cast<unsigned long long>(margins.hash));
    std::printf("faces %llu, in double %llu, exactly %llu\n",
                static_cast<unsigned long long>(faces), static_cast<unsigned long long>(in_double),
                static_cast<unsigned long long>(exact));
    return 0;
}
