// SPDX-License-Identifier: MIT
#include "internal/side_detection.hpp"

#include "internal/mesh_topology.hpp"
#include "internal/processor.hpp"

namespace gnomon::shadows::internal {

namespace {

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
    casting.plus.assign((faces + 63) / 64, 0);
    casting.minus.assign((faces + 63) / 64, 0);
    const Castings& castings = sides.castings;
    if (castings.uniform) {
        if (faces > 0) cast(sides.faces, castings.of_component[0], 0, faces, casting);
        return;
    }
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

std::uint64_t differing_edges_plain(std::span<const FaceUse> uses, std::size_t first,
                                    std::size_t count, std::span<const std::uint64_t> facing) {
    const auto bit = [&](const FaceUse& use) { return facing[use.face / 64] >> (use.face % 64); };
    const FaceUse* use = uses.data() + 2 * first;
    std::uint64_t result = 0;
    for (std::size_t i = 0; i < count; ++i, use += 2) {
        result |= ((bit(use[0]) ^ bit(use[1])) & 1U) << i;
    }
    return result;
}

#ifdef GNOMON_HAS_AVX2

namespace {

// Eight edges at a time; what is left over, face by face.
[[gnu::target("avx2")]] std::uint64_t differing_edges_avx2(std::span<const FaceUse> uses,
                                                           std::size_t first, std::size_t count,
                                                           std::span<const std::uint64_t> facing) {
    static_assert(sizeof(FaceUse) == 4);
    const auto* words = reinterpret_cast<const int*>(facing.data());
    const __m256i face_bits = _mm256_set1_epi32(0x7FFFFFFF);
    const __m256i within = _mm256_set1_epi32(31);
    std::uint64_t result = 0;
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
        result |= std::uint64_t{in_order} << i;
    }
    if (i < count) result |= differing_edges_plain(uses, first + i, count - i, facing) << i;
    return result;
}

}  // namespace

std::uint64_t differing_edges(std::span<const FaceUse> uses, std::size_t first, std::size_t count,
                              std::span<const std::uint64_t> facing) {
    static const bool avx2 = has_avx2();
    return (avx2 ? differing_edges_avx2 : differing_edges_plain)(uses, first, count, facing);
}

#else

std::uint64_t differing_edges(std::span<const FaceUse> uses, std::size_t first, std::size_t count,
                              std::span<const std::uint64_t> facing) {
    return differing_edges_plain(uses, first, count, facing);
}

#endif

}  // namespace gnomon::shadows::internal
