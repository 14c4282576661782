// SPDX-License-Identifier: MIT
#include "internal/convex_parts.hpp"

#include <algorithm>
#include <memory>
#include <mutex>
#include <utility>

namespace gnomon::shadows::internal {

namespace {

// Of a part's size: what corners may lie before planes. Spheres in single precision are that
// uneven.
constexpr double convex_slack = 1e-5;
// Of a part's size: what its middle must lie behind each plane.
constexpr double least_depth = 1e-6;
// Of normals' cosine, less than 1: of faces in one plane.
constexpr double flat_slack = 1e-8;

// More components than this are not gone through for the largest ones.
constexpr std::size_t most_tried = 16;

// Of meshes of more faces, which have small ones, nothing is grown; from no more faces, and to no
// more: what is large has large faces.
constexpr std::size_t most_faces_to_grow = 512;
constexpr std::size_t most_seeds = 12;
constexpr std::size_t most_grown_faces = 48;
// Of a mesh's size, squared: parts of less area hide little.
constexpr double least_area = 0.01;

bool may_be_convex(const Component& component) {
    return component.closed && component.boundary_edges == 0 && component.inconsistent_edges == 0 &&
           component.non_manifold_edges == 0 && component.faces >= 4 &&
           component.faces <= most_convex_faces;
}

double size_of(const Component& component) {
    return glm::length(glm::dvec3(component.bounds_max) - glm::dvec3(component.bounds_min));
}

// The surface of some faces, whatever its shape; false where one has no area.
bool gather(const ShadowMesh& mesh, const std::vector<std::uint32_t>& faces, ConvexPart& part) {
    struct Side {
        std::uint32_t edge;  // of the mesh
        std::uint32_t face;  // of the part
        std::array<std::uint32_t, 2> ends;
    };
    std::vector<Side> sides;
    std::vector<std::uint32_t> vertices;  // of the mesh
    for (const std::uint32_t f : faces) {
        const auto& corners = mesh.faces()[f];
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
            continue;  // it has no edge with any other
        }
        if (mesh.is_degenerate(f)) return false;
        const auto number = static_cast<std::uint32_t>(part.faces.size());
        part.faces.push_back(corners);
        vertices.insert(vertices.end(), corners.begin(), corners.end());
        for (std::size_t i = 0; i < 3; ++i) {
            sides.push_back({mesh.face_edges()[f][i], number, {corners[i], corners[(i + 1) % 3]}});
        }
    }
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    const auto place = [&](std::uint32_t& vertex) {
        vertex = static_cast<std::uint32_t>(std::ranges::lower_bound(vertices, vertex) -
                                            vertices.begin());
    };
    for (const std::uint32_t v : vertices) part.vertices.push_back(mesh.positions()[v]);
    for (auto& face : part.faces) std::ranges::for_each(face, place);
    std::ranges::sort(sides, {}, [](const Side& side) { return std::pair(side.edge, side.face); });
    for (std::size_t i = 0; i < sides.size(); ++i) {
        Side& side = sides[i];
        std::ranges::for_each(side.ends, place);
        // Across an edge of other faces as well, or of two that look apart, nothing goes on.
        const bool is_shared = i + 1 < sides.size() && sides[i + 1].edge == side.edge &&
                               side.edge < mesh.regular_edges();
        part.edges.push_back({side.ends, {side.face, ConvexPart::no_face}});
        if (is_shared) part.edges.back().faces[1] = sides[++i].face;
    }
    return !part.faces.empty();
}

// Whether a few of the faces have all the others behind them: most components fail sooner than they
// are gathered.
bool may_be_convex(const ShadowMesh& mesh, const std::vector<std::uint32_t>& faces, double slack,
                   bool inside_out) {
    const auto corner = [&](std::uint32_t face, std::size_t i) {
        return glm::dvec3(mesh.positions()[mesh.faces()[face][i]]);
    };
    constexpr std::size_t looked_at = 4;
    for (std::size_t i = 0; i < faces.size(); i += 1 + faces.size() / looked_at) {
        const glm::dvec3 a = corner(faces[i], 0);
        const glm::dvec3 normal = glm::cross(corner(faces[i], 1) - a, corner(faces[i], 2) - a);
        const double most = slack * glm::length(normal);
        for (const std::uint32_t face : faces) {
            const double before = glm::dot(normal, corner(face, 0) - a);
            if ((inside_out ? -before : before) > most) return false;
        }
    }
    return true;
}

void measure(ConvexPart& part) {
    for (const glm::vec3& v : part.vertices) part.center += glm::dvec3(v);
    part.center /= static_cast<double>(part.vertices.size());
    for (const auto& face : part.faces) {
        const glm::dvec3 a(part.vertices[face[0]]);
        part.area += 0.5 * glm::length(glm::cross(glm::dvec3(part.vertices[face[1]]) - a,
                                                  glm::dvec3(part.vertices[face[2]]) - a));
    }
}

bool is_convex(const ConvexPart& part, double size) {
    const auto ends = [](const auto& edge) { return edge.faces[1] == ConvexPart::no_face; };
    if (std::ranges::any_of(part.edges, ends)) return false;
    for (const auto& face : part.faces) {
        const glm::dvec3 a(part.vertices[face[0]]);
        const glm::dvec3 normal = glm::cross(glm::dvec3(part.vertices[face[1]]) - a,
                                             glm::dvec3(part.vertices[face[2]]) - a);
        const double length = glm::length(normal);
        if (!(length > 0.0)) return false;
        const glm::dvec3 outward = (part.inside_out ? -1.0 : 1.0) / length * normal;
        if (!(glm::dot(outward, part.center - a) < -least_depth * size)) return false;
        for (const glm::vec3& v : part.vertices) {
            if (glm::dot(outward, glm::dvec3(v) - a) > convex_slack * size) return false;
        }
    }
    return true;
}

// Some faces, while they grow.
class Growth {
public:
    Growth(const ShadowMesh& mesh, double size) : mesh_(mesh), slack_(convex_slack * size) {}

