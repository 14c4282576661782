// SPDX-License-Identifier: MIT
//
// What figures look like: tubes of ten corners through a handful of ellipses each.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "figure.hpp"

namespace gnomon::game {

namespace {

/// A cross-section of a limb: an ellipse about `center`, so far in x and in the limb's other
/// direction. `bend`: how far the lower joint has taken over.
struct Ellipse {
    glm::dvec3 center;
    double across;
    double deep;
    double bend;
};

class FigureMesh {
public:
    /// A closed tube through the ellipses; the first and the last are points. `deep_along` is +Z
    /// for what stands and +Y for what lies along Z.
    void tube(std::uint32_t material, std::size_t upper, std::size_t lower,
              const std::vector<Ellipse>& ellipses,
              const glm::dvec3& deep_along = {0.0, 0.0, 1.0}) {
        constexpr std::uint32_t round = 10;
        const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
        const std::size_t last = ellipses.size() - 1;
        add(ellipses.front().center, ellipses.front().bend, upper, lower);
        for (std::size_t ring = 1; ring < last; ++ring) {
            const Ellipse& e = ellipses[ring];
            for (std::uint32_t s = 0; s < round; ++s) {
                const double angle = 2.0 * std::numbers::pi * (s + 0.5) / round;
                glm::dvec3 p = e.center + glm::dvec3(e.across * std::cos(angle), 0.0, 0.0) +
                               deep_along * (e.deep * std::sin(angle));
                p.y = std::max(p.y, 0.004);
                add(p, e.bend, upper, lower);
            }
        }
        add(ellipses.back().center, ellipses.back().bend, upper, lower);
        const auto end = static_cast<std::uint32_t>(mesh_.positions.size()) - 1;

        const auto corner = [&](std::size_t ring, std::uint32_t s) {
            return first + 1 + static_cast<std::uint32_t>(ring - 1) * round + s % round;
        };
        std::vector<std::uint32_t> triangles;
        for (std::uint32_t s = 0; s < round; ++s) {
            triangles.insert(triangles.end(), {first, corner(1, s), corner(1, s + 1)});
            for (std::size_t ring = 1; ring + 1 < last; ++ring) {
                const std::uint32_t a = corner(ring, s);
                const std::uint32_t b = corner(ring, s + 1);
                const std::uint32_t c = corner(ring + 1, s + 1);
                const std::uint32_t d = corner(ring + 1, s);
                triangles.insert(triangles.end(), {a, d, c, a, c, b});
            }
            triangles.insert(triangles.end(), {corner(last - 1, s), end, corner(last - 1, s + 1)});
        }
        turn_outward(triangles, first);
        sub_mesh(material, triangles);
    }

    Result<std::shared_ptr<const scene::Mesh>> finish() {
        mesh_.name = "figure";
        mesh_.normals.assign(mesh_.positions.size(), glm::vec3(0.0F));
        for (std::size_t i = 0; i < mesh_.indices.size(); i += 3) {
            const auto& p = mesh_.positions;
            const std::uint32_t a = mesh_.indices[i];
            const std::uint32_t b = mesh_.indices[i + 1];
            const std::uint32_t c = mesh_.indices[i + 2];
            const glm::vec3 normal = glm::cross(p[b] - p[a], p[c] - p[a]);
            for (const std::uint32_t corner : {a, b, c}) mesh_.normals[corner] += normal;
        }
        for (glm::vec3& normal : mesh_.normals) {
            const float length = glm::length(normal);
            normal = length > 0.0F ? normal / length : glm::vec3(0.0F, 1.0F, 0.0F);
        }
        auto deformation = scene::make_mesh_deformation(mesh_, std::move(source_));
        if (!deformation) return forward_error(deformation);
        mesh_.deformation = *deformation;
        return std::make_shared<const scene::Mesh>(std::move(mesh_));
    }

private:
    void add(const glm::dvec3& position, double bend, std::size_t upper, std::size_t lower) {
        mesh_.positions.emplace_back(position);
        source_.influences_per_vertex = 2;
        source_.joints.push_back(static_cast<std::uint32_t>(upper));
        source_.joints.push_back(static_cast<std::uint32_t>(lower));
        source_.weights.push_back(static_cast<float>(1.0 - bend));
        source_.weights.push_back(static_cast<float>(bend));
    }

    /// Counter-clockwise from outside, whichever way the ellipses run.
    void turn_outward(std::vector<std::uint32_t>& triangles, std::uint32_t origin) const {
        double volume = 0.0;
        const glm::dvec3 from(mesh_.positions[origin]);
        for (std::size_t i = 0; i < triangles.size(); i += 3) {
            const glm::dvec3 a = glm::dvec3(mesh_.positions[triangles[i]]) - from;
            const glm::dvec3 b = glm::dvec3(mesh_.positions[triangles[i + 1]]) - from;
            const glm::dvec3 c = glm::dvec3(mesh_.positions[triangles[i + 2]]) - from;
            volume += glm::dot(a, glm::cross(b, c));
        }
        if (volume >= 0.0) return;
        for (std::size_t i = 0; i < triangles.size(); i += 3) {
            std::swap(triangles[i + 1], triangles[i + 2]);
        }
    }

