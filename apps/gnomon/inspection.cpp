// SPDX-License-Identifier: MIT
#include "inspection.hpp"

#include <algorithm>
#include <unordered_map>

#include <fmt/format.h>

#include <gnomon/scene/scene_description.hpp>
#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/scene/transforms.hpp>

namespace gnomon::cli {

namespace {

using shadows::CasterKind;

bool is_alpha_tested(const scene::Scene& scene, const scene::Mesh& mesh) {
    return std::any_of(
        mesh.sub_meshes.begin(), mesh.sub_meshes.end(), [&](const scene::SubMesh& sub) {
            return scene.materials[sub.material].alpha_mode == scene::AlphaMode::Mask;
        });
}

std::uint64_t count_of(CasterKind kind, const InspectedMesh& mesh) {
    return count_kinds(*mesh.shadow_mesh)[static_cast<std::size_t>(kind)];
}

struct FindingRow {
    Finding finding;
    std::uint64_t (*count)(const InspectedMesh&);
};

const std::array<FindingRow, 7>& finding_rows() {
    static const std::array<FindingRow, 7> rows{{
        {{.kind = "boundary",
          .title = "boundary edges",
          .what = "They have one face only: a hole, a rim, the border of a sheet, or a seam whose "
                  "two sides are not equal to the last bit.",
          .shadows = "Nothing leaks: what they belong to casts two-sided. Light passes through "
                     "holes as it would through real ones.",
          .advice = "Merge vertices by distance, and fill the holes that are not meant. Leaves and "
                    "cloth may stay open."},
         [](const InspectedMesh& m) { return m.shadow_mesh->report().boundary_edges; }},
        {{.kind = "non_manifold",
          .title = "non-manifold edges",
          .what = "They have three faces or more: an inner wall, a fin, solids that touch along an "
                  "edge, or faces listed twice.",
          .shadows = "Nothing leaks. Where the faces cancel in pairs, as between two solids that "
                     "touch, casting stays one-sided; otherwise it is two-sided.",
          .advice = "Remove doubled and inner faces, or split the mesh along these edges."},
         [](const InspectedMesh& m) { return m.shadow_mesh->report().non_manifold_edges; }},
        {{.kind = "inconsistent",
          .title = "inconsistently wound edges",
          .what = "Their two faces are wound against each other: one of them shows its back.",
          .shadows = "Nothing leaks, and the shadow is the same: casting is two-sided. Drawn "
                     "without back faces, the picture has holes there that cast all the same.",
          .advice = "Recalculate normals to the outside. What has no outside, as a Moebius strip, "
                    "may stay."},
         [](const InspectedMesh& m) { return m.shadow_mesh->report().inconsistent_edges; }},
        {{.kind = "degenerate",
          .title = "degenerate faces",
          .what = "They have no area: corners coincide, or lie exactly on one line.",
          .shadows = "They cast nothing and cost next to nothing. They may be what holds their "
                     "neighbours together, so that these stay closed.",
          .advice = "Leave them, or dissolve them so that their neighbours are joined; just "
                    "deleted, they leave holes."},
         [](const InspectedMesh& m) { return m.shadow_mesh->report().degenerate_faces; }},
        {{.kind = "inside_out",
          .title = "components inside out",
          .what = "They are closed and wound inwards.",
          .shadows = "The shadow is right: the faces turned away from the light cast. For the "
                     "inner wall of a hollow body, that is how it should be.",
          .advice =
              "Flip the normals of an outer surface: not its shadow is wrong, but its lighting."},
         [](const InspectedMesh& m) { return count_of(CasterKind::InsideOut, m); }},
        {{.kind = "two_sided",
          .title = "two-sided components",
          .what = "They are not closed, so every face casts, whichever way it looks.",
          .shadows = "The shadow is right: it is that of the surface, not of a solid. A two-sided "
                     "volume is about twice as large as that of a closed body of the same faces, "
                     "and counts each surface on the way to the light where a closed one counts "
                     "each body, so that half as many fill the 255 layers of an 8-bit stencil.",
          .advice = "Close, and wind consistently, what is drawn often and large."},
         [](const InspectedMesh& m) { return count_of(CasterKind::TwoSided, m); }},
        {{.kind = "alpha_tested",
          .title = "alpha-tested meshes",
          .what = "Parts of them are cut out by a texture.",
          .shadows = "Their shadow is that of whole triangles: the cut-out parts cast as well.",
          .advice = "Model the outline where the shadow should show it."},
         [](const InspectedMesh& m) { return std::uint64_t{m.alpha_tested ? 1U : 0U}; }},
    }};
    return rows;
}

}  // namespace

Result<Inspection> look_into(const std::string& model) {
    auto loaded = scene::load_scene(model);
    if (!loaded) return forward_error(loaded);
    scene::Scene& scene = *loaded;
    scene::update_world_transforms(scene.registry);
    Inspection result;
    result.model = model;
    result.messages = scene.messages;
    result.nodes = scene.registry.count<scene::LocalTransform>();
    result.lights = scene.registry.count<scene::PointLight>() +
                    scene.registry.count<scene::SpotLight>() +
                    scene.registry.count<scene::DirectionalLight>();
    result.bounds = scene::world_bounds(scene);

    std::unordered_map<const scene::Mesh*, std::size_t> known;
    scene.registry.each<scene::MeshInstance>(
        [&](scene::Entity, const scene::MeshInstance& instance) {
            result.drawn_triangles += instance.mesh->triangle_count();
            const auto [at, is_new] = known.try_emplace(instance.mesh.get(), result.meshes.size());
            if (is_new) {
                result.meshes.push_back({.mesh = instance.mesh,
                                         .shadow_mesh = nullptr,
                                         .cost = {},
                                         .alpha_tested = is_alpha_tested(scene, *instance.mesh)});
            }
            ++result.meshes[at->second].instances;
        });
    scene::ShadowAdapter adapter;
    for (InspectedMesh& inspected : result.meshes) {
        auto shadow_mesh = adapter.shadow_mesh(inspected.mesh);
        if (!shadow_mesh) {
            return fail(shadow_mesh.error().code,
                        fmt::format("{}: {}", model, shadow_mesh.error().message));
        }
        inspected.shadow_mesh = std::move(*shadow_mesh);
        inspected.cost = shadows::measure_cost(*inspected.shadow_mesh);
    }
    return result;
}

std::array<std::uint64_t, 4> count_kinds(const shadows::ShadowMesh& mesh) {
    std::array<std::uint64_t, 4> counts{};
    for (const shadows::Component& component : mesh.components()) {
        ++counts[static_cast<std::size_t>(caster_kind(component))];
    }
    return counts;
}

std::string_view name_of(CasterKind kind) {
    switch (kind) {
        case CasterKind::Nothing: return "nothing";
        case CasterKind::OneSided: return "one_sided";
        case CasterKind::InsideOut: return "inside_out";
        case CasterKind::TwoSided: break;
    }
    return "two_sided";
}

std::vector<Finding> findings(const Inspection& inspection) {
    std::vector<Finding> found;
    for (const FindingRow& row : finding_rows()) {
        Finding finding = row.finding;
        for (const InspectedMesh& mesh : inspection.meshes) {
            const std::uint64_t count = row.count(mesh);
            finding.count += count;
            finding.meshes += count > 0 ? 1U : 0U;
        }
        if (finding.count > 0) found.push_back(finding);
    }
    return found;
}

}  // namespace gnomon::cli
