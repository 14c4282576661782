// SPDX-License-Identifier: MIT
//
// gnomon inspect: what shadows know of a model's meshes.
#include "inspect_command.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <gnomon/scene/scene_description.hpp>
#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/scene/transforms.hpp>

#include "arguments.hpp"

namespace gnomon::cli {

namespace {

struct MeshEntry {
    std::shared_ptr<const scene::Mesh> mesh;
    shadows::MeshReport report;
    std::uint64_t instances = 0;
    bool alpha_tested = false;
};

struct Inspection {
    std::vector<MeshEntry> meshes;
    std::uint64_t nodes = 0;
    std::uint64_t lights = 0;
    std::uint64_t drawn_triangles = 0;
    scene::Bounds bounds;
    std::vector<std::string> messages;
};

Result<Inspection> look(const std::string& model) {
    auto loaded = scene::load_scene(model);
    if (!loaded) return forward_error(loaded);
    scene::Scene& scene = *loaded;
    scene::update_world_transforms(scene.registry);
    Inspection result;
    result.messages = scene.messages;
    result.nodes = scene.registry.count<scene::LocalTransform>();
    result.lights = scene.registry.count<scene::PointLight>() +
                    scene.registry.count<scene::SpotLight>() +
                    scene.registry.count<scene::DirectionalLight>();
    result.bounds = scene::world_bounds(scene);

    scene::ShadowAdapter adapter;
    std::map<const scene::Mesh*, std::size_t> known;
    Status status;
    scene.registry.each<scene::MeshInstance>(
        [&](scene::Entity, const scene::MeshInstance& instance) {
            result.drawn_triangles += instance.mesh->triangle_count();
            const auto [at, is_new] = known.try_emplace(instance.mesh.get(), result.meshes.size());
            if (is_new) {
                auto shadow_mesh = adapter.shadow_mesh(instance.mesh);
                if (!shadow_mesh) {
                    if (status) {
                        status = fail(shadow_mesh.error().code,
                                      fmt::format("{}: {}", model, shadow_mesh.error().message));
                    }
                    result.meshes.push_back({instance.mesh, {}, 0, false});
                    return;
                }
                const auto& subs = instance.mesh->sub_meshes;
                const bool tested =
                    std::any_of(subs.begin(), subs.end(), [&](const scene::SubMesh& sub) {
                        return scene.materials[sub.material].alpha_mode == scene::AlphaMode::Mask;
                    });
                result.meshes.push_back({instance.mesh, (*shadow_mesh)->report(), 0, tested});
            }
            ++result.meshes[at->second].instances;
        });
    if (!status) return forward_error(status);
    return result;
}

std::string casting_of(const shadows::MeshReport& report) {
    if (report.components == 0) return "casts nothing";
    if (report.closed()) return "closed: casts one-sided";
    if (report.closed_components == 0) return "casts two-sided";
    return fmt::format("{} of {} components closed, the others cast two-sided",
                       report.closed_components, report.components);
}

std::string as_text(const std::string& model, const Inspection& inspection) {
    std::string text = fmt::format("{}: {} nodes, {} meshes, {} triangles drawn, {} lights\n",
                                   model, inspection.nodes, inspection.meshes.size(),
                                   inspection.drawn_triangles, inspection.lights);
    if (!inspection.bounds.empty()) {
        const glm::dvec3 size = inspection.bounds.max - inspection.bounds.min;
        text += fmt::format("size: {:.6g} x {:.6g} x {:.6g} m\n", size.x, size.y, size.z);
    }
    for (const MeshEntry& entry : inspection.meshes) {
        const shadows::MeshReport& r = entry.report;
        text += fmt::format("\nmesh \"{}\", used {} time{}: {}\n", one_line(entry.mesh->name),
                            entry.instances, entry.instances == 1 ? "" : "s", casting_of(r));
        text += fmt::format(
            "  triangles {}, vertices {} (welded {}), edges {}, components {} (closed {})\n",
            r.triangles, r.vertices, r.welded_vertices, r.edges, r.components, r.closed_components);
        text += fmt::format(
            "  boundary edges {}, non-manifold {}, inconsistently wound {}, unbalanced {}, "
            "degenerate faces {}\n",
            r.boundary_edges, r.non_manifold_edges, r.inconsistent_edges, r.unbalanced_edges,
            r.degenerate_faces);
        if (entry.alpha_tested) text += "  alpha-tested: its shadow is that of whole triangles\n";
    }
    for (const std::string& message : inspection.messages) text += "\nnote: " + one_line(message);
    if (!inspection.messages.empty()) text += "\n";
    return text;
}

std::string as_json(const std::string& model, const Inspection& inspection) {
    using Json = nlohmann::ordered_json;
    Json meshes = Json::array();
    for (const MeshEntry& entry : inspection.meshes) {
        const shadows::MeshReport& r = entry.report;
        meshes.push_back({{"name", entry.mesh->name},
                          {"instances", entry.instances},
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
                          {"alpha_tested", entry.alpha_tested}});
    }
    const Json json{{"model", model},
                    {"nodes", inspection.nodes},
                    {"lights", inspection.lights},
                    {"drawn_triangles", inspection.drawn_triangles},
                    {"meshes", meshes},
                    {"messages", inspection.messages}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

Result<std::string> inspect(const InspectOptions& options) {
    auto inspection = look(options.model);
    if (!inspection) return forward_error(inspection);
    return options.json ? as_json(options.model, *inspection) : as_text(options.model, *inspection);
}

}  // namespace gnomon::cli
