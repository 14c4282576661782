// SPDX-License-Identifier: MIT
//
// Row 14: what a far cap of fans would give. It is closed as well, of fewer triangles. But a rim
// bounds two parts of the sphere of directions, and a fan takes the smaller one: from within a box
// without a lid that is the opening, where it should be the walls.
#include <gtest/gtest.h>

#include <gnomon/scene/primitives.hpp>

#include "tests/hard_cases/hard_meshes.hpp"
#include "tests/rows/picture.hpp"
#include "tests/rows/stage.hpp"
#include "tests/support/devices.hpp"
#include "tests/truth/traced.hpp"

namespace gnomon::test {
namespace {

// Every side quad's far edge joined to the first one's corner.
void cap_with_a_fan(shadows::DrawList& list) {
    std::uint64_t revision = std::uint64_t{1} << 40U;  // of the test's own
    for (shadows::VolumeDraw& draw : list.draws) {
        const shadows::Volume& whole = *draw.volume;
        shadows::Volume fan;
        fan.indices.assign(whole.indices.begin(), whole.indices.begin() + whole.far_cap.first);
        fan.sides = whole.sides;
        fan.near_cap = whole.near_cap;
        // A quad's first triangle begins with its near vertices, which run against the far cap.
        const std::uint32_t hub = whole.indices[whole.sides.first + 1] + 1;
        for (std::uint32_t i = 0; i < whole.sides.count; i += 6) {
            const std::uint32_t* quad = &whole.indices[whole.sides.first + i];
            fan.indices.insert(fan.indices.end(), {hub, quad[0] + 1, quad[1] + 1});
        }
        fan.far_cap = {whole.far_cap.first,
                       static_cast<std::uint32_t>(fan.indices.size()) - whole.far_cap.first};
        const auto flipped = whole.indices.begin() + whole.near_cap_flipped.first;
        fan.near_cap_flipped = {static_cast<std::uint32_t>(fan.indices.size()),
                                whole.near_cap_flipped.count};
        fan.indices.insert(fan.indices.end(), flipped, flipped + whole.near_cap_flipped.count);
        fan.silhouette_edges = whole.silhouette_edges;
        EXPECT_TRUE(shadows::is_closed(fan, false));
        draw.volume = std::make_shared<const shadows::Volume>(std::move(fan));
        draw.revision = revision++;
    }
}

struct Wrong {
    std::uint64_t with_faces = 0;
    std::uint64_t with_fans = 0;
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
        const auto wrong = [&](PictureOptions options) {
            options.technique = shadows::Technique::DepthFail;
            return judge_lights(traced, must(take_picture(device(), setting, options)).masks)
                .wrong();
        };
        return {wrong({}), wrong({.mutate = cap_with_a_fan})};
    }
};

TEST_P(FarCap, a_fan_is_right_where_the_light_is_far_outside) {
    const Wrong wrong = wrong_pixels({3.0, 8.0, 4.0});
    EXPECT_EQ(wrong.with_faces, 0U);
    EXPECT_EQ(wrong.with_fans, 0U);
}

TEST_P(FarCap, a_fan_is_wrong_where_the_light_is_within) {
    const Wrong wrong = wrong_pixels({0.0, 1.5, 0.25});
    EXPECT_EQ(wrong.with_faces, 0U);
    EXPECT_GT(wrong.with_fans, 1000U);
}

INSTANTIATE_TEST_SUITE_P(Devices, FarCap, testing::ValuesIn(drawing_devices()), device_case_name);

}  // namespace
}  // namespace gnomon::test
