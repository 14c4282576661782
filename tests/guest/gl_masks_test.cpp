// SPDX-License-Identifier: MIT
//
// A guest in OpenGL: whatever a host's conventions are, the mask in its stencil is the truth, and
// that of gnomon's own renderer.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gnomon/gl/backend.hpp>
#include <gnomon/shadow_pass/light_masks.hpp>

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

// One for each kind of target and each origin.
std::vector<GuestCase> mask_cases() {
    using enum HostTarget::Kind;
    const std::string still = "still_life_three_lights";
    const std::string inside = "eye_inside_a_volume";
    return {
        {{.name = "plain"}, still},
        {{.name = "upper_left",
          .zero_to_one = true,
          .reversed = true,
          .upper_left = true,
          .format = gpu::Format::Depth32FloatStencil8},
         inside,
         {.technique = shadows::Technique::DepthFail}},
        {{.name = "y_down", .zero_to_one = true, .y_down = true, .kind = Texture},
         inside,
         {},
         true},
        {{.name = "left_handed", .zero_to_one = true, .along_plus_z = true, .kind = Renderbuffer},
         still}};
}

// Mirrored sample places and not.
std::vector<GuestCase> sample_cases() {
    using enum HostTarget::Kind;
    const std::string row = "hidden_caster";  // quickly traced
    return {{{.name = "plain", .samples = 4}, row},
            {{.name = "y_down",
              .zero_to_one = true,
              .reversed = true,
              .y_down = true,
              .format = gpu::Format::Depth32FloatStencil8,
              .kind = Texture,
              .samples = 4},
             row,
             {.technique = shadows::Technique::DepthFail}},
            {{.name = "upper_left", .upper_left = true, .samples = 4}, row, {}, true}};
}

class GuestInGl : public testing::TestWithParam<GuestCase> {};

// A guest on the host's context, in its framebuffer, with one view of a row.
struct Guest {
    gpu::Device device;
    gpu::Texture target;
    shadow_pass::GuestPassDesc desc;
    shadows::HostView view;
    shadows::DrawList list;
};

Guest invite(const GuestCase& c, GlHost& host) {
    auto context = must(gl::adopt_current_context([&](const char* n) { return host.find(n); }));
    gpu::Device device(must(gl::create_backend(std::move(context))));
    auto target = must(device.import_texture({.label = "host",
                                              .width = row_width,
                                              .height = row_height,
                                              .format = c.way.format,
                                              .usage = gpu::TextureUsage::RenderAttachment,
                                              .sample_count = c.way.samples},
                                             host.target()));
    shadow_pass::GuestPassDesc desc{.target = target,
                                    .size = {row_width, row_height},
                                    .format = c.way.format,
                                    .sample_count = c.way.samples,
                                    .conventions = host.conventions()};
    if (c.way.shared_positions) desc.cap_bias = {};
    const GlHost::Camera camera = host.camera_of(setting_of(c.row));
    const auto view = must(
        shadows::view_of_host(camera.view_from_world, camera.clip_from_view, host.conventions()));
    return {std::move(device), std::move(target), desc, view, list_of(c.row, c.options, view.view)};
}

gpu::Texture import_mask(gpu::Device& device, GLuint mask, gpu::Format format,
                         std::uint32_t samples = 1) {
    return must(device.import_texture({.label = "mask",
                                       .width = row_width,
                                       .height = row_height,
                                       .format = format,
                                       .usage = gpu::TextureUsage::RenderAttachment,
                                       .sample_count = samples},
                                      GlHost::mask_target(mask)));
}

