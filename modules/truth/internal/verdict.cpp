// SPDX-License-Identifier: MIT
#include "internal/verdict.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon::truth::internal {

namespace {

// A triangle seen this close to edge-on closes nothing off, for its own facing is rounding.
constexpr double edge_on_cosine = 1e-9;
// A surface this close to edge-on may or may not be drawn.
constexpr double grazing_view_cosine = 1e-6;
// Light this close to a surface's plane: whether it is lit at all is rounding.
constexpr double grazing_light_sine = 1e-5;
// More triangles than this within one pixel's neighbourhood: nothing can be said.
constexpr std::size_t crowd = 4096;

Tile tile_of(const Triangle& triangle, const Beam& beam, const glm::dvec3& at, double slack) {
    const glm::dvec3 to_apex = glm::normalize(beam.to_apex(at));
    const double facing = glm::dot(triangle.normal, to_apex);
    return {.corners = triangle.corner_ids,
            .towards = facing > 0.0,
            .usable = std::abs(facing) > edge_on_cosine,
            .edges_inside = beam.edges_inside(triangle.corners, slack)};
}

}  // namespace

void PixelJudge::look(Beam& pixel) {
    const double slack = world_->soup.noise_m;
    // What lies on the near or the far plane may or may not be drawn; so it is looked at.
    const double rim = camera_->contact_on_near_plane_m(world_->soup.farthest_reach_m);
    const Plane before_far{-pixel.height.normal, camera_->far_depth - pixel.height.offset};
    pixel.lowest -= rim;
    pixel.highest += rim;
    seen_.clear();
    tiles_.clear();
    crowded_ = false;
    world_->receivers.walk(pixel, slack, [&](std::uint32_t index) {
        const Triangle& t = triangle(index);
        Seen seen{.triangle = index, .region = pixel.cut(t.corners)};
        if (seen.region.empty()) return true;
        seen.contact_m =
            camera_->contact_m(seen.region.centroid(), world_->soup.reach_m[t.instance]);
        const Range uncut = range_along(pixel.height, seen.region);
        seen.region.clip(pixel.height, -rim);
        if (std::isfinite(camera_->far_depth)) seen.region.clip(before_far, -rim);
        if (seen.region.empty()) return true;
        const glm::dvec3 middle = seen.region.centroid();
        // It only touches the beam with an edge or a corner, as a neighbour of what is in it does.
        if (seen.region.thickness() < 1e-6 * Camera::width_at(pixel, middle)) return true;
        seen.depth = range_along(pixel.height, seen.region);
        seen.facing = glm::dot(t.normal, glm::normalize(pixel.to_apex(middle)));

        Tile tile = tile_of(t, pixel, middle, slack);
        tile.usable = tile.usable && uncut.min > seen.contact_m &&
                      uncut.max < camera_->far_depth - seen.contact_m;
        if (tile.usable && tile.edges_inside == 0) {
            pixel.highest = std::min(pixel.highest, seen.depth.max + 4.0 * seen.contact_m);
        }
        seen.edges_inside = tile.edges_inside;
        tiles_.push_back(tile);
        seen_.push_back(seen);
        crowded_ = seen_.size() >= crowd;
        return !crowded_;
    });
    covers_ = find_covers(tiles_, cover_of_);
    for (std::size_t i = 0; i < seen_.size(); ++i) seen_[i].cover = cover_of_[i];
}

/// Whether the whole region lies behind some cover by more than a depth buffer's precision. A cover
/// is as near as the nearest of its planes at least, whatever the place in the beam.
bool PixelJudge::is_hidden(const Seen& seen) const {
    for (int cover = 0; cover < covers_; ++cover) {
        const bool behind_all = std::all_of(seen_.begin(), seen_.end(), [&](const Seen& front) {
            if (front.cover != cover) return true;
            if (seen.depth.min > front.depth.max + seen.contact_m) return true;
            const Triangle& t = triangle(front.triangle);
            const double sign = front.facing > 0.0 ? 1.0 : -1.0;
            const Plane plane = Plane::through(t.corners[0], sign * t.normal);
            return range_along(plane, seen.region).max < -seen.contact_m * std::abs(front.facing);
        });
        if (behind_all) return true;
    }
    return false;
}

PixelJudge::Answer PixelJudge::answer(const Seen& seen) {
    if (std::abs(seen.facing) < grazing_view_cosine) return Answer::Uncertain;
    const Triangle& t = triangle(seen.triangle);
    const glm::dvec3 middle = seen.region.centroid();
    const glm::dvec3 to_light = glm::dvec3(light_) - light_.w * middle;
    const double distance = glm::length(to_light);

    if (light_.w != 0.0) {
        double nearest = distance;
        double farthest = 0.0;
        for (int i = 0; i < seen.region.size(); ++i) {
            const glm::dvec3& corner = seen.region[i];
            nearest = std::min(nearest, distance - glm::distance(corner, middle));
            farthest = std::max(farthest, glm::distance(corner, glm::dvec3(light_)));
        }
        if (nearest > range_m_) return Answer::OutOfRange;
        if (farthest > range_m_) return Answer::Uncertain;
    }

    const double height = glm::dot(t.normal, to_light);
    // The renderer sees the light from the mesh's own origin, in single precision.
    const double light_rounding =
        light_.w * 0x1p-22 * (distance + world_->soup.reach_m[t.instance]);
    if (std::abs(height) <= std::max(grazing_light_sine * distance, light_rounding)) {
        return Answer::Uncertain;
    }
    // Light so flat that the whole triangle is thinner, along it, than a depth buffer resolves: the
    // triangle and the side of its own volume cannot be told apart.
    const double extent = std::max({glm::distance(t.corners[0], t.corners[1]),
                                    glm::distance(t.corners[1], t.corners[2]),
                                    glm::distance(t.corners[2], t.corners[0])});
    if (extent * std::abs(height) <= 2.0 * seen.contact_m * distance) return Answer::Uncertain;
    if ((height > 0.0) != (seen.facing > 0.0)) return Answer::Averted;
    return light_reaches(seen, Plane::through(t.corners[0], height > 0.0 ? t.normal : -t.normal));
}

