// SPDX-License-Identifier: MIT
//
// LightFan: all the ways from a segment to a light: a triangle, or a strip without end. What cuts
// it casts its shadow on a part of the segment.
#pragma once

#include <array>
#include <optional>

#include <glm/glm.hpp>

#include "box_tree.hpp"

namespace gnomon::shadows::internal {

/// Parameters along a segment, from 0 to 1.
struct SegmentPart {
    double begin = 0.0;
    double end = 0.0;
};

class LightFan {
public:
    /// From `from`, where the parameter is 0, to `to`. `slack` as for Sight.
    LightFan(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec4& light,
             double slack = 0.0);

    /// The light is on the segment's line: nothing casts a shadow with an end on it but what the
    /// segment itself passes through.
    [[nodiscard]] bool flat() const { return area_ == 0.0; }
    /// False only when no way in the fan comes as near as the slack to the box. Conservative.
    [[nodiscard]] bool enters(const Box<double>& box) const;

    /// The part of the segment that has the face between itself and the light, rounded; nullopt
    /// where there is none. Faces that share an edge get the very same parameter from it, so that
    /// their shadows leave no gap. Not for a flat fan, nor for a face
    /// whose plane contains the light.
    [[nodiscard]] std::optional<SegmentPart> shadow_of(const std::array<glm::dvec3, 3>& face) const;

private:
    /// How far a place in the fan is towards the light, and its weights of `from` and `to`.
    struct Place {
        double towards = 0.0;
        double from = 0.0;
        double to = 0.0;

        [[nodiscard]] double parameter() const { return to / (from + to); }
    };
    struct Side {
        glm::dvec3 through{0.0};
        glm::dvec3 inward{0.0};
        double error = 0.0;  // of the normal, per metre
    };

    [[nodiscard]] int side_of(const glm::dvec3& corner) const;
    [[nodiscard]] Place place_on_edge(glm::dvec3 p, glm::dvec3 q) const;

    glm::dvec3 from_;
    glm::dvec3 to_;
    glm::dvec4 light_;
    glm::dvec3 from_to_light_;  // or the direction
    glm::dvec3 to_to_light_;
    glm::dvec3 normal_;
    double normal_error_;
    int u_ = 0;  // the two axes that the fan is widest along
    int v_ = 1;
    double area_ = 0.0;
    std::array<Side, 3> sides_;
    double slack_;
};

}  // namespace gnomon::shadows::internal
