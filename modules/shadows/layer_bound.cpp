// SPDX-License-Identifier: MIT
#include <gnomon/shadows/layer_bound.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "internal/layers.hpp"
#include "internal/upright_planes.hpp"
#include "internal/winding_grid.hpp"

namespace gnomon::shadows {

namespace {

using internal::GridPoint;
using internal::WindingGrid;

constexpr double half_ulp = 0x1p-53;

// Positions as seen from the light: relative to it for a point light.
struct Placement {
    const ShadowMesh& mesh;
    const LayerSpace& space;
    bool is_local;

    Placement(const ShadowMesh& m, const LayerSpace& s)
        : mesh(m), space(s), is_local(s.space_from_local == glm::dmat4(1.0)) {}

    [[nodiscard]] bool directional() const { return space.light.w == 0.0; }
    [[nodiscard]] glm::dvec3 place(const glm::dvec3& p) const {
        const glm::dvec3 there =
            is_local ? p : glm::dvec3(space.space_from_local * glm::dvec4(p, 1.0));
        return directional() ? there : there - glm::dvec3(space.light);
    }
    [[nodiscard]] glm::dvec3 operator()(std::uint32_t vertex) const {
        return place(glm::dvec3(mesh.positions()[vertex]));
    }
    [[nodiscard]] std::array<glm::dvec3, 8> corners() const {
        std::array<glm::dvec3, 8> result;
        for (unsigned i = 0; i < 8; ++i) {
            const glm::vec3& low = mesh.bounds_min();
            const glm::vec3& high = mesh.bounds_max();
            result[i] =
                place(glm::dvec3((i & 1U) != 0 ? high.x : low.x, (i & 2U) != 0 ? high.y : low.y,
                                 (i & 4U) != 0 ? high.z : low.z));
        }
        return result;
    }
    // Of each coordinate of a placed position; its own rounding, relative to itself, excepted.
    [[nodiscard]] double error() const {
        if (is_local) return 0.0;
        const glm::dvec3 farthest = glm::max(glm::abs(glm::dvec3(mesh.bounds_min())),
                                             glm::abs(glm::dvec3(mesh.bounds_max())));
        double sum = 0.0;
        for (int i = 0; i < 3; ++i) {
            sum += glm::length(glm::dvec3(space.space_from_local[i])) * farthest[i];
        }
        return 8.0 * half_ulp *
               (sum + glm::length(glm::dvec3(space.space_from_local[3])) +
                glm::length(glm::dvec3(space.light)));
    }
};

std::int64_t cells_for(std::size_t edges, internal::Grid grid) {
    const std::size_t cells = std::clamp<std::size_t>(std::bit_ceil(edges / 8 + 1), 8, 256);
    if (grid == internal::Grid::Half) return static_cast<std::int64_t>(cells / 2);
    return static_cast<std::int64_t>(grid == internal::Grid::Fine ? 4 * cells : cells);
}

// right x up = backward: what is counter-clockwise to the light is so in the picture.
struct Axes {
    glm::dvec3 right, up, forward;
};

Axes axes_along(const glm::dvec3& forward) {
    const glm::dvec3 f = glm::normalize(forward);
    const glm::dvec3 a = glm::abs(f);
    const glm::dvec3 least = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
                             : a.y <= a.z             ? glm::dvec3(0, 1, 0)
                                                      : glm::dvec3(0, 0, 1);
    const glm::dvec3 right = glm::normalize(glm::cross(f, least));
    return {right, glm::cross(right, f), f};
}

// Along the way to the middle of the mesh; none where it fills more than some 160 degrees, and a
// picture has no resolution left.
std::optional<Axes> axes_of_one_picture(const Placement& placement) {
    if (placement.directional()) return axes_along(-glm::dvec3(placement.space.light));
    glm::dvec3 center(0.0);
    const auto corners = placement.corners();
    for (const glm::dvec3& corner : corners) center += corner * 0.125;
    const Axes axes = axes_along(center);
    const bool narrow = std::all_of(corners.begin(), corners.end(), [&](const glm::dvec3& d) {
        return glm::dot(d, axes.forward) > 0.15 * glm::length(d);
    });
    return narrow ? std::optional(axes) : std::nullopt;
}

// Of a coordinate of a picture that reaches from `low` to `high`.
double error_in_picture(const Placement& placement, const glm::dvec2& low, const glm::dvec2& high,
                        double nearest) {
    const double largest = std::max({std::abs(low.x), std::abs(low.y), std::abs(high.x),
                                     std::abs(high.y), placement.directional() ? 0.0 : 1.0});
    return 16.0 * half_ulp * largest +
           2.0 * placement.error() * (placement.directional() ? 1.0 : (1.0 + largest) / nearest);
}

// The nearest even number; x within +-2^30, moved to where leaving out what is behind the point is
// rounding down.
std::int64_t even(double x) {
    constexpr std::int64_t shift = std::int64_t{1} << 30U;
    return 2 * (static_cast<std::int64_t>(0.5 * x + (static_cast<double>(shift) + 0.5)) - shift);
}

// ---------------------------------------------------------------------------------------------
// One picture holds the whole mesh, and outside it nothing is covered.

std::optional<std::int64_t> bound_in_one_picture(const Placement& placement,
                                                 std::span<const SilhouetteEdge> boundary,
                                                 const Axes& axes, internal::Grid grid) {
    std::vector<glm::dvec2> points;
    points.reserve(2 * boundary.size());
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high(-low);
    double nearest = std::numeric_limits<double>::infinity();
    for (const SilhouetteEdge& edge : boundary) {
        for (const std::uint32_t v : {edge.from, edge.to}) {
            const glm::dvec3 d = placement(v);
            glm::dvec2 p(glm::dot(d, axes.right), glm::dot(d, axes.up));
            if (!placement.directional()) {
                const double depth = glm::dot(d, axes.forward);
                nearest = std::min(nearest, depth);
                p /= depth;
            }
            points.push_back(p);
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    }
    const double extent = std::max(high.x - low.x, high.y - low.y);
    const double error = error_in_picture(placement, low, high, nearest);
    // In units of the grid, half of its slack; also refuses what is not a number.
    if (!(error * static_cast<double>(WindingGrid::width) <=
          0.5 * static_cast<double>(WindingGrid::slack) * extent)) {
        return std::nullopt;
    }
    const double border = 64.0;
    const double scale = (static_cast<double>(WindingGrid::width) - 2.0 * border) / extent;
    const auto to_grid = [&](const glm::dvec2& p) {
        return GridPoint(even((p.x - low.x) * scale + border),
                         even((p.y - low.y) * scale + border));
    };
    const auto most_with = [&](std::int64_t cells) {
        WindingGrid windings(cells);
        for (std::size_t i = 0; i < boundary.size(); ++i) {
            windings.add_edge(to_grid(points[2 * i]), to_grid(points[2 * i + 1]),
                              boundary[i].count);
        }
        return windings.most(0);
    };
    const std::int64_t most = most_with(cells_for(boundary.size(), grid));
    if (grid != internal::Grid::Best || most <= internal::many_layers) return most;
    return std::min(most, most_with(cells_for(boundary.size(), internal::Grid::Fine)));
}

// ---------------------------------------------------------------------------------------------
// A sheaf of lines across one picture, in two directions: a line that passes a point which the
// boundary winds round n times crosses it 2 n times or more. Lines are binned; all that may cross
// any line of a bin counts.

class Sheaf {
public:
    Sheaf(double low, double high) : low_(low), scale_(bins / (high - low)) {}

    // What a line at `a` or at `b` is next to may be in its place: rounding is far below that.
    void add_edge(double a, double b) {
        const auto bin = [&](double x) {
            return std::clamp(static_cast<int>((x - low_) * scale_), 0, bins - 1);
        };
        starts_[static_cast<std::size_t>(bin(std::min(a, b) - room()))] += 1;
        starts_[static_cast<std::size_t>(bin(std::max(a, b) + room())) + 1] -= 1;
    }
    [[nodiscard]] std::int64_t most_crossings() const {
        std::int64_t most = 0;
        std::int64_t now = 0;
        for (const std::int32_t change : starts_) most = std::max(most, now += change);
        return most;
    }
    [[nodiscard]] double room() const { return 1e-3 / scale_; }

private:
    static constexpr int bins = 256;
    double low_;
    double scale_;
    std::array<std::int32_t, bins + 1> starts_{};
};

std::optional<std::int64_t> bound_by_sheaves(const Placement& placement, const IndexRange& sides,
                                             std::span<const std::uint32_t> indices,
                                             const Axes& axes) {
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high(-low);
    double nearest = std::numeric_limits<double>::infinity();
    const auto project = [&](const glm::dvec3& d) {
        const glm::dvec2 p(glm::dot(d, axes.right), glm::dot(d, axes.up));
        return placement.directional() ? p : p / glm::dot(d, axes.forward);
    };
    for (const glm::dvec3& corner : placement.corners()) {
        const glm::dvec2 p = project(corner);
        low = glm::min(low, p);
        high = glm::max(high, p);
        nearest = std::min(nearest, glm::dot(corner, axes.forward));
    }
    Sheaf upright(low.x, high.x);
    Sheaf level(low.y, high.y);
    const double error = error_in_picture(placement, low, high, nearest);
    // Strictly: a picture without extent has no lines to tell apart.
    if (!(2.0 * error < std::min(upright.room(), level.room()))) return std::nullopt;
    for (std::uint32_t i = sides.first; i < sides.first + sides.count; i += 3) {
        const std::uint32_t to = indices[i];
        const std::uint32_t from = indices[i + 1];
        if (to % 2 != 0 || from % 2 != 0) continue;
        const glm::dvec2 a = project(placement(from / 2));
        const glm::dvec2 b = project(placement(to / 2));
        upright.add_edge(a.x, b.x);
        level.add_edge(a.y, b.y);
    }
    return std::min(upright.most_crossings(), level.most_crossings()) / 2;
}

// ---------------------------------------------------------------------------------------------
// A light among the faces: six pictures, the sides of a cube about it. Each begins at a corner of
// the cube, where the layers are counted face by face; all six share two corners.

struct CornerLayers {
    std::int64_t low = 0;   // towards (-1, -1, -1)
    std::int64_t high = 0;  // towards (1, 1, 1)
};

// Casting faces that the two rays meet, or pass within 1e-5 rad: the pictures begin near the
// corners, not on them.
CornerLayers layers_at_corners(const Placement& placement, const internal::CastingFaces& casting) {
    constexpr double tolerance = 1e-5;
    constexpr double rounding = 1e-12;
    CornerLayers layers;
    const auto add = [&](const std::array<std::uint32_t, 3>& face) {
        std::array<glm::dvec3, 3> d;
        std::array<double, 3> length2{};
        for (std::size_t i = 0; i < 3; ++i) {
            d[i] = placement(face[i]);
            length2[i] = glm::dot(d[i], d[i]);
        }
        // On which sides of the planes through the light and an edge (1, 1, 1) lies.
        bool left = true;
        bool right = true;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t k = (i + 1) % 3;
            const glm::dvec3 n = glm::cross(d[i], d[k]);
            const double height = n.x + n.y + n.z;
            const bool clear =
                height * height > 6.0 * (tolerance * tolerance * glm::dot(n, n) +
                                         rounding * rounding * length2[i] * length2[k]);
            left = left && (height >= 0.0 || !clear);
            right = right && (height <= 0.0 || !clear);
        }
        if (!left && !right) return;
        // The face, or its mirror image behind the light.
        const double side = glm::dot(d[0], glm::cross(d[1], d[2]));
        const double doubt = rounding * std::sqrt(length2[0] * length2[1] * length2[2]);
        const bool forwards = side >= -doubt;
        const bool backwards = side <= doubt;
        layers.high += (left && forwards) || (right && backwards) ? 1 : 0;
        layers.low += (right && forwards) || (left && backwards) ? 1 : 0;
    };
    for (std::size_t i = 0; i < casting.triples.size(); i += 3) {
        add({casting.triples[i] / 2, casting.triples[i + 1] / 2, casting.triples[i + 2] / 2});
    }
    for_each_face_of_ranges(placement.mesh, casting.ranges, casting.undone,
                            [&](std::uint32_t f) { add(placement.mesh.faces()[f]); });
    return layers;
}

// The piece of a -> b with |right| and |up| at most `limit` times forward.
bool clip(glm::dvec3& a, glm::dvec3& b, double limit) {
    double from = 0.0;
    double to = 1.0;
    for (int axis = 0; axis < 2; ++axis) {
        for (const double sign : {-1.0, 1.0}) {
            const double at_a = limit * a.z + sign * a[axis];
            const double at_b = limit * b.z + sign * b[axis];
            if (at_a < 0.0 && at_b < 0.0) return false;
            if (at_a < 0.0) from = std::max(from, at_a / (at_a - at_b));
            if (at_b < 0.0) to = std::min(to, at_a / (at_a - at_b));
        }
    }
    if (from >= to) return false;
    const glm::dvec3 d = b - a;
    if (to < 1.0) b = a + to * d;
    if (from > 0.0) a += from * d;
    return a.z > 0.0 && b.z > 0.0;
}

std::optional<std::int64_t> bound_all_round(const Placement& placement,
                                            const internal::CastingFaces& casting,
                                            std::span<const SilhouetteEdge> boundary,
                                            internal::Grid grid) {
    // The pictures overlap a little, and edges reach a little beyond them.
    constexpr double side = 1.0 + 1e-6;
    constexpr double reach = 1.0 + 1e-3;
    double nearest = std::numeric_limits<double>::infinity();
    std::vector<glm::dvec3> points;
    points.reserve(2 * boundary.size());
    for (const SilhouetteEdge& edge : boundary) {
        for (const std::uint32_t v : {edge.from, edge.to}) {
            points.push_back(placement(v));
            nearest = std::min(nearest, glm::length(points.back()));
        }
    }
    if (!(placement.error() * 0x1p27 <= nearest)) return std::nullopt;

    std::int64_t result = 0;
    WindingGrid windings(cells_for(boundary.size() / 2, grid));
    const CornerLayers at_corners = layers_at_corners(placement, casting);
    for (int face = 0; face < 6; ++face) {
        const int axis = face % 3;
        const double sign = face < 3 ? -1.0 : 1.0;  // of the side, and of the corner it begins at
        const auto seen = [&](const glm::dvec3& d) {
            const double u = -sign * d[(axis + 1) % 3];
            const double v = -sign * d[(axis + 2) % 3];
            return sign < 0.0 ? glm::dvec3(u, v, -d[axis]) : glm::dvec3(v, u, d[axis]);
        };
        const auto to_grid = [&](const glm::dvec3& p) {
            constexpr double scale = static_cast<double>(WindingGrid::width) / (2.0 * side);
            // Within what the grid takes, whatever is left of a piece that passes the light.
            const auto at = [&](double x) {
                return even((std::clamp(x / p.z, -reach, reach) + side) * scale);
            };
            return GridPoint(at(p.x), at(p.y));
        };
        for (std::size_t i = 0; i < boundary.size(); ++i) {
            glm::dvec3 a = seen(points[2 * i]);
            glm::dvec3 b = seen(points[2 * i + 1]);
            if (clip(a, b, reach)) windings.add_edge(to_grid(a), to_grid(b), boundary[i].count);
        }
        result = std::max(result, windings.most(sign < 0.0 ? at_corners.low : at_corners.high));
        windings.clear();
    }
    return result;
}

}  // namespace

namespace internal {

std::uint32_t quick_bound(std::uint64_t faces, std::uint64_t sides, bool from_outside) {
    if (from_outside) faces = std::min(faces, sides == 0 ? 0 : (sides - 1) / 2);
    return static_cast<std::uint32_t>(faces);
}

void silhouette_of(const Volume& volume, std::vector<SilhouetteEdge>& silhouette) {
    silhouette.clear();
    // Each side starts with the two near vertices of its edge, the later one first.
    const IndexRange& sides = volume.sides;
    for (std::uint32_t i = sides.first; i < sides.first + sides.count; i += 3) {
        const std::uint32_t to = volume.indices[i];
        const std::uint32_t from = volume.indices[i + 1];
        if (to % 2 != 0 || from % 2 != 0) continue;
        const SilhouetteEdge edge{from / 2, to / 2, 1};
        if (!silhouette.empty() && silhouette.back().from == edge.from &&
            silhouette.back().to == edge.to) {
            ++silhouette.back().count;
        } else {
            silhouette.push_back(edge);
        }
    }
}

std::uint32_t bound_layers(const ShadowMesh& mesh, const CastingFaces& casting,
                           std::span<const SilhouetteEdge> boundary, const LayerSpace& space,
                           Grid grid) {
    const Placement placement(mesh, space);
    std::uint64_t sides = 0;
    for (const SilhouetteEdge& edge : boundary) sides += static_cast<std::uint64_t>(edge.count);
    const std::uint32_t quick = quick_bound(casting.count(), sides, seen_from_outside(mesh, space));
    if (quick <= 1) return quick;

    const std::optional<Axes> axes = axes_of_one_picture(placement);
    const auto found = axes ? bound_in_one_picture(placement, boundary, *axes, grid)
                            : bound_all_round(placement, casting, boundary, grid);
    if (!found) return quick;
    return static_cast<std::uint32_t>(std::min<std::int64_t>(*found, quick));
}

std::uint32_t layer_bound_on(Grid grid, const ShadowMesh& mesh, const Volume& volume,
                             const LayerSpace& space) {
    std::vector<SilhouetteEdge> boundary;
    silhouette_of(volume, boundary);
    // The triples of all near caps follow each other, then what is undone, and nothing more.
    const std::span<const std::uint32_t> indices(volume.indices);
    const std::uint32_t first = volume.near_cap.triples.first;
    const std::uint32_t undone = volume.near_cap.undone.first;
    return bound_layers(
        mesh, {indices.subspan(first, undone - first), volume.ranges, indices.subspan(undone)},
        boundary, space, grid);
}

}  // namespace internal

bool seen_from_outside(const ShadowMesh& mesh, const LayerSpace& space) {
    const Placement placement(mesh, space);
    if (placement.directional()) return true;
    const auto corners = placement.corners();
    const double error = placement.error();
    for (int axis = 0; axis < 3; ++axis) {
        const auto beyond = [&](double sign) {
            return std::all_of(corners.begin(), corners.end(),
                               [&](const glm::dvec3& d) { return sign * d[axis] > error; });
        };
        if (beyond(1.0) || beyond(-1.0)) return true;
    }
    return false;
}

std::uint32_t quick_layer_bound(const Volume& volume, bool from_outside) {
    // A side is two triangles, or one where all far vertices are one point.
    return internal::quick_bound(volume.cap_faces(),
                                 volume.sides.count / (volume.made_with.one_far_point() ? 3 : 6),
                                 from_outside);
}

std::uint32_t coarse_layer_bound(const ShadowMesh& mesh, const Volume& volume,
                                 const LayerSpace& space) {
    const std::uint32_t quick = quick_layer_bound(volume, seen_from_outside(mesh, space));
    const Placement placement(mesh, space);
    const glm::vec4 light(space.light);
    if (placement.is_local && glm::dvec4(light) == space.light) {
        const std::size_t stride = volume.made_with.one_far_point() ? 3 : 6;
        const auto found = internal::bound_by_upright_planes(
            mesh, {light},
            {std::span(volume.indices).subspan(volume.sides.first, volume.sides.count), stride});
        if (found) return std::min(*found, quick);
    }
    const std::optional<Axes> axes = axes_of_one_picture(placement);
    if (!axes) return quick;
    const auto found = bound_by_sheaves(placement, volume.sides, volume.indices, *axes);
    if (!found) return quick;
    return static_cast<std::uint32_t>(std::min<std::int64_t>(*found, quick));
}

std::uint32_t layer_bound(const ShadowMesh& mesh, const Volume& volume, const LayerSpace& space) {
    return internal::layer_bound_on(internal::Grid::Best, mesh, volume, space);
}

}  // namespace gnomon::shadows