/// What a surface and another one do that lies on it: whichever is nearer by rounding is drawn, and
/// the other's caps, being farther, do not count on it. So neither shadows the other. That takes a
/// triangle that is drawn, and fills the pixel's whole neighbourhood with its cover.
bool PixelJudge::fights_for_depth(std::uint32_t index, const Plane& base, double within_m) const {
    return std::any_of(seen_.begin(), seen_.end(), [&](const Seen& other) {
        if (other.triangle != index || other.cover == no_cover) return false;
        const Range height = range_along(base, other.region);
        return height.min > -within_m && height.max < within_m;
    });
}

PixelJudge::Answer PixelJudge::light_reaches(const Seen& seen, const Plane& base) {
    const double noise = world_->soup.noise_m;
    // A contact's depth may be off by contact_m either way; so may what it is compared with.
    const double low = 4.0 * seen.contact_m;
    Beam wide = light_beam(seen.region, light_, base, 2.0 * seen.contact_m);
    // Never so narrow that nothing is left of the beam, which is as thick as the region seen from
    // the light: what then touches the region would not be noticed.
    const glm::dvec3 to_light = glm::dvec3(light_) - light_.w * seen.region.centroid();
    const double thickness =
        seen.region.thickness() * glm::dot(base.normal, to_light) / glm::length(to_light);
    const double shrink = std::min(0.01 * seen.contact_m, 0.125 * thickness);
    const Beam narrow = light_beam(seen.region, light_, base, -shrink);
    if (wide.side_count < 3) return Answer::Uncertain;
    wide.lowest = -low;
    if (light_.w != 0.0) wide.highest = base.at(glm::dvec3(light_)) * (1.0 - 1e-9);

    const Triangle& self = triangle(seen.triangle);
    bool blocked = false;
    bool covered = false;
    tiles_.clear();
    world_->casters.walk(wide, noise, [&](std::uint32_t index) {
        if (index == seen.triangle) return true;
        const Triangle& t = triangle(index);
        const Polygon part = wide.cut(t.corners);
        if (part.empty()) return true;
        const Range height = range_along(base, part);
        // Exactly on the surface, a triangle that is drawn shadows nothing (fights_for_depth). One
        // that is not drawn has caps that no depth buffer has seen: above or below is rounding.
        const double lowest = t.receives ? noise : -low;
        if (height.max < lowest || height.min > wide.highest) return true;
        if (height.max >= low) {
            blocked = true;
            Tile tile = tile_of(t, wide, part.centroid(), noise);
            tile.usable = tile.usable && height.min >= low && height.max <= wide.highest;
            covered = tile.usable && tile.edges_inside == 0;
            tiles_.push_back(tile);
            return !covered && tiles_.size() < crowd;
        }
        if (blocked || t.corners == self.corners || fights_for_depth(index, base, low)) return true;
        Polygon touching = narrow.cut(t.corners);
        touching.clip(base, lowest);
        blocked = !touching.empty();
        return true;
    });
    if (covered) return Answer::Shadowed;
    if (!blocked) return Answer::Lit;
    return find_covers(tiles_, cover_of_) > 0 ? Answer::Shadowed : Answer::Uncertain;
}

/// A volume begins at this edge: on which side of it a pixel falls is up to the rasteriser's grid.
/// So is then whether one layer of it counts, or is missing: even where both sides are lit (the rim
/// of a sheet, seen against lit ground) or both are in another caster's shadow, of one layer too.
bool PixelJudge::has_silhouette_inside(const Seen& seen) const {
    const Triangle& t = triangle(seen.triangle);
    if (!t.casts) return false;
    for (std::size_t k = 0; k < 3; ++k) {
        if ((seen.edges_inside >> k & 1U) != 0 &&
            world_->caster_edges.is_silhouette(world_->soup, t.corner_ids[k],
                                               t.corner_ids[(k + 1) % 3], light_)) {
            return true;
        }
    }
    return false;
}

Verdict PixelJudge::verdict(Beam pixel) {
    look(pixel);
    if (crowded_) return Verdict::Band;
    bool first = true;
    Verdict all = Verdict::Unjudged;
    if (covers_ == 0) first = false;  // nothing at all may be seen
    for (const Seen& seen : seen_) {
        if (is_hidden(seen)) continue;
        Verdict one = Verdict::Unjudged;
        const Answer found = answer(seen);
        switch (found) {
            case Answer::OutOfRange:
            case Answer::Averted: break;
            case Answer::Lit:
            case Answer::Shadowed:
                if (has_silhouette_inside(seen)) return Verdict::Band;
                one = found == Answer::Lit ? Verdict::Lit : Verdict::Shadowed;
                break;
            case Answer::Uncertain: return Verdict::Band;
        }
        if (!first && one != all) return Verdict::Band;
        all = one;
        first = false;
    }
    return all;
}

}  // namespace gnomon::truth::internal
