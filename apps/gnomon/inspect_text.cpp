// SPDX-License-Identifier: MIT
//
// gnomon inspect as text: figures a mesh, the worst of its components, and at the end what it all
// means for shadows, each thing said once.
#include <algorithm>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "arguments.hpp"
#include "inspection.hpp"

namespace gnomon::cli {

namespace {

using shadows::CasterKind;
using shadows::Component;

constexpr std::size_t most_components = 5;

std::string_view in_words(CasterKind kind) {
    switch (kind) {
        case CasterKind::Nothing: return "without area";
        case CasterKind::OneSided: return "closed";
        case CasterKind::InsideOut: return "inside out";
        case CasterKind::TwoSided: break;
    }
    return "two-sided";
}

std::string casting_of(const shadows::MeshReport& report) {
    if (report.components == 0) return "casts nothing";
    if (report.closed()) return "closed: casts one-sided";
    if (report.closed_components == 0) return "casts two-sided";
    return fmt::format("{} of {} components closed, the others cast two-sided",
                       report.closed_components, report.components);
}

/// Indented, in lines of at most 100 columns.
void append_wrapped(std::string& text, std::string_view label, std::string_view sentences) {
    constexpr std::size_t columns = 100;
    std::string line = fmt::format("  {}", label);
    while (!sentences.empty()) {
        const std::size_t end = std::min(sentences.find(' '), sentences.size());
        const std::string_view word = sentences.substr(0, end);
        sentences.remove_prefix(std::min(end + 1, sentences.size()));
        if (line.size() + word.size() > columns) {
            line.back() = '\n';
            text += line;
            line = "    ";
        }
        line += word;
        line += ' ';
    }
    line.back() = '\n';
    text += line;
}

void append_row(std::string& text, std::string_view label, const shadows::CastingCost& cost) {
    using shadows::CastingCost;
    const auto figure = [](std::uint64_t total, std::uint64_t largest) {
        return fmt::format("{:.1f} / {}", CastingCost::mean(total), largest);
    };
    const shadows::VolumeSize& total = cost.total;
    const shadows::VolumeSize& largest = cost.largest;
    fmt::format_to(std::back_inserter(text), "    {:<16}{:>20}{:>20}{:>20}{:>24}\n", label,
                   figure(total.silhouette_edges, largest.silhouette_edges),
                   figure(total.side_quads, largest.side_quads),
                   figure(total.cap_triangles, largest.cap_triangles),
                   figure(total.index_bytes(), cost.largest_index_bytes));
}

void append_cost(std::string& text, const shadows::MeshCost& mesh) {
    const shadows::CasterCost& cost = mesh.mesh;
    fmt::format_to(std::back_inserter(text), "  {:<18}{:>20}{:>20}{:>20}{:>24}\n",
                   "volume of a light", "silhouette edges", "side quads", "cap triangles",
                   "index bytes");
    append_row(text, "as it casts", cost.as_it_casts);
    if (cost.as_it_casts.total != cost.two_sided.total) {
        append_row(text, "all two-sided", cost.two_sided);
    }
    fmt::format_to(std::back_inserter(text), "  layers over a point: at most {}{}\n",
                   mesh.most_layers,
                   mesh.most_layers > 255 ? ", more than a stencil counts: drawn in batches" : "");
}

std::uint64_t offences(const Component& c) {
    return c.boundary_edges + c.non_manifold_edges + c.inconsistent_edges + c.degenerate_faces;
}

std::string place_of(const InspectedMesh& inspected, const Component& c) {
    const glm::dvec3 min = inspected.mesh->origin + glm::dvec3(c.bounds_min);
    const glm::dvec3 max = inspected.mesh->origin + glm::dvec3(c.bounds_max);
    return fmt::format("({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g})", min.x, min.y, min.z,
                       max.x, max.y, max.z);
}

void append_components(std::string& text, const InspectedMesh& inspected) {
    const auto components = inspected.shadow_mesh->components();
    if (components.size() < 2) return;
    const auto kinds = count_kinds(*inspected.shadow_mesh);
    text += "  components by kind:";
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        if (kinds[kind] == 0) continue;
        fmt::format_to(std::back_inserter(text), "{} {} {}", text.back() == ':' ? "" : ",",
                       kinds[kind], in_words(static_cast<CasterKind>(kind)));
    }
    text += "\n";

