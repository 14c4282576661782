// SPDX-License-Identifier: MIT
//
// ShadowMesh: what shadows need to know of a triangle mesh, worked out once. Vertices welded by
// exact position (and identity, where they may move apart), unique edges with all their signed face
// uses, components, face planes with error bounds, and a report. Any triangles do: open,
// non-manifold, inconsistently wound, degenerate. It is immutable and may be shared between
// threads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>
#include <gnomon/shadows/jobs.hpp>

#pragma GCC visibility push(default)
namespace gnomon::shadows {

class ShadowMesh;
namespace internal {
class FaceTree;
struct FaceTreeShape;
const FaceTree& face_tree(const ShadowMesh& mesh);
struct ConvexPart;
const std::vector<ConvexPart>& convex_parts(const ShadowMesh& mesh);
struct MeshTopology;
struct DetectionTables;
const MeshTopology& topology_of(const ShadowMesh& mesh);
const DetectionTables& tables_of(const ShadowMesh& mesh);
}  // namespace internal

/// Triangles as the caller has them; read during build only.
struct MeshView {
    const std::byte* positions = nullptr;    ///< three floats each, metres, in the caster's space
    std::size_t stride = sizeof(glm::vec3);  ///< bytes from one position to the next
    std::size_t vertex_count = 0;            ///< how many positions there are
    std::span<const std::uint32_t> indices =
        {};  ///< three a triangle, counter-clockwise from outside
    /// One number a vertex, or none at all: vertices at one position are welded only where their
    /// numbers are equal as well. It is for meshes that deform: what may move apart must not be
    /// welded, and what moves alike must be, or a seam would open. Give equal numbers exactly to
    /// vertices that have equal positions in every pose. What is not welded is a boundary there,
    /// and boundaries cast two-sided: right, but dearer (docs/conventions.md).
    std::span<const std::uint32_t> identities = {};
};

/// What is found on the way. None of it is an error: the shadow is right whatever it says
/// (docs/conventions.md).
struct MeshReport {
    std::uint64_t triangles = 0;           ///< as given
    std::uint64_t vertices = 0;            ///< as given
    std::uint64_t welded_vertices = 0;     ///< distinct (positions, identities) that triangles use
    std::uint64_t edges = 0;               ///< between welded vertices
    std::uint64_t components = 0;          ///< connected through edges
    std::uint64_t closed_components = 0;   ///< whose every edge cancels
    std::uint64_t boundary_edges = 0;      ///< one face
    std::uint64_t non_manifold_edges = 0;  ///< three faces or more
    std::uint64_t inconsistent_edges = 0;  ///< two faces that run along it the same way
    std::uint64_t unbalanced_edges = 0;    ///< the signed sum of face uses is not zero
    std::uint64_t degenerate_faces = 0;    ///< zero area, exactly: they cast nothing

    /// Whether all of it is closed; not where there is nothing.
    [[nodiscard]] bool closed() const { return components > 0 && closed_components == components; }
};

/// One edge between welded vertices low < high; its face uses are uses[first_use .. first_use +
/// use_count), those that run low -> high first.
struct Edge {
    std::uint32_t low = 0;        ///< the lower vertex
    std::uint32_t high = 0;       ///< the higher one
    std::uint32_t first_use = 0;  ///< its place among uses()
    std::uint32_t use_count = 0;  ///< how many faces it has
};

/// One face that has an edge.
struct FaceUse {
    std::uint32_t face : 31 = 0;     ///< which one
    std::uint32_t backward : 1 = 0;  ///< it runs high -> low

