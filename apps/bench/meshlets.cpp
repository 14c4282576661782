// SPDX-License-Identifier: MIT
#include "meshlets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gnomon/shadows/facing.hpp>
#include <gnomon/shadows/orientation.hpp>
#include <gnomon/shadows/topology.hpp>

#include <meshoptimizer.h>

namespace gnomon::bench {

namespace {

using shadows::LightLocal;
using shadows::ShadowMesh;

constexpr std::size_t max_vertices = 64;
constexpr std::size_t max_triangles = 124;
constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

struct Cluster {
    glm::vec3 center{0.0F};
    float radius = 0.0F;
    glm::vec3 axis{0.0F};
    float cutoff = 1.0F;
    bool certain = true;  // no face whose normal single precision may have wrong
    std::uint32_t first_face = 0;
    std::uint32_t face_count = 0;
    std::uint32_t first_edge = 0;
    std::uint32_t edge_count = 0;
};

class Meshlets final : public shadows::SilhouetteDetector {
public:
    const shadows::Detection& detect(const ShadowMesh& mesh, LightLocal light,
                                     shadows::NearCaps near_caps) override {
        if (mesh.id() != prepared_for_) prepare(mesh);
        prepared_for_ = mesh.id();
        if (near_caps != shadows::NearCaps::Facing || !is_one_sided(mesh, light)) {
            return plain(mesh, light, near_caps);
        }
        weights_.resize(mesh.faces().size());
        found_.silhouette.clear();
        found_.stats = {};
        mixed_.clear();
        for (const Cluster& cluster : clusters_) {
            const int side = side_of(cluster, light);
            if (side == 0) {
                mixed_.push_back(&cluster);
                continue;
            }
            for (std::uint32_t i = 0; i < cluster.face_count; ++i) {
                weights_[faces_[cluster.first_face + i]] = side > 0 ? 1 : 0;
            }
        }
        for (const Cluster* cluster : mixed_) {
            for (std::uint32_t i = 0; i < cluster->face_count; ++i) {
                const std::uint32_t face = faces_[cluster->first_face + i];
                weights_[face] = faces_light(mesh, face, light) ? 1 : 0;
            }
            found_.stats.faces_tested += cluster->face_count;
        }
        for (const Cluster* cluster : mixed_)
            look_at(mesh, cluster->first_edge, cluster->edge_count);
        look_at(mesh, border_, static_cast<std::uint32_t>(edges_.size()) - border_);
        shadows::pack_weights(weights_, found_.casting);
        found_.solid_averted.assign(mesh.components().size(), 0);
        found_.margin = 0.0;
        found_.stats.bytes_touched = clusters_.size() * sizeof(Cluster) + weights_.size() * 6 +
                                     found_.stats.faces_tested * 5 * sizeof(float) +
                                     found_.stats.edges_tested * (sizeof(shadows::Edge) + 22);
        return found_;
    }

    [[nodiscard]] std::size_t memory_bytes() const override {
        return sizeof *this + clusters_.capacity() * sizeof(Cluster) +
               (faces_.capacity() + edges_.capacity()) * sizeof(std::uint32_t) +
               weights_.capacity() + 2 * found_.casting.plus.capacity() * sizeof(std::uint64_t) +
               found_.silhouette.capacity() * sizeof(shadows::SilhouetteEdge);
    }

private:
    void prepare(const ShadowMesh& mesh) {
        clusters_.clear();
        faces_.clear();
        edges_.clear();
        // Degenerate faces weigh nothing whatever the light; meshoptimizer leaves them out of
        // cones.
        std::vector<std::uint32_t> indices;
        std::vector<std::uint32_t> order;  // of the faces that are not
        for (std::uint32_t f = 0; f < mesh.faces().size(); ++f) {
            if (mesh.is_degenerate(f)) continue;
            indices.insert(indices.end(), mesh.faces()[f].begin(), mesh.faces()[f].end());
            order.push_back(f);
        }
        weights_.assign(mesh.faces().size(), 0);
        if (order.empty()) return;
        cluster_faces(mesh, indices, order);
        sort_edges(mesh);
    }

