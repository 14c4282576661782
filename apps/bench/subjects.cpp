// SPDX-License-Identifier: MIT
#include "subjects.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gnomon/scene/gltf.hpp>
#include <gnomon/scene/primitives.hpp>
#include <gnomon/scene/transforms.hpp>

namespace gnomon::bench {

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

std::uint32_t root_of(double value) {
    return static_cast<std::uint32_t>(std::lround(std::sqrt(value)));
}

scene::Mesh sphere(std::uint32_t triangles) {
    const std::uint32_t stacks = root_of(triangles / 4.0);
    return scene::make_sphere(1.0F, 2 * stacks, stacks);
}

scene::Mesh knot(std::uint32_t triangles) {
    const std::uint32_t tube = root_of(triangles / 16.0);
    return scene::make_torus_knot(1.0F, 0.3F, 2, 3, 8 * tube, tube);
}

// Hashed lattice values, blended smoothly.
double noise(const glm::dvec3& p) {
    const glm::dvec3 floor = glm::floor(p);
    const glm::dvec3 part = p - floor;
    const glm::dvec3 blend = part * part * (3.0 - 2.0 * part);
    const auto value = [&](int x, int y, int z) {
        std::uint64_t h = 0x9E3779B97F4A7C15ULL;
        for (const double c : {floor.x + x, floor.y + y, floor.z + z}) {
            h = (h ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(c))) *
                0xFF51AFD7ED558CCDULL;
            h ^= h >> 29U;
        }
        return static_cast<double>(h >> 11U) * 0x1p-52 - 1.0;
    };
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const int x = corner & 1;
        const int y = corner >> 1 & 1;
        const int z = corner >> 2;
        sum += value(x, y, z) * (x != 0 ? blend.x : 1.0 - blend.x) *
               (y != 0 ? blend.y : 1.0 - blend.y) * (z != 0 ? blend.z : 1.0 - blend.z);
    }
    return sum;
}

scene::Mesh bumpy(std::uint32_t triangles) {
    scene::Mesh mesh = sphere(triangles);
    for (glm::vec3& position : mesh.positions) {
        const glm::dvec3 p(position);
        double height = 1.0;
        for (int octave = 0; octave < 5; ++octave) {
            height += 0.16 * std::ldexp(noise(std::ldexp(4.0, octave) * p), -octave);
        }
        position = glm::vec3(height * p);
    }
    return mesh;
}

// A closed surface of `columns` x `rows` quads, each way round.
template <class Place>
scene::Mesh closed_grid(std::uint32_t columns, std::uint32_t rows, Place&& place) {
    scene::Mesh mesh;
    for (std::uint32_t i = 0; i < columns; ++i) {
        for (std::uint32_t j = 0; j < rows; ++j) mesh.positions.push_back(glm::vec3(place(i, j)));
    }
    for (std::uint32_t i = 0; i < columns; ++i) {
        for (std::uint32_t j = 0; j < rows; ++j) {
            const std::uint32_t next = (i + 1) % columns;
            const std::uint32_t up = (j + 1) % rows;
            const std::uint32_t a = i * rows + j;
            const std::uint32_t b = i * rows + up;
            const std::uint32_t c = next * rows + up;
            const std::uint32_t d = next * rows + j;
            mesh.indices.insert(mesh.indices.end(), {a, c, b, a, d, c});
        }
    }
    return mesh;
}

// A gear wheel with a bore: flat faces of many triangles, sharp edges, and round walls.
scene::Mesh gear(std::uint32_t triangles) {
    constexpr std::uint32_t teeth = 24;
    const std::uint32_t side = std::max(2U, root_of(triangles / (2.0 * teeth * 8.0 * 4.0)));
    const std::uint32_t columns = teeth * 8 * side;
    return closed_grid(columns, 4 * side, [&](std::uint32_t i, std::uint32_t j) {
        const double angle = two_pi * i / columns;
        const double tooth = std::fmod(static_cast<double>(i) / (8.0 * side), 1.0);
        const double outer = tooth < 0.5 ? 1.0 : 0.85;
        const double along = static_cast<double>(j % side) / side;
        double radius = outer;
        double height = 0.25;
        switch (j / side) {
            case 0: height = -0.25 + 0.5 * along; break;
            case 1: radius = std::lerp(outer, 0.35, along); break;
            case 2: radius = 0.35, height = 0.25 - 0.5 * along; break;
            default: radius = std::lerp(0.35, outer, along), height = -0.25; break;
        }
        return glm::dvec3(radius * std::cos(angle), height, -radius * std::sin(angle));
    });
}

