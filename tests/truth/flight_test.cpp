// SPDX-License-Identifier: MIT
//
// A camera flies through cities and rooms for 600 frames, past and into shadows, with one shadow
// system that sees all of them and leaves out what cannot be seen. Every twentieth frame is held
// against the truth. A long test (label soak); skipped where the models are not there.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <string_view>

#include <gnomon/render/camera.hpp>
#include <gnomon/scene/gltf.hpp>
#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/scene/transforms.hpp>

#include "tests/rows/picture.hpp"
#include "tests/support/devices.hpp"
#include "tests/support/models.hpp"
#include "tests/truth/traced.hpp"

namespace gnomon::test {
namespace {

constexpr std::uint32_t width = 320;
constexpr std::uint32_t height = 180;
constexpr int frames = 600;
constexpr int judged_every = 20;

// A closed curve through the middle of the scene, low and high, looking ahead and about.
shadows::View view_at(const scene::Bounds& bounds, int frame) {
    const double t = 2.0 * std::numbers::pi * frame / frames;
    const glm::dvec3 center = 0.5 * (bounds.min + bounds.max);
    const glm::dvec3 half = 0.5 * (bounds.max - bounds.min);
    const glm::dvec3 eye = center + half * glm::dvec3(0.7 * std::sin(2.0 * t),
                                                      0.5 * std::sin(3.0 * t), 0.7 * std::cos(t));
    const glm::dvec3 way(std::sin(5.0 * t), -0.35 + 0.3 * std::cos(4.0 * t), std::cos(5.0 * t));
    const scene::Camera camera{
        scene::PerspectiveCamera{.fovy_rad = 0.9, .near_m = 1e-5 * bounds.diagonal()}};
    return render::make_view(camera, render::camera_pose(eye, eye + way, {0.0, 1.0, 0.0}),
                             static_cast<double>(width) / height);
}

// Mesa extrapolates the depth of a far cap's slivers (docs/hard-cases.md, "Limits"); an NVIDIA
// card has none wrong.
std::uint64_t known_limit(std::string_view scene, std::string_view rasteriser) {
    return scene == "kenney-city.glb" && rasteriser == "llvmpipe" ? 1 : 0;
}

class Flight : public testing::TestWithParam<const char*> {};

TEST_P(Flight, has_no_wrong_pixel_outside_the_band) {
    const auto files = model_files();
    const auto file = files.find(GetParam());
    if (file == files.end()) GTEST_SKIP() << GetParam() << " is not in " << models_folder();
    Setting setting{must(scene::load_gltf(file->second)), {}};
    scene::update_world_transforms(setting.scene.registry);
    const scene::Bounds bounds = scene::world_bounds(setting.scene);
    if (setting.scene.registry.count<scene::PointLight>() +
            setting.scene.registry.count<scene::SpotLight>() +
            setting.scene.registry.count<scene::DirectionalLight>() ==
        0) {
        scene::LocalTransform local;
        local.matrix = render::camera_pose({0.0, 0.0, 0.0}, {0.75, -1.0, -0.4}, {0.0, 1.0, 0.0});
        setting.scene.registry.emplace<scene::DirectionalLight>(
            setting.scene.create_node("sun", local));
        scene::update_world_transforms(setting.scene.registry);
    }
    TestDevice* device = must(shared_device(drawing_devices().front()));
    const std::uint64_t limit = known_limit(GetParam(), rasteriser_of(device->device));
    auto system = must(shadows::ShadowSystem::create({.receivers = shadows::Receivers::Submitted}));
    scene::ShadowAdapter adapter;
    truth::Judgement total;
    std::uint64_t hidden = 0;
    std::uint64_t detected = 0;
    for (int frame = 0; frame < frames; ++frame) {
        setting.view = view_at(bounds, frame);
        auto submission = system.begin_frame();
        must(adapter.submit(setting.scene, submission));
        const shadows::DrawList& list = std::move(submission).finish(setting.view);
        hidden += list.stats.pairs_hidden + list.stats.pairs_culled;
        detected += list.stats.pairs_redetected;
        if (frame % judged_every != 0) continue;
        SCOPED_TRACE(frame);
        const Picture picture = must(take_picture(
            device->device, setting,
            {.width = width, .height = height, .mutate = [&](shadows::DrawList& drawn) {
                 drawn = list;
             }}));
        const truth::Judgement judgement =
            judge_lights(trace_lights(setting, {.width = width, .height = height}), picture.masks);
        if (limit == 0) {
            EXPECT_EQ(judgement.wrong(), 0U) << wrong_places(judgement, width);
        }
        total += judgement;
    }
    std::printf(
        "%s: %llu pixels judged, %llu in shadow, %llu wrong; %.1f pairs a frame not drawn, "
        "%llu detections\n",
        GetParam(), static_cast<unsigned long long>(total.judged()),
        static_cast<unsigned long long>(total.shadowed),
        static_cast<unsigned long long>(total.wrong()), static_cast<double>(hidden) / frames,
        static_cast<unsigned long long>(detected));
    EXPECT_GT(total.shadowed, 0U);
    EXPECT_LE(total.wrong(), limit);
    if (limit > 0) {
        EXPECT_GT(total.wrong(), 0U) << "right here: it is no limit any more";
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Flight,
                         testing::Values("kenney-city.glb", "linz-old-town.glb", "godot-room.glb",
                                         "dream-apartment.glb", "duplex-house.glb",
                                         "tps-level-lights.glb", "zdm2-map.glb"),
                         [](const auto& param) {
                             std::string name = param.param;
                             for (char& c : name)
                                 c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                             return name;
                         });

}  // namespace
}  // namespace gnomon::test
