// SPDX-License-Identifier: MIT
//
// What the blocks of C++ in the guides take as given: one struct a document, named after it, with
// the names that the text around a block has spoken of. check_snippets.cmake makes a function of
// each block, within a struct that inherits this one. A name that a guide uses newly is added here.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include <entt/entt.hpp>  // the stand-in of tests/examples

#include <gnomon/gl/backend.hpp>
#include <gnomon/gl/host_target.hpp>
#include <gnomon/shadow_pass/guest_pass.hpp>
#include <gnomon/shadow_pass/light_masks.hpp>
#include <gnomon/shadows/facing.hpp>
#include <gnomon/shadows/shadow_query.hpp>
#include <gnomon/shadows/silhouette.hpp>
#include <gnomon/shadows/volume.hpp>
#include <gnomon/vk/host_device.hpp>

using namespace gnomon;

extern "C" {
void (*glfwGetProcAddress(const char*))();
void glEnable(unsigned);
void glStencilFunc(unsigned, int, unsigned);
void glBlendFunc(unsigned, unsigned);
void glDepthFunc(unsigned);
void glDepthMask(unsigned char);
}
enum : unsigned { GL_FALSE, GL_ONE, GL_BLEND, GL_EQUAL, GL_STENCIL_TEST };

namespace contexts {

struct ecs {
    struct Pose {
        glm::dmat4 world_from_local;
    };
    struct Shape {
        std::shared_ptr<const shadows::ShadowMesh> mesh;
    };
    struct Lamp {};
    entt::registry& registry;
    shadows::ShadowSystem& system;
    shadows::View view;
};

struct embedding {
    struct Thing {
        std::uint64_t id;
        std::shared_ptr<const shadows::ShadowMesh> shadow_mesh;
        glm::dmat4 pose;
    };
    std::vector<Thing> things;
    glm::dvec4 lamp;
    std::uint32_t w, h, framebuffer;
    glm::dmat4 view_matrix, projection;
    gpu::TextureDesc desc;
    std::uint64_t image;
    std::uint32_t layout;
    shadows::HostConventions conventions;
    std::uint32_t texture;
    void* commands;
    static constexpr std::uint32_t VK_FORMAT_B8G8R8A8_SRGB = 50;
    static void vkCmdBeginRendering(void*, std::nullptr_t);
    static void vkCmdEndRendering(void*);
    // What the blocks before have made.
    gpu::Device& device;
    Result<gpu::Texture>& target;
    Result<shadows::ShadowSystem>& system;
    Result<shadow_pass::GuestPass>& pass;
    Result<vk::AdoptedDevice>& adopted;
    const shadows::DrawList& list;
    Result<shadows::HostView>& view;
    std::size_t light;
};

/// Of docs/ten-minutes.md; as there, `must` ends the program.
struct Must {
    template <class T>
    T operator()(Result<T> result) const {
        if constexpr (!std::is_void_v<T>) return std::move(*result);
    }
};
struct ten_minutes {
    struct Thing {
        std::uint64_t id;
        std::shared_ptr<const shadows::ShadowMesh> shadow_mesh;
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
    Must must;
    gpu::Device& device;
    gpu::Texture target;
    shadows::HostConventions conventions;
    shadow_pass::GuestPass& pass;
    shadows::ShadowSystem& system;
};

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
