// SPDX-License-Identifier: MIT
//
// The components of gnomon's own scenes. Metres, seconds, radians; right-handed, +Y up; cameras and
// lights look along their own -Z, as in glTF.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <gnomon/scene/mesh.hpp>
#include <gnomon/scene/registry.hpp>

#pragma GCC visibility push(default)
namespace gnomon::scene {

/// What people call it; need not be unique.
struct Name {
    std::string value;  ///< UTF-8
};

/// What a LocalTransform is relative to.
struct Parent {
    Entity value;  ///< the parent
};

/// Pose relative to the parent (or the world): translation * rotation * scale, or any affine
/// matrix.
struct LocalTransform {
    glm::dvec3 translation{0.0};                      ///< metres
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};          ///< unit; w, x, y, z
    glm::dvec3 scale{1.0};                            ///< may be negative or zero
    std::optional<glm::dmat4> matrix = std::nullopt;  ///< used instead of the three above

    /// `matrix`, or the product of the three.
    [[nodiscard]] glm::dmat4 parent_from_local() const;
};

/// Written by update_world_transforms (transforms.hpp).
struct WorldTransform {
    glm::dmat4 world_from_local{1.0};  ///< affine
};

/// A mesh at this place.
struct MeshInstance {
    std::shared_ptr<const Mesh> mesh;  ///< not null
};

/// The joints that move an instance whose mesh is skinned (MeshDeformation::influences).
struct Skin {
    std::vector<Entity> joints;  ///< by the numbers that influences name
    /// One a joint: from the space of the mesh to the joint's own, as it was bound.
    std::shared_ptr<const std::vector<glm::dmat4>> inverse_bind_matrices;
};

/// How much of each morph target is blended into an instance: one a target.
struct MorphWeights {
    std::vector<double> values;  ///< as many as the mesh has targets
};

/// What an instance's vertices are now. Written by deform() (deform.hpp), read through
/// geometry_of() (scene.hpp).
struct Deformed {
    std::shared_ptr<const Mesh> mesh;  ///< of which; under another one it does not count
    /// Where the origin of `positions` lies in the instance's space, as Mesh::origin.
    glm::dvec3 origin{0.0};
    std::vector<glm::vec3> positions;  ///< metres, one a vertex
    std::vector<glm::vec3> normals;    ///< unit
    /// Never zero, no two states of the process have the same one, and it changes only when a
    /// number above does.
    std::uint64_t revision = 0;
    std::vector<double> inputs;  ///< the weights and joints it was made from
};

struct Caster {};    ///< tag: its mesh casts shadows
struct Receiver {};  ///< tag: its mesh is drawn

/// Shines in all directions.
struct PointLight {
    glm::vec3 color{1.0F};                         ///< linear
    float intensity = 1.0F;                        ///< candela
    std::optional<double> range_m = std::nullopt;  ///< no light beyond it
};
/// Shines along -Z, in a cone.
struct SpotLight {
    glm::vec3 color{1.0F};                         ///< linear
    float intensity = 1.0F;                        ///< candela
    std::optional<double> range_m = std::nullopt;  ///< no light beyond it
    float inner_cone_rad = 0.0F;       ///< half the angle within which it is at its brightest
    float outer_cone_rad = 0.785398F;  ///< half the angle beyond which it is dark
};
/// Shines along -Z from infinitely far.
struct DirectionalLight {
    glm::vec3 color{1.0F};   ///< linear
    float intensity = 1.0F;  ///< lux
};

/// A pinhole.
struct PerspectiveCamera {
    double fovy_rad = 0.785398;  ///< from the lower edge of the picture to the upper
    double near_m = 0.01;        ///< there is no far plane: gnomon's perspective is infinite
};
/// Parallel rays.
struct OrthographicCamera {
    double half_width_m = 1.0;   ///< of what is seen
    double half_height_m = 1.0;  ///< of what is seen
    double near_m = 0.0;         ///< may be negative
    double far_m = 100.0;        ///< > near_m
};
/// Somebody who looks along -Z.
struct Camera {
    std::variant<PerspectiveCamera, OrthographicCamera> projection =
        PerspectiveCamera{};  ///< which of the two
};

}  // namespace gnomon::scene
#pragma GCC visibility pop
