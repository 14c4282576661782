// SPDX-License-Identifier: MIT
//
// Near caps towards the light and averted from it, in a depth buffer that comes from the shared
// position function: both are right, and where they differ is known.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/near_caps/host.hpp"
#include "tests/near_caps/scenes.hpp"
#include "tests/rows/picture.hpp"
#include "tests/support/devices.hpp"
#include "tests/truth/traced.hpp"

namespace gnomon::test {
namespace {

using shadow_pass::AvertedFaces;
using shadows::NearCaps;
using truth::Verdict;

// Casters with averted caps leave no umbra, so that others would be left out or not by the kind.
constexpr shadows::FillOptions no_umbrae{.cull_by_umbra = false};

class NearCapKinds : public testing::TestWithParam<Row> {
protected:
    static Picture take(const DeviceCase& device_case, const Setting& setting, NearCaps near_caps,
                        AvertedFaces averted_faces, std::optional<shadows::Technique> technique) {
        TestDevice* device = must(shared_device(device_case));
        return must(take_picture(device->device, setting,
                                 {.technique = technique,
                                  .near_caps = near_caps,
                                  .averted_faces = averted_faces,
                                  .fill = no_umbrae,
                                  .cull_back_faces = GetParam().cull_back_faces}));
    }
};

TEST_P(NearCapKinds, give_the_same_counts_on_every_judged_pixel) {
    const Setting setting = GetParam().make();
    const auto truth = trace_lights(setting);
    for (const DeviceCase& device_case : drawing_devices()) {
        if (!shared_device(device_case)) continue;
        for (const auto technique :
             {std::optional<shadows::Technique>(), std::optional(shadows::Technique::DepthFail)}) {
            const auto picture = [&](NearCaps caps, AvertedFaces faces) {
                return take(device_case, setting, caps, faces, technique);
            };
            const Picture facing = picture(NearCaps::Facing, AvertedFaces::Shadowed);
            const Picture averted = picture(NearCaps::Averted, AvertedFaces::Shadowed);
            const Picture open = picture(NearCaps::Averted, AvertedFaces::LeftToShading);
            std::size_t differ = 0;
            std::size_t judged_differ = 0;
            std::size_t opened = 0;
            for (std::size_t light = 0; light < truth.size(); ++light) {
                for (std::size_t i = 0; i < truth[light][0].verdicts.size(); ++i) {
                    const auto f = facing.masks[light][0][i];
                    const auto a = averted.masks[light][0][i];
                    const auto o = open.masks[light][0][i];
                    const Verdict verdict = truth[light][0].verdicts[i];
                    const bool judged = verdict == Verdict::Lit || verdict == Verdict::Shadowed;
                    differ += f != a ? 1 : 0;
                    judged_differ += judged && (f != a || f != o) ? 1 : 0;
                    opened += f != 0 && o == 0 ? 1 : 0;
                }
            }
            std::printf("%-36s %-18s %-4s differ: %zu, of judged %zu; left to shading %zu\n",
                        GetParam().name.c_str(), device_case.name.c_str(),
                        technique ? "fail" : "auto", differ, judged_differ, opened);
            EXPECT_EQ(judged_differ, 0U) << device_case.name;
            for (const Picture* kind : {&averted, &open}) {
                EXPECT_EQ(judge_lights(truth, kind->masks).wrong(), 0U) << device_case.name;
            }
        }
    }
}

// What averted caps ask for: nothing that is seen may lie within a solid. Here everything does.
TEST(NearCapKindsInside, AnEyeWithinASolidNeedsCapsTowardsTheLight) {
    TestDevice* device = must(shared_device(drawing_devices().front()));
    for (const bool drawn : {true, false}) {
        const Setting setting = eye_in_a_solid(drawn);
        const auto truth = trace_lights(setting);
        const auto judged = [&](NearCaps caps) {
            return judge_lights(truth,
                                host_picture(device->device, setting, {.near_caps = caps}).masks);
        };
        const auto facing = judged(NearCaps::Facing);
        EXPECT_GT(facing.shadowed, 10'000U);
        EXPECT_EQ(facing.wrong(), 0U);
        const auto averted = judged(NearCaps::Averted);
        std::printf("eye within a solid, %-8s: averted caps light %llu of %llu pixels in shadow\n",
                    drawn ? "drawn" : "undrawn",
                    static_cast<unsigned long long>(averted.false_light),
                    static_cast<unsigned long long>(averted.shadowed));
        if (drawn) {
            EXPECT_GT(averted.false_light, averted.shadowed / 2);
        } else {
            EXPECT_EQ(averted.wrong(), 0U) << "the adapter knows that it may be seen into";
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Rows, NearCapKinds, testing::ValuesIn(rows()),
                         [](const auto& param) { return param.param.name; });

}  // namespace
}  // namespace gnomon::test
