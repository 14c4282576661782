// SPDX-License-Identifier: MIT
#include <gnomon/shadows/shadow_mesh.hpp>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <unordered_map>

#include <gnomon/shadows/topology.hpp>

#include "internal/disjoint_sets.hpp"
#include "internal/face_plane.hpp"
#include "internal/rounded_product.hpp"

namespace gnomon::shadows {

namespace {

// 2 * vertex + 1 must fit an index, with room to spare; and so must the number of a volume's
// indices, of which a face that casts needs 24 at most: two caps and three sides.
constexpr std::size_t max_vertices = std::size_t{1} << 30U;
constexpr std::size_t max_triangles = std::size_t{1} << 27U;

glm::vec3 position_at(const MeshView& view, std::size_t vertex) {
    glm::vec3 p;
    std::memcpy(&p, view.positions + vertex * view.stride, sizeof p);
    return p + 0.0F;  // -0 becomes +0, so that equal positions have equal bits
}

struct PositionHash {
    std::size_t operator()(const glm::vec3& p) const {
        const auto x = std::bit_cast<std::array<std::uint32_t, 3>>(p);
        std::uint64_t h = 0x9E3779B97F4A7C15ULL;
        for (const std::uint32_t word : x) h = (h ^ word) * 0xFF51AFD7ED558CCDULL, h ^= h >> 29U;
        return static_cast<std::size_t>(h);
    }
};

// Six times the signed volume between a surface and a point, as the sum over its faces, with the
// sum of all magnitudes, which bounds its error (docs/numerics.md, "Facing"). A flat or doubled
// sheet has volume zero, so that rounding alone would decide about its sign: hence products that
// are the same in every build.
struct SignedVolume {
    glm::dvec3 reference{0.0};
    double sum = 0.0;
    double magnitude = 0.0;

    void add(const glm::vec3& a_float, const glm::vec3& b_float, const glm::vec3& c_float) {
        const glm::dvec3 a = glm::dvec3(a_float) - reference;
        const glm::dvec3 b = glm::dvec3(b_float) - reference;
        const glm::dvec3 c = glm::dvec3(c_float) - reference;
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3;
            const int k = (i + 2) % 3;
            const double plus = internal::rounded_product(b[j], c[k]);
            const double minus = internal::rounded_product(b[k], c[j]);
            sum += internal::rounded_product(a[i], plus - minus);
            magnitude +=
                internal::rounded_product(std::abs(a[i]), std::abs(plus) + std::abs(minus));
        }
    }
    [[nodiscard]] bool certainly_negative(std::uint64_t faces) const {
        return sum < -(3.0 * static_cast<double>(faces) + 16.0) * 0x1p-53 * magnitude;
    }
};

struct HalfEdge {
    std::uint32_t low, high, face;
    std::int32_t sign;  // 0: of a face with two equal corners, which uses no edge but lies at one
};

std::vector<HalfEdge> sorted_half_edges(std::span<const std::array<std::uint32_t, 3>> faces) {
    std::vector<HalfEdge> result;
    result.reserve(faces.size() * 3);
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const auto& [a, b, c] = faces[f];
        const bool collapsed = a == b || b == c || c == a;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t from = faces[f][i];
            const std::uint32_t to = faces[f][(i + 1) % 3];
            if (from == to) continue;
            result.push_back({std::min(from, to), std::max(from, to), static_cast<std::uint32_t>(f),
                              collapsed ? 0 : (from < to ? 1 : -1)});
        }
    }
    std::sort(result.begin(), result.end(), [](const HalfEdge& a, const HalfEdge& b) {
        if (a.low != b.low) return a.low < b.low;
        if (a.high != b.high) return a.high < b.high;
        return a.face < b.face;
    });
    return result;
}

Status check(const MeshView& view) {
    const auto bad = [](std::string sentence) {
        return fail(ErrorCode::InvalidInput, std::move(sentence));
    };
    if (view.indices.size() % 3 != 0) {
        return bad("The mesh has " + std::to_string(view.indices.size()) +
                   " indices, which is not a multiple of 3.");
    }
    if (view.indices.size() / 3 > max_triangles || view.vertex_count > max_vertices) {
        return bad("The mesh has " + std::to_string(view.vertex_count) + " vertices and " +
                   std::to_string(view.indices.size() / 3) + " triangles; the limits are " +
                   std::to_string(max_vertices) + " and " + std::to_string(max_triangles) + ".");
    }
    if (view.vertex_count > 0 && view.positions == nullptr) {
        return bad("The mesh has " + std::to_string(view.vertex_count) +
                   " vertices but no positions.");
    }
    for (std::size_t i = 0; i < view.indices.size(); ++i) {
        if (view.indices[i] >= view.vertex_count) {
            return bad("Index " + std::to_string(i) + " of the mesh is " +
                       std::to_string(view.indices[i]) + ", but it has " +
                       std::to_string(view.vertex_count) + " vertices.");
        }
    }
    for (std::size_t v = 0; v < view.vertex_count; ++v) {
        const glm::vec3 p = position_at(view, v);
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
            return bad("Position " + std::to_string(v) + " of the mesh is not finite.");
        }
    }
    return {};
}

}  // namespace

