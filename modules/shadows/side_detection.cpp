// SPDX-License-Identifier: MIT
#include "internal/side_detection.hpp"

#include "internal/mesh_topology.hpp"

namespace gnomon::shadows::internal {

namespace {

class RunWriter {
public:
    explicit RunWriter(std::vector<FaceRun>& runs) : runs_(runs) { runs_.clear(); }

    void add(std::size_t first, std::size_t count, int weight) {
        if (weight == 0 || count == 0) return;
        if (!runs_.empty() && runs_.back().weight == weight &&
            std::size_t{runs_.back().first} + runs_.back().count == first) {
            runs_.back().count += static_cast<std::uint32_t>(count);
            return;
        }
        runs_.push_back(
            {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count), weight});
    }

private:
    std::vector<FaceRun>& runs_;
};

// Faces [begin, end), which all cast by `casting`.
void write_runs(const FaceSides& sides, const Casting& casting, std::size_t begin, std::size_t end,
                RunWriter& writer) {
    const auto facing = sides.facing();
    const auto edge_on = sides.edge_on();
    const auto clean = [&](std::size_t word, std::uint64_t value) {
        return facing[word] == value && edge_on[word] == 0;
    };
    while (begin < end) {
        const std::size_t word = begin / 64;
        const std::size_t bit = begin % 64;
        if (bit == 0 && begin + 64 <= end && (facing[word] + 1) <= 1 && edge_on[word] == 0) {
            // Words that are all alike.
            const std::uint64_t value = facing[word];
            std::size_t last = word + 1;
            while ((last + 1) * 64 <= end && clean(last, value)) ++last;
            writer.add(begin, last * 64 - begin, casting[value != 0 ? 2 : 0]);
            begin = last * 64;
            continue;
        }
        const std::size_t count = std::min(64 - bit, end - begin);
        const std::uint64_t f = facing[word] >> bit;
        const std::uint64_t e = edge_on[word] >> bit;
        for (std::size_t i = 0; i < count;) {
            const int side = ((f >> i) & 1U) != 0 ? 1 : (((e >> i) & 1U) != 0 ? 0 : -1);
            const std::uint64_t same = side == 1 ? f : (side == 0 ? e : ~(f | e));
            const std::size_t length =
                std::min(count - i, static_cast<std::size_t>(std::countr_one(same >> i)));
            writer.add(begin + i, length, casting[static_cast<std::size_t>(side + 1)]);
            i += length;
        }
        begin += count;
    }
}

}  // namespace

void casting_runs(const ShadowMesh& mesh, const Sides& sides, std::vector<FaceRun>& runs) {
    RunWriter writer(runs);
    const Castings& castings = sides.castings;
    if (castings.uniform) {
        if (!castings.of_component.empty()) {
            write_runs(sides.faces, castings.of_component[0], 0, mesh.faces().size(), writer);
        }
        return;
    }
    const auto components = mesh.face_components();
    for (const FaceGroup& group : topology_of(mesh).groups) {
        const std::size_t end = std::size_t{group.first} + group.count;
        for (std::size_t begin = group.first; begin < end;) {
            const Casting& casting = castings.of_component[components[begin]];
            std::size_t next = group.one_component ? end : begin + 1;
            while (next < end && castings.of_component[components[next]] == casting) ++next;
            write_runs(sides.faces, casting, begin, next, writer);
            begin = next;
        }
    }
}

std::uint64_t differing_edges(std::span<const FaceUse> uses, std::size_t first, std::size_t count,
                              std::span<const std::uint64_t> facing) {
    const auto bit = [&](const FaceUse& use) { return facing[use.face / 64] >> (use.face % 64); };
    const FaceUse* use = uses.data() + 2 * first;
    std::uint64_t result = 0;
    for (std::size_t i = 0; i < count; ++i, use += 2) {
        result |= ((bit(use[0]) ^ bit(use[1])) & 1U) << i;
    }
    return result;
}

}  // namespace gnomon::shadows::internal