    // meshoptimizer does not say which face of a cluster was which of the mesh: found again by its
    // corners, of which it keeps the order.
    void cluster_faces(const ShadowMesh& mesh, const std::vector<std::uint32_t>& indices,
                       std::vector<std::uint32_t>& order) {
        const auto* positions = reinterpret_cast<const float*>(mesh.positions().data());
        const std::size_t vertices = mesh.positions().size();
        const std::size_t bound =
            meshopt_buildMeshletsBound(indices.size(), max_vertices, max_triangles);
        std::vector<meshopt_Meshlet> meshlets(bound);
        std::vector<unsigned int> of_vertices(bound * max_vertices);
        std::vector<unsigned char> of_triangles(bound * max_triangles * 3);
        meshlets.resize(meshopt_buildMeshlets(meshlets.data(), of_vertices.data(),
                                              of_triangles.data(), indices.data(), indices.size(),
                                              positions, vertices, sizeof(glm::vec3), max_vertices,
                                              max_triangles, 0.5F));
        using Corners = std::array<std::uint32_t, 3>;
        const auto canonical = [](Corners c) {
            std::ranges::rotate(c, std::ranges::min_element(c));
            return c;
        };
        const auto corners_of = [&](std::uint32_t f) { return canonical(mesh.faces()[f]); };
        std::ranges::sort(order, {}, corners_of);
        std::vector<bool> taken(order.size());
        for (const meshopt_Meshlet& meshlet : meshlets) {
            const unsigned char* triangles = &of_triangles[meshlet.triangle_offset];
            const meshopt_Bounds cone = meshopt_computeMeshletBounds(
                &of_vertices[meshlet.vertex_offset], triangles, meshlet.triangle_count, positions,
                vertices, sizeof(glm::vec3));
            Cluster cluster{.center = {cone.center[0], cone.center[1], cone.center[2]},
                            .radius = cone.radius,
                            .axis = {cone.cone_axis[0], cone.cone_axis[1], cone.cone_axis[2]},
                            .cutoff = cone.cone_cutoff,
                            .first_face = static_cast<std::uint32_t>(faces_.size()),
                            .face_count = meshlet.triangle_count};
            for (std::size_t t = 0; t < meshlet.triangle_count; ++t) {
                Corners corners{};
                for (std::size_t i = 0; i < 3; ++i) {
                    corners[i] = of_vertices[meshlet.vertex_offset + triangles[3 * t + i]];
                }
                auto at = static_cast<std::size_t>(
                    std::ranges::lower_bound(order, canonical(corners), {}, corners_of) -
                    order.begin());
                while (taken[at]) ++at;  // the same triangle several times
                taken[at] = true;
                faces_.push_back(order[at]);
                cluster.certain = cluster.certain && mesh.planes().error[order[at]] < 1e-5F;
            }
            clusters_.push_back(cluster);
        }
    }

    // Those within one cluster come first, cluster by cluster; then those between clusters.
    void sort_edges(const ShadowMesh& mesh) {
        std::vector<std::uint32_t> cluster_of(mesh.faces().size(), nowhere);
        for (std::uint32_t c = 0; c < clusters_.size(); ++c) {
            for (std::uint32_t i = 0; i < clusters_[c].face_count; ++i) {
                cluster_of[faces_[clusters_[c].first_face + i]] = c;
            }
        }
        struct Placed {
            std::uint32_t cluster;
            std::uint32_t edge;
        };
        std::vector<Placed> placed;
        for (std::uint32_t e = 0; e < mesh.edges().size(); ++e) {
            const auto uses = mesh.uses(mesh.edges()[e]);
            const std::uint32_t cluster = cluster_of[uses[0].face];
            const bool inner = shadows::edge_kind(uses) == shadows::EdgeKind::Regular &&
                               std::ranges::all_of(uses, [&](const auto& u) {
                                   return cluster_of[u.face] == cluster;
                               });
            placed.push_back({inner ? cluster : nowhere, e});
        }
        std::ranges::stable_sort(placed, {}, &Placed::cluster);
        border_ = static_cast<std::uint32_t>(placed.size());
        for (const auto& [cluster, edge] : placed) {
            const auto place = static_cast<std::uint32_t>(edges_.size());
            edges_.push_back(edge);
            if (cluster == nowhere) {
                border_ = std::min(border_, place);
                continue;
            }
            if (clusters_[cluster].edge_count++ == 0) clusters_[cluster].first_edge = place;
        }
    }

