// SPDX-License-Identifier: MIT
//
// Umbra: a part of what is certainly in the shadow of some faces, cut out by planes, and whether
// the bounds of another caster lie in it. Whatever does needs no volume of its own: its shadow lies
// in there as well.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/shadows/light.hpp>

#include "convex_parts.hpp"
#include "local_light.hpp"

namespace gnomon::shadows::internal {

/// A box in the world, as an umbra looks at it.
struct UmbraBox {
    glm::dvec3 center{0.0};
    double radius = 0.0;               ///< of a sphere round it
    std::array<glm::dvec3, 3> half{};  ///< from the center to the middles of three sides
    /// What single precision does to the light in the caster's space: metres, or radians of a
    /// direction; and to its vertices when they are drawn, in metres.
    double light_error = 0.0;
    double vertex_error = 0.0;
};

[[nodiscard]] UmbraBox umbra_box(const Pose& pose, const glm::dvec3& bounds_min,
                                 const glm::dvec3& bounds_max, const glm::dvec4& light_world);

class Umbra {
public:
    /// Of the faces of `part`, placed by `pose`, that look to the light, whichever light: it holds
    /// nothing where the light is in or about the part, where what single precision makes of the
    /// light or the vertices could matter, or where anything is not finite. The pose must not be
    /// singular. `follow` is how far from a caster a shadow can be seen, in metres, for directions,
    /// which rounding turns by some 1e-7 radians; a thousand times the part's size is the most that
    /// counts. Cost: some dozen flops a face and an edge.
    ///
    /// Right for any faces of which each casts a volume of its own, convex or not. Let F be those,
    /// and p a point that (1) lies on the inner side of every plane through the light and an edge
    /// that has a face of F on one side only, "inner" being where that face is, and (2) behind the
    /// planes of all of F, or beyond all of F along an axis that leads away from the light. If no
    /// face of F covered p as seen from the light, the shortest way (as seen from there) from p to
    /// where most of them overlap would have to enter F across such an edge from its outer side,
    /// and p, farther back on it, would be there as well: but it is not. So a face covers p, and by
    /// (2) it lies before p.
    void make(const ConvexPart& part, const Pose& pose, const glm::dvec4& light_world,
              double follow);

    /// Whether the box is wholly inside, with a margin: of a ten thousandth of the part's size, and
    /// of what the roundings of both casters can turn their shadows by, as far as these go.
    /// False where in doubt. Cost: a dozen flops for each plane that it takes to find a corner
    /// outside.
    [[nodiscard]] bool holds(const UmbraBox& box) const;

    [[nodiscard]] bool empty() const { return planes_.empty(); }
    /// Inside: dot(xyz, p - origin()) + w >= 0.
    [[nodiscard]] const std::vector<glm::dvec4>& planes() const { return planes_; }
    [[nodiscard]] const glm::dvec3& origin() const { return origin_; }
    [[nodiscard]] std::size_t memory_bytes() const {
        return planes_.capacity() * sizeof(glm::dvec4) + vertices_.capacity() * sizeof(glm::dvec3) +
               looks_.capacity();
    }

private:
    [[nodiscard]] bool cut_out(const ConvexPart& part, double size, double outwards);
    void add(const glm::dvec4& plane, double size);

    glm::dvec3 origin_{0.0};
    std::vector<glm::dvec4> planes_;
    glm::dvec3 light_{0.0};  // from the origin, or its direction
    bool directional_ = true;
    double margin_ = 0.0;
    double turn_ = 0.0;     // radians, as seen from the light
    double nearest_ = 0.0;  // metres from the light that nothing inside is nearer than
    double follow_ = 0.0;
    // Of make(), from time to time.
    std::vector<glm::dvec3> vertices_;
    std::vector<std::uint8_t> looks_;
};

}  // namespace gnomon::shadows::internal
