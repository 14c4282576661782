// SPDX-License-Identifier: MIT
//
// A guest in OpenGL: whatever a host's conventions are, the mask in its stencil is the truth, and
// that of gnomon's own renderer.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gnomon/gl/backend.hpp>

#include "tests/guest/gl_host.hpp"
#include "tests/guest/masks.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::test {
namespace {

using gl::HostTarget;

struct GuestCase {
    HostWay way;
    std::string row;
    MaskOptions options = {};
    bool egl = false;
};

void PrintTo(const GuestCase& c, std::ostream* out) { *out << c.way.name << " " << c.row; }

std::vector<GuestCase> cases() {
    using enum HostTarget::Kind;
    constexpr auto floats = gpu::Format::Depth32FloatStencil8;
    const HostWay plain{.name = "plain"};
    const HostWay modern{.name = "modern", .zero_to_one = true, .reversed = true, .format = floats};
    const HostWay finite{.name = "finite", .far = Far::Finite, .kind = Renderbuffer};
    const HostWay finite_reversed{
        .name = "finite_reversed", .reversed = true, .far = Far::Finite, .format = floats};
    const HostWay y_down{.name = "y_down", .zero_to_one = true, .y_down = true, .kind = Texture};
    const HostWay upper_left{.name = "upper_left",
                             .zero_to_one = true,
                             .reversed = true,
                             .upper_left = true,
                             .format = floats};
    const HostWay upside_down{.name = "upside_down", .y_down = true, .upper_left = true};
    const HostWay left_handed{
        .name = "left_handed", .zero_to_one = true, .along_plus_z = true, .kind = Renderbuffer};
    const HostWay minus_one_reversed{.name = "minus_one_reversed",
                                     .reversed = true,
                                     .far = Far::Epsilon,
                                     .along_plus_z = true,
                                     .format = floats};
    const HostWay epsilon{
        .name = "epsilon", .far = Far::Epsilon, .format = floats, .kind = Texture};
    HostWay shared = modern;
    shared.name = "shared";
    shared.shared_positions = true;
    HostWay shared_plain = plain;
    shared_plain.name = "shared_plain";
    shared_plain.shared_positions = true;
    const std::string still = "still_life_three_lights";
    const std::string inside = "eye_inside_a_volume";
    const MaskOptions depth_fail{.technique = shadows::Technique::DepthFail};
    const MaskOptions anywhere{.technique = shadows::Technique::DepthFail,
                               .receivers = shadows::Receivers::Anywhere};
    return {{plain, still},
            {plain, inside, anywhere},
            {modern, still, {}, true},
            {modern, inside},
            {finite, still, depth_fail},
            {finite_reversed, inside},
            {y_down, still},
            {y_down, inside},
            {upper_left, still},
            {upper_left, inside, depth_fail},
            {upside_down, still},
            {left_handed, inside},
            {left_handed, still, anywhere},
            {minus_one_reversed, still},
            {epsilon, inside, depth_fail},
            {shared, still, depth_fail},
            {shared_plain, inside, depth_fail},
            {plain, "orthographic"},
            {left_handed, "orthographic", depth_fail},
            {upper_left, "orthographic_near_plane_in_a_volume"}};
}

class GuestInGl : public testing::TestWithParam<GuestCase> {};

std::vector<std::vector<std::uint8_t>> masks_of(const GuestCase& c, GlHost& host,
                                                const std::function<void()>& after_draw = {}) {
    auto context = must(gl::adopt_current_context([&](const char* n) { return host.find(n); }));
    gpu::Device device(must(gl::create_backend(std::move(context))));
    const auto target = must(device.import_texture({.label = "host",
                                                    .width = row_width,
                                                    .height = row_height,
                                                    .format = c.way.format,
                                                    .usage = gpu::TextureUsage::RenderAttachment},
                                                   host.target()));
    shadow_pass::GuestPassDesc desc{.target = target,
                                    .size = {row_width, row_height},
                                    .format = c.way.format,
                                    .conventions = host.conventions()};
    if (c.way.shared_positions) desc.cap_bias = {};
    auto guest = must(shadow_pass::GuestPass::create(device, desc));

    host.draw(setting_of(c.row));
    if (after_draw) after_draw();
    const GlHost::Camera camera = host.camera_of(setting_of(c.row));
    const auto view = must(
        shadows::view_of_host(camera.view_from_world, camera.clip_from_view, host.conventions()));
    const shadows::DrawList list = list_of(c.row, c.options, view.view);
    must(guest.prepare(list, view));
    std::vector<std::vector<std::uint8_t>> masks;
    for (std::size_t light = 0; light < list.lights.size(); ++light) {
        must(guest.count(light));
        masks.push_back(host.stencil());
    }
    EXPECT_EQ(host.gl().GetError(), GLenum{GL_NO_ERROR});
    return masks;
}

TEST_P(GuestInGl, the_mask_in_its_stencil_is_the_truth) {
    const GuestCase& c = GetParam();
    auto context = c.egl ? gl::create_egl_context() : gl::create_osmesa_context();
    if (!context) GTEST_SKIP() << context.error().message;
    GlHost host(std::move(*context), c.way);
    expect_true(c.row, c.options, masks_of(c, host));
}

// Switches that only compatibility contexts have, all of which would change what is counted.
TEST(GuestInCompatibilityGl, what_the_host_left_on_is_off_while_it_counts) {
    const std::string row = "still_life_three_lights";
    const GuestCase c{.way = {.name = "plain"}, .row = row};
    auto context = gl::create_osmesa_context();
    if (!context) GTEST_SKIP() << context.error().message;
    GlHost host(std::move(*context), c.way);
    constexpr GLenum polygon_stipple = 0x0B42;
    constexpr GLenum stencil_test_two_side = 0x8910;
    const auto is_enabled = reinterpret_cast<decltype(&::glIsEnabled)>(host.find("glIsEnabled"));
    const auto set_stipple =
        reinterpret_cast<void(APIENTRY*)(const GLubyte*)>(host.find("glPolygonStipple"));
    ASSERT_NE(set_stipple, nullptr);
    const auto leave_on = [&] {
        const std::array<GLubyte, 128> nothing{};
        set_stipple(nothing.data());
        host.gl().Enable(polygon_stipple);
        host.gl().Enable(stencil_test_two_side);
        ASSERT_EQ(host.gl().GetError(), GLenum{GL_NO_ERROR});
    };
    const auto masks = masks_of(c, host, leave_on);
    EXPECT_EQ(is_enabled(polygon_stipple), GL_TRUE);
    EXPECT_EQ(is_enabled(stencil_test_two_side), GL_TRUE);
    expect_true(row, {}, masks);
}

INSTANTIATE_TEST_SUITE_P(Ways, GuestInGl, testing::ValuesIn(cases()), [](const auto& info) {
    return info.param.way.name + "_" + info.param.row +
           (info.param.options.technique ? "_depth_fail" : "") + (info.param.egl ? "_egl" : "");
});

}  // namespace
}  // namespace gnomon::test
