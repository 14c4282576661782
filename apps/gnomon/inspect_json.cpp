// SPDX-License-Identifier: MIT
//
// gnomon inspect --json: all of it, components included. Members may be added, none taken away.
#include <nlohmann/json.hpp>

#include "inspection.hpp"

namespace gnomon::cli {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const shadows::CastingCost& cost) {
    using shadows::CastingCost;
    const shadows::VolumeSize& total = cost.total;
    const shadows::VolumeSize& largest = cost.largest;
    return {{"mean",
             {{"silhouette_edges", CastingCost::mean(total.silhouette_edges)},
              {"side_quads", CastingCost::mean(total.side_quads)},
              {"cap_triangles", CastingCost::mean(total.cap_triangles)},
              {"index_bytes", CastingCost::mean(total.index_bytes())}}},
            {"largest",
             {{"silhouette_edges", largest.silhouette_edges},
              {"side_quads", largest.side_quads},
              {"cap_triangles", largest.cap_triangles},
              {"index_bytes", cost.largest_index_bytes}}}};
}

Json json_of(const shadows::CasterCost& cost) {
    return {{"as_it_casts", json_of(cost.as_it_casts)}, {"two_sided", json_of(cost.two_sided)}};
}

Json json_of(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

Json components_of(const InspectedMesh& inspected) {
    Json list = Json::array();
    const auto components = inspected.shadow_mesh->components();
    for (std::size_t i = 0; i < components.size(); ++i) {
        const shadows::Component& c = components[i];
        const glm::dvec3& origin = inspected.mesh->origin;
        list.push_back({{"casts", name_of(caster_kind(c))},
                        {"faces", c.faces},
                        {"edges", c.edges},
                        {"closed", c.closed},
                        {"inside_out", c.inside_out},
                        {"boundary_edges", c.boundary_edges},
                        {"non_manifold_edges", c.non_manifold_edges},
                        {"inconsistent_edges", c.inconsistent_edges},
                        {"unbalanced_edges", c.unbalanced_edges},
                        {"degenerate_faces", c.degenerate_faces},
                        {"bounds_min", json_of(origin + glm::dvec3(c.bounds_min))},
                        {"bounds_max", json_of(origin + glm::dvec3(c.bounds_max))},
                        {"cost", json_of(inspected.cost.components[i])}});
    }
    return list;
}

}  // namespace

std::string as_json(const Inspection& inspection) {
    Json meshes = Json::array();
    for (const InspectedMesh& inspected : inspection.meshes) {
        const shadows::MeshReport& r = inspected.shadow_mesh->report();
        Json kinds;
        const auto counts = count_kinds(*inspected.shadow_mesh);
        for (std::size_t kind = 0; kind < counts.size(); ++kind) {
            kinds[std::string(name_of(static_cast<shadows::CasterKind>(kind)))] = counts[kind];
        }
        meshes.push_back({{"name", inspected.mesh->name},
                          {"instances", inspected.instances},
                          {"triangles", r.triangles},
                          {"vertices", r.vertices},
                          {"welded_vertices", r.welded_vertices},
                          {"edges", r.edges},
                          {"components", r.components},
                          {"closed_components", r.closed_components},
                          {"closed", r.closed()},
                          {"boundary_edges", r.boundary_edges},
                          {"non_manifold_edges", r.non_manifold_edges},
                          {"inconsistent_edges", r.inconsistent_edges},
                          {"unbalanced_edges", r.unbalanced_edges},
                          {"degenerate_faces", r.degenerate_faces},
                          {"alpha_tested", inspected.alpha_tested},
                          {"components_by_kind", kinds},
                          {"cost", json_of(inspected.cost.mesh)},
                          {"most_layers", inspected.cost.most_layers},
                          {"component_list", components_of(inspected)}});
    }
    Json found = Json::array();
    for (const Finding& finding : findings(inspection)) {
        found.push_back({{"kind", finding.kind},
                         {"count", finding.count},
                         {"meshes", finding.meshes},
                         {"title", finding.title},
                         {"what", finding.what},
                         {"shadows", finding.shadows},
                         {"advice", finding.advice}});
    }
    const Json json{{"model", inspection.model},
                    {"nodes", inspection.nodes},
                    {"lights", inspection.lights},
                    {"drawn_triangles", inspection.drawn_triangles},
                    {"cost_directions", shadows::sample_direction_count},
                    {"meshes", meshes},
                    {"findings", found},
                    {"messages", inspection.messages}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace gnomon::cli
