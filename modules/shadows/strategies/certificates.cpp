// SPDX-License-Identifier: MIT
//
// Exact temporal coherence. A block of faces that was decided with the margin m when the light had
// come the way p is not looked at again before the way p + m: no face of it can have changed, by
// the triangle inequality. What is due is decided anew, and each face that flips changes three
// edges. A step in which much is due is a search like dual_bvh's, whose settled boxes are
// certificates as well, so that no frame costs much more than that. The way grows only by steps
// that something is due in: a light that trembles about a place costs nothing.
//
// A kinetic data structure (J. Basch, L. Guibas and J. Hershberger, "Data Structures for Mobile
// Data", 1999), whose certificates hold for any motion instead of a known one; near to M. Pop, C.
// Duncan, G. Barequet, M. Goodrich, W. Huang and S. Kumar, "Efficient Perspective-Accurate
// Silhouette Computation and Applications" (2001).
#include "internal/certificates.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "internal/finite.hpp"
#include "internal/strategies.hpp"
#include "internal/work.hpp"

namespace gnomon::shadows::internal {

namespace {

// Of some of the values: so small that about `count` of all are below.
double quantile(std::span<const double> values, std::size_t count) {
    constexpr std::size_t most = 256;
    std::array<double, most> sample;
    const std::size_t size = std::min(most, values.size());
    if (size == 0) return 0.0;
    for (std::size_t i = 0; i < size; ++i) sample[i] = values[i * values.size() / size];
    const std::size_t rank = std::min(size - 1, count * size / values.size());
    const auto at = sample.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(sample.begin(), at, sample.begin() + static_cast<std::ptrdiff_t>(size));
    return *at;
}

}  // namespace

const Detection& Certificates::detect(const ShadowMesh& mesh, LightLocal light,
                                      NearCaps near_caps) {
    if (!is_finite(light.position)) {
        mesh_ = 0;
        return nothing_of(mesh, found_);
    }
    if (mesh_ != mesh.id() || near_caps_ != near_caps ||
        light_.is_directional() != light.is_directional()) {
        search(mesh, light, near_caps);
        return found_;
    }
    switch (look(light)) {
        case Due::Nothing: break;
        case Due::Some: renew(mesh); break;
        case Due::Much: search(mesh, light, near_caps); break;
    }
    return found_;
}

Certificates::Due Certificates::find_due(LightLocal light, double way) {
    const bool far = !(way - way_ < far_);
    way_ = way;
    light_ = light;
    if (far) return Due::Much;
    blocks_.clear();
    deadlines_.visit_due(way_, [&](std::size_t block) {
        blocks_.push_back(static_cast<std::uint32_t>(block));
        return blocks_.size() <= most_due_;
    });
    return blocks_.size() <= most_due_ ? Due::Some : Due::Much;
}

double Certificates::margin() const {
    return std::max(0.0, sum_down(std::min(deadlines_.next(), castings_deadline_), -way_));
}

std::size_t Certificates::memory_bytes() const {
    return sizeof *this + sides_.memory_bytes() + memory_of(found_) + silhouette_.memory_bytes() +
           deadlines_.memory_bytes() +
           (flipped_.capacity() + blocks_.capacity()) * sizeof(std::uint32_t);
}

void Certificates::search(const ShadowMesh& mesh, LightLocal light, NearCaps near_caps) {
    if (mesh_ != mesh.id()) {
        deadlines_.resize((mesh.faces().size() + block_size - 1) / block_size);
        sides_.faces.resize(mesh.faces().size());
    }
    mesh_ = mesh.id();
    near_caps_ = near_caps;
    light_ = light;
    way_ = 0.0;
    found_.stats = {};
    found_.changed = true;
    find_castings(mesh, light, near_caps, sides_.castings, found_.solid_averted);
    castings_deadline_ = sides_.castings.margin;
    const BlockClassifier classifier(mesh, light, found_.stats);
    const std::span<double> deadlines = deadlines_.values();
    const std::size_t nodes =
        *search_faces(mesh, classifier, sides_.faces, blocks_, found_.stats, no_limit,
                      [&](std::size_t first, std::size_t count, double margin) {
                          std::ranges::fill(deadlines.subspan(first, count), margin);
                      });
    deadlines_.rebuild();
    jump_work_ = work::search_of_faces(nodes, blocks_.size());
    find_casting(mesh, sides_, found_.casting);
    jump_work_ += find_whole_silhouette(mesh, classifier.light());
    jump_work_ += work::of_detection(deadlines.size(), found_.silhouette.size());
    work_ = jump_work_ + work::new_certificate * static_cast<double>(deadlines.size());
    most_due_ = static_cast<std::size_t>(work_ / work::renewed_block);
    far_ = quantile(deadlines, most_due_);
    found_.margin = margin();
}

double Certificates::find_whole_silhouette(const ShadowMesh& mesh, const FilterLight& light) {
    const auto edges = mesh.edges();
    silhouette_.clear(edges.size());
    const std::size_t nodes =
        *search_edges(mesh, sides_, light, blocks_, found_.stats, no_limit,
                      [&](std::size_t edge, std::int32_t count) {
                          silhouette_.add(edge, silhouette_edge(edges[edge], count));
                      });
    return work::search_of_edges(nodes, blocks_.size());
}

bool Certificates::renew_castings(const ShadowMesh& mesh) {
    const std::vector<Casting> before = sides_.castings.of_component;
    const std::vector<std::uint8_t> averted_before = found_.solid_averted;
    find_castings(mesh, light_, near_caps_, sides_.castings, found_.solid_averted);
    castings_deadline_ = sum_down(way_, sides_.castings.margin);
    return sides_.castings.of_component != before || found_.solid_averted != averted_before;
}

void Certificates::renew(const ShadowMesh& mesh) {
    flipped_.clear();
    const BlockClassifier classifier(mesh, light_, found_.stats);
    for (const std::uint32_t block : blocks_) classifier.prefetch_block(block);
    FaceSides& sides = sides_.faces;
    for (const std::uint32_t block : blocks_) {
        const BlockClassifier::Block decided = classifier.classify(block);
        const std::uint32_t differing = (decided.facing ^ sides.facing_block(block)) |
                                        (decided.edge_on ^ sides.edge_on_block(block));
        for (std::uint32_t rest = differing; rest != 0; rest &= rest - 1) {
            flipped_.push_back(static_cast<std::uint32_t>(
                block * block_size + static_cast<std::size_t>(std::countr_zero(rest))));
        }
        if (differing != 0) sides.set_block(block, decided.facing, decided.edge_on);
        deadlines_.values()[block] = sum_down(way_, decided.margin);
    }
    deadlines_.renew(blocks_);
    work_ = work::call + work::renewed_block * static_cast<double>(blocks_.size());
    found_.stats.faces_tested = blocks_.size() * block_size;
    found_.stats.bytes_touched = blocks_.size() * block_size * bytes_per_face_test;
    const bool recast = castings_deadline_ < way_ && renew_castings(mesh);
    found_.margin = margin();
    if (!recast && flipped_.empty()) return;

    found_.changed = true;
    if (recast || flipped_.size() > mesh.faces().size() / 16 + 16) {
        find_casting(mesh, sides_, found_.casting);
        work_ += find_whole_silhouette(mesh, classifier.light());
        work_ += work::of_detection(deadlines_.values().size(), found_.silhouette.size());
        return;
    }
    const auto edges = mesh.edges();
    for (const std::uint32_t face : flipped_) {
        const int weight = sides_.weight(mesh, face);
        const std::uint64_t bit = std::uint64_t{1} << (face % 64);
        std::uint64_t& plus = found_.casting.plus[face / 64];
        std::uint64_t& minus = found_.casting.minus[face / 64];
        plus = weight > 0 ? plus | bit : plus & ~bit;
        minus = weight < 0 ? minus | bit : minus & ~bit;
        for (const std::uint32_t edge : mesh.face_edges()[face]) {
            if (edge == ShadowMesh::no_edge) continue;
            silhouette_.set(edge, silhouette_edge(edges[edge], sides_.count(mesh, edge)));
        }
    }
    found_.stats.edges_tested = 3 * flipped_.size();
    work_ += work::renewed_edge * static_cast<double>(found_.stats.edges_tested);
    found_.stats.bytes_touched += found_.stats.edges_tested * (sizeof(Edge) + bytes_per_edge_test);
}

std::unique_ptr<SilhouetteDetector> certificates_detector() {
    return std::make_unique<Certificates>();
}

}  // namespace gnomon::shadows::internal