Result<std::shared_ptr<const ShadowMesh>> ShadowMesh::build(const MeshView& view) {
    if (const Status ok = check(view); !ok) return forward_error(ok);

    static std::atomic<std::uint64_t> next_id{1};
    std::shared_ptr<ShadowMesh> mesh(new ShadowMesh);
    mesh->id_ = next_id.fetch_add(1);
    MeshReport& report = mesh->report_;
    report.triangles = view.indices.size() / 3;
    report.vertices = view.vertex_count;

    // Weld: only positions that triangles use, numbered by first use.
    {
        std::unordered_map<glm::vec3, std::uint32_t, PositionHash> welded;
        welded.reserve(view.vertex_count);
        std::vector<std::uint32_t> welded_of(view.vertex_count,
                                             std::numeric_limits<std::uint32_t>::max());
        mesh->faces_.resize(view.indices.size() / 3);
        for (std::size_t i = 0; i < view.indices.size(); ++i) {
            const std::uint32_t vertex = view.indices[i];
            std::uint32_t& target = welded_of[vertex];
            if (target == std::numeric_limits<std::uint32_t>::max()) {
                const glm::vec3 p = position_at(view, vertex);
                const auto [found, inserted] =
                    welded.try_emplace(p, static_cast<std::uint32_t>(mesh->positions_.size()));
                if (inserted) mesh->positions_.push_back(p);
                target = found->second;
            }
            mesh->faces_[i / 3][i % 3] = target;
        }
    }
    report.welded_vertices = mesh->positions_.size();

    // Edges with their signed uses; components.
    const std::vector<HalfEdge> half_edges = sorted_half_edges(mesh->faces_);
    internal::DisjointSets groups(mesh->faces_.size());
    mesh->uses_.reserve(half_edges.size());
    for (std::size_t begin = 0; begin < half_edges.size();) {
        const HalfEdge& edge = half_edges[begin];
        const auto first_use = static_cast<std::uint32_t>(mesh->uses_.size());
        for (; begin < half_edges.size() && half_edges[begin].low == edge.low &&
               half_edges[begin].high == edge.high;
             ++begin) {
            const HalfEdge& use = half_edges[begin];
            groups.join(edge.face, use.face);
            if (use.sign == 0) continue;
            mesh->uses_.push_back({use.face, use.sign});
        }
        const auto count = static_cast<std::uint32_t>(mesh->uses_.size()) - first_use;
        if (count > 0) mesh->edges_.push_back({edge.low, edge.high, first_use, count});
    }
    report.edges = mesh->edges_.size();

    std::vector<std::uint32_t> component_of_root(mesh->faces_.size());
    std::vector<SignedVolume> volumes;
    mesh->face_components_.resize(mesh->faces_.size());
    for (std::uint32_t f = 0; f < mesh->faces_.size(); ++f) {
        const auto& face = mesh->faces_[f];
        const glm::vec3 a = mesh->positions_[face[0]];
        const glm::vec3 b = mesh->positions_[face[1]];
        const glm::vec3 c = mesh->positions_[face[2]];
        const std::uint32_t root = groups.find(f);
        if (root == f) {
            component_of_root[f] = static_cast<std::uint32_t>(mesh->components_.size());
            mesh->components_.push_back({.bounds_min = a, .bounds_max = a});
            volumes.push_back({.reference = glm::dvec3(a)});
        }
        const std::uint32_t index = component_of_root[root];
        mesh->face_components_[f] = index;
        Component& component = mesh->components_[index];
        ++component.faces;
        component.bounds_min = glm::min(component.bounds_min, glm::min(a, glm::min(b, c)));
        component.bounds_max = glm::max(component.bounds_max, glm::max(a, glm::max(b, c)));
        volumes[index].add(a, b, c);
    }
    for (const Edge& edge : mesh->edges_) {
        const auto uses = mesh->uses(edge);
        Component& component = mesh->components_[mesh->face_components_[uses.front().face]];
        ++component.edges;
        if (edge_balance(uses) != 0) ++component.unbalanced_edges;
        switch (edge_kind(uses)) {
            case EdgeKind::Regular: break;
            case EdgeKind::Boundary: ++component.boundary_edges; break;
            case EdgeKind::Inconsistent: ++component.inconsistent_edges; break;
            case EdgeKind::NonManifold: ++component.non_manifold_edges; break;
        }
    }
    for (std::size_t i = 0; i < mesh->components_.size(); ++i) {
        Component& component = mesh->components_[i];
        report.boundary_edges += component.boundary_edges;
        report.non_manifold_edges += component.non_manifold_edges;
        report.inconsistent_edges += component.inconsistent_edges;
        report.unbalanced_edges += component.unbalanced_edges;
        component.closed = component.unbalanced_edges == 0;
        component.inside_out = component.closed && volumes[i].certainly_negative(component.faces);
        if (component.closed) ++report.closed_components;
        if (i == 0) {
            mesh->bounds_min_ = component.bounds_min;
            mesh->bounds_max_ = component.bounds_max;
        }
        mesh->bounds_min_ = glm::min(mesh->bounds_min_, component.bounds_min);
        mesh->bounds_max_ = glm::max(mesh->bounds_max_, component.bounds_max);
    }
    report.components = mesh->components_.size();
    mesh->planes_ = internal::make_face_planes(mesh->positions_, mesh->faces_, mesh->bounds_min_,
                                               mesh->bounds_max_);
    for (std::size_t f = 0; f < mesh->faces_.size(); ++f) {
        if (!mesh->is_degenerate(f)) continue;
        ++report.degenerate_faces;
        ++mesh->components_[mesh->face_components_[f]].degenerate_faces;
    }
    return mesh;
}

bool ShadowMesh::is_degenerate(std::size_t face) const {
    return internal::is_degenerate(planes_, face);
}

}  // namespace gnomon::shadows
