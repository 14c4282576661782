// SPDX-License-Identifier: MIT
//
// Camera: a View taken apart into what beams through its pixels need, relative to the tracer's
// origin.
#pragma once

#include <glm/glm.hpp>

#include <gnomon/shadows/view.hpp>

#include "internal/beam.hpp"

namespace gnomon::truth::internal {

struct Camera {
    glm::dvec4 eye{0.0};  ///< a point (w = 1), or the direction towards the camera (w = 0)
    glm::dvec4 row_x{0.0};
    glm::dvec4 row_y{0.0};
    glm::dvec4 row_w{0.0};
    Plane depth;           ///< metres beyond the near plane
    double far_depth = 0;  ///< depth.at() on the far plane; infinite where there is none

    /// Any projection whose near plane is depth 1 and whose far plane, if it has one, is depth 0
    /// and parallel to it.
    [[nodiscard]] static Camera of(const shadows::View& view, const glm::dvec3& origin);

    /// The beam through a rectangle of normalised device coordinates (y up), from the near plane
    /// on.
    [[nodiscard]] Beam beam(const glm::dvec2& ndc_min, const glm::dvec2& ndc_max) const;
    /// How wide that beam is at a point, in metres.
    [[nodiscard]] static double width_at(const Beam& beam, const glm::dvec3& x);
    /// How far a depth buffer of single precision can tell two places apart near x, in metres. A
    /// mesh that reaches `reach_m` from its own origin is placed by single-precision products of
    /// that size.
    [[nodiscard]] double contact_m(const glm::dvec3& x, double reach_m) const;
    /// The same on the near plane, in its middle.
    [[nodiscard]] double contact_on_near_plane_m(double reach_m) const {
        const glm::dvec3 at_eye = eye.w != 0.0 ? glm::dvec3(eye) : glm::dvec3(0.0);
        return contact_m(at_eye - depth.at(at_eye) * depth.normal, reach_m);
    }
};

}  // namespace gnomon::truth::internal
