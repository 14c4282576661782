// SPDX-License-Identifier: MIT
//
// What the blocks of C++ in docs/ecs.md take as given: the names that the text around a block has
// spoken of, and no `using namespace`. A name that the guide uses newly is added here.
#pragma once

#include <cstdint>
#include <memory>

#include <entt/entt.hpp>  // the stand-in of tests/examples

#include <gnomon/shadows/shadow_system.hpp>

namespace contexts {

struct ecs {
    struct Pose {
        glm::dmat4 world_from_local;
    };
    struct Shape {
        std::shared_ptr<const gnomon::shadows::ShadowMesh> mesh;
    };
    struct Lamp {};
    entt::registry& registry;
    gnomon::shadows::ShadowSystem& system;
    gnomon::shadows::View view;
};

}  // namespace contexts
