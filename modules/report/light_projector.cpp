// SPDX-License-Identifier: MIT
#include "internal/light_projector.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace gnomon::report::internal {

namespace {

struct Frame {
    glm::dvec3 right, up, forward;
};

Frame frame_along(const glm::dvec3& forward, const glm::dvec3& aside) {
    const bool parallel = std::abs(glm::dot(forward, aside)) > 0.99;
    const glm::dvec3 other = std::abs(forward.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, parallel ? other : aside));
    return {right, glm::cross(right, forward), forward};
}

// Rows of a matrix; glm's are columns.
glm::dmat4 from_rows(const glm::dvec4& x, const glm::dvec4& y, const glm::dvec4& z,
                     const glm::dvec4& w) {
    return glm::transpose(glm::dmat4(x, y, z, w));
}

// An axis through a point, as a row.
glm::dvec4 row(const glm::dvec3& axis, const glm::dvec3& origin) {
    return {axis, -glm::dot(axis, origin)};
}

struct Box2 {
    glm::dvec2 low{1e300};
    glm::dvec2 high{-1e300};
    void include(const glm::dvec2& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    void cut(const Box2& other) {
        low = glm::max(low, other.low);
        high = glm::min(high, other.high);
    }
    [[nodiscard]] bool empty() const { return !(low.x < high.x && low.y < high.y); }
    [[nodiscard]] glm::dvec2 middle() const { return (low + high) * 0.5; }
    // With room for what a texel at the border asks of its neighbours.
    [[nodiscard]] glm::dvec2 half(std::uint32_t size) const {
        return (high - low) * 0.5 * (1.0 + 4.0 / size);
    }
};

Projector orthographic(const glm::dvec3& towards_light, const Fitting& fitting) {
    const Frame f = frame_along(-glm::normalize(towards_light), fitting.view_forward);
    const auto place = [&](const glm::dvec3& p) {
        return glm::dvec2(glm::dot(f.right, p), glm::dot(f.up, p));
    };
    Box2 box;
    double far_m = -1e300;
    double near_m = 1e300;
    for (const glm::dvec3& p : fitting.seen) {
        box.include(place(p));
        far_m = std::max(far_m, glm::dot(f.forward, p));
        near_m = std::min(near_m, glm::dot(f.forward, p));
    }
    Box2 casting;
    for (const glm::dvec3& p : corners_of(fitting.casters, glm::dmat4(1.0))) {
        casting.include(place(p));
        near_m = std::min(near_m, glm::dot(f.forward, p));
    }
    box.cut(casting);
    if (box.empty() || !(near_m < far_m)) return {};
    const glm::dvec2 middle = box.middle();
    const glm::dvec2 half = box.half(fitting.size);
    const double margin_m = 1e-3 * (far_m - near_m);
    const double range_m = far_m - near_m + 2.0 * margin_m;
    Projector p;
    p.receiver_from_world =
        from_rows(glm::dvec4(f.right, -middle.x) / half.x, glm::dvec4(f.up, -middle.y) / half.y,
                  glm::dvec4(-f.forward, far_m + margin_m) / range_m, {0.0, 0.0, 0.0, 1.0});
    p.clip_from_world = {p.receiver_from_world};
    p.is_needed = {1};
    p.texel = 2.0 * std::max(half.x, half.y) / fitting.size / range_m;
    return p;
}

// Empty where something that is seen lies too far aside.
std::optional<Projector> perspective(const glm::dvec3& light, const Fitting& fitting) {
    glm::dvec3 sum(0.0);
    for (const glm::dvec3& p : fitting.seen) {
        const double length = glm::length(p - light);
        if (length > 0.0) sum += (p - light) / length;
    }
    if (!(glm::length(sum) > 1e-9)) return std::nullopt;
    const Frame f = frame_along(glm::normalize(sum), fitting.view_forward);
    Box2 box;
    for (const glm::dvec3& p : fitting.seen) {
        const glm::dvec3 to = p - light;
        const double w = glm::dot(f.forward, to);
        if (!(w > 0.5 * glm::length(to))) return std::nullopt;
        box.include({glm::dot(f.right, to) / w, glm::dot(f.up, to) / w});
    }
    double near_m = 1e300;
    Box2 casting;
    bool behind = false;
    for (const glm::dvec3& p : corners_of(fitting.casters, glm::dmat4(1.0))) {
        const glm::dvec3 to = p - light;
        const double w = glm::dot(f.forward, to);
        near_m = std::min(near_m, w);
        behind = behind || !(w > 0.0);
        if (!behind) casting.include({glm::dot(f.right, to) / w, glm::dot(f.up, to) / w});
    }
    if (!behind) box.cut(casting);
    if (box.empty()) return Projector{};
    const glm::dvec2 middle = box.middle();
    const glm::dvec2 half = box.half(fitting.size);
    Projector p;
    p.near_m = std::max(0.99 * near_m, 1e-4 * fitting.scale_m);
    const glm::dvec4 w = row(f.forward, light);
    p.receiver_from_world =
        from_rows((row(f.right, light) - middle.x * w) / half.x,
                  (row(f.up, light) - middle.y * w) / half.y, {0.0, 0.0, 0.0, p.near_m}, w);
    p.clip_from_world = {p.receiver_from_world};
    p.is_needed = {1};
    p.texel = 2.0 * std::max(half.x, half.y) / fitting.size;
    return p;
}

Projector cube(const glm::dvec3& light, const Fitting& fitting) {
    // Axes as mapped.frag has them.
    static const std::array<Frame, 6> faces{{{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}},
                                             {{0, 0, -1}, {0, 1, 0}, {-1, 0, 0}},
                                             {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                             {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                             {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                             {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}}};
    Projector p;
    p.cube = true;
    p.near_m = 1e-4 * fitting.scale_m;
    p.receiver_from_world[3] = glm::dvec4(-light, 1.0);
    p.texel = 2.0 / fitting.size;
    for (const Frame& f : faces) {
        p.clip_from_world.push_back(from_rows(row(f.right, light), row(f.up, light),
                                              {0.0, 0.0, 0.0, p.near_m}, row(f.forward, light)));
        const auto all_beyond = [&](const glm::dvec3& normal) {
            return std::ranges::all_of(fitting.seen, [&](const glm::dvec3& seen) {
                return glm::dot(normal, seen - light) < 0.0;
            });
        };
        p.is_needed.push_back(!all_beyond(f.forward) && !all_beyond(f.forward + f.right) &&
                              !all_beyond(f.forward - f.right) && !all_beyond(f.forward + f.up) &&
                              !all_beyond(f.forward - f.up));
    }
    return p;
}

}  // namespace

std::array<glm::dvec3, 8> corners_of(const scene::Bounds& box, const glm::dmat4& world_from_box) {
    std::array<glm::dvec3, 8> all;
    for (std::size_t i = 0; i < 8; ++i) {
        all[i] =
            glm::dvec3(world_from_box * glm::dvec4((i & 1U) != 0 ? box.max.x : box.min.x,
                                                   (i & 2U) != 0 ? box.max.y : box.min.y,
                                                   (i & 4U) != 0 ? box.max.z : box.min.z, 1.0));
    }
    return all;
}

std::vector<glm::dvec3> seen_part(const scene::Bounds& box, const shadows::View& view) {
    if (box.empty()) return {};
    const glm::dmat4 rows = glm::transpose(view.clip_from_world());
    const std::array<glm::dvec4, 5> planes{rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1],
                                           rows[3] - rows[1], rows[3] - rows[2]};
    const auto corner = corners_of(box, glm::dmat4(1.0));
    constexpr std::array<std::array<std::size_t, 4>, 6> faces{
        {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
    std::vector<glm::dvec3> seen;
    // What is seen of the box's faces (Sutherland and Hodgman, 1974) ...
    for (const auto& face : faces) {
        std::vector<glm::dvec3> polygon;
        for (const std::size_t i : face) polygon.push_back(corner[i]);
        for (const glm::dvec4& plane : planes) {
            std::vector<glm::dvec3> cut;
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const glm::dvec3& a = polygon[i];
                const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
                const double da = glm::dot(plane, glm::dvec4(a, 1.0));
                const double db = glm::dot(plane, glm::dvec4(b, 1.0));
                if (da >= 0.0) cut.push_back(a);
                if ((da >= 0.0) != (db >= 0.0)) cut.push_back(a + (b - a) * (da / (da - db)));
            }
            polygon = std::move(cut);
        }
        seen.insert(seen.end(), polygon.begin(), polygon.end());
    }
    // ... and the corners of the view that lie within it: those of the near plane.
    const glm::dmat4 world_from_clip = glm::inverse(view.clip_from_world());
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
            const glm::dvec4 p = world_from_clip * glm::dvec4(x, y, 1.0, 1.0);
            const glm::dvec3 place = glm::dvec3(p) / p.w;
            if (glm::all(glm::greaterThanEqual(place, box.min)) &&
                glm::all(glm::lessThanEqual(place, box.max))) {
                seen.push_back(place);
            }
        }
    }
    return seen;
}

bool is_outside(const std::array<glm::dvec3, 8>& corners, const glm::dmat4& clip_from_world) {
    std::array<bool, 5> beyond{true, true, true, true, true};
    for (const glm::dvec3& corner : corners) {
        const glm::dvec4 p = clip_from_world * glm::dvec4(corner, 1.0);
        beyond[0] = beyond[0] && p.x < -p.w;
        beyond[1] = beyond[1] && p.x > p.w;
        beyond[2] = beyond[2] && p.y < -p.w;
        beyond[3] = beyond[3] && p.y > p.w;
        beyond[4] = beyond[4] && p.z > p.w;
    }
    return std::ranges::any_of(beyond, [](bool b) { return b; });
}

Projector fit_projector(const shadows::Light& light, const Fitting& fitting) {
    if (fitting.seen.empty() || fitting.casters.empty()) return {};
    const glm::dvec3 position(light.position_world);
    if (light.position_world.w == 0.0) return orthographic(position, fitting);
    if (auto single = perspective(position, fitting)) return *std::move(single);
    return cube(position, fitting);
}

}  // namespace gnomon::report::internal
