// SPDX-License-Identifier: MIT
//
// Hard cases 20 and 21: each capability of an adapter switched off in turn. What does not need it
// gives the same bytes; what needs it is refused with a sentence; another depth format is held
// against traced truth.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <tuple>

#include <gnomon/scene/primitives.hpp>

#include "tests/hard_cases/hard_case.hpp"
#include "tests/rows/picture.hpp"
#include "tests/rows/rows.hpp"
#include "tests/rows/stage.hpp"
#include "tests/support/devices.hpp"
#include "tests/truth/traced.hpp"

#if GNOMON_HAS_GL
#include <gnomon/gl/backend.hpp>
#endif
#if GNOMON_HAS_VK
#include <gnomon/vk/backend.hpp>
#endif

namespace gnomon::test {
namespace {

using testing::HasSubstr;

std::vector<DeviceCase> crippled_devices() {
    std::vector<DeviceCase> cases;
    const char* variable = std::getenv("GNOMON_TEST_ADAPTER");
    [[maybe_unused]] const std::string adapter = variable != nullptr ? variable : "";
#if GNOMON_HAS_GL
    for (const char* extension :
         {"GL_ARB_depth_clamp", "GL_ARB_stencil_texturing", "GL_ARB_texture_multisample",
          "GL_ARB_occlusion_query", "GL_ARB_timer_query", "GL_ARB_polygon_offset_clamp",
          "GL_KHR_debug", "GL_KHR_robustness"}) {
        if (!adapter.empty()) break;
        cases.push_back(
            {.name = std::string("gl_without_") + extension,
             .create_backend = [=](gpu::MessageSink sink) -> Result<std::unique_ptr<gpu::Backend>> {
                 auto context = gl::create_osmesa_context();
                 if (!context) return forward_error(context);
                 return gl::create_backend(std::move(*context), {.disabled_extensions = {extension},
                                                                 .debug = true,
                                                                 .message_sink = std::move(sink)});
             }});
    }
#endif
#if GNOMON_HAS_VK
    for (const char* feature :
         {"depthClamp", "depthBiasClamp", "independentBlend", "occlusionQueryPrecise", "sampleRate",
          "timestamps", "D32_SFLOAT_S8_UINT", "D24_UNORM_S8_UINT", "sampledStencil"}) {
        cases.push_back({.name = std::string("vk_without_") + feature,
                         .create_backend = [=](gpu::MessageSink sink) {
                             vk::BackendOptions options;
                             options.adapter = adapter;
                             options.validation = true;
                             options.disabled_features = {feature};
                             options.message_sink = std::move(sink);
                             return vk::create_backend(options);
                         }});
    }
#endif
    return cases;
}

const Row& row_named(const std::string& name) {
    return *std::find_if(rows().begin(), rows().end(),
                         [&](const Row& row) { return row.name == name; });
}

Setting orthographic_by_depth_pass() {
    Stage s;
    s.ground();
    const MeshPointer knot = shared(scene::make_torus_knot(0.6F, 0.2F, 2, 3, 96, 16));
    for (const double x : {-1.5, 0.0, 1.5}) {
        s.place(knot, moved({x, 1.2, 0.3 * x}) * turned(40.0 * x, {1, 1, 0}));
    }
    s.sun({-0.6, -1.0, -0.5});
    s.lamp({0.5, 4.0, 2.0});
    s.look_orthographic({0.0, 6.0, 9.0}, {0.0, 0.6, 0.0}, 2.4, 0.5, 30.0);
    return s.finish();
}

class WithoutOne : public testing::TestWithParam<DeviceCase> {
protected:
    void SetUp() override {
        auto reference = shared_device(drawing_devices().front());
        auto opened = open_device(GetParam());
        if (!opened || !reference) GTEST_SKIP() << "no such device";
        reference_ = *reference;
        if (on_swiftshader(*reference_)) GTEST_SKIP() << "it has one depth format";
        device_ = std::move(*opened);
    }
    [[nodiscard]] const gpu::Features& has() const { return device_->device.caps().features; }
    [[nodiscard]] PictureOptions options(std::uint32_t samples = 1) const {
        return {.samples = samples,
                .depth_stencil_format = has().depth32float_stencil8
                                            ? gpu::Format::Depth32FloatStencil8
                                            : gpu::Format::Depth24UnormStencil8};
    }

