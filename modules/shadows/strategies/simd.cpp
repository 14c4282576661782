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
        found_.margin = std::min(test_all_faces(mesh, classifier, sides_.faces, found_.stats),
                                 sides_.castings.margin);
        find_casting(mesh, sides_, found_.casting);
        found_.silhouette.clear();
        const auto edges = mesh.edges();
        test_all_edges(mesh, sides_, found_.stats, [&](std::size_t edge, std::int32_t count) {
            found_.silhouette.push_back(silhouette_edge(edges[edge], count));
        });
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
