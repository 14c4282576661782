// SPDX-License-Identifier: MIT
//
// One mesh of a glTF file, all its primitives together.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gnomon/scene/mesh.hpp>

#include "internal/gltf_model.hpp"

namespace gnomon::scene::internal {

/// Which joints move a vertex, and how much: up to two sets of four; the rest have weight 0.
struct Influence {
    std::array<std::uint32_t, 8> joints{};
    std::array<float, 8> weights{};
};

struct BuiltMesh {
    std::shared_ptr<const Mesh> mesh;   ///< null when there is not one triangle
    std::vector<Influence> influences;  ///< one per position; empty unless asked for and there
    bool has_morph_targets = false;
};

/// Reads each mesh once, when it is first asked for. Throws InputError.
class MeshReader {
public:
    MeshReader(const GltfModel& model, std::vector<std::string>& messages);

    /// `with_influences` must be the same in every call for one mesh.
    const BuiltMesh& read(int mesh, bool with_influences);

private:
    /// Many primitives may share one accessor, so a small file can describe a huge scene: what is
    /// read in all is held against this.
    void spend(std::size_t elements, const std::string& place);

    friend class MeshBuilder;
    const GltfModel& model_;
    std::vector<std::string>& messages_;
    std::map<int, BuiltMesh> built_;
    std::size_t limit_ = 0;
    std::size_t spent_ = 0;
};

}  // namespace gnomon::scene::internal
