// SPDX-License-Identifier: MIT
//
// Row 14: a far cap that is a fan. It is closed as well, of fewer triangles. But a rim bounds two
// parts of the sphere of directions, and a fan takes the smaller one: from within a box without a
// lid that is the opening, where it should be the walls. So there it is refused, and what would
// come of it is shown.
#include <gtest/gtest.h>

#include <gnomon/scene/primitives.hpp>

#include "tests/hard_cases/hard_meshes.hpp"
#include "tests/rows/picture.hpp"
#include "tests/rows/stage.hpp"
#include "tests/support/devices.hpp"
#include "tests/truth/traced.hpp"

namespace gnomon::test {
namespace {

// As the shadow system would if it did not ask whether a fan is exact.
void cap_with_a_fan(shadows::DrawList& list) {
    std::uint64_t revision = std::uint64_t{1} << 40U;  // of the test's own
    for (shadows::VolumeDraw& draw : list.draws) {
        shadows::Facing facing;
        // The far vertex of p is p - L: so the extrusion says where the light is.
        const shadows::LightLocal light{
            glm::vec4(-glm::vec3(draw.extrusion.offset), draw.extrusion.scale)};
        shadows::classify_faces(*draw.mesh, light, facing);
        std::vector<shadows::SilhouetteEdge> silhouette;
        shadows::find_silhouette(*draw.mesh, facing.weights, silhouette);
        std::vector<shadows::FaceRun> casting;
        shadows::runs_of(facing.weights, casting);
        shadows::Volume fan;
        shadows::build_volume(*draw.mesh, casting, silhouette,
                              {.caps = {.far_cap = shadows::FarCap::Fan}}, fan);
        EXPECT_TRUE(shadows::is_closed(*draw.mesh, fan));
        EXPECT_EQ(fan.silhouette_edges, draw.volume->silhouette_edges);
        draw.volume = std::make_shared<const shadows::Volume>(std::move(fan));
        draw.revision = revision++;
    }
}

struct Wrong {
    std::uint64_t with_faces = 0;
    std::uint64_t with_fans = 0;    // whatever the light
    std::uint64_t where_exact = 0;  // fans where they are, as the shadow system does
    std::size_t fans = 0;           // of the latter
};

class FarCap : public DeviceTest {
protected:
    Wrong wrong_pixels(const glm::dvec3& lamp) {
        Stage s;
        s.place(shared(scene::make_plane(20.0F, 20.0F)), glm::dmat4(1.0), false);
        s.place(shared(open_cube()), moved({0.0, 1.25, 0.0}));
        s.lamp(lamp);
        s.look({0.5, 4.0, 6.5}, {0.0, 0.9, 0.0});
        const Setting setting = s.finish();
        const Traced traced = trace_lights(setting);
        Wrong wrong;
        const auto wrong_with = [&](PictureOptions options) {
            options.technique = shadows::Technique::DepthFail;
            options.receivers = shadows::Receivers::Anywhere;
            const Picture picture = must(take_picture(device(), setting, options));
            wrong.fans = 0;
            for (const shadows::VolumeDraw& draw : picture.list.draws) {
                const shadows::FarCap used = draw.volume->made_with.caps.far_cap;
                wrong.fans += used == shadows::FarCap::Fan ? 1 : 0;
            }
            return judge_lights(traced, picture.masks).wrong();
        };
        wrong.with_faces = wrong_with({});
        wrong.with_fans = wrong_with({.mutate = cap_with_a_fan});
        EXPECT_EQ(wrong.fans, 1U);
        wrong.where_exact = wrong_with({.caps = {.far_cap = shadows::FarCap::Fan}});
        return wrong;
    }
};

TEST_P(FarCap, a_fan_is_right_where_the_light_is_far_outside) {
    const Wrong wrong = wrong_pixels({3.0, 8.0, 4.0});
    EXPECT_EQ(wrong.with_faces, 0U);
    EXPECT_EQ(wrong.with_fans, 0U);
    EXPECT_EQ(wrong.where_exact, 0U);
    EXPECT_EQ(wrong.fans, 1U);
}

TEST_P(FarCap, a_fan_is_wrong_where_the_light_is_within_and_refused) {
    const Wrong wrong = wrong_pixels({0.0, 1.5, 0.25});
    EXPECT_EQ(wrong.with_faces, 0U);
    EXPECT_GT(wrong.with_fans, 1000U);
    EXPECT_EQ(wrong.where_exact, 0U);
    EXPECT_EQ(wrong.fans, 0U) << "the far cap is made of faces";
}

INSTANTIATE_TEST_SUITE_P(Devices, FarCap, testing::ValuesIn(drawing_devices()), device_case_name);

}  // namespace
}  // namespace gnomon::test
