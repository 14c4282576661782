// SPDX-License-Identifier: MIT
//
// gnomon inspect --obj: where the offending edges are, for modelling programs. Elements are lines
// and faces; every object has vertices of its own, so that it can be hidden or deleted by itself.
#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "arguments.hpp"
#include "inspection.hpp"

namespace gnomon::cli {

namespace {

// A name in OBJ ends at white space.
std::string one_word(std::string text) {
    for (char& c : text) {
        if (std::isspace(static_cast<unsigned char>(c)) != 0) c = '_';
    }
    return text;
}

/// Equal corners say that it is a line, or a point.
using Element = std::array<std::uint32_t, 3>;

/// Nothing where there are no elements. `last_number`: of the vertices, which OBJ counts through
/// all objects.
void append_object(std::string& text, const InspectedMesh& inspected, const std::string& name,
                   const std::vector<Element>& elements, std::uint64_t& last_number) {
    if (elements.empty()) return;
    auto out = std::back_inserter(text);
    fmt::format_to(out, "o {}\n", name);
    std::unordered_map<std::uint32_t, std::uint64_t> number_of;
    for (const Element& element : elements) {
        for (const std::uint32_t vertex : element) {
            if (!number_of.try_emplace(vertex, last_number + 1).second) continue;
            ++last_number;
            const glm::vec3& p = inspected.shadow_mesh->positions()[vertex];
            const glm::dvec3& origin = inspected.mesh->origin;
            // The shortest text that reads back as the same number; that of a double where the mesh
            // lies so far out that a float cannot say.
            if (origin == glm::dvec3(0.0)) {
                fmt::format_to(out, "v {} {} {}\n", p.x, p.y, p.z);
            } else {
                const glm::dvec3 far = origin + glm::dvec3(p);
                fmt::format_to(out, "v {} {} {}\n", far.x, far.y, far.z);
            }
        }
    }
    for (Element element : elements) {
        std::sort(element.begin(), element.end());
        const auto end = std::unique(element.begin(), element.end());
        text += "plf"[end - element.begin() - 1];
        for (auto vertex = element.begin(); vertex != end; ++vertex) {
            fmt::format_to(out, " {}", number_of.at(*vertex));
        }
        text += '\n';
    }
}

}  // namespace

std::string as_obj(const Inspection& inspection) {
    using shadows::EdgeKind;
    constexpr std::array<std::pair<EdgeKind, std::string_view>, 3> kinds{
        {{EdgeKind::Boundary, "boundary"},
         {EdgeKind::NonManifold, "non_manifold"},
         {EdgeKind::Inconsistent, "inconsistent"}}};
    std::string text = fmt::format(
        "# gnomon inspect {}: the edges and faces that it counts, each mesh in its own space.\n",
        one_line(inspection.model));
    std::uint64_t last_number = 0;
    for (std::size_t m = 0; m < inspection.meshes.size(); ++m) {
        const InspectedMesh& inspected = inspection.meshes[m];
        const shadows::ShadowMesh& mesh = *inspected.shadow_mesh;
        const shadows::MeshReport& r = mesh.report();
        const std::string name = one_line(inspected.mesh->name);
        fmt::format_to(std::back_inserter(text),
                       "# mesh {} \"{}\": {} boundary, {} non_manifold, {} inconsistent edges, {} "
                       "degenerate faces\n",
                       m, name, r.boundary_edges, r.non_manifold_edges, r.inconsistent_edges,
                       r.degenerate_faces);
        const std::string prefix = fmt::format("{}_{}", m, one_word(name));
        for (const auto& [kind, kind_name] : kinds) {
            std::vector<Element> lines;
            for (const shadows::Edge& edge : mesh.edges()) {
                if (edge_kind(mesh.uses(edge)) == kind) {
                    lines.push_back({edge.low, edge.high, edge.high});
                }
            }
            append_object(text, inspected, fmt::format("{}_{}", prefix, kind_name), lines,
                          last_number);
        }
        std::vector<Element> faces;
        for (std::size_t f = 0; f < mesh.faces().size(); ++f) {
            if (mesh.is_degenerate(f)) faces.push_back(mesh.faces()[f]);
        }
        append_object(text, inspected, prefix + "_degenerate", faces, last_number);
    }
    return text;
}

}  // namespace gnomon::cli
