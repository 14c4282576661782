// SPDX-License-Identifier: MIT
//
// The same scene gives the same bytes on every device that rasterises alike: random triangles in
// depth, then random volumes counted into the stencil. Devices of different rasterisers are not
// compared here.
#include <algorithm>
#include <map>
#include <random>
#include <string>

#include "tests/conformance/painting.hpp"
#include "tests/conformance/reading_shader.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::conformance {
namespace {

constexpr std::uint32_t width = 160;
constexpr std::uint32_t height = 120;
constexpr std::uint32_t seed = 20240229;

struct Bytes {
    std::vector<std::uint8_t> color;
    std::vector<float> depth;                         // empty when multisampled
    std::vector<std::vector<std::uint8_t>> stencils;  // of each sample
};

std::vector<Vertex> random_triangles(std::mt19937& random, int count) {
    // Raw bits scaled by hand: distributions differ between standard libraries.
    const auto between = [&random](float low, float high) {
        return low + (high - low) * (static_cast<float>(random() >> 8) / 16777216.0F);
    };
    std::vector<Vertex> vertices;
    for (int i = 0; i < count; ++i) {
        const float x = between(-1, 1);
        const float y = between(-1, 1);
        for (int corner = 0; corner < 3; ++corner) {
            const float w = between(0.5F, 4.0F);
            vertices.push_back({(x + between(-0.7F, 0.7F)) * w, (y + between(-0.7F, 0.7F)) * w,
                                between(0.05F, 0.95F) * w, w, between(0, 1), between(0, 1),
                                between(0, 1), 1});
        }
    }
    return vertices;
}

Bytes draw_scene(gpu::Device& device, std::uint32_t sample_count) {
    std::mt19937 random(seed);
    const Step scene{
        .vertices = random_triangles(random, 40),
        .depth_stencil = {.depth_write_enabled = true, .depth_compare = gpu::Compare::Greater}};
    const Step volumes{
        .vertices = random_triangles(random, 300),
        .depth_stencil = {.depth_compare = gpu::Compare::Greater,
                          .stencil_front = {.depth_fail_op = gpu::StencilOp::DecrementWrap},
                          .stencil_back = {.depth_fail_op = gpu::StencilOp::IncrementWrap}},
        .write_mask = gpu::ColorWrite::None};
    Painting painting(device, {.width = width, .height = height, .sample_count = sample_count});
    painting.paint({scene, volumes});

    Bytes bytes{.color = painting.color(), .depth = {}, .stencils = {}};
    if (sample_count == 1) {
        bytes.depth = painting.depth();
        bytes.stencils.push_back(painting.stencil());
    } else {
        for (std::uint32_t sample = 0; sample < sample_count; ++sample) {
            bytes.stencils.push_back(fetch_stencil_samples(device, painting.depth_stencil_texture(),
                                                           width, height,
                                                           static_cast<std::int32_t>(sample)));
        }
    }
    return bytes;
}

template <class T>
std::size_t differences(const std::vector<T>& a, const std::vector<T>& b) {
    EXPECT_EQ(a.size(), b.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) count += a[i] != b[i] ? 1 : 0;
    return count;
}

void compare_all(std::uint32_t sample_count) {
    std::map<std::string, std::pair<std::string, Bytes>> references;  // by rasteriser
    int compared = 0;
    for (const test::DeviceCase& device_case : test::drawing_devices()) {
        const auto shared = test::shared_device(device_case);
        if (!shared) {
            EXPECT_FALSE(test::is_required(device_case.name)) << shared.error().message;
            continue;
        }
        gpu::Device& device = (*shared)->device;
        const gpu::Features& features = device.caps().features;
        if (sample_count > 1 && (!features.multisample_4 || !features.sampled_stencil)) continue;
        Bytes bytes = draw_scene(device, sample_count);
        for (const auto& stencil : bytes.stencils) {
            const auto covered = std::count_if(stencil.begin(), stencil.end(),
                                               [](std::uint8_t value) { return value != 0; });
            EXPECT_GT(covered, 1000) << "the scene counts next to nothing";
        }
        const std::string rasteriser = test::rasteriser_of(device);
        const auto found = references.find(rasteriser);
        if (found == references.end()) {
            references.emplace(rasteriser, std::pair(device_case.name, std::move(bytes)));
            continue;
        }
        const auto& [name, reference] = found->second;
        SCOPED_TRACE(device_case.name + " against " + name);
        ++compared;
        EXPECT_EQ(differences(bytes.color, reference.color), 0U) << "colour bytes";
        EXPECT_EQ(differences(bytes.depth, reference.depth), 0U) << "depths";
        ASSERT_EQ(bytes.stencils.size(), reference.stencils.size());
        for (std::size_t sample = 0; sample < bytes.stencils.size(); ++sample) {
            EXPECT_EQ(differences(bytes.stencils[sample], reference.stencils[sample]), 0U)
                << "stencil bytes of sample " << sample;
        }
    }
    if (compared == 0) GTEST_SKIP() << "fewer than two devices of one rasteriser";
}

TEST(Parity, OneSampleIsByteEqual) { compare_all(1); }
TEST(Parity, FourSamplesAreByteEqual) { compare_all(4); }

}  // namespace
}  // namespace gnomon::conformance
