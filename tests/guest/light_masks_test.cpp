// SPDX-License-Identifier: MIT
//
// Light masks on every device: they say, bit by bit and sample by sample, what the stencil says
// after each light, and say the same on all devices with one rasteriser. What cannot be is refused.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gnomon/render/renderer.hpp>
#include <gnomon/scene/primitives.hpp>
#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/shadow_pass/light_masks.hpp>
#include <gnomon_shaders/conformance.hpp>

#include "tests/conformance/reading_shader.hpp"
#include "tests/rows/rows.hpp"
#include "tests/rows/stage.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::test {
namespace {

using shadow_pass::GuestPassDesc;
using shadow_pass::LightMasks;
using testing::HasSubstr;

constexpr std::uint32_t width = 96;
constexpr std::uint32_t height = 72;
constexpr std::size_t pixels = std::size_t{width} * height;
// Of the renderer's own passes.
constexpr shadows::HostConventions conventions{shadows::HostDepth::ZeroToOne, true,
                                               shadows::HostRows::FromOne};

using Words = std::vector<std::uint32_t>;

// More lights than masks have bits, no two shadows alike.
Setting many_lights(std::size_t count) {
    Stage s;
    s.ground();
    s.place(shared(scene::make_torus(1.0F, 0.4F, 16, 8)), moved({0.0, 1.2, 0.0}));
    s.place(shared(scene::make_box(glm::vec3(0.7F))), moved({1.7, 0.6, 0.4}));
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = 2.4 * static_cast<double>(i);
        s.lamp({(1.0 + 0.08 * static_cast<double>(i)) * std::cos(angle), 4.0,
                (1.0 + 0.08 * static_cast<double>(i)) * std::sin(angle)});
    }
    s.look({0.5, 4.0, 5.0}, {0.0, 0.6, 0.0});
    return s.finish();
}

// A scene's depth on a device, its volumes, and the stencil after each light as gnomon's own
// renderer has it: [light][sample].
struct Drawn {
    Setting setting;
    render::Renderer renderer;
    shadows::DrawList list;
    std::vector<std::vector<std::vector<std::byte>>> stencils;

    [[nodiscard]] shadows::HostView view() const {
        return {setting.view, setting.view, conventions};
    }
    [[nodiscard]] GuestPassDesc host() const {
        const render::RendererDesc& desc = renderer.desc();
        return {.target = renderer.depth_stencil(),
                .size = {desc.width, desc.height},
                .format = desc.depth_stencil_format,
                .sample_count = desc.sample_count,
                .conventions = conventions,
                .cap_bias = {}};
    }
};

Drawn draw(gpu::Device& device, Setting setting, std::uint32_t samples,
           std::uint32_t max_layers = 255) {
    auto renderer = must(render::Renderer::create(
        device, {.width = width, .height = height, .sample_count = samples}));
    must(renderer.upload(setting.scene));
    auto system = must(shadows::ShadowSystem::create({.max_layers = max_layers}));
    auto frame = system.begin_frame();
    scene::ShadowAdapter adapter;
    must(adapter.submit(setting.scene, frame));
    shadows::DrawList list = std::move(frame).finish(setting.view);
    std::vector<std::vector<std::vector<std::byte>>> stencils;
    const auto after_light = [&](std::size_t) -> Status {
        auto& of_light = stencils.emplace_back();
        for (std::uint32_t s = 0; s < samples; ++s) {
            auto counts = render::read_stencil(device, renderer, s);
            if (!counts) return forward_error(counts);
            of_light.push_back(std::move(*counts));
        }
        return {};
    };
    must(renderer.render({setting.scene, setting.view, list, after_light}));
    return {std::move(setting), std::move(renderer), std::move(list), std::move(stencils)};
}

gpu::Texture mask_texture(gpu::Device& device, gpu::Format format, std::uint32_t samples = 1) {
    gpu::TextureDesc desc{
        .label = "mask",
        .width = width,
        .height = height,
        .format = format,
        .usage = gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::TextureBinding,
        .sample_count = samples};
    if (samples == 1) desc.usage = desc.usage | gpu::TextureUsage::CopySrc;
    return must(device.create_texture(desc));
}

Words words_of(const std::vector<std::byte>& bytes) {
    Words words(bytes.size() / sizeof(std::uint32_t));
    std::memcpy(words.data(), bytes.data(), bytes.size());
    return words;
}

// One sample's bits.
Words read_bits(gpu::Device& device, gpu::TextureId mask, std::uint32_t samples,
                std::uint32_t sample) {
    if (samples == 1) return words_of(must(device.read_texture(mask)));
    return words_of(conformance::read_by_shader(
        device, {.fragment = conformance::shaders::fetch_uint_ms_frag,
                 .textures = {{.texture = mask,
                               .sample_type = gpu::SampleType::Uint,
                               .multisampled = true}},
                 .block = std::array<std::int32_t, 4>{static_cast<std::int32_t>(sample), 0, 0, 0},
                 .target_format = gpu::Format::R32Uint,
                 .width = width,
                 .height = height}));
}

