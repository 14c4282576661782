// SPDX-License-Identifier: MIT
//
// `--animate`: deterministic motion, the same on every run and backend.
#pragma once

#include <cstdint>

#include "arguments.hpp"
#include "render_setup.hpp"

namespace gnomon::cli {

/// Moves what moves from frame 0 to frame `frame` (absolute: frames may be skipped or repeated).
/// Fails where an animation takes vertices beyond what is finite.
class Animator {
public:
    Animator(const Shot& shot, const Motion& motion);
    [[nodiscard]] Status apply(std::uint32_t frame, Shot& shot) const;

private:
    Motion motion_;
    glm::dmat4 camera_start_;
    double time_start_s_ = 0.0;
    struct Start {
        scene::Entity entity;
        glm::dmat4 world;
    };
    std::vector<Start> moving_;
};

}  // namespace gnomon::cli
