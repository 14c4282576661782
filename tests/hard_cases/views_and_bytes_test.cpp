// SPDX-License-Identifier: MIT
//
// Hard cases whose claim is about bytes: depth-pass, depth-fail and the mixture of both that is
// chosen by itself give the same masks from any camera, caps in ranges give those of caps written
// out, and a whole scene that is moved gives the same masks wherever its sums are exact.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include <gnomon/scene/primitives.hpp>

#include "tests/hard_cases/hard_case.hpp"
#include "tests/rows/stage.hpp"
#include "tests/support/devices.hpp"
#include "tests/support/share.hpp"

namespace gnomon::test {
namespace {

std::size_t differing(const Picture& a, const Picture& b) {
    std::size_t count = a.masks.size() == b.masks.size() ? 0 : 1;
    for (std::size_t light = 0; light < std::min(a.masks.size(), b.masks.size()); ++light) {
        for (std::size_t sample = 0; sample < a.masks[light].size(); ++sample) {
            count += differing_bytes(a.masks[light][sample], b.masks[light][sample]);
        }
    }
    return count;
}

class HardCasesByBytes : public DeviceTest {};

// 7, 8, 9, 10: every view of camera_cases, all pairs by depth-fail against what is chosen.
TEST_P(HardCasesByBytes, depth_pass_and_depth_fail_mix_without_a_seam) {
    if (on_swiftshader(*must(shared_device(GetParam())))) {
        GTEST_SKIP() << "sides seen edge-on are wrong there (docs/hard-cases.md)";
    }
    std::uint64_t depth_pass = 0;
    std::uint64_t depth_fail = 0;
    for (const HardCase& hard_case : camera_cases()) {
        if (hard_case.options.technique || hard_case.options.samples > 1) continue;
        std::uint64_t sweep_pass = 0;
        std::uint64_t sweep_fail = 0;
        for (int frame = 0; frame < hard_case.frames; frame += 2) {  // a sweep's middle included
            const Setting setting = hard_case.make(frame);
            PictureOptions options = hard_case.options;
            const Picture chosen = must(take_picture(device(), setting, options));
            options.technique = shadows::Technique::DepthFail;
            const Picture all_fail = must(take_picture(device(), setting, options));
            sweep_pass += chosen.list.stats.zpass_pairs;
            sweep_fail += chosen.list.stats.zfail_pairs;
            EXPECT_EQ(differing(chosen, all_fail), 0U) << hard_case.name << ", frame " << frame;
        }
        depth_pass += sweep_pass;
        depth_fail += sweep_fail;
        if (hard_case.name.starts_with("07_sweep") && !hard_case.name.ends_with("orthographic") &&
            !hard_case.name.ends_with("oblique")) {
            EXPECT_GT(sweep_pass, 0U) << hard_case.name << " never leaves the volume";
            EXPECT_GT(sweep_fail, 0U) << hard_case.name << " never meets the volume";
        }
    }
    EXPECT_GT(depth_pass, 50U);
    EXPECT_GT(depth_fail, 50U);
}

// 23: coordinates, offsets and the camera's matrix are multiples of powers of two, so that no sum
// in double precision rounds: not a byte may differ, up to 2^27 m (134,000 km).
Setting exact_scene(const glm::dvec3& away) {
    Stage s;
    s.ground(16.0F, moved(away));
    const MeshPointer knot = shared(scene::make_torus_knot(1.0F, 0.32F, 2, 3, 96, 16));
    s.place(knot, moved(away + glm::dvec3(-0.75, 1.75, 0.0)) * turned(20, {1, 1, 0}));
    s.place(knot, moved(away + glm::dvec3(1.75, 1.25, -0.5)) * scaled({0.5, -0.75, 0.5}));
    s.lamp(away + glm::dvec3(1.5, 4.5, 2.0));
    s.sun({-0.5, -1.0, -0.5});
    // Straight along -Z; a lens shifted down looks at the ground.
    const glm::dvec3 eye = away + glm::dvec3(0.25, 2.5, 5.5);
    s.view().view_from_world = moved(-eye);
    glm::dmat4& clip = s.view().clip_from_view;
    clip = glm::dmat4(0.0);
    clip[0][0] = 1.5;
    clip[1][1] = 2.0;
    clip[2][1] = -0.75;
    clip[2][3] = -1.0;
    clip[3][2] = 0x1p-6;
    return s.finish();
}

TEST_P(HardCasesByBytes, a_scene_moved_by_exact_sums_keeps_every_byte) {
    const Picture here = must(take_picture(device(), exact_scene(glm::dvec3(0.0)), {}));
    std::size_t dark = 0;
    for (const std::uint8_t count : here.masks[0][0]) dark += count != 0 ? 1 : 0;
    ASSERT_GT(dark, here.masks[0][0].size() / 20);
    for (const int power : {10, 13, 16, 20, 23, 27}) {
        const glm::dvec3 away = std::ldexp(1.0, power) * glm::dvec3(1.0, -0.25, 0.75);
        const Picture there = must(take_picture(device(), exact_scene(away), {}));
        EXPECT_EQ(differing(there, here), 0U) << "moved by 2^" << power << " m";
        EXPECT_EQ(differing_bytes(there.depth, here.depth), 0U) << "moved by 2^" << power << " m";
    }
}

// Of every hard case's first frame: ranges of faces, and far caps that are near caps drawn again,
// against triangles that are all written out.
TEST_P(HardCasesByBytes, caps_in_ranges_give_the_bytes_of_caps_written_out) {
    std::size_t ranges = 0;
    for (std::size_t i = 0; i < hard_cases().size(); ++i) {
        if (!falls_to(number(), i, 3)) continue;
        const HardCase& hard_case = hard_cases()[i];
        const auto taken = [&](const shadows::CapOptions& caps) {
            PictureOptions options = hard_case.options;
            options.width = 160;
            options.height = 120;
            options.caps = caps;
            return take_picture(device(), hard_case.make(0), options);
        };
        const auto plain = taken(shadows::CapOptions::plain());
        if (!plain) continue;  // no such format here
        const Picture in_ranges = must(taken({.draw_worth_faces = 2, .max_ranges = 16}));
        EXPECT_EQ(differing(in_ranges, *plain), 0U) << hard_case.name;
        for (const shadows::VolumeDraw& draw : in_ranges.list.draws) {
            ranges += draw.volume->ranges.size();
        }
    }
    EXPECT_GT(ranges, 100U);
}

INSTANTIATE_TEST_SUITE_P(Devices, HardCasesByBytes, testing::ValuesIn(drawing_devices()),
                         device_case_name);

}  // namespace
}  // namespace gnomon::test
