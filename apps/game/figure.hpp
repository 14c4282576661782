// SPDX-License-Identifier: MIT
//
// Figures: one skinned mesh of few triangles, made anew as a shadow mesh in every tick, on the
// skeleton and gait of gnomon's built-in walker. The gait goes by the way that was walked, so that
// feet stand still on the ground.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>
#include <gnomon/scene/scene.hpp>

namespace gnomon::game {

/// The joints of the built-in walker and how they move in one cycle of its gait.
struct Skeleton {
    struct Joint {
        std::string name;
        int parent = -1;        ///< an earlier joint
        glm::dvec3 place{0.0};  ///< at rest, in the figure's space: feet on y = 0, looks along +Z
        int rotation = -1;      ///< of `samplers`
        int translation = -1;
    };
    std::vector<Joint> joints;
    std::shared_ptr<const std::vector<scene::AnimationSampler>> samplers;
    double cycle_s = 1.0;
    double stride_m = 1.0;  ///< by which a cycle brings it ahead

    /// Its place among the joints. Must be there.
    [[nodiscard]] std::size_t joint(std::string_view name) const;
};

/// Fails where this gnomon has no walker with the joints that figures need.
[[nodiscard]] Result<Skeleton> load_skeleton();

/// What a figure is dressed in: places in Scene::materials.
struct Dress {
    std::uint32_t cloth = 0;
    std::uint32_t trousers = 0;
    std::uint32_t skin = 0;
    std::uint32_t accent = 0;
    bool hooded = false;  ///< a hood, else a helmet with a brim
};

/// Closed limbs that lie in each other. Fails as make_mesh_deformation.
[[nodiscard]] Result<std::shared_ptr<const scene::Mesh>> make_figure_mesh(const Skeleton& skeleton,
                                                                          const Dress& dress);

struct Figure {
    scene::Entity root;
    scene::Entity body;  ///< has the mesh, and casts
    std::vector<scene::Entity> joints;
};

[[nodiscard]] Figure add_figure(scene::Scene& scene, const Skeleton& skeleton,
                                const std::string& name,
                                const std::shared_ptr<const scene::Mesh>& mesh);

struct Stance {
    glm::dvec2 at{0.0};
    double facing_rad = 0.0;
    double walked_m = 0.0;
    double stride = 0.0;        ///< 0: stands, 1: walks, up to 1.5: runs
    double crouch = 0.0;        ///< 0 .. 1
    bool carries_lamp = false;  ///< in the right hand, held out
};

/// Writes the local transforms of root and joints. update_world_transforms() and deform() follow.
void pose_figure(scene::Registry& registry, const Skeleton& skeleton, const Figure& figure,
                 const Stance& stance);

}  // namespace gnomon::game
