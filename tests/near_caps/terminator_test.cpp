// SPDX-License-Identifier: MIT
//
// The shadow terminator: a sphere of few triangles with smooth normals against the smooth sphere
// that it stands for. Where a triangle is averted from the light but its smooth normals are not,
// exact shadows of the triangles show the triangles. How much, with each kind of near caps, is
// measured pixel by pixel; light is 1 and the surface white and Lambertian.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <vector>

#include "tests/near_caps/host.hpp"
#include "tests/near_caps/scenes.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::test {
namespace {

using shadow_pass::AvertedFaces;
using shadows::NearCaps;

constexpr std::uint32_t width = 640;
constexpr std::uint32_t height = 480;

// What one pixel sees of the sphere's triangles, and where its ray meets the true sphere.
struct Seen {
    double distance = std::numeric_limits<double>::infinity();
    double smooth = 0.0;     // N.L of the interpolated normal
    double geometric = 0.0;  // of the triangle
    double truth = 0.0;      // of the sphere
};

// Every pixel of the setting's one mesh, whose pose is the identity; distance is infinite
// elsewhere.
std::vector<Seen> look(const Setting& setting, const glm::dvec3& to_light) {
    std::vector<Seen> seen(std::size_t{width} * height);
    const glm::dmat4 world_from_view = glm::inverse(setting.view.view_from_world);
    const glm::dvec3 eye(world_from_view[3]);
    const glm::dmat4& projection = setting.view.clip_from_view;
    const glm::dmat4 clip_from_world = setting.view.clip_from_world();
    const auto pixel_of = [&](const glm::dvec3& p) {
        const glm::dvec4 clip = clip_from_world * glm::dvec4(p, 1.0);
        return glm::dvec2((clip.x / clip.w * 0.5 + 0.5) * width,
                          (0.5 - clip.y / clip.w * 0.5) * height);
    };
    const auto ray_of = [&](int x, int y) {
        const glm::dvec3 in_view((2.0 * (x + 0.5) / width - 1.0) / projection[0][0],
                                 (1.0 - 2.0 * (y + 0.5) / height) / projection[1][1], -1.0);
        return glm::dmat3(world_from_view) * in_view;
    };
    setting.scene.registry.each<scene::MeshInstance>([&](scene::Entity,
                                                         const scene::MeshInstance& instance) {
        const scene::Mesh& mesh = *instance.mesh;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const auto corner = [&](std::size_t k) {
                return glm::dvec3(mesh.positions[mesh.indices[i + k]]);
            };
            const auto normal = [&](std::size_t k) {
                return glm::dvec3(mesh.normals[mesh.indices[i + k]]);
            };
            const glm::dvec3 a = corner(0);
            const glm::dvec3 e1 = corner(1) - a;
            const glm::dvec3 e2 = corner(2) - a;
            const glm::dvec3 n = glm::cross(e1, e2);
            const double area = glm::length(n);
            if (area == 0.0 || glm::dot(n, eye - a) <= 0.0) continue;
            glm::dvec2 low = pixel_of(a);
            glm::dvec2 high = low;
            for (const std::size_t k : {1U, 2U}) {
                low = glm::min(low, pixel_of(corner(k)));
                high = glm::max(high, pixel_of(corner(k)));
            }
            for (int y = static_cast<int>(low.y) - 1; y <= static_cast<int>(high.y) + 1; ++y) {
                for (int x = static_cast<int>(low.x) - 1; x <= static_cast<int>(high.x) + 1; ++x) {
                    const glm::dvec3 ray = ray_of(x, y);
                    const double t = glm::dot(n, a - eye) / glm::dot(n, ray);
                    const glm::dvec3 q = eye + t * ray - a;
                    const double v = glm::dot(glm::cross(q, e2), n) / (area * area);
                    const double w = glm::dot(glm::cross(e1, q), n) / (area * area);
                    Seen& here =
                        seen[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)];
                    if (v < 0.0 || w < 0.0 || v + w > 1.0 || t >= here.distance) continue;
                    const glm::dvec3 d = glm::normalize(ray);
                    const double b = glm::dot(eye, d);
                    const double root = b * b - glm::dot(eye, eye) + 1.0;
                    const glm::dvec3 on_sphere = eye + (-b - std::sqrt(std::max(root, 0.0))) * d;
                    const glm::dvec3 interpolated =
                        normal(0) * (1.0 - v - w) + normal(1) * v + normal(2) * w;
                    here = {t, glm::dot(glm::normalize(interpolated), to_light),
                            glm::dot(n / area, to_light),
                            glm::dot(glm::normalize(on_sphere), to_light)};
                }
            }
        }
    });
    return seen;
}

