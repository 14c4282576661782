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
    std::vector<std::size_t> animations = {};  ///< that are played, by place in the scene
    double start_s = 0.0;                      ///< their time in the first frame
};

/// Brings the scene to what its animations say at `time_s`: poses, skins and morphs. `name` stands
/// for the file in messages.
[[nodiscard]] Status play(Shot& shot, double time_s, const std::string& name);

[[nodiscard]] Result<Shot> make_shot(const RenderOptions& options);

}  // namespace gnomon::cli
