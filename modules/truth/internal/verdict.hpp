// SPDX-License-Identifier: MIT
//
// PixelJudge: one pixel's verdict. First a beam from the eye finds every surface that may be seen
// within the pixel's neighbourhood; then a beam from each of these to the light asks what is in the
// way. Only if all of them give one and the same answer is the pixel judged.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/truth/truth.hpp>

#include "internal/beam.hpp"
#include "internal/camera.hpp"
#include "internal/caster_edges.hpp"
#include "internal/cover.hpp"
#include "internal/soup.hpp"
#include "internal/triangle_tree.hpp"

namespace gnomon::truth::internal {

struct World {
    Soup soup;
    TriangleTree receivers;
    TriangleTree casters;
    CasterEdges caster_edges;
};

/// Has buffers of its own: one a thread.
class PixelJudge {
public:
    /// `light`: relative to the soup's origin; both must outlive the judge.
    PixelJudge(const World& world, const Camera& camera, const glm::dvec4& light, double range_m)
        : world_(&world), camera_(&camera), light_(light), range_m_(range_m) {}

    [[nodiscard]] Verdict verdict(Beam pixel);

private:
    /// A receiver that the pixel's beam meets.
    struct Seen {
        std::uint32_t triangle = 0;
        Polygon region{};  // the part inside the beam
        Range depth{};
        double contact_m = 0.0;
        double facing = 0.0;  // cosine between the normal and the way to the eye
        int cover = no_cover;
        std::uint8_t edges_inside = 0;  // bit k: its edge from corner k enters the beam
    };
    enum class Answer : std::uint8_t { OutOfRange, Averted, Lit, Shadowed, Uncertain };

    void look(Beam& pixel);
    [[nodiscard]] bool is_hidden(const Seen& seen) const;
    [[nodiscard]] Answer answer(const Seen& seen);
    [[nodiscard]] bool has_silhouette_inside(const Seen& seen) const;
    [[nodiscard]] Answer light_reaches(const Seen& seen, const Plane& base);
    [[nodiscard]] bool fights_for_depth(std::uint32_t triangle, const Plane& base,
                                        double within_m) const;
    [[nodiscard]] const Triangle& triangle(std::uint32_t index) const {
        return world_->soup.triangles[index];
    }

    const World* world_;
    const Camera* camera_;
    glm::dvec4 light_;
    double range_m_;

    std::vector<Seen> seen_;
    int covers_ = 0;
    bool crowded_ = false;  // more surfaces than are worth sorting out
    std::vector<Tile> tiles_;
    std::vector<int> cover_of_;
};

}  // namespace gnomon::truth::internal