    [[nodiscard]] const std::vector<std::uint32_t>& faces() const { return faces_; }
    void begin(std::uint32_t face, bool inside_out) {
        inward_ = inside_out;
        faces_.clear();
        normals_.clear();
        corners_.clear();
        add(face);
    }
    void add(std::uint32_t face) {
        faces_.push_back(face);
        normals_.push_back(normal_of(face));
        for (const std::uint32_t vertex : mesh_.faces()[face]) {
            if (std::ranges::find(corners_, vertex) == corners_.end()) corners_.push_back(vertex);
        }
    }
    [[nodiscard]] bool has(std::uint32_t face) const {
        return std::ranges::find(faces_, face) != faces_.end();
    }
    [[nodiscard]] bool may_add(std::uint32_t face) const {
        const glm::dvec3 normal = normal_of(face);
        for (const std::uint32_t vertex : corners_) {
            if (glm::dot(normal, at(vertex) - corner(face, 0)) > slack_) return false;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            if (std::ranges::find(corners_, mesh_.faces()[face][k]) != corners_.end()) continue;
            for (std::size_t i = 0; i < faces_.size(); ++i) {
                const glm::dvec3 way = corner(face, k) - corner(faces_[i], 0);
                if (glm::dot(normals_[i], way) > slack_) return false;
            }
        }
        // In one plane: neither may have a corner beyond a side of the other's that is a border.
        for (std::size_t i = 0; i < faces_.size(); ++i) {
            if (glm::dot(normal, normals_[i]) < 1.0 - flat_slack) continue;
            if (!is_beside(faces_[i], face, face, normals_[i]) ||
                !is_beside(face, faces_[i], face, normal)) {
                return false;
            }
        }
        return true;
    }

private:
    [[nodiscard]] glm::dvec3 at(std::uint32_t vertex) const {
        return glm::dvec3(mesh_.positions()[vertex]);
    }
    [[nodiscard]] glm::dvec3 corner(std::uint32_t face, std::size_t i) const {
        return at(mesh_.faces()[face][i]);
    }
    [[nodiscard]] glm::dvec3 normal_of(std::uint32_t face) const {
        const glm::dvec3 a = corner(face, 0);
        const glm::dvec3 normal =
            glm::normalize(glm::cross(corner(face, 1) - a, corner(face, 2) - a));
        return inward_ ? -normal : normal;
    }
    // Where `more` is to be one of them.
    [[nodiscard]] bool is_beside(std::uint32_t face, std::uint32_t other, std::uint32_t more,
                                 const glm::dvec3& normal) const {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t edge = mesh_.face_edges()[face][i];
            if (edge < mesh_.regular_edges()) {
                const auto uses = mesh_.uses(mesh_.edges()[edge]);
                const std::uint32_t next = uses[0].face == face ? uses[1].face : uses[0].face;
                if (next == more || has(next)) continue;
            }
            const glm::dvec3 a = corner(face, i);
            const glm::dvec3 along = corner(face, (i + 1) % 3) - a;
            const glm::dvec3 inner = glm::normalize(glm::cross(inward_ ? -normal : normal, along));
            for (std::size_t k = 0; k < 3; ++k) {
                if (glm::dot(inner, corner(other, k) - a) < -slack_) return false;
            }
        }
        return true;
    }

    const ShadowMesh& mesh_;
    double slack_;
    bool inward_ = false;
    std::vector<std::uint32_t> faces_;
    std::vector<glm::dvec3> normals_;
    std::vector<std::uint32_t> corners_;
};

