// SPDX-License-Identifier: MIT
#include "internal/umbra.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "internal/finite.hpp"

namespace gnomon::shadows::internal {

namespace {

// Of radians: faces that look less to the light than this are left out, so that no edge that is
// used points at the light, and no face that is used turns away from the light as it is drawn.
constexpr double least_look = 1e-5;
// Of radians: what the roundings of the light may come to, four times; so a face that looks to the
// light enough does so as it is drawn.
constexpr double most_turn = 1e-5;
// Of a part's size.
constexpr double umbra_margin = 1e-4;
// Of a part's size: how far shadows of a direction are followed at the most.
constexpr double most_sizes = 1e3;
// Of a part's size: what a lamp must be away from a face.
constexpr double least_clearance = 1e-3;
// More planes are not worth it.
constexpr std::size_t most_planes = 64;
// One behind all faces takes their place.
constexpr std::size_t most_near_planes = 12;

double light_error_of(const Pose& pose, const glm::dvec4& light_world) {
    const glm::dmat3 linear(pose.world_from_local);
    const glm::dvec3 l(light_world);
    const glm::dvec3 local =
        pose.local_from_world * (l - light_world.w * glm::dvec3(pose.world_from_local[3]));
    double error = 0.0;
    for (int i = 0; i < 3; ++i) error += glm::length(linear[i]) * std::abs(local[i]);
    error *= 0x1p-24;
    return light_world.w == 0.0 ? error / glm::length(l) : error;
}

double vertex_error_of(const Pose& pose, const glm::dvec3& farthest) {
    double error = 0.0;
    for (int i = 0; i < 3; ++i) {
        error += glm::length(glm::dvec3(pose.world_from_local[i])) * farthest[i];
    }
    return 0x1p-21 * error + 1e-13 * glm::length(glm::dvec3(pose.world_from_local[3]));
}

}  // namespace

UmbraBox umbra_box(const Pose& pose, const glm::dvec3& bounds_min, const glm::dvec3& bounds_max,
                   const glm::dvec4& light_world) {
    UmbraBox box;
    box.center =
        glm::dvec3(pose.world_from_local * glm::dvec4(0.5 * (bounds_min + bounds_max), 1.0));
    const glm::dvec3 half = 0.5 * (bounds_max - bounds_min);
    for (int i = 0; i < 3; ++i) {
        box.half[static_cast<std::size_t>(i)] = half[i] * glm::dvec3(pose.world_from_local[i]);
        box.radius += glm::length(box.half[static_cast<std::size_t>(i)]);
    }
    box.light_error = light_error_of(pose, light_world);
    box.vertex_error = vertex_error_of(pose, glm::max(glm::abs(bounds_min), glm::abs(bounds_max)));
    return box;
}

void Umbra::add(const glm::dvec4& plane, double size) {
    for (const glm::dvec4& known : planes_) {
        const glm::dvec3 turned(known - plane);
        if (glm::dot(turned, turned) < 1e-20 && std::abs(known.w - plane.w) < 1e-10 * size) return;
    }
    planes_.push_back(plane);
}

void Umbra::make(const ConvexPart& part, const Pose& pose, const glm::dvec4& light_world,
                 double follow) {
    planes_.clear();
    directional_ = light_world.w == 0.0;
    origin_ = glm::dvec3(pose.world_from_local * glm::dvec4(part.center, 1.0));
    light_ =
        directional_ ? glm::normalize(glm::dvec3(light_world)) : glm::dvec3(light_world) - origin_;
    if (!pose.finite || pose.singular || !is_finite(origin_) || !is_finite(light_)) return;

    const glm::dmat3 linear(pose.world_from_local);
    vertices_.clear();
    double size = 0.0;
    glm::dvec3 farthest(0.0);
    for (const glm::vec3& v : part.vertices) {
        vertices_.push_back(linear * (glm::dvec3(v) - part.center));
        size = std::max(size, glm::dot(vertices_.back(), vertices_.back()));
        farthest = glm::max(farthest, glm::abs(glm::dvec3(v)));
    }
    size = std::sqrt(size);
    if (!(size > 0.0)) return;

    const double outwards = part.inside_out != pose.mirrored ? -1.0 : 1.0;
    if (!cut_out(part, size, outwards)) {
        planes_.clear();
        if (!part.two_sided || !cut_out(part, size, -outwards)) {
            planes_.clear();
            return;
        }
    }
    margin_ = umbra_margin * size + vertex_error_of(pose, farthest) +
              1e-13 * (glm::length(origin_) + (directional_ ? 0.0 : glm::length(light_)));
    turn_ = 1e-7 + 4.0 * light_error_of(pose, light_world) / nearest_;
    const double enough = most_sizes * size;
    follow_ = follow <= enough ? follow : enough;
    if (!(turn_ <= most_turn) || !std::isfinite(margin_)) planes_.clear();
}

bool Umbra::cut_out(const ConvexPart& part, double size, double outwards) {
    // Which faces look to the light; first their planes.
    looks_.assign(part.faces.size(), 0);
    double clearance = 0.0;
    std::size_t looking = 0;
    const glm::dvec3 axis = directional_ ? -light_ : -glm::normalize(light_);
    double last = -std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < part.faces.size(); ++f) {
        const glm::dvec3& a = vertices_[part.faces[f][0]];
        const glm::dvec3& b = vertices_[part.faces[f][1]];
        const glm::dvec3& c = vertices_[part.faces[f][2]];
        glm::dvec3 normal = glm::cross(b - a, c - a);
        const double length = glm::length(normal);
        if (!(length > 0.0)) return false;
        normal *= outwards / length;
        const glm::dvec3 to_light = directional_ ? light_ : light_ - a;
        const double height = glm::dot(normal, to_light);
        if (!(height > least_look * glm::length(to_light))) continue;
        looks_[f] = 1;
        ++looking;
        clearance = std::max(clearance, height);
        for (const glm::dvec3* corner : {&a, &b, &c})
            last = std::max(last, glm::dot(axis, *corner));
        if (planes_.size() <= most_near_planes) {
            add(glm::dvec4(-normal, glm::dot(normal, a)), size);
        }
    }
    const bool in_or_about =
        !directional_ && (clearance < least_clearance * size || !(last > glm::dot(axis, light_)));
    if (looking == 0 || in_or_about) return false;
    if (planes_.size() > most_near_planes) planes_.assign(1, glm::dvec4(axis, -last));
    const std::size_t near_planes = planes_.size();

