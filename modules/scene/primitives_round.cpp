// SPDX-License-Identifier: MIT
//
// Sphere, torus, torus knot, cylinder. A seam needs two vertices where texture coordinates wrap;
// their positions come from one table entry each, so they are bit-equal: sin(2 pi) is never
// computed.
#include <cmath>
#include <numbers>

#include <gnomon/core/expects.hpp>
#include <gnomon/scene/primitives.hpp>

namespace gnomon::scene {
namespace {

/// Points (cos, sin) of a full turn, in double; entry i of n at the angle 2 pi i / n.
std::vector<glm::dvec2> full_turn(std::uint32_t n) {
    std::vector<glm::dvec2> turn(n);
    for (std::uint32_t i = 0; i < n; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / n;
        turn[i] = {std::cos(angle), std::sin(angle)};
    }
    return turn;
}

void add_vertex(Mesh& mesh, const glm::dvec3& position, const glm::dvec3& normal,
                const glm::dvec2& texcoord) {
    mesh.positions.emplace_back(position);
    mesh.normals.emplace_back(glm::normalize(normal));
    mesh.texcoords.emplace_back(texcoord);
}

void add_triangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

/// Two triangles a cell of a grid of (columns + 1) x (rows + 1) vertices, row by row; counter-
/// clockwise when columns run to the right and rows run up.
void add_grid(Mesh& mesh, std::uint32_t columns, std::uint32_t rows) {
    const std::uint32_t stride = columns + 1;
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const std::uint32_t a = row * stride + column;
            add_triangle(mesh, a, a + 1, a + stride + 1);
            add_triangle(mesh, a, a + stride + 1, a + stride);
        }
    }
}

Mesh finish(Mesh mesh, std::uint32_t material) {
    mesh.sub_meshes.push_back({0, static_cast<std::uint32_t>(mesh.indices.size()), material});
    return mesh;
}

/// A closed tube: `ring_segments` rings of `tube_segments` points. frame_of(i) gives the centre of
/// ring i, its outward direction and the second direction of its plane.
template <class FrameOf>
Mesh make_tube(const char* name, double tube_radius, std::uint32_t ring_segments,
               std::uint32_t tube_segments, std::uint32_t material, const FrameOf& frame_of) {
    GNOMON_EXPECTS(ring_segments >= 3 && tube_segments >= 3);
    Mesh mesh;
    mesh.name = name;
    const std::vector<glm::dvec2> tube = full_turn(tube_segments);
    for (std::uint32_t j = 0; j <= tube_segments; ++j) {
        const glm::dvec2 round = tube[j % tube_segments];
        for (std::uint32_t i = 0; i <= ring_segments; ++i) {
            const auto [center, out, up] = frame_of(i % ring_segments);
            const glm::dvec3 normal = out * round.x + up * round.y;
            add_vertex(
                mesh, center + normal * tube_radius, normal,
                {static_cast<double>(i) / ring_segments, static_cast<double>(j) / tube_segments});
        }
    }
    add_grid(mesh, ring_segments, tube_segments);
    return finish(std::move(mesh), material);
}

struct Frame {
    glm::dvec3 center, out, up;
};

}  // namespace

Mesh make_sphere(float radius, std::uint32_t slices, std::uint32_t stacks, std::uint32_t material) {
    GNOMON_EXPECTS(slices >= 3 && stacks >= 2);
    Mesh mesh;
    mesh.name = "sphere";
    const std::vector<glm::dvec2> turn = full_turn(slices);
    const double r = radius;
    const auto pole = [&](double y, double v) {
        for (std::uint32_t i = 0; i < slices; ++i) {
            add_vertex(mesh, {0.0, y * r, 0.0}, {0.0, y, 0.0}, {(i + 0.5) / slices, v});
        }
    };
    pole(-1.0, 1.0);
    for (std::uint32_t j = 1; j < stacks; ++j) {
        const double angle = std::numbers::pi * j / stacks;  // from the south pole
        for (std::uint32_t i = 0; i <= slices; ++i) {
            const glm::dvec2 round = turn[i % slices] * std::sin(angle);
            const glm::dvec3 normal{round.x, -std::cos(angle), -round.y};
            add_vertex(mesh, normal * r, normal,
                       {static_cast<double>(i) / slices, 1.0 - static_cast<double>(j) / stacks});
        }
    }
    pole(1.0, 0.0);
    const std::uint32_t stride = slices + 1;
    const auto ring = [&](std::uint32_t j) { return slices + (j - 1) * stride; };
    const std::uint32_t north = ring(stacks);
    for (std::uint32_t i = 0; i < slices; ++i) add_triangle(mesh, i, ring(1) + i + 1, ring(1) + i);
    for (std::uint32_t j = 1; j + 1 < stacks; ++j) {
        for (std::uint32_t i = 0; i < slices; ++i) {
            const std::uint32_t a = ring(j) + i;
            add_triangle(mesh, a, a + 1, a + stride + 1);
            add_triangle(mesh, a, a + stride + 1, a + stride);
        }
    }
    for (std::uint32_t i = 0; i < slices; ++i) {
        add_triangle(mesh, ring(stacks - 1) + i, ring(stacks - 1) + i + 1, north + i);
    }
    return finish(std::move(mesh), material);
}

