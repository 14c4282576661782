// SPDX-License-Identifier: MIT
#include <gnomon/shadows/shadow_mesh.hpp>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include <gnomon/shadows/topology.hpp>

#include "internal/detection_tables.hpp"
#include "internal/face_plane.hpp"
#include "internal/face_tree.hpp"
#include "internal/finite.hpp"
#include "internal/mesh_topology.hpp"
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
    if (!view.identities.empty() && view.identities.size() != view.vertex_count) {
        return bad("The mesh has " + std::to_string(view.identities.size()) +
                   " identities, but must have none or one for each of its " +
                   std::to_string(view.vertex_count) + " vertices.");
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

std::uint64_t next_mesh_id() {
    static std::atomic<std::uint64_t> next{1};
    return next.fetch_add(1);
}

struct Welded {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> sources;  // by position: the first vertex that has it
    std::vector<std::array<std::uint32_t, 3>> faces;
};

std::uint64_t weld_hash(const glm::vec3& position, std::uint32_t identity) {
    std::uint64_t h = 0x9E3779B97F4A7C15ULL + identity * 0xC2B2AE3D27D4EB4FULL;
    for (const std::uint32_t word : std::bit_cast<std::array<std::uint32_t, 3>>(position)) {
        h = (h ^ word) * 0xFF51AFD7ED558CCDULL;
        h ^= h >> 29U;
    }
    return h;
}

// Only vertices that triangles use, numbered by first use. The table is of numbers, open, and half
// empty at least.
Welded weld(const MeshView& view) {
    constexpr std::uint32_t unknown = std::numeric_limits<std::uint32_t>::max();
    Welded result;
    std::vector<std::uint32_t> known(std::bit_ceil(2 * view.vertex_count + 1), unknown);
    const auto identity_of = [&](std::uint32_t vertex) {
        return view.identities.empty() ? 0 : view.identities[vertex];
    };
    const auto number_of = [&](std::uint32_t vertex) {
        const glm::vec3 p = position_at(view, vertex);
        const std::uint32_t identity = identity_of(vertex);
        for (std::size_t slot = weld_hash(p, identity);; ++slot) {
            std::uint32_t& number = known[slot & (known.size() - 1)];
            if (number == unknown) {
                number = static_cast<std::uint32_t>(result.positions.size());
                result.positions.push_back(p);
                result.sources.push_back(vertex);
                return number;
            }
            if (result.positions[number] == p && identity_of(result.sources[number]) == identity) {
                return number;
            }
        }
    };
    std::vector<std::uint32_t> welded_of(view.vertex_count, unknown);
    result.faces.resize(view.indices.size() / 3);
    for (std::size_t i = 0; i < view.indices.size(); ++i) {
        std::uint32_t& target = welded_of[view.indices[i]];
        if (target == unknown) target = number_of(view.indices[i]);
        result.faces[i / 3][i % 3] = target;
    }
    return result;
}

// What follows from topology alone.
std::vector<Component> components_of(const internal::MeshTopology& topology) {
    std::vector<Component> components(topology.components);
    for (const std::uint32_t c : topology.face_components) ++components[c].faces;
    for (const Edge& edge : topology.edges) {
        const auto uses = std::span(topology.uses).subspan(edge.first_use, edge.use_count);
        Component& component = components[topology.face_components[uses.front().face]];
        ++component.edges;
        if (edge_balance(uses) != 0) ++component.unbalanced_edges;
        switch (edge_kind(uses)) {
            case EdgeKind::Regular: break;
            case EdgeKind::Boundary: ++component.boundary_edges; break;
            case EdgeKind::Inconsistent: ++component.inconsistent_edges; break;
            case EdgeKind::NonManifold: ++component.non_manifold_edges; break;
        }
    }
    for (Component& component : components) component.closed = component.unbalanced_edges == 0;
    return components;
}

// Bounds, and which closed components are inside out.
void place(std::vector<Component>& components, std::span<const glm::vec3> positions,
           std::span<const std::array<std::uint32_t, 3>> faces,
           std::span<const std::uint32_t> face_components) {
    std::vector<SignedVolume> volumes(components.size());
    std::vector<std::uint8_t> met(components.size(), 0);
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const glm::vec3& a = positions[faces[f][0]];
        const glm::vec3& b = positions[faces[f][1]];
        const glm::vec3& c = positions[faces[f][2]];
        const std::uint32_t index = face_components[f];
        Component& component = components[index];
        if (met[index] == 0) {
            met[index] = 1;
            component.bounds_min = component.bounds_max = a;
            volumes[index].reference = glm::dvec3(a);
        }
        component.bounds_min = glm::min(component.bounds_min, glm::min(a, glm::min(b, c)));
        component.bounds_max = glm::max(component.bounds_max, glm::max(a, glm::max(b, c)));
        volumes[index].add(a, b, c);
    }
    for (std::size_t i = 0; i < components.size(); ++i) {
        components[i].inside_out =
            components[i].closed && volumes[i].certainly_negative(components[i].faces);
    }
}

}  // namespace

const internal::MeshTopology& internal::topology_of(const ShadowMesh& mesh) {
    return *mesh.topology_;
}

const internal::DetectionTables& internal::tables_of(const ShadowMesh& mesh) {
    std::call_once(mesh.tables_once_, [&] {
        mesh.tables_ = std::make_shared<const DetectionTables>(make_tables(mesh));
    });
    return *mesh.tables_;
}

