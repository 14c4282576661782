// SPDX-License-Identifier: MIT
#include "internal/side_detection.hpp"

#include "internal/mesh_topology.hpp"
#include "internal/processor.hpp"

namespace gnomon::shadows::internal {

namespace {

// All faces, which cast alike.
void cast_all(const FaceSides& sides, const Casting& casting, std::size_t faces,
              CastingFaces& out) {
    const std::size_t words = (faces + 63) / 64;
    out.plus.resize(words);
    out.minus.resize(words);
    const std::uint64_t plus = casting[2] != 0 ? ~std::uint64_t{0} : 0;
    const std::uint64_t minus = casting[0] != 0 ? ~std::uint64_t{0} : 0;
    const auto facing = sides.facing();
    const auto edge_on = sides.edge_on();
    for (std::size_t w = 0; w < words; ++w) {
        out.plus[w] = facing[w] & plus;
        out.minus[w] = ~(facing[w] | edge_on[w]) & minus;
    }
    if (faces % 64 != 0) out.minus.back() &= (std::uint64_t{1} << (faces % 64)) - 1;
}

// Faces [begin, end), which all cast by `casting`; their bits are 0 as yet.
void cast(const FaceSides& sides, const Casting& casting, std::size_t begin, std::size_t end,
          CastingFaces& out) {
    while (begin < end) {
        const std::size_t word = begin / 64;
        const std::size_t next = std::min(end, 64 * (word + 1));
        const std::uint64_t mask =
            (~std::uint64_t{0} << (begin % 64)) & (~std::uint64_t{0} >> (64 * (word + 1) - next));
        const std::uint64_t facing = sides.facing()[word];
        if (casting[2] != 0) out.plus[word] |= facing & mask;
        if (casting[0] != 0) out.minus[word] |= ~(facing | sides.edge_on()[word]) & mask;
        begin = next;
    }
}

}  // namespace

void find_casting(const ShadowMesh& mesh, const Sides& sides, CastingFaces& casting) {
    const std::size_t faces = mesh.faces().size();
    const Castings& castings = sides.castings;
    if (castings.uniform && faces > 0) {
        cast_all(sides.faces, castings.of_component[0], faces, casting);
        return;
    }
    casting.plus.assign((faces + 63) / 64, 0);
    casting.minus.assign((faces + 63) / 64, 0);
    const auto components = mesh.face_components();
    for (const FaceGroup& group : topology_of(mesh).groups) {
        const std::size_t end = std::size_t{group.first} + group.count;
        for (std::size_t begin = group.first; begin < end;) {
            const Casting& kind = castings.of_component[components[begin]];
            std::size_t next = group.one_component ? end : begin + 1;
            while (next < end && castings.of_component[components[next]] == kind) ++next;
            cast(sides.faces, kind, begin, next, casting);
            begin = next;
        }
    }
}

std::size_t differing_edges_plain(std::span<const FaceUse> uses, std::size_t first,
                                  std::size_t count, std::span<const std::uint64_t> facing,
                                  std::uint32_t* out) {
    const auto bit = [&](const FaceUse& use) { return facing[use.face / 64] >> (use.face % 64); };
    std::size_t found = 0;
    for (std::size_t edge = first; edge < first + count; ++edge) {
        out[found] = static_cast<std::uint32_t>(edge);
        found += (bit(uses[2 * edge]) ^ bit(uses[2 * edge + 1])) & 1U;
    }
    return found;
}

#ifdef GNOMON_HAS_AVX2

namespace {

// By eight bits: the places of those that are set, one in each byte.
constexpr std::array<std::uint64_t, 256> places_of_bits() {
    std::array<std::uint64_t, 256> places{};
    for (std::size_t bits = 0; bits < places.size(); ++bits) {
        unsigned count = 0;
        for (std::uint64_t place = 0; place < 8; ++place) {
            if (((bits >> place) & 1U) != 0) places[bits] |= place << (8 * count++);
        }
    }
    return places;
}
constexpr auto bit_places = places_of_bits();

// Eight edges at a time; what is left over, one by one.
[[gnu::target("avx2,popcnt")]] std::size_t differing_edges_avx2(
    std::span<const FaceUse> uses, std::size_t first, std::size_t count,
    std::span<const std::uint64_t> facing, std::uint32_t* out) {
    static_assert(sizeof(FaceUse) == 4);
    const auto* words = reinterpret_cast<const int*>(facing.data());
    const __m256i face_bits = _mm256_set1_epi32(0x7FFFFFFF);
    const __m256i within = _mm256_set1_epi32(31);
    std::size_t found = 0;
    std::size_t i = 0;
    for (; i + 8 <= count; i += 8) {
        const auto* at = reinterpret_cast<const __m256i*>(uses.data() + 2 * (first + i));
        const __m256 a = _mm256_castsi256_ps(_mm256_loadu_si256(at));
        const __m256 b = _mm256_castsi256_ps(_mm256_loadu_si256(at + 1));
        // The forward and the backward uses of edges 0 1 4 5 2 3 6 7.
        const __m256i forward = _mm256_castps_si256(_mm256_shuffle_ps(a, b, 0x88));
        const __m256i backward =
            _mm256_and_si256(_mm256_castps_si256(_mm256_shuffle_ps(a, b, 0xDD)), face_bits);
        const __m256i f = _mm256_i32gather_epi32(words, _mm256_srli_epi32(forward, 5), 4);
        const __m256i g = _mm256_i32gather_epi32(words, _mm256_srli_epi32(backward, 5), 4);
        const __m256i differing =
            _mm256_xor_si256(_mm256_srlv_epi32(f, _mm256_and_si256(forward, within)),
                             _mm256_srlv_epi32(g, _mm256_and_si256(backward, within)));
        const auto bits = static_cast<unsigned>(
            _mm256_movemask_ps(_mm256_castsi256_ps(_mm256_slli_epi32(differing, 31))));
        const unsigned in_order = (bits & 0xC3U) | ((bits & 0x0CU) << 2U) | ((bits & 0x30U) >> 2U);
        const __m256i places =
            _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(static_cast<long long>(bit_places[in_order])));
        _mm256_storeu_si256(
            reinterpret_cast<__m256i*>(out + found),
            _mm256_add_epi32(places, _mm256_set1_epi32(static_cast<int>(first + i))));
        found += static_cast<std::size_t>(_mm_popcnt_u32(in_order));
    }
    if (i < count) {
        found += differing_edges_plain(uses, first + i, count - i, facing, out + found);
    }
    return found;
}

}  // namespace

std::size_t differing_edges(std::span<const FaceUse> uses, std::size_t first, std::size_t count,
                            std::span<const std::uint64_t> facing, std::uint32_t* out) {
    static const bool avx2 = has_avx2();
    return (avx2 ? differing_edges_avx2 : differing_edges_plain)(uses, first, count, facing, out);
}

#else

std::size_t differing_edges(std::span<const FaceUse> uses, std::size_t first, std::size_t count,
                            std::span<const std::uint64_t> facing, std::uint32_t* out) {
    return differing_edges_plain(uses, first, count, facing, out);
}

#endif

}  // namespace gnomon::shadows::internal