// Of lights first to first + count - 1 of what was drawn.
Words expected_bits(const Drawn& drawn, std::uint32_t sample, std::size_t first = 0,
                    std::size_t count = LightMasks::max_lights) {
    Words words(pixels, 0);
    for (std::size_t l = first; l < std::min(first + count, drawn.stencils.size()); ++l) {
        for (std::size_t i = 0; i < pixels; ++i) {
            if (drawn.stencils[l][sample][i] != std::byte{0}) words[i] |= 1U << (l - first);
        }
    }
    return words;
}

std::size_t differing(const Words& a, const Words& b) {
    std::size_t count = a.size() == b.size() ? 0 : pixels;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) count += a[i] != b[i] ? 1 : 0;
    return count;
}

std::size_t shadowed_in(const Words& words) {
    std::size_t count = 0;
    for (const std::uint32_t word : words) count += word != 0 ? 1 : 0;
    return count;
}

Setting still_life() { return rows().front().make(); }

class LightMasksOnDevice : public DeviceTest {
protected:
    void expect_bits(Setting setting, std::uint32_t samples, std::uint32_t max_layers) {
        const Drawn drawn = draw(device(), std::move(setting), samples, max_layers);
        const gpu::Texture mask = mask_texture(device(), gpu::Format::R32Uint, samples);
        auto masks = must(LightMasks::create(device(), {.host = drawn.host(), .masks = {mask}}));
        must(masks.prepare(drawn.list, drawn.view()));
        must(masks.resolve());
        must(masks.resolve());  // what was recorded is submitted again
        // By rasteriser: what the first device said.
        static std::map<std::string, Words> first;
        for (std::uint32_t s = 0; s < samples; ++s) {
            const Words bits = read_bits(device(), mask, samples, s);
            EXPECT_EQ(differing(bits, expected_bits(drawn, s)), 0U) << "sample " << s;
            EXPECT_GT(shadowed_in(bits), pixels / 20);
            // By two passes single slivers are lost (docs/backends.md).
            const bool two_pass = device().caps().stencil_path == "two-pass";
            const std::string key = rasteriser_of(device()) + (two_pass ? " two-pass " : " ") +
                                    std::to_string(samples) + " " + std::to_string(s) + " " +
                                    std::to_string(max_layers);
            const auto [found, added] = first.emplace(key, bits);
            EXPECT_EQ(differing(bits, found->second), 0U) << "sample " << s;
        }
        // The next light begins with a stencil of 0, and so may the host.
        for (std::uint32_t s = 0; s < samples; ++s) {
            EXPECT_THAT(must(render::read_stencil(device(), drawn.renderer, s)),
                        testing::Each(std::byte{0}));
        }
    }
};

TEST_P(LightMasksOnDevice, bits_are_the_stencils) { expect_bits(still_life(), 1, 255); }

TEST_P(LightMasksOnDevice, bits_of_samples_are_the_samples_stencils) {
    if (!features().multisample_4) GTEST_SKIP() << "The adapter has no four samples.";
    if (!features().multisample_32bit) GTEST_SKIP() << "Its integers have no four samples.";
    expect_bits(still_life(), 4, 255);
}

TEST_P(LightMasksOnDevice, lights_in_batches_have_bits_as_well) {
    expect_bits(many_lights(2), 1, 1);
}

TEST_P(LightMasksOnDevice, every_bit_is_another_lights) {
    const Drawn drawn = draw(device(), many_lights(LightMasks::max_lights), 1);
    ASSERT_EQ(drawn.list.lights.size(), LightMasks::max_lights);
    const gpu::Texture mask = mask_texture(device(), gpu::Format::R32Uint);
    auto masks = must(LightMasks::create(device(), {.host = drawn.host(), .masks = {mask}}));
    must(masks.prepare(drawn.list, drawn.view()));
    must(masks.resolve());
    const Words bits = read_bits(device(), mask, 1, 0);
    EXPECT_EQ(differing(bits, expected_bits(drawn, 0)), 0U);
    std::uint32_t ever = 0;
    for (const std::uint32_t word : bits) ever |= word;
    EXPECT_EQ(ever, 0xFFFFFFFFU);
}