// A box of cells x cells quads a side, with each position once a side.
void append_box(scene::Mesh& mesh, const glm::dvec3& low, const glm::dvec3& high,
                std::uint32_t cells) {
    for (int axis = 0; axis < 3; ++axis) {
        for (const bool upper : {false, true}) {
            const int u = (axis + 1) % 3;
            const int v = (axis + 2) % 3;
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            for (std::uint32_t i = 0; i <= cells; ++i) {
                for (std::uint32_t j = 0; j <= cells; ++j) {
                    glm::dvec3 p;
                    p[axis] = upper ? high[axis] : low[axis];
                    p[u] = std::lerp(low[u], high[u], static_cast<double>(i) / cells);
                    p[v] = std::lerp(low[v], high[v], static_cast<double>(j) / cells);
                    mesh.positions.push_back(glm::vec3(p));
                }
            }
            for (std::uint32_t i = 0; i < cells; ++i) {
                for (std::uint32_t j = 0; j < cells; ++j) {
                    const std::uint32_t a = first + i * (cells + 1) + j;
                    std::array<std::uint32_t, 6> quad{a, a + cells + 1, a + cells + 2,
                                                      a, a + cells + 2, a + 1};
                    if (!upper) std::swap(quad[1], quad[2]), std::swap(quad[4], quad[5]);
                    mesh.indices.insert(mesh.indices.end(), quad.begin(), quad.end());
                }
            }
        }
    }
}

// Streets of houses with about so many triangles in all; every fifth house is a tower.
scene::Mesh houses(std::uint32_t triangles, std::uint32_t cells) {
    scene::Mesh mesh;
    const std::uint32_t count = std::max(1U, triangles / (12 * cells * cells));
    const std::uint32_t street = root_of(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::dvec3 corner(20.0 * (i % street), 0.0, 25.0 * (i / street));
        const double height = (i % 5 == 0 ? 60.0 : 9.0) + (i * 7) % 13;
        append_box(mesh, corner, corner + glm::dvec3(12.0, height, 10.0 + (i * 3) % 7), cells);
    }
    return mesh;
}

Result<scene::Mesh> load(const std::filesystem::path& path) {
    auto loaded = scene::load_gltf(path);
    if (!loaded) return forward_error(loaded);
    scene::update_world_transforms(loaded->registry);
    scene::Mesh all;
    loaded->registry.each<scene::MeshInstance, scene::WorldTransform>(
        [&](scene::Entity, const scene::MeshInstance& instance,
            const scene::WorldTransform& transform) {
            const auto first = static_cast<std::uint32_t>(all.positions.size());
            for (const glm::vec3& p : instance.mesh->positions) {
                const glm::dvec4 local(glm::dvec3(p) + instance.mesh->origin, 1.0);
                all.positions.push_back(glm::vec3(transform.world_from_local * local));
            }
            for (const std::uint32_t i : instance.mesh->indices) all.indices.push_back(first + i);
        });
    return all;
}

}  // namespace

std::vector<Subject> subjects(const std::filesystem::path& models, bool quick) {
    std::vector<Subject> result;
    struct Size {
        const char* name;
        std::uint32_t triangles;
        bool quick;
    };
    for (const Size& size :
         {Size{"1k", 1'000, true}, Size{"10k", 10'000, true}, Size{"100k", 100'000, false},
          Size{"1M", 1'000'000, false}, Size{"4M", 4'000'000, false}}) {
        if (quick && !size.quick) continue;
        const std::uint32_t n = size.triangles;
        const auto add = [&](const char* family, scene::Mesh (*make)(std::uint32_t)) {
            result.push_back({std::string(family) + "-" + size.name, family,
                              [=]() -> Result<scene::Mesh> { return make(n); },
                              1.0 + n / 500'000.0});
        };
        add("sphere", sphere);
        add("knot", knot);
        const bool middle = n == 100'000 || n == 1'000'000 || (quick && n == 10'000);
        if (middle) add("noise", bumpy);
        if (middle || n == 10'000) add("CAD", gear);
    }
    struct File {
        const char* path;
        const char* family;
    };
    for (const File& file :
         {File{"large/bunny-69k-open.glb", "scan"}, File{"large/koala-100k.glb", "scan"},
          File{"large/scorpion-100k.glb", "scan"}, File{"large/bunny-576k.glb", "scan"},
          File{"large/boat-32k.glb", "prop"}, File{"props/flight-helmet.glb", "prop"},
          File{"props/dutch-ship.glb", "prop"}, File{"props/chess-board.glb", "prop"},
          File{"hard/manifold-twin-7081-left.glb", "CAD"}}) {
        const std::filesystem::path path = models / file.path;
        if (quick || !std::filesystem::exists(path)) continue;
        result.push_back({path.stem().string(), file.family, [path] { return load(path); }, 1.0});
    }
    return result;
}

std::vector<Subject> stand_ins(bool quick) {
    struct Scene {
        const char* name;
        std::uint32_t triangles;
        std::uint32_t cells;
    };
    std::vector<Subject> result;
    for (const Scene& scene :
         {Scene{"tower (11k)", 11'353, 1}, Scene{"works (13.6k)", 13'615, 2},
          Scene{"quarter (147k)", 147'296, 4}, Scene{"city (182k)", 182'038, 3}}) {
        if (quick && !result.empty()) break;
        const auto [triangles, cells] = std::pair(scene.triangles, scene.cells);
        result.push_back({scene.name, "stand-in",
                          [=]() -> Result<scene::Mesh> { return houses(triangles, cells); }});
    }
    return result;
}

}  // namespace gnomon::bench