struct Error {
    double too_dark = 0.0;    // share of the pixels that are black and truly lit
    double too_bright = 0.0;  // share of the pixels that are lit and truly black
    double mean = 0.0;        // of |radiance - truth|
    double greatest = 0.0;
};

struct Method {
    const char* name;
    NearCaps near_caps;
    AvertedFaces averted_faces;
    double (*radiance)(const Seen&);  // where the mask says lit
};

double smooth_light(const Seen& s) { return std::max(s.smooth, 0.0); }
double cut_light(const Seen& s) { return s.geometric > 0.0 ? smooth_light(s) : 0.0; }
// As forward.glsl has it.
double faded_light(const Seen& s) {
    const double t = std::clamp(s.geometric / 0.12, 0.0, 1.0);
    return smooth_light(s) * t * t * (3.0 - 2.0 * t);
}

constexpr Method facing{"facing", NearCaps::Facing, AvertedFaces::Shadowed, smooth_light};
constexpr Method facing_faded{"facing, faded", NearCaps::Facing, AvertedFaces::Shadowed,
                              faded_light};
constexpr Method averted{"averted", NearCaps::Averted, AvertedFaces::Shadowed, smooth_light};
constexpr Method averted_cut{"averted, cut by geometric N.L", NearCaps::Averted,
                             AvertedFaces::LeftToShading, cut_light};
constexpr Method averted_open{"averted, left to shading", NearCaps::Averted,
                              AvertedFaces::LeftToShading, smooth_light};

class Terminator : public testing::TestWithParam<std::uint32_t> {
protected:
    void SetUp() override {
        const glm::dvec3 travel(-1.0, -0.45, -0.25);
        setting_.emplace(sphere_in_the_sun(GetParam(), GetParam() / 2, travel));
        seen_ = look(*setting_, -glm::normalize(travel));
    }

    Error error_of(const Method& method) {
        TestDevice* device = must(shared_device(drawing_devices().front()));
        const HostPicture picture = host_picture(device->device, *setting_,
                                                 {.near_caps = method.near_caps,
                                                  .averted_faces = method.averted_faces,
                                                  .width = width,
                                                  .height = height});
        Error error;
        double pixels = 0.0;
        for (std::size_t i = 0; i < seen_.size(); ++i) {
            if (!std::isfinite(seen_[i].distance)) continue;
            pixels += 1.0;
            const double radiance = picture.masks[0][i] == 0 ? method.radiance(seen_[i]) : 0.0;
            const double truth = std::max(seen_[i].truth, 0.0);
            error.too_dark += radiance == 0.0 && truth > 0.0 ? 1.0 : 0.0;
            error.too_bright += radiance > 0.0 && truth == 0.0 ? 1.0 : 0.0;
            error.mean += std::abs(radiance - truth);
            error.greatest = std::max(error.greatest, std::abs(radiance - truth));
        }
        error.too_dark /= pixels;
        error.too_bright /= pixels;
        error.mean /= pixels;
        std::printf(
            "%2u x %2u  %-30s too dark %5.2f %%, too bright %5.2f %%, mean error %.4f, "
            "greatest %.3f\n",
            GetParam(), GetParam() / 2, method.name, 100.0 * error.too_dark,
            100.0 * error.too_bright, error.mean, error.greatest);
        return error;
    }

    std::optional<Setting> setting_;
    std::vector<Seen> seen_;
};

TEST_P(Terminator, is_gone_where_averted_faces_are_left_to_shading) {
    const Error with_facing = error_of(facing);
    const Error faded = error_of(facing_faded);
    const Error shadowed = error_of(averted);
    const Error cut = error_of(averted_cut);
    const Error open = error_of(averted_open);
    EXPECT_GT(with_facing.too_dark, 0.005) << "there is no terminator to be rid of";
    EXPECT_LT(open.too_dark, 0.25 * with_facing.too_dark);
    EXPECT_LT(open.mean, with_facing.mean);
    EXPECT_LT(open.greatest, with_facing.greatest);
    // Fading softens the teeth, and costs light.
    EXPECT_GT(faded.mean, with_facing.mean);
    // What alone does not help: other caps under the strict comparison, or a cut by the triangle.
    EXPECT_EQ(shadowed.too_dark, with_facing.too_dark);
    EXPECT_GE(cut.too_dark, with_facing.too_dark);
    for (const Error& error : {with_facing, faded, shadowed, cut, open}) {
        EXPECT_EQ(error.too_bright, 0.0) << "inscribed triangles: nothing leaks";
    }
}

INSTANTIATE_TEST_SUITE_P(Slices, Terminator, testing::Values(12U, 24U, 48U),
                         [](const auto& param) { return std::to_string(param.param); });

}  // namespace
}  // namespace gnomon::test
