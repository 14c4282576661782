// SPDX-License-Identifier: MIT
//
// `--animate`: deterministic motion, the same on every run and backend.
#pragma once

#include <cstdint>

#include "arguments.hpp"
#include "render_setup.hpp"

namespace gnomon::cli {

/// Moves what moves from frame 0 to frame `frame` (absolute: frames may be skipped or repeated).
class Animator {
public:
    Animator(const Shot& shot, const Motion& motion);
    void apply(std::uint32_t frame, Shot& shot) const;

private:
    Motion motion_;
    glm::dmat4 camera_start_;
    struct Start {
        scene::Entity entity;
        glm::dmat4 world;
    };
    std::vector<Start> moving_;
};

}  // namespace gnomon::cli