    for (const ConvexPart::Edge& edge : part.edges) {
        const auto looks = [&](std::uint32_t face) {
            return face != ConvexPart::no_face && looks_[face] != 0;
        };
        const bool first = looks(edge.faces[0]);
        if (first == looks(edge.faces[1])) continue;
        const auto& face = part.faces[edge.faces[first ? 0 : 1]];
        const glm::dvec3& a = vertices_[edge.ends[0]];
        const glm::dvec3& b = vertices_[edge.ends[1]];
        // What of the face is no end of the edge.
        const std::uint32_t apex = *std::ranges::find_if(
            face, [&](std::uint32_t v) { return v != edge.ends[0] && v != edge.ends[1]; });
        const glm::dvec3 along = directional_ ? light_ : light_ - a;
        glm::dvec3 normal = glm::cross(b - a, along);
        const double length = glm::length(normal);
        const double inner = glm::dot(normal, vertices_[apex] - a);
        const bool is_sound = length > 0.0 && std::abs(inner) > 1e-12 * size * length;
        if (!is_sound || planes_.size() - near_planes >= most_planes) return false;
        normal /= inner < 0.0 ? -length : length;
        add(glm::dvec4(normal, -glm::dot(normal, a)), size);
    }
    // What is aside is seen soonest.
    std::rotate(planes_.begin(), planes_.begin() + static_cast<std::ptrdiff_t>(near_planes),
                planes_.end());

    nearest_ = directional_ ? 1.0 : std::max(clearance, glm::length(light_) - size);
    return true;
}

bool Umbra::holds(const UmbraBox& box) const {
    if (planes_.empty()) return false;
    const glm::dvec3 center = box.center - origin_;
    // Not-a-number is never >=.
    const double reach = directional_ ? glm::length(center) + box.radius + follow_
                                      : glm::length(center - light_) + box.radius;
    const double nearest = directional_ ? 1.0 : std::max(nearest_, reach - 2.0 * box.radius);
    const double turn = turn_ + 4.0 * box.light_error / nearest;
    if (!(turn <= 2.0 * most_turn)) return false;
    const double margin = margin_ + box.vertex_error + turn * reach;
    return std::ranges::all_of(planes_, [&](const glm::dvec4& plane) {
        const glm::dvec3 normal(plane);
        const double inside = glm::dot(normal, center) + plane.w - margin;
        if (!(inside >= 0.0)) return false;
        double across = 0.0;
        for (const glm::dvec3& half : box.half) across += std::abs(glm::dot(normal, half));
        return inside >= across;
    });
}

}  // namespace gnomon::shadows::internal
