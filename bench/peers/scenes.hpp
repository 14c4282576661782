// SPDX-License-Identifier: MIT
//
// What every peer draws: meshes, poses, lights and the camera, made here from numbers alone, so
// that all engines are given the very same. Metres; right-handed, +Y up; triangles are
// counter-clockwise from outside. Poses are rotations and translations, no more: what all engines
// take. This header and peer.hpp are C++17, which is as far as some engines' headers go.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>

namespace gnomon::peers {

enum class Motion : std::uint8_t {
    Static,
    Light,    ///< the first light does what Lights has all do
    Lights,   ///< every light goes round the scene, or swings
    Casters,  ///< those that move turn where they stand
};

[[nodiscard]] Result<Motion> motion_named(std::string_view name);

struct PeerMesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;      ///< unit; one per position
    std::vector<std::uint32_t> indices;  ///< three a triangle

    [[nodiscard]] std::size_t triangle_count() const { return indices.size() / 3; }
};

struct Instance {
    std::size_t mesh = 0;
    glm::dmat4 world_from_local{1.0};
    bool casts = true;
    bool moves = false;  ///< under Motion::Casters
};

struct Light {
    glm::dvec4 position_world{0.0, 1.0, 0.0, 0.0};  ///< w 0: the direction towards a sun
    /// Of a point light, divided by the squared distance, one at which a surface that faces it
    /// looks fully lit.
    double intensity = 1.0;
};

struct PeerScene {
    std::string name = {};
    std::vector<PeerMesh> meshes = {};
    std::vector<Instance> instances = {};
    std::vector<Light> lights = {};
    glm::dvec3 eye{0.0};
    glm::dvec3 target{0.0};
    glm::dvec3 center{0.0};  ///< what the lights go round
    double fovy_rad = 0.8;
    double near_m = 0.1;
    double light_step_deg = 1.0;   ///< a frame, at the most
    double light_swing_deg = 0.0;  ///< 0: lights go round; else they swing to this on either side
    double caster_step_deg = 1.0;  ///< a frame

    [[nodiscard]] std::size_t triangle_count() const;
    [[nodiscard]] std::size_t caster_count() const;
    [[nodiscard]] bool casts(std::size_t mesh) const;  ///< whether any of its instances does
};

[[nodiscard]] std::vector<std::string> scene_names();

/// Fails with ErrorCode::InvalidInput for a name that is not among them. The same bits every time.
[[nodiscard]] Result<PeerScene> make_scene(std::string_view name);

/// Where instance and light are in a frame.
[[nodiscard]] glm::dmat4 pose_in(const PeerScene& scene, const Instance& instance, Motion motion,
                                 std::int64_t frame);
[[nodiscard]] glm::dvec4 light_in(const PeerScene& scene, std::size_t light, Motion motion,
                                  std::int64_t frame);

}  // namespace gnomon::peers
