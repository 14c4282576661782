// SPDX-License-Identifier: MIT
//
// The motion of a report: lights go round the scene's middle, a step a frame; and the truth of each
// frame.
#pragma once

#include <vector>

#include <gnomon/report/report.hpp>

#include "stage.hpp"

namespace gnomon::report::internal {

class LightTurn {
public:
    /// Turns the lights of `subject` itself, which must outlive it and is as it was afterwards.
    LightTurn(Subject& subject, const Options& options);
    ~LightTurn() { apply(0); }
    LightTurn(const LightTurn&) = delete;
    LightTurn& operator=(const LightTurn&) = delete;
    /// Absolute: frames may be skipped and repeated.
    void apply(std::uint32_t frame);
    /// As apply() left it. Points into the subject.
    [[nodiscard]] Moment moment() const;
    [[nodiscard]] const scene::Scene& scene() const { return scene_; }
    [[nodiscard]] const scene::Bounds& bounds() const { return bounds_; }
    [[nodiscard]] const shadows::View& view() const { return view_; }

private:
    struct Start {
        scene::Entity entity;
        glm::dmat4 world;
    };
    scene::Scene& scene_;
    scene::Bounds bounds_;
    shadows::View view_;
    double degrees_per_frame_;
    std::vector<Start> lights_;
};

/// By light.
using FrameTruth = std::vector<truth::Picture>;

}  // namespace gnomon::report::internal