    // The same bytes as with everything, or, in another depth format, the truth.
    void expect_right(const Setting& setting, std::uint32_t samples = 1) {
        const Picture picture = must(take_picture(device_->device, setting, options(samples)));
        if (!has().depth32float_stencil8) {
            expect_truth(setting, picture);
            return;
        }
        const Picture all = must(take_picture(reference_->device, setting, {.samples = samples}));
        ASSERT_EQ(picture.masks.size(), all.masks.size());
        for (std::size_t light = 0; light < all.masks.size(); ++light) {
            for (std::size_t sample = 0; sample < samples; ++sample) {
                EXPECT_EQ(differing_bytes(picture.masks[light][sample], all.masks[light][sample]),
                          0U)
                    << "light " << light << ", sample " << sample;
            }
        }
    }

    static void expect_truth(const Setting& setting, const Picture& picture) {
        const Traced traced = trace_lights(setting);
        for (std::size_t light = 0; light < traced.size(); ++light) {
            const truth::Judgement judgement =
                truth::judge(traced[light][0], picture.masks[light][0]);
            EXPECT_GT(judgement.shadowed, 0U);
            EXPECT_GT(judgement.lit, 0U);
            EXPECT_EQ(judgement.wrong(), 0U) << "light " << light;
        }
    }

    TestDevice* reference_ = nullptr;
    std::unique_ptr<TestDevice> device_;
};

TEST_P(WithoutOne, perspective_masks_are_right) {
    for (const char* name : {"eye_inside_a_volume", "mirrored_and_sheared", "hidden_caster"}) {
        SCOPED_TRACE(name);
        expect_right(row_named(name).make());
    }
}

TEST_P(WithoutOne, depth_fail_under_a_far_plane_is_right_or_refused) {
    const Setting setting = row_named("orthographic_near_plane_in_a_volume").make();
    if (has().unclipped_depth) {
        expect_right(setting);
        return;
    }
    const auto refused = take_picture(device_->device, setting, options());
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::Unsupported);
    EXPECT_THAT(refused.error().message, HasSubstr("lacks unclipped depth"));
}

TEST_P(WithoutOne, depth_pass_under_a_far_plane_is_right) {
    const Setting setting = orthographic_by_depth_pass();
    if (has().unclipped_depth) {
        expect_right(setting);
        return;
    }
    // The scene is clipped now, which gives other bits to its edges.
    const Picture picture = must(take_picture(device_->device, setting, options()));
    ASSERT_EQ(picture.list.stats.zfail_pairs, 0U) << "this scene should not need depth-fail";
    expect_truth(setting, picture);
}

TEST_P(WithoutOne, four_samples_are_right_or_refused) {
    const Setting setting = row_named("eye_inside_a_volume").make();
    if (has().multisample_4 && has().sampled_stencil && has().depth32float_stencil8) {
        expect_right(setting, 4);
        return;
    }
    const auto refused = take_picture(device_->device, setting, options(4));
    if (has().multisample_4 && has().sampled_stencil) {
        EXPECT_TRUE(refused) << refused.error().message;
        return;
    }
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message,
                HasSubstr(has().multisample_4 ? "sampled_stencil" : "multisample_4"));
}

TEST_P(WithoutOne, a_missing_depth_format_is_refused) {
    for (const auto& [has_it, format, name] :
         {std::tuple(has().depth32float_stencil8, gpu::Format::Depth32FloatStencil8,
                     "Depth32FloatStencil8"),
          std::tuple(has().depth24unorm_stencil8, gpu::Format::Depth24UnormStencil8,
                     "Depth24UnormStencil8")}) {
        const auto picture = take_picture(device_->device, row_named("hidden_caster").make(),
                                          {.depth_stencil_format = format});
        EXPECT_EQ(picture.has_value(), has_it);
        if (!picture) {
            EXPECT_THAT(picture.error().message, HasSubstr(name));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Capabilities, WithoutOne, testing::ValuesIn(crippled_devices()),
                         device_case_name);

}  // namespace
}  // namespace gnomon::test