TEST_P(LightMasksOnDevice, more_lights_are_refused_at_once_and_come_in_rounds) {
    const Drawn drawn = draw(device(), many_lights(40), 1);
    const gpu::Texture mask = mask_texture(device(), gpu::Format::R32Uint);
    auto masks = must(LightMasks::create(device(), {.host = drawn.host(), .masks = {mask}}));
    must(masks.prepare(drawn.list, drawn.view()));
    const Status refused = masks.resolve();
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message,
              "There are 40 lights, but a light mask has bits for 32: resolve them in rounds, and "
              "shade after each.");
    must(masks.resolve(0, 32));
    EXPECT_EQ(differing(read_bits(device(), mask, 1, 0), expected_bits(drawn, 0, 0, 32)), 0U);
    must(masks.resolve(32, 8));
    EXPECT_EQ(differing(read_bits(device(), mask, 1, 0), expected_bits(drawn, 0, 32, 8)), 0U);
}

TEST_P(LightMasksOnDevice, bytes_are_the_shares_of_samples_in_shadow) {
    const std::uint32_t most = features().multisample_4 ? 4 : 1;
    for (std::uint32_t samples = 1; samples <= most; samples += 3) {
        const Drawn drawn = draw(device(), still_life(), samples);
        // One more than there are lights: of no light.
        std::vector<gpu::Texture> textures;
        std::vector<gpu::TextureId> ids;
        for (std::size_t i = 0; i <= drawn.list.lights.size(); ++i) {
            textures.push_back(mask_texture(device(), gpu::Format::R8Unorm));
            ids.push_back(textures.back());
        }
        auto masks = must(LightMasks::create(device(), {.host = drawn.host(), .masks = ids}));
        must(masks.prepare(drawn.list, drawn.view()));
        must(masks.resolve());
        for (std::size_t l = 0; l < drawn.list.lights.size(); ++l) {
            const auto bytes = must(device().read_texture(ids[l]));
            std::size_t wrong = 0;
            std::size_t partly = 0;
            for (std::size_t i = 0; i < pixels; ++i) {
                int in_shadow = 0;
                for (std::uint32_t s = 0; s < samples; ++s) {
                    in_shadow += drawn.stencils[l][s][i] != std::byte{0} ? 1 : 0;
                }
                const double share = in_shadow / static_cast<double>(samples);
                const double said = std::to_integer<int>(bytes[i]) / 255.0;
                wrong += std::abs(share - said) > 0.5001 / 255.0 + 1e-3 ? 1 : 0;
                partly += share > 0.0 && share < 1.0 ? 1 : 0;
            }
            EXPECT_EQ(wrong, 0U) << "light " << l << ", " << samples << " samples";
            EXPECT_GE(partly, samples == 4 ? 20U : 0U);
        }
        EXPECT_THAT(must(device().read_texture(ids.back())), testing::Each(std::byte{0}));
    }
}

