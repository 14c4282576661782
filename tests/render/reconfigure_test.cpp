// SPDX-License-Identifier: MIT
//
// A renderer that was reconfigured draws what one draws that was created so.
#include <gnomon/render/renderer.hpp>

#include <gtest/gtest.h>

#include <gnomon/scene/shadow_adapter.hpp>

#include "tests/rows/picture.hpp"
#include "tests/rows/rows.hpp"
#include "tests/support/devices.hpp"

namespace gnomon::test {
namespace {

class Reconfigured : public DeviceTest {
protected:
    std::vector<std::byte> draw(render::Renderer& renderer) {
        const Status rendered = renderer.render({setting_.scene, setting_.view, list_});
        EXPECT_TRUE(rendered) << rendered.error().message;
        return must(device().read_texture(renderer.picture()));
    }
    render::Renderer make(const render::RendererDesc& desc) {
        render::Renderer renderer = must(render::Renderer::create(device(), desc));
        must(renderer.upload(setting_.scene));
        return renderer;
    }
    void SetUp() override {
        DeviceTest::SetUp();
        if (IsSkipped()) return;
        setting_ = std::ranges::find(rows(), std::string_view("hidden_caster"), &Row::name)->make();
        auto system = shadows::ShadowSystem::create();
        scene::ShadowAdapter adapter;
        auto frame = system->begin_frame();
        must(adapter.submit(setting_.scene, frame));
        list_ = std::move(frame).finish(setting_.view);
    }

    Setting setting_;
    shadows::DrawList list_;
};

constexpr render::RendererDesc plain{.width = row_width, .height = row_height};

TEST_P(Reconfigured, draws_as_if_created_so) {
    std::vector<render::RendererDesc> descs(5, plain);
    descs[0].width = row_width * 2;
    descs[0].height = row_height + 10;
    descs[1].overlays = {.volumes = true, .silhouettes = true, .caps = true};
    descs[2].overlays = {.wireframe = true, .count = true, .fill = true};
    descs[3].cull_back_faces = true;
    if (features().multisample_4) descs[4].sample_count = 4;
    render::Renderer renderer = make(plain);
    const auto before = draw(renderer);
    for (const render::RendererDesc& desc : descs) {
        must(renderer.reconfigure(desc));
        EXPECT_EQ(renderer.desc(), desc);
        render::Renderer fresh = make(desc);
        const auto expected = draw(fresh);
        EXPECT_EQ(draw(renderer), expected) << "description " << &desc - descs.data();
        EXPECT_EQ(draw(renderer), expected) << "again";
        if (desc.overlays.any()) {
            EXPECT_NE(expected, before);
        }
    }
    must(renderer.reconfigure(plain));
    EXPECT_EQ(draw(renderer), before);
}

TEST_P(Reconfigured, keeps_the_scene_on_the_device) {
    render::Renderer renderer = make(plain);
    draw(renderer);
    const gpu::DeviceCounters before = device().counters();
    must(renderer.reconfigure(plain));
    EXPECT_EQ(device().counters().uploaded_bytes, before.uploaded_bytes);
    render::RendererDesc larger = plain;
    larger.width += 16;
    must(renderer.reconfigure(larger));
    EXPECT_EQ(device().counters().uploaded_bytes, before.uploaded_bytes);
    EXPECT_EQ(device().counters().objects_alive, before.objects_alive);
    larger.overlays.volumes = true;
    must(renderer.reconfigure(larger));
    draw(renderer);
    const std::uint64_t uploaded = device().counters().uploaded_bytes;
    render::Renderer fresh = make(larger);
    draw(fresh);
    EXPECT_LT(uploaded - before.uploaded_bytes, device().counters().uploaded_bytes - uploaded);
}

TEST_P(Reconfigured, has_no_fill_to_measure_before_it_draws_again) {
    render::RendererDesc desc = plain;
    desc.meter_fill = true;
    render::Renderer renderer = make(desc);
    draw(renderer);
    const auto before = must(renderer.measure_fill());
    ASSERT_FALSE(before.empty());
    for (const bool culls : {true, false}) {
        desc.cull_back_faces = culls;
        must(renderer.reconfigure(desc));
        EXPECT_TRUE(must(renderer.measure_fill()).empty());
    }
    draw(renderer);
    EXPECT_EQ(must(renderer.measure_fill()).size(), before.size());
}

INSTANTIATE_TEST_SUITE_P(Devices, Reconfigured, testing::ValuesIn(drawing_devices()),
                         device_case_name);

}  // namespace
}  // namespace gnomon::test
