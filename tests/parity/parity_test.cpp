// SPDX-License-Identifier: MIT
//
// The same raw stencil bytes, and the same depth, from every device of this rasteriser family,
// whatever path the device takes; and from every path of ours that must not matter.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "tests/rows/picture.hpp"
#include "tests/rows/rows.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::test {
namespace {

class Parity : public testing::TestWithParam<Row> {
protected:
    static std::string name_of(const std::string& what) {
        return fmt::format("parity.{}.{}", GetParam().name, what);
    }

    // Compares all masks and depth of two pictures of this row.
    static void expect_equal(const Picture& actual, const Picture& expected,
                             const std::string& what) {
        ASSERT_EQ(actual.masks.size(), expected.masks.size()) << what;
        for (std::size_t light = 0; light < expected.masks.size(); ++light) {
            ASSERT_EQ(actual.masks[light].size(), expected.masks[light].size()) << what;
            for (std::size_t sample = 0; sample < expected.masks[light].size(); ++sample) {
                const auto& a = actual.masks[light][sample];
                const auto& e = expected.masks[light][sample];
                const std::size_t wrong = differing_bytes(a, e);
                if (wrong == 0) continue;
                ADD_FAILURE() << what << ": " << wrong << " stencil bytes of light " << light
                              << ", sample " << sample << " differ; see "
                              << save_difference(
                                     name_of(fmt::format("{}.light{}.s{}", what, light, sample)),
                                     row_width, row_height, a, e);
            }
        }
        EXPECT_EQ(differing_bytes(actual.depth, expected.depth), 0U) << what << ": depth";
    }

    static Picture take(const DeviceCase& device_case, PictureOptions options = {}) {
        options.cull_back_faces = GetParam().cull_back_faces;
        TestDevice* device = must(shared_device(device_case));
        return must(take_picture(device->device, GetParam().make(), options));
    }

    static std::vector<DeviceCase> devices() {
        std::vector<DeviceCase> usable;
        for (const DeviceCase& device_case : drawing_devices()) {
            auto device = shared_device(device_case);
            if (device) {
                usable.push_back(device_case);
            } else {
                EXPECT_FALSE(is_required(device_case.name)) << device.error().message;
            }
        }
        return usable;
    }
};

TEST_P(Parity, all_devices_give_the_same_bytes) {
    const auto usable = devices();
    if (usable.size() < 2) GTEST_SKIP() << "fewer than two drawing devices";
    const Picture reference = take(usable[0]);
    ASSERT_FALSE(reference.masks.empty());
    for (std::size_t i = 1; i < usable.size(); ++i)
        expect_equal(take(usable[i]), reference, usable[i].name);
}

TEST_P(Parity, all_devices_give_the_same_bytes_at_four_samples) {
    const auto usable = devices();
    if (usable.size() < 2) GTEST_SKIP() << "fewer than two drawing devices";
    const Picture reference = take(usable[0], {.samples = 4});
    ASSERT_FALSE(reference.masks.empty());
    std::size_t differ_between_samples = 0;
    for (const auto& light : reference.masks) {
        for (std::size_t s = 1; s < light.size(); ++s)
            differ_between_samples += differing_bytes(light[s], light[0]);
    }
    EXPECT_GT(differ_between_samples, 0U) << "four samples that are one";
    for (std::size_t i = 1; i < usable.size(); ++i) {
        expect_equal(take(usable[i], {.samples = 4}), reference, usable[i].name);
    }
}

TEST_P(Parity, depth_fail_everywhere_gives_the_same_bytes) {
    for (const DeviceCase& device : devices()) {
        expect_equal(take(device, {.technique = shadows::Technique::DepthFail}), take(device),
                     device.name);
    }
}

TEST_P(Parity, extrusion_on_the_cpu_gives_the_same_bytes) {
    for (const DeviceCase& device : devices()) {
        expect_equal(take(device, {.extrusion = shadow_pass::ExtrusionPath::Cpu}), take(device),
                     device.name);
    }
}

TEST_P(Parity, the_order_of_volumes_does_not_matter) {
    const auto backwards = [](shadows::DrawList& list) {
        for (const auto& light : list.lights) {
            std::reverse(list.draws.begin() + light.first,
                         list.draws.begin() + light.first + light.count);
        }
    };
    for (const DeviceCase& device : devices()) {
        expect_equal(take(device, {.mutate = backwards}), take(device), device.name);
    }
}

INSTANTIATE_TEST_SUITE_P(Rows, Parity, testing::ValuesIn(rows()),
                         [](const auto& param) { return param.param.name; });

}  // namespace
}  // namespace gnomon::test
