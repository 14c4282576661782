// SPDX-License-Identifier: MIT
#include "internal/jump.hpp"

#include "internal/finite.hpp"
#include "internal/strategies.hpp"

namespace gnomon::shadows::internal {

namespace {

// Of the blocks: where the hyperplane crosses more, finding them and looking at them here and there
// costs more than looking at all in turn (the ratio of the work:: above).
std::size_t most_worth_searching(std::size_t blocks) { return 3 * blocks / 10; }

std::size_t blocks_of(std::size_t items) { return (items + block_size - 1) / block_size; }

}  // namespace

Detection& Jump::detect(const ShadowMesh& mesh, LightLocal light, NearCaps near_caps,
                        bool may_search) {
    searched_ = false;
    work_ = 0.0;
    if (!is_finite(light.position)) {
        nothing_of(mesh, found_);
        return found_;
    }
    found_.stats = {};
    found_.changed = true;
    find_castings(mesh, light, near_caps, sides_.castings, found_.solid_averted);
    sides_.faces.resize(mesh.faces().size());
    const BlockClassifier classifier(mesh, light, found_.stats);
    found_.margin = std::min(sides_.castings.margin, decide_faces(mesh, classifier, may_search));
    find_casting(mesh, sides_, found_.casting);
    find_silhouette(mesh, classifier.light(), may_search);
    work_ += work::of_detection(blocks_of(mesh.faces().size()), found_.silhouette.size());
    return found_;
}

double Jump::decide_faces(const ShadowMesh& mesh, const BlockClassifier& classifier,
                          bool may_search) {
    const std::size_t blocks = blocks_of(mesh.faces().size());
    if (may_search && faces_.is_due()) {
        double nearest = std::numeric_limits<double>::infinity();
        const auto nodes = search_faces(
            mesh, classifier, sides_.faces, crossed_, found_.stats, most_worth_searching(blocks),
            [&](std::size_t, std::size_t, double margin) { nearest = std::min(nearest, margin); });
        if (nodes) {
            faces_.paid();
            work_ += work::search_of_faces(*nodes, crossed_.size());
            return nearest;
        }
        faces_.failed();
    }
    work_ += work::face_block_in_turn * static_cast<double>(blocks);
    return test_all_faces(mesh, classifier, sides_.faces, found_.stats);
}

void Jump::find_silhouette(const ShadowMesh& mesh, const FilterLight& light, bool may_search) {
    const auto edges = mesh.edges();
    const auto add = [&](std::size_t edge, std::int32_t count) {
        found_.silhouette.push_back(silhouette_edge(edges[edge], count));
    };
    found_.silhouette.clear();
    const std::size_t blocks = blocks_of(mesh.regular_edges());
    if (may_search && edges_.is_due()) {
        const auto nodes = search_edges(mesh, sides_, light, crossed_, found_.stats,
                                        most_worth_searching(blocks), add);
        searched_ = nodes.has_value();
        if (nodes) {
            edges_.paid();
            work_ += work::search_of_edges(*nodes, crossed_.size());
            return;
        }
        edges_.failed();
    }
    work_ += work::edge_block_in_turn * static_cast<double>(blocks);
    test_all_edges(mesh, sides_, found_.stats, add);
}

}  // namespace gnomon::shadows::internal
