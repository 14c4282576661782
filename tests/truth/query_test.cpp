// SPDX-License-Identifier: MIT
//
// What a player sees is what the game knows: in every row, for every light, each pixel's place is
// asked about, and the answer is held against the truth and against the rendered mask. Where the
// truth has a verdict all three agree; where mask and query differ, the truth says that a shadow's
// edge is near, or has nothing to say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/shadows/shadow_query.hpp>
#include <gnomon/truth/truth.hpp>

#include "tests/rows/picture.hpp"
#include "tests/rows/rows.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::test {
namespace {

// What is seen through a pixel's centre.
struct Seen {
    double distance = std::numeric_limits<double>::infinity();  // along the pixel's ray
    glm::dvec3 place{0.0};
    glm::dvec3 normal{0.0};  // of length 1, towards the eye
};

// Primary rays by brute force: each triangle is asked about the pixels that its corners enclose.
class Eye {
public:
    explicit Eye(const shadows::View& view)
        : view_(view), origin_(glm::inverse(view.view_from_world)[3]) {
        pixels_.resize(std::size_t{row_width} * row_height);
    }

    void look_at(const truth::Instance& instance) {
        if (!instance.receives) return;
        // Relative to the eye, so that a scene far from the origin loses nothing.
        glm::dmat4 pose = instance.world_from_local;
        pose[3] -= glm::dvec4(origin_, 0.0);
        for (std::size_t i = 0; i + 2 < instance.indices.size(); i += 3) {
            std::array<glm::dvec3, 3> p;
            for (std::size_t k = 0; k < 3; ++k) {
                p[k] = glm::dvec3(
                    pose *
                    glm::dvec4(glm::dvec3(instance.positions[instance.indices[i + k]]), 1.0));
            }
            look_at(p);
        }
    }
    [[nodiscard]] const std::vector<Seen>& pixels() const { return pixels_; }

private:
    void look_at(const std::array<glm::dvec3, 3>& p) {
        const glm::dmat4 clip_from_here =
            view_.clip_from_view * glm::dmat4(glm::dmat3(view_.view_from_world));
        glm::dvec2 low(std::numeric_limits<double>::infinity());
        glm::dvec2 high(-low);
        for (const glm::dvec3& corner : p) {
            const glm::dvec4 clip = clip_from_here * glm::dvec4(corner, 1.0);
            if (clip.w < 1e-3) {  // behind the eye: anywhere
                low = glm::dvec2(0.0);
                high = glm::dvec2(row_width, row_height);
                break;
            }
            const glm::dvec2 pixel((clip.x / clip.w + 1.0) * 0.5 * row_width,
                                   (1.0 - clip.y / clip.w) * 0.5 * row_height);
            low = glm::min(low, pixel);
            high = glm::max(high, pixel);
        }
        const glm::dvec2 size(row_width, row_height);
        const auto from = glm::clamp(glm::floor(low), glm::dvec2(0.0), size);
        const auto to = glm::clamp(glm::ceil(high), glm::dvec2(0.0), size);
        const glm::dmat4 here_from_clip = glm::inverse(clip_from_here);
        const glm::dvec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
        for (auto y = static_cast<std::uint32_t>(from.y); y < static_cast<std::uint32_t>(to.y);
             ++y) {
            for (auto x = static_cast<std::uint32_t>(from.x); x < static_cast<std::uint32_t>(to.x);
                 ++x) {
                const glm::dvec2 ndc((x + 0.5) / row_width * 2.0 - 1.0,
                                     1.0 - (y + 0.5) / row_height * 2.0);
                const glm::dvec4 near = here_from_clip * glm::dvec4(ndc, 1.0, 1.0);
                const glm::dvec4 far = here_from_clip * glm::dvec4(ndc, 0.25, 1.0);
                const glm::dvec3 start = glm::dvec3(near) / near.w;
                const glm::dvec3 way = glm::dvec3(far) / far.w - start;
                const double t = glm::dot(n, p[0] - start) / glm::dot(n, way);
                Seen& seen = pixels_[std::size_t{y} * row_width + x];
                if (!(t > 0.0) || !(t < seen.distance)) continue;
                const glm::dvec3 at = start + t * way;
                if ((clip_from_here * glm::dvec4(at, 1.0)).z < 0.0)
                    continue;  // beyond the far plane
                bool inside = true;
                for (std::size_t k = 0; k < 3; ++k) {
                    const glm::dvec3 edge = p[(k + 1) % 3] - p[k];
                    inside = inside && glm::dot(glm::cross(edge, at - p[k]), n) >= 0.0;
                }
                if (inside)
                    seen = {t, at + origin_, glm::normalize(glm::dot(n, way) < 0.0 ? n : -n)};
            }
        }
    }

