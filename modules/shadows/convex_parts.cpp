// SPDX-License-Identifier: MIT
#include "internal/convex_parts.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <utility>

namespace gnomon::shadows::internal {

namespace {

// Of a part's size: what corners may lie before planes. Spheres in single precision are that
// uneven.
constexpr double convex_slack = 1e-5;
// Of a part's size: what its middle must lie behind each plane.
constexpr double least_depth = 1e-6;

// More components than this are not gone through for the largest ones.
constexpr std::size_t most_tried = 16;

bool may_be_convex(const Component& component) {
    return component.closed && component.boundary_edges == 0 && component.inconsistent_edges == 0 &&
           component.non_manifold_edges == 0 && component.faces >= 4 &&
           component.faces <= most_convex_faces;
}

double size_of(const Component& component) {
    return glm::length(glm::dvec3(component.bounds_max) - glm::dvec3(component.bounds_min));
}

// The surface of a component, whatever its shape; false where a face has no area.
bool gather(const ShadowMesh& mesh, const std::vector<std::uint32_t>& faces, ConvexPart& part) {
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::unordered_map<std::uint32_t, std::uint32_t> places;  // of vertices
    std::unordered_map<std::uint32_t, std::uint32_t> edges;   // of the mesh, in the part
    for (const std::uint32_t f : faces) {
        const auto& corners = mesh.faces()[f];
        if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) {
            continue;  // it has no edge with any other
        }
        if (mesh.is_degenerate(f)) return false;
        std::array<std::uint32_t, 3> face{};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [found, added] =
                places.try_emplace(corners[i], static_cast<std::uint32_t>(part.vertices.size()));
            if (added) part.vertices.push_back(mesh.positions()[corners[i]]);
            face[i] = found->second;
        }
        const auto number = static_cast<std::uint32_t>(part.faces.size());
        part.faces.push_back(face);
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [found, added] = edges.try_emplace(
                mesh.face_edges()[f][i], static_cast<std::uint32_t>(part.edges.size()));
            if (added) {
                part.edges.push_back({{face[i], face[(i + 1) % 3]}, {number, none}});
            } else {
                part.edges[found->second].faces[1] = number;
            }
        }
    }
    return std::ranges::none_of(part.edges, [](const auto& edge) { return edge.faces[1] == none; });
}

bool is_convex(ConvexPart& part, double size, bool inside_out) {
    for (const glm::vec3& v : part.vertices) part.center += glm::dvec3(v);
    part.center /= static_cast<double>(part.vertices.size());
    for (const auto& face : part.faces) {
        const glm::dvec3 a(part.vertices[face[0]]);
        const glm::dvec3 normal = glm::cross(glm::dvec3(part.vertices[face[1]]) - a,
                                             glm::dvec3(part.vertices[face[2]]) - a);
        const double length = glm::length(normal);
        if (!(length > 0.0)) return false;
        part.area += 0.5 * length;
        const glm::dvec3 outward = (inside_out ? -1.0 : 1.0) / length * normal;
        if (!(glm::dot(outward, part.center - a) < -least_depth * size)) return false;
        for (const glm::vec3& v : part.vertices) {
            if (glm::dot(outward, glm::dvec3(v) - a) > convex_slack * size) return false;
        }
    }
    return true;
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
    if (tried.empty()) return parts;

    std::vector<std::vector<std::uint32_t>> faces(tried.size());
    for (std::uint32_t f = 0; f < mesh.faces().size(); ++f) {
        const auto found = std::ranges::find(tried, mesh.face_components()[f]);
        if (found != tried.end()) {
            faces[static_cast<std::size_t>(found - tried.begin())].push_back(f);
        }
    }
    for (std::size_t i = 0; i < tried.size(); ++i) {
        const Component& component = components[tried[i]];
        ConvexPart part;
        if (!gather(mesh, faces[i], part)) continue;
        if (!is_convex(part, size_of(component), component.inside_out)) continue;
        parts.push_back(std::move(part));
    }
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
