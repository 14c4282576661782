// SPDX-License-Identifier: MIT
//
// Two hierarchies of boxes in dual space: one of the faces' points, which settles most faces in
// large pieces, and one of the edges' segments, which finds those that the light's hyperplane may
// cross. After A. Hertzmann and D. Zorin, "Illustrating Smooth Surfaces" (2000), section 3.2; on
// planes of faces, so that the answer is exact.
#include <algorithm>

#include "internal/finite.hpp"
#include "internal/side_detection.hpp"
#include "internal/strategies.hpp"

namespace gnomon::shadows::internal {

namespace {

class DualBvh final : public SilhouetteDetector {
public:
    const Detection& detect(const ShadowMesh& mesh, LightLocal light, NearCaps near_caps) override {
        if (!is_finite(light.position)) return nothing_of(mesh, found_);
        found_.stats = {};
        find_castings(mesh, light, near_caps, sides_.castings, found_.solid_averted);
        sides_.faces.resize(mesh.faces().size());
        const BlockClassifier classifier(mesh, light, found_.stats);
        found_.margin = sides_.castings.margin;
        search_faces(mesh, classifier, sides_.faces, crossed_, found_.stats, no_limit,
                     [&](std::size_t, std::size_t, double margin) {
                         found_.margin = std::min(found_.margin, margin);
                     });
        find_casting(mesh, sides_, found_.casting);
        found_.silhouette.clear();
        const auto edges = mesh.edges();
        search_edges(mesh, sides_, classifier.light(), crossed_, found_.stats, no_limit,
                     [&](std::size_t edge, std::int32_t count) {
                         found_.silhouette.push_back(silhouette_edge(edges[edge], count));
                     });
        return found_;
    }

    [[nodiscard]] std::size_t memory_bytes() const override {
        return sizeof *this + sides_.memory_bytes() + memory_of(found_) +
               crossed_.capacity() * sizeof(std::uint32_t);
    }

private:
    Sides sides_;
    std::vector<std::uint32_t> crossed_;
    Detection found_;
};

}  // namespace

std::unique_ptr<SilhouetteDetector> dual_bvh_detector() { return std::make_unique<DualBvh>(); }

}  // namespace gnomon::shadows::internal
