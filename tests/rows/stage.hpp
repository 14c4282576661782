// SPDX-License-Identifier: MIT
//
// Stage: a scene under construction, for rows and hard cases: a few words each for what stands
// where, what shines and from where it is seen.
#pragma once

#include <memory>
#include <optional>

#include <glm/glm.hpp>

#include <gnomon/scene/mesh.hpp>
#include <gnomon/scene/scene.hpp>

#include "tests/rows/rows.hpp"

namespace gnomon::test {

using MeshPointer = std::shared_ptr<const scene::Mesh>;

[[nodiscard]] MeshPointer shared(scene::Mesh mesh);

[[nodiscard]] glm::dmat4 moved(const glm::dvec3& by);
[[nodiscard]] glm::dmat4 turned(double degrees, const glm::dvec3& axis);
[[nodiscard]] glm::dmat4 scaled(const glm::dvec3& by);

class Stage {
public:
    Stage() { scene_.materials.emplace_back(); }

    scene::Entity place(const MeshPointer& mesh, const glm::dmat4& pose, bool casts = true,
                        bool drawn = true);
    /// A square sheet facing +Y, drawn and casting.
    void ground(float size = 20.0F, const glm::dmat4& pose = glm::dmat4(1.0));
    void lamp(const glm::dvec3& at, std::optional<double> range_m = std::nullopt);
    /// `travel`: the way the light goes.
    void sun(const glm::dvec3& travel);
    /// An infinite perspective.
    void look(const glm::dvec3& eye, const glm::dvec3& target, double fovy_deg = 50.0,
              double near_m = 0.01);
    void look_orthographic(const glm::dvec3& eye, const glm::dvec3& target, double half_height,
                           double near_m, double far_m);
    shadows::View& view() { return view_; }
    scene::Scene& scene() { return scene_; }
    [[nodiscard]] Setting finish();

private:
    scene::Scene scene_;
    shadows::View view_;
};

}  // namespace gnomon::test