std::vector<std::vector<std::uint8_t>> masks_of(const GuestCase& c, GlHost& host,
                                                const std::function<void()>& after_draw = {}) {
    Guest guest = invite(c, host);
    auto pass = must(shadow_pass::GuestPass::create(guest.device, guest.desc));
    host.draw(setting_of(c.row));
    if (after_draw) after_draw();
    must(pass.prepare(guest.list, guest.view));
    std::vector<std::vector<std::uint8_t>> masks;
    for (std::size_t light = 0; light < guest.list.lights.size(); ++light) {
        must(pass.count(light));
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

std::string case_name(const testing::TestParamInfo<GuestCase>& info) {
    return info.param.way.name + "_" + info.param.row +
           (info.param.options.technique ? "_depth_fail" : "") + (info.param.egl ? "_egl" : "");
}

INSTANTIATE_TEST_SUITE_P(Ways, GuestInGl, testing::ValuesIn(cases()), case_name);

// Masks in the host's own textures, beside its depth wherever that is.
class MasksInGl : public GuestInGl {};

TEST_P(MasksInGl, bits_in_the_hosts_texture_are_the_truth) {
    const GuestCase& c = GetParam();
    auto context = c.egl ? gl::create_egl_context() : gl::create_osmesa_context();
    if (!context) GTEST_SKIP() << context.error().message;
    GlHost host(std::move(*context), c.way);
    const auto stencils = masks_of(c, host);
    Guest guest = invite(c, host);
    const GLuint texture = host.make_mask(GL_R32UI);
    const auto mask = import_mask(guest.device, texture, gpu::Format::R32Uint);
    auto masks =
        must(shadow_pass::LightMasks::create(guest.device, {.host = guest.desc, .masks = {mask}}));
    host.draw(setting_of(c.row));
    must(masks.prepare(guest.list, guest.view));
    must(masks.resolve());
    const auto bits = host.read_bits(texture);
    expect_true_bits(c.row, bits);
    EXPECT_EQ(wrong_bits(bits, stencils), 0U);
    EXPECT_THAT(host.stencil(), testing::Each(0));
    EXPECT_EQ(host.gl().GetError(), GLenum{GL_NO_ERROR});
}

INSTANTIATE_TEST_SUITE_P(Ways, MasksInGl, testing::ValuesIn(mask_cases()), case_name);

// Sample by sample: the stencil, the bits of a mask with four samples, and shares in one of one.
class FourSamplesInGl : public GuestInGl {};

TEST_P(FourSamplesInGl, each_sample_is_the_truth_where_it_lies) {
    const GuestCase& c = GetParam();
    auto context = c.egl ? gl::create_egl_context() : gl::create_osmesa_context();
    if (!context) GTEST_SKIP() << context.error().message;
    GlHost host(std::move(*context), c.way);
    Guest guest = invite(c, host);
    auto pass = must(shadow_pass::GuestPass::create(guest.device, guest.desc));
    host.draw(setting_of(c.row));
    must(pass.prepare(guest.list, guest.view));
    std::vector<std::vector<std::vector<std::uint8_t>>> stencils;
    for (std::size_t light = 0; light < guest.list.lights.size(); ++light) {
        must(pass.count(light));
        stencils.emplace_back();
        for (int s = 0; s < 4; ++s) stencils.back().push_back(host.stencil_sample(s));
    }
    expect_true_samples(c.row, stencils, host.samples_are_mirrored());

    const GLuint texture = host.make_mask(GL_R32UI, 4);
    const auto mask = import_mask(guest.device, texture, gpu::Format::R32Uint, 4);
    auto masks =
        must(shadow_pass::LightMasks::create(guest.device, {.host = guest.desc, .masks = {mask}}));
    must(masks.prepare(guest.list, guest.view));
    must(masks.resolve());
    for (std::size_t s = 0; s < 4; ++s) {
        std::vector<std::vector<std::uint8_t>> of_sample;
        for (const auto& of_light : stencils) of_sample.push_back(of_light[s]);
        EXPECT_EQ(wrong_bits(host.read_bits(texture, static_cast<int>(s)), of_sample), 0U);
    }

    std::vector<GLuint> textures;
    std::vector<gpu::Texture> bytes;
    std::vector<gpu::TextureId> ids;
    for (std::size_t light = 0; light < stencils.size(); ++light) {
        textures.push_back(host.make_mask(GL_R8));
        bytes.push_back(import_mask(guest.device, textures.back(), gpu::Format::R8Unorm));
        ids.push_back(bytes.back());
    }
    auto shares =
        must(shadow_pass::LightMasks::create(guest.device, {.host = guest.desc, .masks = ids}));
    must(shares.prepare(guest.list, guest.view));
    must(shares.resolve());
    for (std::size_t light = 0; light < stencils.size(); ++light) {
        const auto said = host.read_bytes(textures[light]);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < said.size(); ++i) {
            int in_shadow = 0;
            for (std::size_t s = 0; s < 4; ++s) in_shadow += stencils[light][s][i] != 0 ? 1 : 0;
            wrong += std::abs(said[i] - 63.75 * in_shadow) > 1.0 ? 1 : 0;
        }
        EXPECT_EQ(wrong, 0U);
    }
    EXPECT_EQ(host.gl().GetError(), GLenum{GL_NO_ERROR});
}

INSTANTIATE_TEST_SUITE_P(Ways, FourSamplesInGl, testing::ValuesIn(sample_cases()), case_name);

// Whose samples no shader reads, but for the mask's.
TEST(FourSamplesOfARenderbuffer, are_the_truth_in_a_mask) {
    auto context = gl::create_osmesa_context();
    if (!context) GTEST_SKIP() << context.error().message;
    const GuestCase c{
        {.name = "renderbuffer", .kind = HostTarget::Kind::Renderbuffer, .samples = 4},
        "hidden_caster"};
    GlHost host(std::move(*context), c.way);
    Guest guest = invite(c, host);
    const GLuint texture = host.make_mask(GL_R32UI, 4);
    const auto mask = import_mask(guest.device, texture, gpu::Format::R32Uint, 4);
    auto masks =
        must(shadow_pass::LightMasks::create(guest.device, {.host = guest.desc, .masks = {mask}}));
    host.draw(setting_of(c.row));
    must(masks.prepare(guest.list, guest.view));
    must(masks.resolve());
    std::vector<std::vector<std::vector<std::uint8_t>>> of_lights(guest.list.lights.size());
    for (int s = 0; s < 4; ++s) {
        const auto bits = host.read_bits(texture, s);
        for (std::size_t light = 0; light < of_lights.size(); ++light) {
            auto& of_sample = of_lights[light].emplace_back();
            for (const std::uint32_t word : bits) of_sample.push_back(word >> light & 1U);
        }
    }
    expect_true_samples(c.row, of_lights, host.samples_are_mirrored());
    EXPECT_EQ(host.gl().GetError(), GLenum{GL_NO_ERROR});
}

}  // namespace
}  // namespace gnomon::test
