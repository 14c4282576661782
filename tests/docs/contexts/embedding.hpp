// SPDX-License-Identifier: MIT
//
// What the blocks of C++ in docs/embedding.md take as given: the names that the text around a block
// has spoken of, and no header that the reader has to include. A name that the guide uses newly is
// added here.
#pragma once

#include <cstdint>
#include <vector>

#include "opengl.hpp"

namespace contexts {

struct embedding {
    struct Thing {
        std::uint64_t id;
        std::shared_ptr<const gnomon::shadows::ShadowMesh> shadow_mesh;
        glm::dmat4 pose;
    };
    std::vector<Thing> things;
    glm::dvec4 lamp;
    std::uint32_t w, h, framebuffer;
    glm::dmat4 view_matrix, projection;
    gnomon::gpu::TextureDesc desc;
    std::uint64_t image;
    std::uint32_t layout;
    gnomon::shadows::HostConventions conventions;
    std::uint32_t texture;
    void* commands;
    static constexpr std::uint32_t VK_FORMAT_B8G8R8A8_SRGB = 50;
    static void vkCmdBeginRendering(void*, std::nullptr_t);
    static void vkCmdEndRendering(void*);
    // What the blocks before have made.
    gnomon::gpu::Device& device;
    gnomon::Result<gnomon::gpu::Texture>& target;
    gnomon::Result<gnomon::shadows::ShadowSystem>& system;
    gnomon::Result<gnomon::shadow_pass::GuestPass>& pass;
    gnomon::Result<gnomon::vk::AdoptedDevice>& adopted;
    const gnomon::shadows::DrawList& list;
    gnomon::Result<gnomon::shadows::HostView>& view;
    std::size_t light;
};

}  // namespace contexts