    std::vector<std::size_t> worst;
    for (std::size_t i = 0; i < components.size(); ++i) {
        if (offences(components[i]) > 0) worst.push_back(i);
    }
    const std::size_t shown = std::min(worst.size(), most_components);
    std::partial_sort(worst.begin(), worst.begin() + static_cast<std::ptrdiff_t>(shown),
                      worst.end(), [&](std::size_t a, std::size_t b) {
                          const std::uint64_t of_a = offences(components[a]);
                          const std::uint64_t of_b = offences(components[b]);
                          return of_a != of_b ? of_a > of_b : a < b;
                      });
    for (std::size_t i = 0; i < shown; ++i) {
        const Component& c = components[worst[i]];
        fmt::format_to(std::back_inserter(text),
                       "    #{}: {}, {} faces, boundary edges {}, non-manifold {}, inconsistently "
                       "wound {}, degenerate faces {}; from {}\n",
                       worst[i], in_words(caster_kind(c)), c.faces, c.boundary_edges,
                       c.non_manifold_edges, c.inconsistent_edges, c.degenerate_faces,
                       place_of(inspected, c));
    }
    if (worst.size() > shown) {
        fmt::format_to(std::back_inserter(text), "    and {} more like these; --json has all\n",
                       worst.size() - shown);
    }
}

void append_mesh(std::string& text, const InspectedMesh& inspected) {
    const shadows::MeshReport& r = inspected.shadow_mesh->report();
    auto out = std::back_inserter(text);
    fmt::format_to(out, "\nmesh \"{}\", used {} time{}: {}\n", one_line(inspected.mesh->name),
                   inspected.instances, inspected.instances == 1 ? "" : "s", casting_of(r));
    fmt::format_to(
        out,
        "  triangles {}, vertices {} (welded {}), edges {}, components {} (closed {})\n"
        "  boundary edges {}, non-manifold {}, inconsistently wound {}, unbalanced {}, degenerate "
        "faces {}\n",
        r.triangles, r.vertices, r.welded_vertices, r.edges, r.components, r.closed_components,
        r.boundary_edges, r.non_manifold_edges, r.inconsistent_edges, r.unbalanced_edges,
        r.degenerate_faces);
    append_components(text, inspected);
    if (inspected.alpha_tested) text += "  alpha-tested: its shadow is that of whole triangles\n";
    if (r.components > 0) append_cost(text, inspected.cost);
}

}  // namespace

std::string as_text(const Inspection& inspection) {
    std::string text = fmt::format("{}: {} nodes, {} meshes, {} triangles drawn, {} lights\n",
                                   inspection.model, inspection.nodes, inspection.meshes.size(),
                                   inspection.drawn_triangles, inspection.lights);
    if (!inspection.bounds.empty()) {
        const glm::dvec3 size = inspection.bounds.max - inspection.bounds.min;
        text += fmt::format("size: {:.6g} x {:.6g} x {:.6g} m\n", size.x, size.y, size.z);
    }
    bool anything_casts = false;
    bool anything_closed = false;
    for (const InspectedMesh& mesh : inspection.meshes) {
        append_mesh(text, mesh);
        anything_casts = anything_casts || mesh.shadow_mesh->report().components > 0;
        anything_closed = anything_closed || mesh.shadow_mesh->report().closed_components > 0;
    }
    if (anything_casts) {
        text += "\nvolumes: mean / largest\n";
        append_wrapped(
            text, "",
            fmt::format("Over {} distant lights all around, each figure by itself. Cap triangles "
                        "are those of the near cap, index bytes those of the sides and both caps.",
                        shadows::sample_direction_count));
        if (anything_closed) {
            append_wrapped(text, "",
                           "A closed component casts two-sided while a point light is within its "
                           "bounds.");
        }
    }
    for (const Finding& finding : findings(inspection)) {
        text += fmt::format("\n{}: {}\n", finding.title, finding.count);
        append_wrapped(text, "", finding.what);
        append_wrapped(text, "For shadows: ", finding.shadows);
        append_wrapped(text, "To do: ", finding.advice);
    }
    for (const std::string& message : inspection.messages) text += "\nnote: " + one_line(message);
    if (!inspection.messages.empty()) text += "\n";
    return text;
}

}  // namespace gnomon::cli
