// SPDX-License-Identifier: MIT
//
// Brute force as fast as memory allows: all planes in vectors, 20 bytes a triangle, into one bit a
// face; then all edges, 12 bytes a triangle, by the bits of their two faces.
#include <algorithm>

#include "internal/finite.hpp"
#include "internal/side_detection.hpp"
#include "internal/strategies.hpp"

namespace gnomon::shadows::internal {

namespace {

class Simd final : public SilhouetteDetector {
public:
    const Detection& detect(const ShadowMesh& mesh, LightLocal light, NearCaps near_caps) override {
        if (!is_finite(light.position)) return nothing_of(mesh, found_);
        found_.stats = {};
        find_castings(mesh, light, near_caps, sides_.castings, found_.solid_averted);
        sides_.faces.resize(mesh.faces().size());
        const BlockClassifier classifier(mesh, light, found_.stats);
        found_.margin = std::min(classifier.classify_all(sides_.faces), sides_.castings.margin);
        find_casting(mesh, sides_, found_.casting);

        found_.silhouette.clear();
        const auto edges = mesh.edges();
        const auto add = [&](std::size_t edge, std::int32_t count) {
            found_.silhouette.push_back(silhouette_edge(edges[edge], count));
        };
        RegularEdges regular(mesh, sides_, add);
        for (std::size_t first = 0; first < mesh.regular_edges(); first += regular.most) {
            regular.add(first, std::min(regular.most, mesh.regular_edges() - first));
        }
        std::uint64_t tested = regular.finish();
        visit_others(mesh, sides_, tested, add);
        found_.stats.faces_tested = mesh.faces().size();
        found_.stats.edges_tested = tested;
        found_.stats.bytes_touched =
            mesh.faces().size() * bytes_per_face_test + tested * bytes_per_edge_test;
        return found_;
    }

    [[nodiscard]] std::size_t memory_bytes() const override {
        return sizeof *this + sides_.memory_bytes() + memory_of(found_);
    }

private:
    Sides sides_;
    Detection found_;
};

}  // namespace

std::unique_ptr<SilhouetteDetector> simd_detector() { return std::make_unique<Simd>(); }

}  // namespace gnomon::shadows::internal