    /// +1 where the face runs low -> high, -1 where it runs high -> low.
    [[nodiscard]] std::int32_t sign() const { return backward != 0 ? -1 : 1; }
};

/// Faces connected through edges. How it casts: topology.hpp.
struct Component {
    bool closed = false;         ///< every edge's signed sum of face uses is zero
    bool inside_out = false;     ///< closed, with a signed volume that is negative for certain
    glm::vec3 bounds_min{0.0F};  ///< in the caster's space, metres
    glm::vec3 bounds_max{0.0F};  ///< in the caster's space, metres
    std::uint64_t faces = 0;     ///< how many
    std::uint64_t edges = 0;     ///< as in MeshReport, here and below: of this component alone
    std::uint64_t boundary_edges = 0;      ///< one face
    std::uint64_t non_manifold_edges = 0;  ///< three faces or more
    std::uint64_t inconsistent_edges = 0;  ///< two that run the same way
    std::uint64_t unbalanced_edges = 0;    ///< the signed sum is not zero
    std::uint64_t degenerate_faces = 0;    ///< zero area
};

/// The planes of all faces, for the first stage of the facing test (facing.hpp), which takes
/// several at a time: one array a quantity, in the order of faces(). The plane of a face is where
/// normal . (x - origin) + offset = 0, with a normal of length 1, all rounded to single precision.
struct FacePlanes {
    glm::vec3 origin{0.0F};  ///< the middle of the bounds: being far from zero costs no precision
    float radius = 0.0F;     ///< no corner has a larger |x| + |y| + |z| relative to the origin
    std::vector<float> normal_x;  ///< padded, as the others, with zeros to a multiple of 16 faces
    std::vector<float> normal_y;  ///< likewise
    std::vector<float> normal_z;  ///< likewise
    std::vector<float> offset;    ///< metres
    /// Bounds the error of the value above, at a point p relative to the origin, per unit of |p.x|
    /// + |p.y| + |p.z| + radius (docs/numerics.md, "Face planes"). 0: a face without area, exactly.
    /// Infinite: a sliver that single precision says nothing about.
    std::vector<float> error;
};

/// A triangle mesh as shadows need it. Immutable, so any number of casters and threads share one.
class ShadowMesh {
public:
    /// Fails with ErrorCode::InvalidInput: a position that is not finite, an index out of range, an
    /// index count that is not a multiple of three, identities that are not one a vertex, more than
    /// 2^30 vertices or 2^27 triangles. Cost: O(n log n), about 100 bytes a triangle. `jobs` runs
    /// what of it can be done at once, and changes nothing in the mesh.
    [[nodiscard]] static Result<std::shared_ptr<const ShadowMesh>> build(const MeshView& view,
                                                                         const Jobs& jobs = {});

    /// The same triangles with vertices in other places: of a skinned or morphed mesh, each frame.
    /// `positions` are of the vertices that the mesh was built from, in their order. Vertices that
    /// were welded stay so, in the place of the first of them: vertices that may come apart must
    /// not be welded. Topology and the order of faces and edges are shared with this mesh; the
    /// other facts are those of the new places. Fails with ErrorCode::InvalidInput: another number
    /// of vertices, or a position that is not finite. Cost: linear, some 50 ns a triangle.
    [[nodiscard]] Result<std::shared_ptr<const ShadowMesh>> deformed(
        std::span<const glm::vec3> positions) const;

    /// Unique among all meshes of the process, never zero.
    [[nodiscard]] std::uint64_t id() const { return id_; }
    /// What was found on the way.
    [[nodiscard]] const MeshReport& report() const { return report_; }

