// SPDX-License-Identifier: MIT
//
// What a volume counts, by a ray caster in double precision that shares no code with the library:
// the winding of the closed volume about a point is the number of casting faces between it and the
// light, and depth-pass and depth-fail agree wherever depth_pass_is_valid says so. Counts are sums,
// so the order of volumes and triangles cannot matter. Rays that come near an edge are drawn anew.
#include <cmath>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/shadows/facing.hpp>
#include <gnomon/shadows/technique.hpp>
#include <gnomon/shadows/volume.hpp>

#include "tests/shadows/random_meshes.hpp"

namespace gnomon::shadows {
namespace {

using test::Random;

struct SignedTriangle {
    glm::dvec3 a, b, c;
    int sign = 1;  // -1: counts the other way round
};

struct Crossing {
    double t = 0.0;
    int entering = 0;  // +1 into the front, -1 out of the back
};

// Where origin + t * direction crosses the triangle; nullopt where it passes so near to an edge, or
// so flat, that rounding could decide.
struct Hit {
    bool certain = true;
    std::optional<Crossing> crossing = std::nullopt;
};

Hit intersect(const SignedTriangle& triangle, const glm::dvec3& origin,
              const glm::dvec3& direction) {
    const glm::dvec3 e1 = triangle.b - triangle.a;
    const glm::dvec3 e2 = triangle.c - triangle.a;
    const glm::dvec3 n = glm::cross(e1, e2);
    const double area = glm::length(n);
    if (area == 0.0) return {};
    const double along = glm::dot(n, direction);
    const glm::dvec3 s = origin - triangle.a;
    const double height = glm::dot(n, s);
    if (std::abs(along) < 1e-7 * area * glm::length(direction)) {
        // Along the plane: certain only when well away from it.
        return {std::abs(height) > 1e-5 * area * (glm::length(s) + 1e-9), std::nullopt};
    }
    const double t = -height / along;
    const glm::dvec3 q = s + t * direction;
    const double v = glm::dot(glm::cross(q, e2), n) / (area * area);
    const double w = glm::dot(glm::cross(e1, q), n) / (area * area);
    const double u = 1.0 - v - w;
    const double least = std::min({u, v, w});
    // In heights over the sides, so that a sliver is no more uncertain than it has to be.
    if (std::abs(least) < 1e-4) return {false, std::nullopt};
    if (least < 0.0) return {};
    return {true, Crossing{t, (along < 0.0 ? 1 : -1) * triangle.sign}};
}

// All crossings with t > 0, or nullopt where one is uncertain.
std::optional<std::vector<Crossing>> crossings(const std::vector<SignedTriangle>& triangles,
                                               const glm::dvec3& origin,
                                               const glm::dvec3& direction) {
    std::vector<Crossing> found;
    for (const SignedTriangle& triangle : triangles) {
        const Hit hit = intersect(triangle, origin, direction);
        if (!hit.certain) return std::nullopt;
        if (!hit.crossing) continue;
        if (std::abs(hit.crossing->t) < 1e-6) return std::nullopt;
        if (hit.crossing->t > 0.0) found.push_back(*hit.crossing);
    }
    return found;
}

// The volume as a soup of triangles at finite places.
std::vector<SignedTriangle> placed(const ShadowMesh& mesh, const Volume& volume,
                                   const Extrusion& extrusion) {
    std::vector<glm::vec4> far;
    extrude(mesh.positions(), extrusion, far);
    const auto place = [&](std::uint32_t index) {
        if (index % 2 == 0) return glm::dvec3(mesh.positions()[index / 2]);
        return glm::dvec3(far[index / 2]) / static_cast<double>(far[index / 2].w);
    };
    std::vector<SignedTriangle> triangles;
    for_each_triangle(
        mesh, volume, [&](const std::array<std::uint32_t, 3>& triangle, bool exchanged) {
            triangles.push_back(
                {place(triangle[0]), place(triangle[1]), place(triangle[2]), exchanged ? -1 : 1});
        });
    return triangles;
}

int winding(const std::vector<Crossing>& along_a_ray) {
    int leaving = 0;
    for (const Crossing& c : along_a_ray) leaving -= c.entering;
    return leaving;
}

struct Shadowed {
    std::shared_ptr<const ShadowMesh> mesh;
    LightLocal light;
    std::vector<std::int8_t> weights;
    std::vector<SignedTriangle> casting;  // the faces that cast
    std::vector<SignedTriangle> volume;
};

constexpr double reach = 64.0;

Shadowed shadow_of(std::shared_ptr<const ShadowMesh> mesh, LightLocal light,
                   NearCaps near_caps = NearCaps::Facing) {
    Shadowed s{std::move(mesh), light, {}, {}, {}};
    Facing facing;
    classify_faces(*s.mesh, light, facing, near_caps);
    s.weights = facing.weights;
    for (std::size_t f = 0; f < s.weights.size(); ++f) {
        if (s.weights[f] == 0) continue;
        const auto& [a, b, c] = s.mesh->faces()[f];
        const auto p = s.mesh->positions();
        s.casting.push_back({glm::dvec3(p[a]), glm::dvec3(p[b]), glm::dvec3(p[c]), 1});
    }
    std::vector<SilhouetteEdge> silhouette;
    find_silhouette(*s.mesh, s.weights, silhouette);
    Volume volume;
    std::vector<FaceRun> casting;
    runs_of(s.weights, casting);
    // Half of the caps in ranges, as many as may be.
    build_volume(*s.mesh, casting, silhouette,
                 {light.is_directional(), FarVertices::Finite, {.draw_worth_faces = 3}}, volume);
    s.volume = placed(*s.mesh, volume, finite_extrusion(light, reach));
    return s;
}

// Casting faces between x and the light, or nullopt where that is uncertain.
std::optional<int> faces_before(const Shadowed& s, const glm::dvec3& x) {
    const glm::dvec3 l(s.light.position);
    const glm::dvec3 towards = s.light.is_directional() ? l : l - x;
    const auto hits = crossings(s.casting, x, towards);
    if (!hits) return std::nullopt;
    int count = 0;
    for (const Crossing& c : *hits) {
        if (!s.light.is_directional() && std::abs(c.t - 1.0) < 1e-6) return std::nullopt;
        count += s.light.is_directional() || c.t < 1.0 ? 1 : 0;
    }
    return count;
}

LightLocal light_about(Random& random, const ShadowMesh& mesh) {
    for (;;) {
        const LightLocal light = test::random_light(random, mesh);
        const double length = glm::length(glm::dvec3(light.position));
        // Within reach of the finite far cap, and not so near a vertex that it falls short.
        if (length < 30.0 && length > 0.2) return light;
    }
}

// Where shadows fall: about the mesh and behind it, not beyond the far cap.
glm::dvec3 sample_point(Random& random, const Shadowed& s) {
    const auto positions = s.mesh->positions();
    const glm::dvec3 p(positions[random.below(positions.size())]);
    const glm::dvec3 from_light =
        s.light.is_directional() ? -glm::dvec3(s.light.position) : p - glm::dvec3(s.light.position);
    return p + random.in_cube(1.5) + random.uniform(-0.5, 3.0) * from_light;
}

// Whether every casting face is cast beyond x: finite volumes end.
bool within_reach(const Shadowed& s, const glm::dvec3& x) {
    if (s.light.is_directional()) {
        double least = 1e9;
        const glm::dvec3 l(s.light.position);
        for (const auto& p : s.mesh->positions())
            least = std::min(least, glm::dot(glm::dvec3(p) - x, l));
        return least + reach * glm::dot(l, l) > 0.0 && glm::dot(x, x) < 400.0;
    }
    double nearest = 1e9;
    const glm::dvec3 l(s.light.position);
    for (const SignedTriangle& t : s.casting) {
        // A lower bound on the distance to the face: to its plane.
        const glm::dvec3 n = glm::cross(t.b - t.a, t.c - t.a);
        if (glm::length(n) == 0.0) continue;
        nearest = std::min(nearest, std::abs(glm::dot(n, l - t.a)) / glm::length(n));
    }
    return glm::length(x - l) < 0.5 * reach * nearest;
}

TEST(Count, IsTheNumberOfCastingFacesBeforeThePoint) {
    GNOMON_RANDOM(random);
    int samples = 0;
    int in_shadow = 0;
    int deep = 0;
    for (int i = 0; i < 1'500; ++i) {
        const auto mesh = test::build(test::random_mesh(random));
        const NearCaps near_caps = random.chance(0.5) ? NearCaps::Facing : NearCaps::Averted;
        const Shadowed s = shadow_of(mesh, light_about(random, *mesh), near_caps);
        for (int j = 0; j < 12; ++j) {
            const glm::dvec3 x = sample_point(random, s);
            if (!within_reach(s, x)) continue;
            const auto expected = faces_before(s, x);
            if (!expected) continue;
            for (int attempt = 0; attempt < 5; ++attempt) {
                const auto along = crossings(s.volume, x, random.unit_vector());
                if (!along) continue;
                ASSERT_EQ(winding(*along), *expected) << "mesh " << i << " sample " << j;
                ++samples;
                in_shadow += *expected > 0 ? 1 : 0;
                deep += *expected > 1 ? 1 : 0;
                break;
            }
        }
    }
    EXPECT_GT(samples, 3'000);
    EXPECT_GT(in_shadow, samples / 10);
    EXPECT_GT(deep, samples / 100);
}

TEST(Count, OfEitherKindOfNearCapsDiffersByTheSolidsAboutThePoint) {
    // So it is the same wherever nothing is inside a solid, and that is where surfaces are seen.
    GNOMON_RANDOM(random);
    int outside = 0;
    int inside = 0;
    for (int i = 0; i < 3'000; ++i) {
        const auto mesh = test::build(test::random_mesh(random));
        const LightLocal light = light_about(random, *mesh);
        const Shadowed facing = shadow_of(mesh, light, NearCaps::Facing);
        const Shadowed averted = shadow_of(mesh, light, NearCaps::Averted);
        Facing kinds;
        classify_faces(*mesh, light, kinds, NearCaps::Averted);
        std::vector<SignedTriangle> solids;
        for (std::size_t f = 0; f < mesh->faces().size(); ++f) {
            if (kinds.solid_averted[mesh->face_components()[f]] == 0) continue;
            const auto& [a, b, c] = mesh->faces()[f];
            const auto p = mesh->positions();
            solids.push_back({glm::dvec3(p[a]), glm::dvec3(p[b]), glm::dvec3(p[c]), 1});
        }
        if (solids.empty()) continue;
        for (int j = 0; j < 12; ++j) {
            const glm::dvec3 x = sample_point(random, facing);
            if (!within_reach(facing, x) || !within_reach(averted, x)) continue;
            const glm::dvec3 ray = random.unit_vector();
            const auto f = crossings(facing.volume, x, ray);
            const auto a = crossings(averted.volume, x, ray);
            const auto s = crossings(solids, x, ray);
            if (!f || !a || !s) continue;
            ASSERT_EQ(winding(*f) - winding(*a), winding(*s)) << "mesh " << i << " sample " << j;
            ++(winding(*s) == 0 ? outside : inside);
        }
    }
    EXPECT_GT(outside, 1'000);
    EXPECT_GT(inside, 100);
}

TEST(Count, OfKnownSolidsAndSheets) {
    const auto box = test::build(test::box());
    const LightLocal above{{0.1F, 10.0F, 0.2F, 1.0F}};
    const glm::dvec3 below(0.17, -5.0, 0.31);
    const auto count = [&](const auto& mesh, const glm::dvec3& x) {
        const Shadowed s = shadow_of(mesh, above);
        return winding(*crossings(s.volume, x, glm::normalize(glm::dvec3(0.3, 0.21, 0.93))));
    };
    EXPECT_EQ(count(box, below), 1) << "closed: its lit side counts";
    EXPECT_EQ(count(box, {0.17, 5.0, 0.31}), 0);
    EXPECT_EQ(count(test::build(test::inside_out(test::box())), below), 1);
    test::Triangles open = test::box();
    test::remove_face(open, 4);
    EXPECT_GE(count(test::build(open), below), 1) << "open: every layer counts";
    EXPECT_EQ(count(test::build(test::moved(test::sheet(3), {-1.4F, 0, -1.3F})), below), 1);
    EXPECT_EQ(
        count(test::build(test::inside_out(test::moved(test::sheet(3), {-1.4F, 0, -1.3F}))), below),
        1)
        << "a sheet casts whichever way it is wound";
}

// ---------------------------------------------------------------------------------------------
// Depth-pass and depth-fail

struct Camera {
    View view;
    std::array<glm::dvec3, 4> near_plane;

    // From the near rectangle into the scene; t = 0 is on the rectangle.
    void ray(Random& random, glm::dvec3& origin, glm::dvec3& direction) const {
        const double u = random.uniform(0.0, 1.0);
        const double v = random.uniform(0.0, 1.0);
        origin = glm::mix(glm::mix(near_plane[0], near_plane[1], u),
                          glm::mix(near_plane[3], near_plane[2], u), v);
        const glm::dmat4 world_from_view = glm::inverse(view.view_from_world);
        direction = view.projection == ProjectionKind::Orthographic
                        ? -glm::dvec3(world_from_view[2])
                        : glm::normalize(origin - glm::dvec3(world_from_view[3]));
    }
};

Camera camera_at(Random& random, const glm::dvec3& eye, const glm::dvec3& target) {
    Camera camera;
    camera.view.view_from_world = look_at(eye, target, random.unit_vector());
    const double near_m = std::pow(10.0, random.uniform(-3.0, 0.3));
    if (random.chance(0.5)) {
        camera.view.clip_from_view = infinite_perspective(random.uniform(0.2, 2.5), 1.5, near_m);
    } else {
        camera.view.projection = ProjectionKind::Orthographic;
        camera.view.clip_from_view = orthographic(random.uniform(0.1, 2.0), 1.0, near_m, 100.0);
    }
    camera.near_plane = near_corners(camera.view);
    return camera;
}

TEST(Count, DepthPassAndDepthFailDifferByTheCountAtTheNearPlane) {
    GNOMON_RANDOM(random);
    int valid_rays = 0;
    int inside_rays = 0;
    int shadowed = 0;
    for (int i = 0; i < 1'500; ++i) {
        const auto mesh = test::build(test::random_mesh(random));
        const Shadowed s = shadow_of(mesh, light_about(random, *mesh));
        const glm::dvec3 eye = sample_point(random, s);
        const Camera camera = camera_at(random, eye, random.in_cube(1.0));
        const glm::dvec4 light(s.light.position);
        const bool valid = depth_pass_is_valid(
            {glm::dmat4(1.0), glm::dvec3(mesh->bounds_min()), glm::dvec3(mesh->bounds_max())},
            light, camera.view);
        for (int j = 0; j < 8; ++j) {
            glm::dvec3 origin;
            glm::dvec3 direction;
            camera.ray(random, origin, direction);
            if (!within_reach(s, origin)) continue;
            const auto all = crossings(s.volume, origin, direction);
            const auto at_near_plane = faces_before(s, origin);
            if (!all || !at_near_plane) continue;
            const double surface = random.uniform(0.1, 10.0);
            int pass = 0;
            int fail = 0;
            for (const Crossing& c : *all) {
                // Front faces before the surface count up, back faces down; behind it, back faces
                // count up and front faces down.
                (c.t < surface ? pass : fail) += c.t < surface ? c.entering : -c.entering;
            }
            ASSERT_EQ(fail - pass, *at_near_plane) << "mesh " << i << " ray " << j;
            if (valid) {
                ASSERT_EQ(pass, fail) << "mesh " << i << " ray " << j;
                ++valid_rays;
            }
            inside_rays += *at_near_plane != 0 ? 1 : 0;
            shadowed += fail != 0 ? 1 : 0;
        }
    }
    EXPECT_GT(valid_rays, 1'000);
    EXPECT_GT(inside_rays, 300);
    EXPECT_GT(shadowed, 1'000);
}

}  // namespace
}  // namespace gnomon::shadows