void ShadowMesh::take(std::shared_ptr<const internal::MeshTopology> topology) {
    topology_ = std::move(topology);
    faces_ = topology_->faces;
    input_faces_ = topology_->input_faces;
    edges_ = topology_->edges;
    uses_ = topology_->uses;
    face_edges_ = topology_->face_edges;
    face_components_ = topology_->face_components;
    regular_edges_ = topology_->regular_edges;
}

void ShadowMesh::find_bounds() {
    for (std::size_t i = 0; i < components_.size(); ++i) {
        if (i == 0) {
            bounds_min_ = components_[i].bounds_min;
            bounds_max_ = components_[i].bounds_max;
        }
        bounds_min_ = glm::min(bounds_min_, components_[i].bounds_min);
        bounds_max_ = glm::max(bounds_max_, components_[i].bounds_max);
    }
}

void ShadowMesh::find_degenerate_faces() {
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
        if (!is_degenerate(f)) continue;
        degenerate_faces_.push_back(f);
        ++components_[face_components_[f]].degenerate_faces;
    }
    report_.degenerate_faces = degenerate_faces_.size();
}

Result<std::shared_ptr<const ShadowMesh>> ShadowMesh::build(const MeshView& view,
                                                            const Jobs& jobs) {
    if (const Status ok = check(view); !ok) return forward_error(ok);

    std::shared_ptr<ShadowMesh> mesh(new ShadowMesh);
    mesh->id_ = next_mesh_id();
    Welded welded = weld(view);
    mesh->positions_ = std::move(welded.positions);
    internal::MeshTopology topology =
        internal::connect(std::move(welded.faces), mesh->positions_.size(), jobs);
    topology.input_vertices = view.vertex_count;
    topology.sources = std::move(welded.sources);
    mesh->components_ = components_of(topology);
    place(mesh->components_, mesh->positions_, topology.faces, topology.face_components);
    mesh->find_bounds();
    mesh->planes_ = internal::make_face_planes(mesh->positions_, topology.faces, mesh->bounds_min_,
                                               mesh->bounds_max_, jobs);

    MeshReport& report = mesh->report_;
    report.triangles = topology.faces.size();
    report.vertices = view.vertex_count;
    report.welded_vertices = mesh->positions_.size();
    report.edges = topology.edges.size();
    report.components = mesh->components_.size();
    std::vector<std::uint8_t> closed;
    for (const Component& component : mesh->components_) {
        report.boundary_edges += component.boundary_edges;
        report.non_manifold_edges += component.non_manifold_edges;
        report.inconsistent_edges += component.inconsistent_edges;
        report.unbalanced_edges += component.unbalanced_edges;
        report.closed_components += component.closed ? 1 : 0;
        closed.push_back(component.closed ? 1 : 0);
    }

    internal::order_by_planes(topology, mesh->planes_, closed, jobs);
    mesh->take(std::make_shared<const internal::MeshTopology>(std::move(topology)));
    mesh->face_tree_shape_ = std::make_shared<internal::FaceTreeShape>();
    mesh->find_degenerate_faces();
    std::call_once(mesh->tables_once_, [&] {
        mesh->tables_ =
            std::make_shared<const internal::DetectionTables>(internal::make_tables(*mesh, jobs));
    });
    return mesh;
}

Result<std::shared_ptr<const ShadowMesh>> ShadowMesh::deformed(
    std::span<const glm::vec3> positions) const {
    if (positions.size() != topology_->input_vertices) {
        return fail(ErrorCode::InvalidInput, "The deformed mesh has " +
                                                 std::to_string(positions.size()) +
                                                 " vertices; the mesh was built from " +
                                                 std::to_string(topology_->input_vertices) + ".");
    }
    for (std::size_t v = 0; v < positions.size(); ++v) {
        if (internal::is_finite(positions[v])) continue;
        return fail(ErrorCode::InvalidInput,
                    "Position " + std::to_string(v) + " of the deformed mesh is not finite.");
    }
    std::shared_ptr<ShadowMesh> mesh(new ShadowMesh);
    mesh->id_ = next_mesh_id();
    mesh->take(topology_);
    mesh->face_tree_shape_ = face_tree_shape_;
    mesh->deformed_ = true;
    mesh->report_ = report_;
    mesh->positions_.reserve(positions_.size());
    for (const std::uint32_t source : topology_->sources) {
        mesh->positions_.push_back(positions[source] + 0.0F);  // as position_at()
    }
    mesh->components_ = components_;
    for (Component& component : mesh->components_) component.degenerate_faces = 0;
    place(mesh->components_, mesh->positions_, faces_, face_components_);
    mesh->find_bounds();
    mesh->planes_ =
        internal::make_face_planes(mesh->positions_, faces_, mesh->bounds_min_, mesh->bounds_max_);
    mesh->find_degenerate_faces();
    return mesh;
}

bool ShadowMesh::is_degenerate(std::size_t face) const {
    return internal::is_degenerate(planes_, face);
}

std::size_t ShadowMesh::memory_bytes() const {
    return sizeof *this + positions_.capacity() * sizeof(glm::vec3) + topology_->memory_bytes() +
           components_.capacity() * sizeof(Component) +
           5 * planes_.error.capacity() * sizeof(float) +
           degenerate_faces_.capacity() * sizeof(std::uint32_t) +
           (tables_ == nullptr ? 0 : tables_->faces.memory_bytes() + tables_->edges.memory_bytes());
}

}  // namespace gnomon::shadows
