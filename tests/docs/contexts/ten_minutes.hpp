// SPDX-License-Identifier: MIT
//
// What the blocks of C++ in docs/ten-minutes.md take as given: the names that the text around a
// block has spoken of, and no header that the reader has to include. A name that the guide uses
// newly is added here.
#pragma once

#include <cstdint>
#include <vector>

#include "opengl.hpp"

namespace contexts {

struct ten_minutes {
    struct Thing {
        std::uint64_t id;
        std::shared_ptr<const gnomon::shadows::ShadowMesh> shadow_mesh;
        glm::mat4 model;
    };
    struct Vertex {
        glm::vec3 position;
        glm::vec2 texcoord;
    };
    std::vector<Thing> things;
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    std::uint32_t width, height;
    glm::mat4 view, projection;
    glm::vec3 sun;
    // What the blocks before have made.
    gnomon::gpu::Device& device;
    gnomon::gpu::Texture target;
    gnomon::shadows::HostConventions conventions;
    std::optional<gnomon::shadow_pass::GuestPass>& pass;
    gnomon::shadows::ShadowSystem& system;
};

}  // namespace contexts
