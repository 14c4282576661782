// SPDX-License-Identifier: MIT
#include "tests/shadows/random_meshes.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <span>
#include <utility>

#include <glm/gtc/quaternion.hpp>

namespace gnomon::test {

using shadows::LightLocal;
using shadows::ShadowMesh;

std::uint64_t run_seed() {
    static const std::uint64_t seed = [] {
        const char* text = std::getenv("GNOMON_SEED");
        return text != nullptr ? std::strtoull(text, nullptr, 10) : 1977ULL;
    }();
    return seed;
}

glm::dvec3 Random::unit_vector() {
    for (;;) {
        const glm::dvec3 v = in_cube(1.0);
        const double length = glm::length(v);
        if (length > 0.05 && length <= 1.0) return v / length;
    }
}

glm::dmat3 Random::rotation() {
    return glm::mat3_cast(glm::angleAxis(uniform(0.0, 2.0 * std::numbers::pi), unit_vector()));
}

std::shared_ptr<const ShadowMesh> build(const Triangles& triangles) {
    auto mesh =
        ShadowMesh::build({.positions = std::as_bytes(std::span(triangles.positions)).data(),
                           .vertex_count = triangles.positions.size(),
                           .indices = triangles.indices});
    if (!mesh) {
        std::fprintf(stderr, "%s\n", mesh.error().message.c_str());
        std::abort();
    }
    return *mesh;
}

namespace {

void quad(Triangles& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
}

// The corners of side `axis`, high or low, counter-clockwise from outside, by their bits xyz.
std::array<std::uint32_t, 4> box_side(unsigned axis, bool high) {
    const std::uint32_t u = 1U << ((axis + 1) % 3);
    const std::uint32_t v = 1U << ((axis + 2) % 3);
    const std::uint32_t base = high ? 1U << axis : 0U;
    if (high) return {base, base + u, base + u + v, base + v};
    return {base, base + v, base + u + v, base + u};
}

glm::vec3 box_corner(std::uint32_t bits, glm::vec3 low, glm::vec3 high) {
    return {(bits & 1U) != 0 ? high.x : low.x, (bits & 2U) != 0 ? high.y : low.y,
            (bits & 4U) != 0 ? high.z : low.z};
}

float angle(int i, int n) {
    return 2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(n);
}

}  // namespace

Triangles box(glm::vec3 low, glm::vec3 high) {
    Triangles mesh;
    for (std::uint32_t i = 0; i < 8; ++i) mesh.positions.push_back(box_corner(i, low, high));
    for (unsigned axis = 0; axis < 3; ++axis) {
        for (const bool is_high : {false, true}) {
            const auto [a, b, c, d] = box_side(axis, is_high);
            quad(mesh, a, b, c, d);
        }
    }
    return mesh;
}

Triangles box_with_seams() {
    Triangles mesh;
    for (unsigned axis = 0; axis < 3; ++axis) {
        for (const bool is_high : {false, true}) {
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            for (const std::uint32_t corner : box_side(axis, is_high)) {
                mesh.positions.push_back(box_corner(corner, glm::vec3(-1.0F), glm::vec3(1.0F)));
            }
            quad(mesh, first, first + 1, first + 2, first + 3);
        }
    }
    return mesh;
}

Triangles sphere(int rings, int segments, float radius) {
    Triangles mesh;
    mesh.positions.emplace_back(0.0F, radius, 0.0F);
    for (int r = 1; r < rings; ++r) {
        const float polar =
            std::numbers::pi_v<float> * static_cast<float>(r) / static_cast<float>(rings);
        for (int s = 0; s < segments; ++s) {
            const float a = angle(s, segments);
            mesh.positions.push_back(radius * glm::vec3(std::sin(polar) * std::cos(a),
                                                        std::cos(polar),
                                                        -std::sin(polar) * std::sin(a)));
        }
    }
    mesh.positions.emplace_back(0.0F, -radius, 0.0F);
    const auto at = [&](int r, int s) {
        return static_cast<std::uint32_t>(1 + (r - 1) * segments + s % segments);
    };
    const auto last = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    for (int s = 0; s < segments; ++s) {
        mesh.indices.insert(mesh.indices.end(), {0U, at(1, s), at(1, s + 1)});
        for (int r = 1; r + 1 < rings; ++r) {
            quad(mesh, at(r, s), at(r + 1, s), at(r + 1, s + 1), at(r, s + 1));
        }
        mesh.indices.insert(mesh.indices.end(), {last, at(rings - 1, s + 1), at(rings - 1, s)});
    }
    return mesh;
}

Triangles torus(int around, int along, float ring, float tube) {
    Triangles mesh;
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < along; ++j) {
            const float u = angle(i, around);
            const float v = angle(j, along);
            const float r = ring + tube * std::cos(v);
            mesh.positions.emplace_back(r * std::cos(u), tube * std::sin(v), -r * std::sin(u));
        }
    }
    const auto at = [&](int i, int j) {
        return static_cast<std::uint32_t>((i % around) * along + j % along);
    };
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < along; ++j) {
            quad(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
    return mesh;
}

Triangles tetrahedron(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
    // Outwards whatever the order of the corners.
    if (glm::dot(glm::cross(b - a, c - a), d - a) > 0.0F) std::swap(b, c);
    return {{a, b, c, d}, {0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0}};
}

Triangles l_shape() {
    Triangles mesh;
    const std::array<glm::vec2, 6> outline{glm::vec2(0, 0), {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    for (const float z : {1.0F, 0.0F}) {
        for (const glm::vec2& p : outline) mesh.positions.emplace_back(p, z);
    }
    quad(mesh, 0, 1, 2, 3);
    quad(mesh, 0, 3, 4, 5);
    quad(mesh, 9, 8, 7, 6);
    quad(mesh, 11, 10, 9, 6);
    for (std::uint32_t i = 0; i < 6; ++i) quad(mesh, 6 + i, 6 + (i + 1) % 6, (i + 1) % 6, i);
    return mesh;
}

Triangles sheet(int n) {
    Triangles mesh;
    for (int z = 0; z <= n; ++z) {
        for (int x = 0; x <= n; ++x) {
            mesh.positions.emplace_back(static_cast<float>(x), 0.0F, static_cast<float>(z));
        }
    }
    const auto at = [&](int x, int z) { return static_cast<std::uint32_t>(z * (n + 1) + x); };
    for (int z = 0; z < n; ++z) {
        for (int x = 0; x < n; ++x)
            quad(mesh, at(x, z), at(x, z + 1), at(x + 1, z + 1), at(x + 1, z));
    }
    return mesh;
}

Triangles book(int pages) {
    Triangles mesh{{{0.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}}, {}};
    for (int i = 0; i < pages; ++i) {
        const float a = angle(i, pages);
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.emplace_back(std::cos(a), 0.0F, std::sin(a));
        mesh.positions.emplace_back(std::cos(a), 1.0F, std::sin(a));
        quad(mesh, 0, first, first + 1, 1);
    }
    return mesh;
}

Triangles moebius(int quads) {
    Triangles mesh;
    for (int i = 0; i < quads; ++i) {
        const float a = angle(i, quads);
        for (const float side : {-0.3F, 0.3F}) {
            const float r = 1.0F + side * std::cos(a / 2.0F);
            mesh.positions.emplace_back(r * std::cos(a), side * std::sin(a / 2.0F),
                                        r * std::sin(a));
        }
    }
    for (int i = 0; i + 1 < quads; ++i) {
        const auto v = static_cast<std::uint32_t>(2 * i);
        quad(mesh, v, v + 1, v + 3, v + 2);
    }
    // Half a turn: the last quad meets the first the other way round.
    const auto v = static_cast<std::uint32_t>(2 * quads - 2);
    quad(mesh, v, v + 1, 0, 1);
    return mesh;
}

Triangles merged(Triangles a, const Triangles& b) {
    const auto first = static_cast<std::uint32_t>(a.positions.size());
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
    for (const std::uint32_t i : b.indices) a.indices.push_back(first + i);
    return a;
}

Triangles moved(Triangles mesh, glm::vec3 offset) {
    for (glm::vec3& p : mesh.positions) p += offset;
    return mesh;
}

Triangles inside_out(Triangles mesh) {
    for (std::size_t f = 0; f < mesh.count(); ++f) flip_face(mesh, f);
    return mesh;
}

Triangles unindexed(const Triangles& mesh) {
    Triangles soup;
    for (const std::uint32_t i : mesh.indices) {
        soup.indices.push_back(static_cast<std::uint32_t>(soup.positions.size()));
        soup.positions.push_back(mesh.positions[i]);
    }
    return soup;
}

void remove_face(Triangles& mesh, std::size_t face) {
    const auto at = mesh.indices.begin() + static_cast<std::ptrdiff_t>(3 * face);
    mesh.indices.erase(at, at + 3);
}

void flip_face(Triangles& mesh, std::size_t face) {
    std::swap(mesh.indices[3 * face + 1], mesh.indices[3 * face + 2]);
}

void repeat_face(Triangles& mesh, std::size_t face) {
    for (std::size_t i = 0; i < 3; ++i) mesh.indices.push_back(mesh.indices[3 * face + i]);
}

namespace {

glm::vec3 grid_point(Random& random, int half) {
    return {static_cast<float>(random.integer(-half, half)),
            static_cast<float>(random.integer(-half, half)),
            static_cast<float>(random.integer(-half, half))};
}

Triangles grid_soup(Random& random) {
    Triangles mesh;
    const int points = random.integer(4, 14);
    for (int i = 0; i < points; ++i) mesh.positions.push_back(grid_point(random, 2));
    const int count = random.integer(4, 40);
    for (int i = 0; i < 3 * count; ++i) mesh.indices.push_back(random.below(mesh.positions.size()));
    return mesh;
}

Triangles base_shape(Random& random) {
    switch (random.integer(0, 10)) {
        case 0: return box();
        case 1: return box_with_seams();
        case 2: return sphere(random.integer(3, 7), random.integer(3, 12));
        case 3: return torus(random.integer(3, 9), random.integer(3, 7));
        case 4:
            return tetrahedron(grid_point(random, 3), grid_point(random, 3), grid_point(random, 3),
                               grid_point(random, 3));
        case 5: return sheet(random.integer(1, 4));
        case 6: return book(random.integer(3, 9));
        case 7: return moebius(random.integer(4, 12));
        case 8: return grid_soup(random);
        case 9:  // two cubes that share an edge
            return merged(box({0, 0, 0}, {1, 1, 1}), box({1, 1, 0}, {2, 2, 1}));
        default: return merged(box(), inside_out(box({-3, -1, -1}, {-2, 0, 0})));
    }
}

}  // namespace

Triangles random_mesh(Random& random) {
    Triangles mesh = base_shape(random);
    if (random.chance(0.3)) mesh = merged(std::move(mesh), base_shape(random));
    const bool plain = random.chance(0.3);
    for (int i = random.integer(0, 4); !plain && i > 0; --i) {
        const std::size_t face = random.below(mesh.count());
        switch (random.integer(0, 5)) {
            case 0: flip_face(mesh, face); break;
            case 1: repeat_face(mesh, face); break;
            case 2:  // two equal corners
                repeat_face(mesh, face);
                mesh.indices.back() = mesh.indices[mesh.indices.size() - 2];
                break;
            case 3: {  // three corners on one line
                const glm::vec3 a = mesh.positions[mesh.indices[3 * face]];
                const glm::vec3 b = mesh.positions[mesh.indices[3 * face + 1]];
                repeat_face(mesh, face);
                mesh.indices.back() = static_cast<std::uint32_t>(mesh.positions.size());
                mesh.positions.push_back((a + b) * 0.5F);
                break;
            }
            default:
                if (mesh.count() > 1) remove_face(mesh, face);
        }
    }
    if (random.chance(0.15)) mesh = inside_out(std::move(mesh));
    if (random.chance(0.2)) mesh = unindexed(mesh);
    if (random.chance(0.3)) {
        const auto jitter = static_cast<float>(random.uniform(0.0, 0.3));
        for (glm::vec3& p : mesh.positions) p += glm::vec3(random.in_cube(1.0)) * jitter;
    }
    return mesh;
}

Triangles wild_soup(Random& random, int count) {
    Triangles mesh;
    const auto coordinate = [&] {
        return static_cast<float>(std::ldexp(random.uniform(-1.0, 1.0), random.integer(-30, 30)));
    };
    for (int i = 0; i < count + 2; ++i) {
        mesh.positions.emplace_back(coordinate(), coordinate(), coordinate());
    }
    for (int i = 0; i < 3 * count; ++i) mesh.indices.push_back(random.below(mesh.positions.size()));
    return mesh;
}

LightLocal random_light(Random& random, const ShadowMesh& mesh) {
    const auto& face = mesh.faces()[random.below(mesh.faces().size())];
    const glm::vec3 a = mesh.positions()[face[0]];
    const glm::vec3 b = mesh.positions()[face[1]];
    const glm::vec3 c = mesh.positions()[face[2]];
    const glm::vec3 low = mesh.bounds_min();
    const glm::vec3 high = mesh.bounds_max();
    const glm::dvec3 center = 0.5 * (glm::dvec3(low) + glm::dvec3(high));
    const double size = glm::length(glm::dvec3(high) - glm::dvec3(low));
    const auto point = [](const glm::vec3& p) { return LightLocal{glm::vec4(p, 1.0F)}; };
    const auto direction = [](const glm::vec3& d) { return LightLocal{glm::vec4(d, 0.0F)}; };
    switch (random.integer(0, 14)) {
        case 0: return point(a);
        case 1: return point((a + b) * 0.5F);
        case 2: return point((a + b + c) / 3.0F);
        case 3:  // in the face's plane, or as near as floats come to it
            return point(a + (b - a) * static_cast<float>(random.integer(-3, 3)) +
                         (c - a) * static_cast<float>(random.integer(-3, 3)));
        case 4: {  // on a side of the bounds
            glm::vec3 p(center + random.in_cube(0.4 * size));
            const int axis = random.integer(0, 2);
            p[axis] = random.chance(0.5) ? low[axis] : high[axis];
            return point(p);
        }
        case 5: return point(random.chance(0.5) ? low : high);
        case 6: return point(glm::vec3(center + random.in_cube(0.3 * size)));
        case 7: return point(glm::vec3(center + random.unit_vector() * size * 1e4));
        case 8: return point(glm::round(glm::vec3(center + random.unit_vector() * 2.0 * size)));
        case 9: return direction(b - a);
        case 10: {
            glm::vec3 d(0.0F);
            d[random.integer(0, 2)] = random.chance(0.5) ? 1.0F : -2.5F;
            return direction(d);
        }
        case 11:
        case 12: return direction(glm::vec3(random.unit_vector()));
        default:
            return point(
                glm::vec3(center + random.unit_vector() * size * random.uniform(0.6, 4.0)));
    }
}

}  // namespace gnomon::test