    void sub_mesh(std::uint32_t material, const std::vector<std::uint32_t>& triangles) {
        const auto begin = static_cast<std::uint32_t>(mesh_.indices.size());
        const auto count = static_cast<std::uint32_t>(triangles.size());
        mesh_.indices.insert(mesh_.indices.end(), triangles.begin(), triangles.end());
        if (!mesh_.sub_meshes.empty() && mesh_.sub_meshes.back().material == material) {
            mesh_.sub_meshes.back().index_count += count;
        } else {
            mesh_.sub_meshes.push_back({begin, count, material});
        }
    }

    scene::Mesh mesh_;
    scene::MeshDeformationSource source_;
};

void add_arm(FigureMesh& mesh, const Skeleton& skeleton, const Dress& dress, double side) {
    const std::string name = side > 0.0 ? "left " : "right ";
    const std::size_t shoulder = skeleton.joint(name + "shoulder");
    const std::size_t elbow = skeleton.joint(name + "elbow");
    const double x = side * 0.20;
    mesh.tube(dress.cloth, shoulder, elbow,
              {{{x, 1.47, -0.004}, 0.0, 0.0, 0.0},
               {{x, 1.44, -0.004}, 0.062, 0.066, 0.0},
               {{x + side * 0.012, 1.28, -0.004}, 0.056, 0.060, 0.0},
               {{x + side * 0.024, 1.15, 0.0}, 0.048, 0.052, 0.25},
               {{x + side * 0.026, 1.08, 0.0}, 0.047, 0.050, 0.8},
               {{x + side * 0.032, 0.90, 0.006}, 0.043, 0.045, 1.0},
               {{x + side * 0.032, 0.89, 0.006}, 0.0, 0.0, 1.0}});
    mesh.tube(dress.skin, elbow, elbow,
              {{{x + side * 0.032, 0.905, 0.008}, 0.0, 0.0, 1.0},
               {{x + side * 0.033, 0.88, 0.008}, 0.028, 0.034, 1.0},
               {{x + side * 0.034, 0.82, 0.012}, 0.032, 0.042, 1.0},
               {{x + side * 0.034, 0.76, 0.014}, 0.022, 0.030, 1.0},
               {{x + side * 0.034, 0.745, 0.014}, 0.0, 0.0, 1.0}});
}

void add_leg(FigureMesh& mesh, const Skeleton& skeleton, const Dress& dress, double side) {
    const std::string name = side > 0.0 ? "left " : "right ";
    const std::size_t hip = skeleton.joint(name + "hip");
    const std::size_t knee = skeleton.joint(name + "knee");
    const std::size_t ankle = skeleton.joint(name + "ankle");
    const std::size_t toes = skeleton.joint(name + "toes");
    const double x = side * 0.09;
    mesh.tube(dress.trousers, hip, knee,
              {{{x, 0.98, 0.0}, 0.0, 0.0, 0.0},
               {{x, 0.95, 0.0}, 0.080, 0.090, 0.0},
               {{x, 0.75, 0.004}, 0.076, 0.082, 0.0},
               {{x, 0.56, 0.006}, 0.062, 0.068, 0.2},
               {{x, 0.46, 0.004}, 0.058, 0.064, 0.8},
               {{x, 0.32, -0.012}, 0.054, 0.064, 1.0},
               {{x, 0.22, -0.008}, 0.050, 0.056, 1.0},
               {{x, 0.21, -0.008}, 0.0, 0.0, 1.0}});
    // A boot: its shaft on the shin, its foot from heel to toes.
    mesh.tube(dress.accent, knee, ankle,
              {{{x, 0.27, -0.008}, 0.0, 0.0, 0.0},
               {{x, 0.265, -0.008}, 0.062, 0.068, 0.0},
               {{x, 0.16, -0.006}, 0.054, 0.060, 0.1},
               {{x, 0.09, 0.0}, 0.050, 0.058, 0.8},
               {{x, 0.04, 0.0}, 0.048, 0.060, 1.0},
               {{x, 0.03, 0.0}, 0.0, 0.0, 1.0}});
    mesh.tube(dress.accent, ankle, toes,
              {{{x, 0.045, -0.075}, 0.0, 0.0, 0.0},
               {{x, 0.045, -0.065}, 0.040, 0.042, 0.0},
               {{x, 0.055, 0.0}, 0.046, 0.052, 0.0},
               {{x, 0.045, 0.10}, 0.050, 0.040, 0.2},
               {{x, 0.035, 0.16}, 0.046, 0.030, 0.9},
               {{x, 0.028, 0.20}, 0.030, 0.022, 1.0},
               {{x, 0.026, 0.21}, 0.0, 0.0, 1.0}},
              {0.0, 1.0, 0.0});
}

void add_head(FigureMesh& mesh, std::size_t chest, std::size_t head, const Dress& dress) {
    mesh.tube(dress.skin, head, head,
              {{{0.0, 1.50, 0.02}, 0.0, 0.0, 1.0},
               {{0.0, 1.53, 0.03}, 0.045, 0.050, 1.0},
               {{0.0, 1.60, 0.02}, 0.072, 0.088, 1.0},
               {{0.0, 1.69, 0.012}, 0.074, 0.090, 1.0},
               {{0.0, 1.75, 0.0}, 0.045, 0.056, 1.0},
               {{0.0, 1.765, 0.0}, 0.0, 0.0, 1.0}});
    if (dress.hooded) {
        mesh.tube(dress.cloth, chest, head,
                  {{{0.0, 1.41, -0.02}, 0.0, 0.0, 0.0},
                   {{0.0, 1.42, -0.02}, 0.150, 0.120, 0.0},
                   {{0.0, 1.50, -0.03}, 0.115, 0.100, 0.4},
                   {{0.0, 1.60, -0.035}, 0.104, 0.110, 1.0},
                   {{0.0, 1.71, -0.04}, 0.098, 0.106, 1.0},
                   {{0.0, 1.80, -0.07}, 0.050, 0.060, 1.0},
                   {{0.0, 1.83, -0.12}, 0.0, 0.0, 1.0}});
        // A scarf in the accent's colour, so that one finds oneself in the dark.
        mesh.tube(dress.accent, chest, head,
                  {{{0.0, 1.43, 0.0}, 0.0, 0.0, 0.0},
                   {{0.0, 1.44, 0.0}, 0.128, 0.112, 0.0},
                   {{0.0, 1.48, 0.004}, 0.132, 0.118, 0.2},
                   {{0.0, 1.52, 0.008}, 0.104, 0.100, 0.5},
                   {{0.0, 1.53, 0.008}, 0.0, 0.0, 0.5}});
        return;
    }
    mesh.tube(dress.skin, chest, head,
              {{{0.0, 1.44, -0.006}, 0.0, 0.0, 0.0},
               {{0.0, 1.45, -0.006}, 0.052, 0.052, 0.0},
               {{0.0, 1.55, 0.006}, 0.048, 0.050, 1.0},
               {{0.0, 1.57, 0.008}, 0.0, 0.0, 1.0}});
    mesh.tube(dress.accent, head, head,
              {{{0.0, 1.665, 0.0}, 0.0, 0.0, 1.0},
               {{0.0, 1.667, 0.01}, 0.150, 0.175, 1.0},
               {{0.0, 1.69, 0.006}, 0.140, 0.160, 1.0},
               {{0.0, 1.705, 0.0}, 0.094, 0.112, 1.0},
               {{0.0, 1.77, 0.0}, 0.080, 0.096, 1.0},
               {{0.0, 1.82, 0.0}, 0.040, 0.050, 1.0},
               {{0.0, 1.83, 0.0}, 0.0, 0.0, 1.0}});
}

}  // namespace

Result<std::shared_ptr<const scene::Mesh>> make_figure_mesh(const Skeleton& skeleton,
                                                            const Dress& dress) {
    const std::size_t pelvis = skeleton.joint("pelvis");
    const std::size_t chest = skeleton.joint("chest");
    FigureMesh mesh;
    mesh.tube(dress.cloth, pelvis, chest,
              {{{0.0, 0.92, 0.0}, 0.0, 0.0, 0.0},
               {{0.0, 0.93, 0.0}, 0.150, 0.106, 0.0},
               {{0.0, 1.03, 0.0}, 0.140, 0.098, 0.1},
               {{0.0, 1.14, 0.002}, 0.134, 0.094, 0.7},
               {{0.0, 1.27, 0.006}, 0.160, 0.108, 1.0},
               {{0.0, 1.38, 0.004}, 0.182, 0.108, 1.0},
               {{0.0, 1.45, -0.006}, 0.142, 0.082, 1.0},
               {{0.0, 1.49, -0.008}, 0.0, 0.0, 1.0}});
    // The skirts of a coat.
    const double hem_m = dress.hooded ? 0.60 : 0.74;
    mesh.tube(dress.cloth, pelvis, pelvis,
              {{{0.0, 1.05, 0.0}, 0.0, 0.0, 0.0},
               {{0.0, 1.04, 0.0}, 0.142, 0.102, 0.0},
               {{0.0, 0.90, 0.0}, 0.186, 0.142, 0.0},
               {{0.0, hem_m, -0.01}, 0.222, 0.192, 0.0},
               {{0.0, hem_m + 0.03, -0.01}, 0.0, 0.0, 0.0}});
    for (const double side : {1.0, -1.0}) add_arm(mesh, skeleton, dress, side);
    for (const double side : {1.0, -1.0}) add_leg(mesh, skeleton, dress, side);
    add_head(mesh, chest, skeleton.joint("head"), dress);
    return mesh.finish();
}

}  // namespace gnomon::game
