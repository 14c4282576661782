// SPDX-License-Identifier: MIT
//
// Visible-non-visible: an edge is in the silhouette where one of its polygons sees the light and
// the other does not. Triangles of one plane that share an edge are one polygon, whose inner edges
// are never looked at.
//
// Source: H. Kolivand, M. S. Sunar and others, "Real-Time Volume Shadow using Visible-Non Visible
// Algorithm", Journal of Computer Science 7 (2011), section "Silhouette detection". There every
// edge is held against every face; here each edge knows its two. "Of one plane" is decided exactly,
// or not at all: with a tolerance, faces of one polygon could see the light differently, and the
// volume would have a hole. Edges of other than two opposite faces are summed up.
#include <cmath>

#include <gnomon/shadows/orientation.hpp>

#include "internal/face_filter.hpp"
#include "internal/facing_first.hpp"
#include "internal/paired_edges.hpp"

namespace gnomon::shadows::internal {

namespace {

// Of one plane and one orientation, exactly: any light has both faces on the same side. Single
// precision comes first; of coplanar faces it knows for certain whether they are turned the same
// way. It says nothing about slivers, which stay polygons of their own.
bool are_one_polygon(const ShadowMesh& mesh, const PairedEdge& edge) {
    const FacePlanes& planes = mesh.planes();
    const auto has_plane = [&](std::uint32_t face) {
        return planes.error[face] > 0.0F && std::isfinite(planes.error[face]);
    };
    if (!has_plane(edge.forth) || !has_plane(edge.back)) return false;
    const auto normal = [&](std::uint32_t face) {
        return glm::vec3(planes.normal_x[face], planes.normal_y[face], planes.normal_z[face]);
    };
    if (glm::dot(normal(edge.forth), normal(edge.back)) < 0.5F) return false;

    glm::vec3 opposite{0.0F};
    for (const std::uint32_t v : mesh.faces()[edge.back]) {
        if (v != edge.low && v != edge.high) opposite = mesh.positions()[v];
    }
    const LightLocal point{glm::vec4(opposite, 1.0F)};
    const FilterLight filtered = filter_light(planes, point);
    const float distance =
        glm::dot(normal(edge.forth), filtered.towards) + planes.offset[edge.forth];
    if (std::abs(distance) > planes.error[edge.forth] * filtered.reach) return false;
    const auto [a, b, c] = mesh.faces()[edge.forth];
    const auto positions = mesh.positions();
    return exact_facing(positions[a], positions[b], positions[c], point) == 0;
}

class VisibleNonVisible final : public FacingFirst {
protected:
    void prepare(const ShadowMesh& mesh) override {
        edges_ = pair_edges(mesh);
        std::erase_if(edges_.pairs, [&](const PairedEdge& e) { return are_one_polygon(mesh, e); });
        edges_.pairs.shrink_to_fit();
    }

    void find_edges(const ShadowMesh& mesh, LightLocal /*light*/,
                    std::span<const std::int8_t> weights, std::vector<SilhouetteEdge>& silhouette,
                    DetectionStats& stats) override {
        for (const PairedEdge& edge : edges_.pairs) append_edge(edge, weights, silhouette);
        append_edges(mesh, edges_.others, weights, silhouette);
        stats.edges_tested = edges_.pairs.size() + edges_.others.size();
        stats.bytes_touched += edges_.pairs.size() * (sizeof(PairedEdge) + 2) +
                               edges_.others.size() * (sizeof(Edge) + sizeof(FaceUse) + 5);
    }

    [[nodiscard]] std::size_t own_bytes() const override { return sizeof *this + edges_.bytes(); }

private:
    PairedEdges edges_;
};

}  // namespace

std::unique_ptr<SilhouetteDetector> vnv_detector() { return std::make_unique<VisibleNonVisible>(); }

}  // namespace gnomon::shadows::internal