    shadows::View view_;
    glm::dvec3 origin_;
    std::vector<Seen> pixels_;
};

class Query : public testing::TestWithParam<Row> {};

TEST_P(Query, agrees_with_the_truth_and_with_the_mask) {
    TestDevice* device = must(shared_device(drawing_devices().front()));
    const Setting setting = GetParam().make();
    const Picture picture = must(
        take_picture(device->device, setting, {.cull_back_faces = GetParam().cull_back_faces}));

    const auto instances = truth::instances_of(setting.scene);
    const glm::dvec3 eye_world(glm::inverse(setting.view.view_from_world)[3]);
    const truth::Tracer tracer = must(truth::Tracer::build(instances, eye_world));
    Eye eye(setting.view);
    for (const truth::Instance& instance : instances) eye.look_at(instance);

    scene::ShadowAdapter adapter;
    shadows::ShadowQueries queries;
    queries.update(must(adapter.casters(setting.scene)));

    std::size_t judged = 0;
    std::size_t shadowed = 0;
    std::size_t wrong = 0;
    std::size_t other_than_mask = 0;
    std::size_t asked = 0;
    std::string places;
    for (std::size_t i = 0; i < picture.list.lights.size(); ++i) {
        const std::uint64_t key = picture.list.lights[i].light;
        const shadows::Light light = *scene::shadow_light(
            setting.scene.registry,
            {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32U)});
        const truth::Picture truth =
            tracer.trace(setting.view, light, {.width = row_width, .height = row_height});
        // Farther than coordinates round at 1e6 m, and nearer than what a depth buffer tells apart.
        constexpr double lift_m = 1e-7;
        std::vector<glm::dvec3> points;
        std::vector<std::size_t> pixel_of;
        for (std::size_t pixel = 0; pixel < eye.pixels().size(); ++pixel) {
            const Seen& seen = eye.pixels()[pixel];
            if (!std::isfinite(seen.distance)) continue;
            points.push_back(seen.place + lift_m * seen.normal);
            pixel_of.push_back(pixel);
        }
        std::vector<shadows::Exposure> exposures(points.size());
        queries.at(light, points, exposures);
        for (std::size_t k = 0; k < points.size(); ++k) {
            const std::size_t pixel = pixel_of[k];
            const bool dark = exposures[k] == shadows::Exposure::Shadowed;
            const bool masked = picture.masks[i][0][pixel] != 0;
            const truth::Verdict verdict = truth.verdicts[pixel];
            if (exposures[k] != shadows::Exposure::OutOfRange) {
                ++asked;
                other_than_mask += dark != masked ? 1U : 0U;
            }
            if (verdict != truth::Verdict::Lit && verdict != truth::Verdict::Shadowed) continue;
            ++judged;
            shadowed += dark ? 1U : 0U;
            const bool right =
                exposures[k] == (verdict == truth::Verdict::Lit ? shadows::Exposure::Lit
                                                                : shadows::Exposure::Shadowed);
            if (right && dark == masked) continue;
            if (++wrong <= 8) {
                places += " light " + std::to_string(i) + " (" + std::to_string(pixel % row_width) +
                          ", " + std::to_string(pixel / row_width) + ")" +
                          (right ? " mask" : " query");
            }
        }
    }
    std::printf(
        "%-40s judged %8zu, shadowed %5.1f %%, wrong %zu; of %zu asked %zu other than the "
        "mask\n",
        GetParam().name.c_str(), judged,
        100.0 * static_cast<double>(shadowed) / static_cast<double>(judged), wrong, asked,
        other_than_mask);
    EXPECT_EQ(wrong, 0U) << places;
    EXPECT_LE(other_than_mask, asked / 1'000);  // on the edges of shadows
    EXPECT_GE(judged, asked / 3);
    EXPECT_GE(shadowed, judged / 20);
    EXPECT_LE(shadowed, judged - judged / 20);
}

INSTANTIATE_TEST_SUITE_P(Rows, Query, testing::ValuesIn(rows()),
                         [](const auto& param) { return param.param.name; });

}  // namespace
}  // namespace gnomon::test