TEST_P(LightMasksOnDevice, each_refusal_says_what_to_change) {
    const Drawn drawn = draw(device(), still_life(), 1);
    const auto answer = [&](const std::vector<gpu::TextureId>& ids, GuestPassDesc host) {
        const auto made = LightMasks::create(device(), {.host = host, .masks = ids});
        return made ? std::string("made") : made.error().message;
    };
    const gpu::Texture bits = mask_texture(device(), gpu::Format::R32Uint);
    const gpu::Texture byte = mask_texture(device(), gpu::Format::R8Unorm);
    const gpu::Texture wrong = mask_texture(device(), gpu::Format::Rgba8Unorm);
    const gpu::Texture small =
        must(device().create_texture({.label = "small",
                                      .width = 17,
                                      .height = height,
                                      .format = gpu::Format::R32Uint,
                                      .usage = gpu::TextureUsage::RenderAttachment}));
    const GuestPassDesc host = drawn.host();
    EXPECT_EQ(answer({bits}, host), "made");
    EXPECT_THAT(answer({}, host), HasSubstr("have no texture to go to: name one of R32Uint, or"));
    EXPECT_THAT(answer({wrong}, host),
                HasSubstr("[Texture \"mask\"] is neither R32Uint, a bit a light, nor R8Unorm"));
    EXPECT_THAT(answer({small}, host),
                HasSubstr("[Texture \"small\"] has 17 x 72 pixels, but the depth 96 x 72 pixels"));
    EXPECT_THAT(answer({byte, byte}, host), HasSubstr("is named for two lights"));
    EXPECT_THAT(answer({byte, bits}, host),
                HasSubstr("has bits for 32 lights, but is one of 2 textures"));
    EXPECT_THAT(answer(std::vector<gpu::TextureId>(33, byte), host),
                HasSubstr("There are 33 textures for light masks, of which 32 are written"));
    EXPECT_THAT(answer({gpu::TextureId{.index = 4711, .generation = 1}}, host),
                HasSubstr("The texture of light mask 0 was freed"));
    GuestPassDesc nowhere = host;
    nowhere.target = {};
    EXPECT_THAT(answer({bits}, nowhere), HasSubstr("There is no target for the light masks"));
    GuestPassDesc wrong_depth = host;
    wrong_depth.conventions.depth = shadows::HostDepth::MinusOneToOne;
    EXPECT_THAT(answer({bits}, wrong_depth), HasSubstr("set it to ZeroToOne"));
    if (device().caps().backend == "webgpu") {
        GuestPassDesc wrong_rows = host;
        wrong_rows.conventions.rows = shadows::HostRows::FromMinusOne;
        EXPECT_THAT(answer({bits}, wrong_rows), HasSubstr("set it to FromOne"));
    }

    auto few = must(LightMasks::create(device(), {.host = host, .masks = {byte}}));
    must(few.prepare(drawn.list, drawn.view()));
    EXPECT_THAT(few.resolve().error().message,
                HasSubstr("There are 2 lights, but textures for the masks of 1"));
    const gpu::Texture only_read =
        must(device().create_texture({.label = "only read",
                                      .width = width,
                                      .height = height,
                                      .format = gpu::Format::R32Uint,
                                      .usage = gpu::TextureUsage::TextureBinding}));
    EXPECT_THAT(answer({only_read}, host),
                HasSubstr("[Texture \"only read\"] cannot be drawn to: make it with "
                          "TextureUsage::RenderAttachment"));
    shadows::HostView view = drawn.view();
    view.conventions.reversed = false;
    EXPECT_THAT(few.prepare(drawn.list, view).error().message,
                HasSubstr("not those of the light masks"));
    if (!features().multisample_4) return;
    const Drawn of_four = draw(device(), still_life(), 4);
    if (features().multisample_32bit) {
        const gpu::Texture four = mask_texture(device(), gpu::Format::R32Uint, 4);
        EXPECT_THAT(answer({four}, host),
                    HasSubstr("has 4 samples, but the depth 1 sample: give the mask as many"));
        EXPECT_EQ(answer({four}, of_four.host()), "made");
    }
    EXPECT_THAT(answer({bits}, of_four.host()),
                HasSubstr("has 1 sample, but the depth 4 samples: give the mask as many, for bits "
                          "of each, or name a texture of R8Unorm and one sample for each light"));
}

TEST_P(LightMasksOnDevice, lights_that_no_list_has_are_refused) {
    const Drawn drawn = draw(device(), still_life(), 1);
    ASSERT_EQ(drawn.list.lights.size(), 2U);
    const gpu::Texture mask = mask_texture(device(), gpu::Format::R32Uint);
    auto masks = must(LightMasks::create(device(), {.host = drawn.host(), .masks = {mask}}));
    auto guest = must(shadow_pass::GuestPass::create(device(), drawn.host()));
    const auto said = [](const Status& status) {
        EXPECT_TRUE(status || status.error().code == ErrorCode::InvalidInput);
        return status ? std::string("done") : status.error().message;
    };
    const auto expect_no_list = [&] {
        EXPECT_EQ(said(masks.resolve(0, 1)),
                  "Light 0 cannot be resolved: no list is prepared for the light masks, since "
                  "prepare() was not called or failed. Call it first, and look at what it says.");
        EXPECT_THAT(said(masks.resolve()), HasSubstr("no list is prepared for the light masks"));
        EXPECT_THAT(said(guest.count(0)),
                    HasSubstr("Light 0 cannot be counted: no list is prepared "
                              "for the guest pass, since prepare()"));
    };
    expect_no_list();
    must(masks.prepare(drawn.list, drawn.view()));
    must(guest.prepare(drawn.list, drawn.view()));
    EXPECT_EQ(said(guest.count(1)), "done");
    EXPECT_EQ(said(guest.count(2)),
              "Light 2 cannot be counted: the list that was prepared last for the guest pass has 2 "
              "lights, which count from 0.");
    EXPECT_EQ(said(masks.resolve(2, 0)), "done");
    EXPECT_THAT(said(masks.resolve(1, 2)),
                HasSubstr("2 lights from 1 on cannot be resolved: the list that was prepared "
                          "last for the light masks has 2 lights"));
    EXPECT_THAT(said(masks.resolve(3, static_cast<std::size_t>(-1))), HasSubstr("from 3 on"));
    shadows::HostView wrong = drawn.view();
    wrong.conventions.reversed = false;
    EXPECT_FALSE(masks.prepare(drawn.list, wrong));
    EXPECT_FALSE(guest.prepare(drawn.list, wrong));
    expect_no_list();
}

INSTANTIATE_TEST_SUITE_P(Devices, LightMasksOnDevice, testing::ValuesIn(drawing_devices()),
                         device_case_name);

}  // namespace
}  // namespace gnomon::test