    static bool is_one_sided(const ShadowMesh& mesh, LightLocal light) {
        const glm::vec3 p(light.position);
        return std::ranges::all_of(mesh.components(), [&](const shadows::Component& c) {
            return c.closed && !c.inside_out &&
                   (light.is_directional() || glm::any(glm::lessThan(p, c.bounds_min)) ||
                    glm::any(glm::greaterThan(p, c.bounds_max)));
        });
    }

    // meshoptimizer's test with the cluster's ball, for the averted and, turned round, for the
    // facing side, with a thousandth to spare for the rounding of the cone. 0: not certain.
    static int side_of(const Cluster& cluster, LightLocal light) {
        if (!cluster.certain) return 0;
        const glm::vec3 l(light.position);
        const glm::vec3 from_light = light.is_directional() ? -l : cluster.center - l;
        const float distance = glm::length(from_light);
        const float radius = light.is_directional() ? 0.0F : cluster.radius;
        const float along = glm::dot(from_light, cluster.axis);
        if (std::abs(along) < (cluster.cutoff + 1e-3F) * distance + 1.001F * radius) return 0;
        return along < 0.0F ? 1 : -1;
    }

    static bool faces_light(const ShadowMesh& mesh, std::uint32_t face, LightLocal light) {
        const shadows::FacePlanes& planes = mesh.planes();
        const glm::dvec3 l(light.position);
        const glm::dvec3 towards = light.is_directional() ? l : l - glm::dvec3(planes.origin);
        const double w = static_cast<double>(light.position.w);
        const glm::dvec3 normal(planes.normal_x[face], planes.normal_y[face],
                                planes.normal_z[face]);
        const double value =
            glm::dot(normal, towards) + static_cast<double>(planes.offset[face]) * w;
        const glm::dvec3 size = glm::abs(towards);
        const double bound = static_cast<double>(planes.error[face]) * 1.001 *
                             (size.x + size.y + size.z + static_cast<double>(planes.radius) * w);
        if (std::abs(value) > bound) return value > 0.0;
        const auto [a, b, c] = mesh.faces()[face];
        const auto p = mesh.positions();
        return shadows::exact_facing(p[a], p[b], p[c], light) > 0;
    }

    void look_at(const ShadowMesh& mesh, std::uint32_t first, std::uint32_t count) {
        for (std::uint32_t i = first; i < first + count; ++i) {
            const shadows::Edge& edge = mesh.edges()[edges_[i]];
            std::int32_t sum = 0;
            for (const shadows::FaceUse& use : mesh.uses(edge)) {
                sum += use.sign() * weights_[use.face];
            }
            if (sum > 0) found_.silhouette.push_back({edge.low, edge.high, sum});
            if (sum < 0) found_.silhouette.push_back({edge.high, edge.low, -sum});
        }
        found_.stats.edges_tested += count;
    }

    const shadows::Detection& plain(const ShadowMesh& mesh, LightLocal light,
                                    shadows::NearCaps near_caps) {
        shadows::classify_faces(mesh, light, plain_, near_caps);
        shadows::pack_weights(plain_.weights, found_.casting);
        shadows::find_silhouette(mesh, plain_.weights, found_.silhouette);
        found_.solid_averted = plain_.solid_averted;
        found_.margin = plain_.margin;
        found_.stats = {.faces_tested = mesh.faces().size(), .edges_tested = mesh.edges().size()};
        return found_;
    }

    std::uint64_t prepared_for_ = 0;
    std::vector<Cluster> clusters_;
    std::vector<std::uint32_t> faces_;  // cluster by cluster
    std::vector<std::uint32_t> edges_;  // of ShadowMesh::edges()
    std::uint32_t border_ = 0;          // where those between clusters begin
    std::vector<std::int8_t> weights_;
    std::vector<const Cluster*> mixed_;
    shadows::Facing plain_;
    shadows::Detection found_;
};

}  // namespace

std::optional<Contestant> meshlets() {
    return Contestant{"meshoptimizer", [] { return std::make_unique<Meshlets>(); }, true, true};
}

}  // namespace gnomon::bench
