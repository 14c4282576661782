// SPDX-License-Identifier: MIT
//
// One mesh of a glTF file, all its primitives together.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gnomon/scene/mesh.hpp>

#include "internal/gltf_model.hpp"

namespace gnomon::scene::internal {

/// Reads each mesh once, when it is first asked for. Throws InputError.
class MeshReader {
public:
    MeshReader(const GltfModel& model, std::vector<std::string>& messages);

    /// Null when there is not one triangle. `with_influences`: joints and weights are read as well;
    /// it must be the same in every call for one mesh.
    const std::shared_ptr<const Mesh>& read(int mesh, bool with_influences);

private:
    /// Many primitives may share one accessor, so a small file can describe a huge scene: what is
    /// read in all is held against this.
    void spend(std::size_t elements, const std::string& place);

    friend class MeshBuilder;
    const GltfModel& model_;
    std::vector<std::string>& messages_;
    std::map<int, std::shared_ptr<const Mesh>> built_;
    std::size_t limit_ = 0;
    std::size_t spent_ = 0;
};

}  // namespace gnomon::scene::internal
