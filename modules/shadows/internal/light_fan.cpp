// SPDX-License-Identifier: MIT
#include "light_fan.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "crossing.hpp"

namespace gnomon::shadows::internal {

namespace {

constexpr double fan_rounding = 0x1p-48;  // of a few operations, relative to their operands

double cross2(const glm::dvec3& a, const glm::dvec3& b, int u, int v) {
    return a[u] * b[v] - a[v] * b[u];
}

}  // namespace

LightFan::LightFan(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec4& light,
                   double slack)
    : from_(from),
      to_(to),
      light_(light),
      from_to_light_(glm::dvec3(light) - light.w * from),
      to_to_light_(glm::dvec3(light) - light.w * to),
      normal_(glm::cross(to - from, from_to_light_)),
      normal_error_(fan_rounding * glm::length(to - from) * glm::length(from_to_light_)),
      slack_(slack) {
    const glm::dvec3 n = glm::abs(normal_);
    const int widest = n.x >= n.y && n.x >= n.z ? 0 : (n.y >= n.z ? 1 : 2);
    u_ = (widest + 1) % 3;
    v_ = (widest + 2) % 3;
    area_ = cross2(to_ - from_, from_to_light_, u_, v_);
    const auto side = [&](const glm::dvec3& through, const glm::dvec3& along) {
        return Side{
            through, glm::cross(normal_, along),
            (2.0 * normal_error_ + fan_rounding * glm::length(normal_)) * glm::length(along)};
    };
    sides_ = {side(from_, to_ - from_), side(to_, to_to_light_), side(from_, -from_to_light_)};
}

bool LightFan::enters(const Box<double>& box) const {
    const glm::dvec3 center = box.center();
    const glm::dvec3 half = box.half() + slack_;
    const double size = half.x + half.y + half.z;
    const glm::dvec3 spoke = center - from_;
    if (std::abs(glm::dot(normal_, spoke)) >
        glm::dot(glm::abs(normal_), half) +
            (normal_error_ + fan_rounding * glm::length(normal_)) * (glm::length(spoke) + size)) {
        return false;
    }
    return std::none_of(sides_.begin(), sides_.end(), [&](const Side& side) {
        const glm::dvec3 away = center - side.through;
        return glm::dot(side.inward, away) + glm::dot(glm::abs(side.inward), half) <
               -(side.error + fan_rounding * glm::length(side.inward)) * (glm::length(away) + size);
    });
}

// A corner in the fan's plane counts as above it, for all faces that have it.
int LightFan::side_of(const glm::dvec3& corner) const {
    return orientation(corner, from_, to_, light_) < 0 ? -1 : 1;
}

// Where the line from p to q meets the fan's plane; p and q lie on either side of it.
LightFan::Place LightFan::place_on_edge(glm::dvec3 p, glm::dvec3 q) const {
    // Every face that has the edge must round alike.
    if (std::tie(q.x, q.y, q.z) < std::tie(p.x, p.y, p.z)) std::swap(p, q);
    const double above = std::abs(glm::dot(normal_, p - from_));
    const double below = std::abs(glm::dot(normal_, q - from_));
    const double t = above + below > 0.0 ? above / (above + below) : 0.0;
    const glm::dvec3 w = p + t * (q - p);
    return {cross2(to_ - from_, w - from_, u_, v_) / area_,
            cross2(to_to_light_, w - to_, u_, v_) / area_,
            cross2(w - from_, from_to_light_, u_, v_) / area_};
}

std::optional<SegmentPart> LightFan::shadow_of(const std::array<glm::dvec3, 3>& face) const {
    std::array<int, 3> above;
    for (std::size_t i = 0; i < 3; ++i) above[i] = side_of(face[i]);
    std::array<Place, 2> ends;
    std::size_t found = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t next = (i + 1) % 3;
        if (above[i] != above[next]) ends[found++] = place_on_edge(face[i], face[next]);
    }
    if (found != 2) return std::nullopt;

    // What of the cut lies on the light's side of the segment, and between the ways of its ends.
    double first = 0.0;
    double last = 1.0;
    bool nothing = false;
    const auto keep = [&](double at_first, double at_last) {
        if (at_first <= 0.0 && at_last <= 0.0) {
            nothing = true;
        } else if (at_first < 0.0) {
            first = std::max(first, at_first / (at_first - at_last));
        } else if (at_last < 0.0) {
            last = std::min(last, at_first / (at_first - at_last));
        }
    };
    keep(ends[0].towards, ends[1].towards);
    keep(ends[0].from, ends[1].from);
    keep(ends[0].to, ends[1].to);
    if (nothing || !(first <= last)) return std::nullopt;
    const auto parameter_at = [&](double at) {
        // An end as it is, to the last bit: the neighbouring face begins there.
        if (at == 0.0) return ends[0].parameter();
        if (at == 1.0) return ends[1].parameter();
        return Place{0.0, glm::mix(ends[0].from, ends[1].from, at),
                     glm::mix(ends[0].to, ends[1].to, at)}
            .parameter();
    };
    const double a = parameter_at(first);
    const double b = parameter_at(last);
    if (!std::isfinite(a) || !std::isfinite(b)) return std::nullopt;
    return SegmentPart{std::clamp(std::min(a, b), 0.0, 1.0), std::clamp(std::max(a, b), 0.0, 1.0)};
}

}  // namespace gnomon::shadows::internal