    /// Welded vertices, in the caster's space, metres, as given to the bit.
    [[nodiscard]] std::span<const glm::vec3> positions() const { return positions_; }
    /// Index triples into positions(), corner order as in the input. The faces themselves are in an
    /// order of the mesh's own, in which neighbours lie in similar planes; everything that goes "by
    /// face" follows it.
    [[nodiscard]] std::span<const std::array<std::uint32_t, 3>> faces() const { return faces_; }
    /// By face: which triangle of the input it is.
    [[nodiscard]] std::span<const std::uint32_t> input_faces() const { return input_faces_; }
    /// The regular ones (topology.hpp) first.
    [[nodiscard]] std::span<const Edge> edges() const { return edges_; }
    /// Edges [0, regular_edges()) have two uses, uses[2 e] forward and uses[2 e + 1] backward.
    [[nodiscard]] std::size_t regular_edges() const { return regular_edges_; }
    /// Of all edges, one after the other.
    [[nodiscard]] std::span<const FaceUse> uses() const { return uses_; }
    /// Of one edge.
    [[nodiscard]] std::span<const FaceUse> uses(const Edge& edge) const {
        return uses_.subspan(edge.first_use, edge.use_count);
    }
    /// By face: its edges, from its corners 0, 1 and 2 on. no_edge where two corners are the same.
    [[nodiscard]] std::span<const std::array<std::uint32_t, 3>> face_edges() const {
        return face_edges_;
    }
    /// No edge at all, in face_edges().
    static constexpr std::uint32_t no_edge = 0xFFFFFFFF;
    /// In no order to rely on.
    [[nodiscard]] std::span<const Component> components() const { return components_; }
    /// By face: its place among components().
    [[nodiscard]] std::span<const std::uint32_t> face_components() const {
        return face_components_;
    }
    /// By face.
    [[nodiscard]] const FacePlanes& planes() const { return planes_; }
    /// Whether a face has no area, exactly; it casts nothing.
    [[nodiscard]] bool is_degenerate(std::size_t face) const;
    /// Ascending.
    [[nodiscard]] std::span<const std::uint32_t> degenerate_faces() const {
        return degenerate_faces_;
    }
    /// Made by deformed().
    [[nodiscard]] bool is_deformed() const { return deformed_; }
    /// Of everything that the mesh holds, but for what shadow queries search in.
    [[nodiscard]] std::size_t memory_bytes() const;
    /// Of all positions, in the caster's space.
    [[nodiscard]] glm::vec3 bounds_min() const { return bounds_min_; }
    /// Likewise.
    [[nodiscard]] glm::vec3 bounds_max() const { return bounds_max_; }

private:
    friend const internal::FaceTree& internal::face_tree(const ShadowMesh& mesh);
    friend const std::vector<internal::ConvexPart>& internal::convex_parts(const ShadowMesh& mesh);
    friend const internal::MeshTopology& internal::topology_of(const ShadowMesh& mesh);
    friend const internal::DetectionTables& internal::tables_of(const ShadowMesh& mesh);
    ShadowMesh() = default;
    void take(std::shared_ptr<const internal::MeshTopology> topology);
    void find_bounds();
    void find_degenerate_faces();

    std::uint64_t id_ = 0;
    MeshReport report_;
    std::vector<glm::vec3> positions_;
    std::shared_ptr<const internal::MeshTopology> topology_;  // shared with deformed meshes
    // Views of it.
    std::span<const std::array<std::uint32_t, 3>> faces_;
    std::span<const std::uint32_t> input_faces_;
    std::span<const Edge> edges_;
    std::span<const FaceUse> uses_;
    std::span<const std::array<std::uint32_t, 3>> face_edges_;
    std::span<const std::uint32_t> face_components_;
    std::size_t regular_edges_ = 0;

    std::vector<Component> components_;
    FacePlanes planes_;
    glm::vec3 bounds_min_{0.0F};
    glm::vec3 bounds_max_{0.0F};
    bool deformed_ = false;
    std::vector<std::uint32_t> degenerate_faces_;  // ascending
    // What silhouettes are searched in: made with the mesh, or when first asked for where that is
    // deformed.
    mutable std::once_flag tables_once_;
    mutable std::shared_ptr<const internal::DetectionTables> tables_;
    // What shadow queries search in: made when first asked for, then as immutable as the rest.
    mutable std::once_flag face_tree_once_;
    mutable std::shared_ptr<const internal::FaceTree> face_tree_;
    std::shared_ptr<internal::FaceTreeShape> face_tree_shape_;  // shared with deformed meshes
    // What other casters may be hidden behind from a light: likewise.
    mutable std::once_flag convex_parts_once_;
    mutable std::shared_ptr<const std::vector<internal::ConvexPart>> convex_parts_;
};

}  // namespace gnomon::shadows
#pragma GCC visibility pop