Mesh make_torus(float ring_radius, float tube_radius, std::uint32_t ring_segments,
                std::uint32_t tube_segments, std::uint32_t material) {
    GNOMON_EXPECTS(ring_segments >= 3);
    const std::vector<glm::dvec2> turn = full_turn(ring_segments);
    return make_tube("torus", tube_radius, ring_segments, tube_segments, material,
                     [&](std::uint32_t i) {
                         const glm::dvec3 out{turn[i].x, 0.0, -turn[i].y};
                         return Frame{out * static_cast<double>(ring_radius), out, {0.0, 1.0, 0.0}};
                     });
}

Mesh make_torus_knot(float ring_radius, float tube_radius, std::uint32_t p, std::uint32_t q,
                     std::uint32_t ring_segments, std::uint32_t tube_segments,
                     std::uint32_t material) {
    GNOMON_EXPECTS(p >= 1 && q >= 1 && ring_segments >= 3);
    // The curve winds p times round the axis and q times round a ring of half the radius.
    const auto curve = [&](double t) {
        const double reach = ring_radius * (2.0 + std::cos(q * t)) * 0.5;
        return glm::dvec3{reach * std::cos(p * t), ring_radius * std::sin(q * t) * 0.5,
                          -reach * std::sin(p * t)};
    };
    std::vector<Frame> frames(ring_segments);
    for (std::uint32_t i = 0; i < ring_segments; ++i) {
        const double t = 2.0 * std::numbers::pi * i / ring_segments;
        const double step = 1e-4;
        const glm::dvec3 center = curve(t);
        const glm::dvec3 along = glm::normalize(curve(t + step) - curve(t - step));
        // Away from the axis, made perpendicular to the curve: depends on the place alone, so the
        // last ring meets the first without a twist.
        const glm::dvec3 away = center - along * glm::dot(center, along);
        const glm::dvec3 out = glm::normalize(away);
        frames[i] = {center, out, glm::cross(out, along)};
    }
    return make_tube("torus knot", tube_radius, ring_segments, tube_segments, material,
                     [&](std::uint32_t i) { return frames[i]; });
}

Mesh make_cylinder(float radius, float height, std::uint32_t slices, std::uint32_t material) {
    GNOMON_EXPECTS(slices >= 3);
    Mesh mesh;
    mesh.name = "cylinder";
    const std::vector<glm::dvec2> turn = full_turn(slices);
    const double r = radius;
    const double half = height * 0.5;
    for (const double y : {-half, half}) {
        for (std::uint32_t i = 0; i <= slices; ++i) {
            const glm::dvec2 round = turn[i % slices];
            add_vertex(mesh, {round.x * r, y, -round.y * r}, {round.x, 0.0, -round.y},
                       {static_cast<double>(i) / slices, y < 0.0 ? 1.0 : 0.0});
        }
    }
    add_grid(mesh, slices, 1);
    for (const double y : {-half, half}) {
        const auto center = static_cast<std::uint32_t>(mesh.positions.size());
        const glm::dvec3 normal{0.0, y < 0.0 ? -1.0 : 1.0, 0.0};
        add_vertex(mesh, {0.0, y, 0.0}, normal, {0.5, 0.5});
        for (const glm::dvec2& round : turn) {
            add_vertex(mesh, {round.x * r, y, -round.y * r}, normal, round * 0.5 + 0.5);
        }
        for (std::uint32_t i = 0; i < slices; ++i) {
            const std::uint32_t here = center + 1 + i;
            const std::uint32_t next = center + 1 + (i + 1) % slices;
            if (y < 0.0) {
                add_triangle(mesh, center, next, here);
            } else {
                add_triangle(mesh, center, here, next);
            }
        }
    }
    return finish(std::move(mesh), material);
}

}  // namespace gnomon::scene
