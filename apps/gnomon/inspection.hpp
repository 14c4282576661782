// SPDX-License-Identifier: MIT
//
// What gnomon inspect finds out about a model: plain data, and what it looks like as text, JSON and
// OBJ.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <gnomon/core/result.hpp>
#include <gnomon/scene/scene.hpp>
#include <gnomon/shadows/casting_cost.hpp>
#include <gnomon/shadows/shadow_mesh.hpp>
#include <gnomon/shadows/topology.hpp>

namespace gnomon::cli {

struct InspectedMesh {
    std::shared_ptr<const scene::Mesh> mesh;
    std::shared_ptr<const shadows::ShadowMesh> shadow_mesh;
    shadows::MeshCost cost;
    std::uint64_t instances = 0;
    bool alpha_tested = false;
};

struct Inspection {
    std::string model;
    std::vector<InspectedMesh> meshes;
    std::uint64_t nodes = 0;
    std::uint64_t lights = 0;
    std::uint64_t drawn_triangles = 0;
    scene::Bounds bounds;
    std::vector<std::string> messages;
};

/// Reads a model and looks at each of its meshes once, however many nodes use it. Errors as
/// scene::load_scene and ShadowMesh::build, with the model's name.
[[nodiscard]] Result<Inspection> look_into(const std::string& model);

/// How many components cast in which way, by shadows::CasterKind.
[[nodiscard]] std::array<std::uint64_t, 4> count_kinds(const shadows::ShadowMesh& mesh);
[[nodiscard]] std::string_view name_of(shadows::CasterKind kind);

/// Something that people ask about, over all meshes of a model. The texts are whole sentences.
struct Finding {
    std::string_view kind;     ///< a stable name: "boundary", "two_sided", …
    std::string_view title;    ///< of the count
    std::string_view what;     ///< what is counted
    std::string_view shadows;  ///< what it means for them
    std::string_view advice;   ///< what to do about it, if anything
    std::uint64_t count = 0;
    std::uint64_t meshes = 0;  ///< in how many
};

/// Those that occur, in a fixed order.
[[nodiscard]] std::vector<Finding> findings(const Inspection& inspection);

[[nodiscard]] std::string as_text(const Inspection& inspection);
[[nodiscard]] std::string as_json(const Inspection& inspection);
/// The offending edges as lines and the faces without area, in each mesh's own space: one object a
/// mesh and kind.
[[nodiscard]] std::string as_obj(const Inspection& inspection);

}  // namespace gnomon::cli
