// SPDX-License-Identifier: MIT
//
// Sources: F. C. Crow, "Shadow Algorithms for Computer Graphics" (1977), for the volume; P.
// Bergeron, "A General Version of Crow's Shadow Volumes" (1986), for edge multiplicities on open
// meshes; B. Kim, K. Kim and G. Turk, "A Shadow-Volume Algorithm for Opaque and Transparent
// Nonmanifold Casters" (2008), for any mesh.
#include <gnomon/shadows/volume.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <tuple>

namespace gnomon::shadows {

namespace {

std::uint32_t near_vertex(std::uint32_t v) { return 2 * v; }
std::uint32_t far_vertex(std::uint32_t v) { return 2 * v + 1; }

bool lexicographically_less(const glm::vec3& a, const glm::vec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

struct Writer {
    std::vector<std::uint32_t>& indices;

    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        indices.push_back(a);
        indices.push_back(b);
        indices.push_back(c);
    }
    [[nodiscard]] IndexRange range_since(std::size_t first) const {
        return {static_cast<std::uint32_t>(first),
                static_cast<std::uint32_t>(indices.size() - first)};
    }
};

}  // namespace

void build_volume(const ShadowMesh& mesh, std::span<const std::int8_t> weights,
                  std::span<const SilhouetteEdge> silhouette, bool directional,
                  FarVertices far_vertices, Volume& out,
                  std::span<const std::uint8_t> solid_averted) {
    out.indices.clear();
    out.silhouette_edges = static_cast<std::uint32_t>(silhouette.size());
    Writer write{out.indices};
    const bool one_far_point = directional && far_vertices == FarVertices::AtInfinity;
    const auto positions = mesh.positions();
    const auto faces = mesh.faces();

    // The near cap runs from -> to, so the side runs back along it: to, from, far from, far to.
    for (const SilhouetteEdge& edge : silhouette) {
        const std::uint32_t a = edge.from;
        const std::uint32_t b = edge.to;
        for (std::int32_t i = 0; i < edge.count; ++i) {
            if (one_far_point) {
                write.triangle(near_vertex(b), near_vertex(a), far_vertex(a));
            } else if (lexicographically_less(positions[a], positions[b])) {
                write.triangle(near_vertex(b), near_vertex(a), far_vertex(b));
                write.triangle(near_vertex(a), far_vertex(a), far_vertex(b));
            } else {
                write.triangle(near_vertex(b), near_vertex(a), far_vertex(a));
                write.triangle(near_vertex(b), far_vertex(a), far_vertex(b));
            }
        }
    }
    out.sides = write.range_since(0);

    std::size_t first = out.indices.size();
    for (std::size_t f = 0; f < faces.size(); ++f) {
        for (int i = 0; i < weights[f]; ++i) {
            write.triangle(near_vertex(faces[f][0]), near_vertex(faces[f][1]),
                           near_vertex(faces[f][2]));
        }
    }
    out.near_cap = write.range_since(first);

    first = out.indices.size();
    if (!one_far_point) {
        for (std::size_t f = 0; f < faces.size(); ++f) {
            const auto& [a, b, c] = faces[f];
            for (int i = 0; i < weights[f]; ++i) {
                write.triangle(far_vertex(c), far_vertex(b), far_vertex(a));
            }
            for (int i = 0; i < -weights[f]; ++i) {
                write.triangle(far_vertex(a), far_vertex(b), far_vertex(c));
            }
        }
    }
    out.far_cap = write.range_since(first);

    const auto face_components = mesh.face_components();
    const auto write_flipped = [&](bool averted) {
        for (std::size_t f = 0; f < faces.size(); ++f) {
            const bool is_averted =
                !solid_averted.empty() && solid_averted[face_components[f]] != 0;
            if (is_averted != averted) continue;
            for (int i = 0; i < -weights[f]; ++i) {
                write.triangle(near_vertex(faces[f][0]), near_vertex(faces[f][1]),
                               near_vertex(faces[f][2]));
            }
        }
    };
    first = out.indices.size();
    write_flipped(false);
    const std::size_t first_averted = out.indices.size();
    const bool any_averted =
        std::any_of(solid_averted.begin(), solid_averted.end(), [](auto a) { return a != 0; });
    if (any_averted) write_flipped(true);
    out.near_cap_flipped = write.range_since(first);
    out.near_cap_averted = write.range_since(first_averted);
}

bool is_closed(const Volume& volume, bool directional_at_infinity) {
    struct Directed {
        std::uint32_t low, high;
        std::int32_t sign;
    };
    std::vector<Directed> edges;
    edges.reserve(volume.indices.size());
    const IndexRange& flipped = volume.near_cap_flipped;
    const auto name = [&](std::uint32_t index) {
        return directional_at_infinity && index % 2 == 1 ? 1U : index;
    };
    for (std::size_t t = 0; t + 2 < volume.indices.size(); t += 3) {
        const bool is_flipped =
            t >= flipped.first && t < flipped.first + std::size_t{flipped.count};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t from = name(volume.indices[t + i]);
            const std::uint32_t to = name(volume.indices[t + (i + 1) % 3]);
            if (from == to) continue;
            const bool forward = (from < to) != is_flipped;
            edges.push_back({std::min(from, to), std::max(from, to), forward ? 1 : -1});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const Directed& a, const Directed& b) {
        return std::tie(a.low, a.high) < std::tie(b.low, b.high);
    });
    for (std::size_t begin = 0; begin < edges.size();) {
        std::int64_t sum = 0;
        std::size_t end = begin;
        for (; end < edges.size() && edges[end].low == edges[begin].low &&
               edges[end].high == edges[begin].high;
             ++end) {
            sum += edges[end].sign;
        }
        if (sum != 0) return false;
        begin = end;
    }
    return true;
}

Extrusion infinite_extrusion(LightLocal light) {
    return {light.position.w, glm::vec4(-glm::vec3(light.position), 0.0F)};
}

Extrusion finite_extrusion(LightLocal light, double reach) {
    const glm::dvec3 l(light.position);
    if (light.is_directional()) return {1.0F, glm::vec4(glm::vec3(-reach * l), 1.0F)};
    return {static_cast<float>(reach), glm::vec4(glm::vec3((1.0 - reach) * l), 1.0F)};
}

void extrude(std::span<const glm::vec3> positions, const Extrusion& extrusion,
             std::vector<glm::vec4>& far_vertices) {
    far_vertices.resize(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        far_vertices[i] = glm::vec4(positions[i] * extrusion.scale + glm::vec3(extrusion.offset),
                                    extrusion.offset.w);
    }
}

}  // namespace gnomon::shadows
