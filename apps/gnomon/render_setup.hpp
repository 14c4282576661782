// SPDX-License-Identifier: MIT
//
// From options and a file to a scene that is ready to be drawn: lights, casters, receivers, camera.
#pragma once

#include <gnomon/scene/scene.hpp>

#include "render_options.hpp"

namespace gnomon::cli {

struct Shot {
    scene::Scene scene;
    scene::Bounds bounds;
    scene::Camera camera;
    glm::dmat4 world_from_camera{1.0};
    double near_m = 0.01;
    std::vector<std::size_t> animations;  ///< those of the scene that are played; none: it stands
    double time_s = 0.0;                  ///< at which it is posed
};

/// Poses everything that the shot's animations move. Does nothing where there are none. Fails as
/// scene::deform does.
[[nodiscard]] Status pose_at(Shot& shot, double time_s);

[[nodiscard]] Result<Shot> make_shot(const RenderOptions& options);

}  // namespace gnomon::cli