// From the largest faces that are in no part yet.
void grow_parts(const ShadowMesh& mesh, const std::vector<std::uint8_t>& is_convex_component,
                std::vector<ConvexPart>& parts) {
    if (mesh.faces().size() > most_faces_to_grow) return;
    const auto area_of = [&](std::uint32_t face) {
        const auto& [a, b, c] = mesh.faces()[face];
        const glm::dvec3 at(mesh.positions()[a]);
        return 0.5 * glm::length(glm::cross(glm::dvec3(mesh.positions()[b]) - at,
                                            glm::dvec3(mesh.positions()[c]) - at));
    };
    std::vector<std::pair<double, std::uint32_t>> seeds;
    for (std::uint32_t f = 0; f < mesh.faces().size(); ++f) {
        if (is_convex_component[mesh.face_components()[f]] != 0 || mesh.is_degenerate(f)) continue;
        const double area = area_of(f);
        if (area > 0.0) seeds.emplace_back(-area, f);
    }
    std::ranges::sort(seeds);
    const double size = glm::length(glm::dvec3(mesh.bounds_max()) - glm::dvec3(mesh.bounds_min()));
    Growth growth(mesh, size);
    std::vector<std::uint8_t> is_taken(mesh.faces().size(), 0);
    std::vector<std::pair<double, std::vector<std::uint32_t>>> grown;  // by area, negative
    std::size_t tried = 0;
    for (const auto& [area, seed] : seeds) {
        if (is_taken[seed] != 0) continue;
        const double enough = static_cast<double>(most_grown_faces) * -area;
        if (++tried > most_seeds || enough < least_area * size * size) break;
        const Component& component = mesh.components()[mesh.face_components()[seed]];
        growth.begin(seed, component.inside_out);
        for (std::size_t i = 0; i < growth.faces().size(); ++i) {
            for (const std::uint32_t edge : mesh.face_edges()[growth.faces()[i]]) {
                if (edge >= mesh.regular_edges()) continue;
                for (const FaceUse& use : mesh.uses(mesh.edges()[edge])) {
                    if (growth.faces().size() < most_grown_faces && is_taken[use.face] == 0 &&
                        !mesh.is_degenerate(use.face) && !growth.has(use.face) &&
                        growth.may_add(use.face)) {
                        growth.add(use.face);
                    }
                }
            }
        }
        double grown_area = 0.0;
        for (const std::uint32_t f : growth.faces()) {
            is_taken[f] = 1;
            grown_area += area_of(f);
        }
        if (grown_area < least_area * size * size) continue;
        grown.emplace_back(-grown_area, growth.faces());
    }
    std::ranges::stable_sort(grown, {}, [](const auto& faces) { return faces.first; });
    if (grown.size() > most_convex_parts) grown.resize(most_convex_parts);
    for (const auto& [area, faces] : grown) {
        const Component& component = mesh.components()[mesh.face_components()[faces[0]]];
        ConvexPart part;
        if (!gather(mesh, faces, part)) continue;
        part.inside_out = component.inside_out;
        part.two_sided = !component.closed;
        measure(part);
        parts.push_back(std::move(part));
    }
}

std::vector<ConvexPart> find_parts(const ShadowMesh& mesh) {
    std::vector<ConvexPart> parts;
    if (mesh.is_deformed()) return parts;
    const auto components = mesh.components();
    std::vector<std::uint32_t> tried;
    for (std::uint32_t c = 0; c < components.size(); ++c) {
        if (may_be_convex(components[c])) tried.push_back(c);
    }
    std::stable_sort(tried.begin(), tried.end(), [&](std::uint32_t a, std::uint32_t b) {
        return size_of(components[a]) > size_of(components[b]);
    });
    if (tried.size() > most_tried) tried.resize(most_tried);
    std::vector<std::uint8_t> is_convex_component(components.size(), 0);

    std::vector<std::vector<std::uint32_t>> faces(tried.size());
    for (std::uint32_t f = 0; f < mesh.faces().size(); ++f) {
        const auto found = std::ranges::find(tried, mesh.face_components()[f]);
        if (found != tried.end()) {
            faces[static_cast<std::size_t>(found - tried.begin())].push_back(f);
        }
    }
    for (std::size_t i = 0; i < tried.size(); ++i) {
        const Component& component = components[tried[i]];
        const double slack = convex_slack * size_of(component);
        if (!may_be_convex(mesh, faces[i], slack, component.inside_out)) continue;
        ConvexPart part;
        if (!gather(mesh, faces[i], part)) continue;
        part.whole = true;
        part.inside_out = component.inside_out;
        measure(part);
        if (!is_convex(part, size_of(component))) continue;
        is_convex_component[tried[i]] = 1;
        parts.push_back(std::move(part));
    }
    grow_parts(mesh, is_convex_component, parts);
    std::stable_sort(parts.begin(), parts.end(),
                     [](const ConvexPart& a, const ConvexPart& b) { return a.area > b.area; });
    if (parts.size() > most_convex_parts) parts.resize(most_convex_parts);
    return parts;
}

}  // namespace

const std::vector<ConvexPart>& convex_parts(const ShadowMesh& mesh) {
    std::call_once(mesh.convex_parts_once_, [&] {
        mesh.convex_parts_ = std::make_shared<const std::vector<ConvexPart>>(find_parts(mesh));
    });
    return *mesh.convex_parts_;
}

}  // namespace gnomon::shadows::internal
