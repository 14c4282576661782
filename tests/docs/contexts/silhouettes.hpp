// SPDX-License-Identifier: MIT
//
// What the blocks of C++ in docs/silhouettes.md take as given: the names that the text around a
// block has spoken of. A name that the guide uses newly is added here.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <gnomon/shadows/facing.hpp>
#include <gnomon/shadows/silhouette.hpp>
#include <gnomon/shadows/volume.hpp>

using namespace gnomon;  // the page has no program around its lines

namespace contexts {

struct silhouettes {
    std::vector<glm::vec3> corners;
    std::vector<std::uint32_t> indices;
    // What the blocks before have made.
    std::shared_ptr<const shadows::ShadowMesh> mesh;
    shadows::LightLocal lamp;
    shadows::Facing facing;
    std::vector<shadows::SilhouetteEdge> silhouette;
};

}  // namespace contexts
