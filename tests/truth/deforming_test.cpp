// SPDX-License-Identifier: MIT
//
// Casters that deform, over time: on every device the shadow of each frame is the traced one of the
// same pose, with one renderer, one shadow system and one adapter from frame to frame. A figure
// that is made here, and models where their folder is (models.hpp).
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include <gnomon/render/camera.hpp>
#include <gnomon/scene/deform.hpp>
#include <gnomon/scene/gltf.hpp>
#include <gnomon/scene/primitives.hpp>
#include <gnomon/scene/scene_description.hpp>
#include <gnomon/scene/shadow_adapter.hpp>
#include <gnomon/scene/transforms.hpp>

#include "tests/rows/picture.hpp"
#include "tests/scene/walking_figure.hpp"
#include "tests/support/devices.hpp"
#include "tests/support/models.hpp"
#include "tests/truth/traced.hpp"

namespace gnomon::test {
namespace {

constexpr double aspect = static_cast<double>(row_width) / row_height;

void pose_at(scene::Scene& scene, double time_s) {
    must(scene::animate(scene, 0, time_s));
    scene::update_world_transforms(scene.registry);
    must(scene::deform(scene));
}

/// The scene on a ground under a sun, seen from three quarters above; lights of its own stay.
Setting on_the_ground(scene::Scene scene) {
    scene::update_world_transforms(scene.registry);
    scene::Bounds bounds = scene::world_bounds(scene);
    const double size = bounds.diagonal();
    if (scene.materials.empty()) scene.materials.emplace_back();
    scene::LocalTransform local;
    local.translation = {bounds.center().x, bounds.min.y, bounds.center().z};
    const scene::Entity ground = scene.create_node("ground", local);
    const auto side = static_cast<float>(4.0 * size);
    scene.registry.emplace<scene::MeshInstance>(
        ground, std::make_shared<const scene::Mesh>(scene::make_plane(side, side, 1, 0)));
    scene.registry.emplace<scene::Receiver>(ground);
    scene::LocalTransform sun;
    sun.matrix = render::camera_pose({0.0, 0.0, 0.0}, {-1.0, -1.3, -0.6}, {0.0, 1.0, 0.0});
    scene.registry.emplace<scene::DirectionalLight>(scene.create_node("sun", sun));
    scene::update_world_transforms(scene.registry);

    scene::Camera camera;
    camera.projection = scene::PerspectiveCamera{.fovy_rad = 0.8, .near_m = 1e-4 * size};
    const glm::dvec3 eye = bounds.center() + glm::dvec3(0.55, 0.5, 0.8) * size * 1.3;
    const glm::dmat4 pose = render::camera_pose(eye, bounds.center(), {0.0, 1.0, 0.0});
    return {std::move(scene), render::make_view(camera, pose, aspect)};
}

/// What goes on from frame to frame on one device.
class Film {
public:
    explicit Film(gpu::Device& device)
        : device_(device),
          renderer_(
              must(render::Renderer::create(device, {.width = row_width, .height = row_height}))),
          system_(must(shadows::ShadowSystem::create())) {}

    std::vector<std::vector<std::uint8_t>> shoot(const Setting& setting) {
        if (!uploaded_) must(renderer_.upload(setting.scene));
        uploaded_ = true;
        auto frame = system_.begin_frame();
        must(adapter_.submit(setting.scene, frame));
        const shadows::DrawList list = std::move(frame).finish(setting.view);
        redetected = list.stats.pairs_redetected;
        std::vector<std::vector<std::uint8_t>> masks;
        const auto after_light = [&](std::size_t) -> Status {
            auto counts = render::read_stencil(device_, renderer_);
            if (!counts) return forward_error(counts);
            masks.emplace_back();
            for (const std::byte count : *counts) {
                masks.back().push_back(std::to_integer<std::uint8_t>(count));
            }
            return {};
        };
        must(renderer_.render({setting.scene, setting.view, list, after_light}));
        return masks;
    }
    std::uint64_t redetected = 0;  ///< of the last frame

private:
    gpu::Device& device_;
    render::Renderer renderer_;
    shadows::ShadowSystem system_;
    scene::ShadowAdapter adapter_;
    bool uploaded_ = false;
};

/// Draws the times one after the other on every device, and judges every frame.
void judge_over_time(Setting setting, const std::vector<double>& times_s) {
    std::vector<std::pair<std::string, Film>> films;
    for (const DeviceCase& device_case : drawing_devices()) {
        const auto device = shared_device(device_case);
        if (device) films.emplace_back(device_case.name, (*device)->device);
    }
    if (films.empty()) GTEST_SKIP() << "no device that draws";
    for (const double time_s : times_s) {
        pose_at(setting.scene, time_s);
        const Traced traced = trace_lights(setting);
        for (auto& [name, film] : films) {
            SCOPED_TRACE(name + " at " + std::to_string(time_s) + " s");
            const auto masks = film.shoot(setting);
            const truth::Judgement judged = judge_lights(traced, masks);
            EXPECT_EQ(judged.wrong(), 0U) << wrong_places(judged, row_width);
            EXPECT_GT(judged.shadowed, 200U);
            EXPECT_GT(film.redetected, 0U);
            // Nothing moved: nothing is detected, and the picture is the same.
            EXPECT_EQ(film.shoot(setting), masks);
            EXPECT_EQ(film.redetected, 0U);
        }
    }
}

TEST(Deforming, a_walking_figure_casts_its_shadow_in_every_frame) {
    auto scene = must(scene::test::walking_figure().load());
    judge_over_time(on_the_ground(std::move(scene)), {0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95});
}

TEST(Deforming, a_figure_far_from_the_origin_casts_the_same_shadow) {
    auto file = scene::test::walking_figure();
    const std::size_t root =
        file.node({{"name", "far"}, {"translation", {2e5, -1e5, 3e5}}, {"children", {0}}});
    file.json["scenes"][0]["nodes"][0] = root;
    judge_over_time(on_the_ground(must(file.load())), {0.1, 0.45, 0.7});
}

// The picture of docs/images/walking_figure.png, at these times.
TEST(Deforming, the_walkers_of_the_built_in_scene_cast_their_shadows) {
    scene::Scene scene = must(scene::make_builtin_scene("walk"));
    shadows::View view;
    scene.registry.each<scene::Camera, scene::WorldTransform>(
        [&](scene::Entity, const scene::Camera&, const scene::WorldTransform& at) {
            // Wider than the picture's, whose width is more than twice its height.
            const scene::Camera camera{scene::PerspectiveCamera{.fovy_rad = 0.56, .near_m = 0.02}};
            view = render::make_view(camera, at.world_from_local, aspect);
        });
    judge_over_time({std::move(scene), view}, {0.0, 0.6});
}

TEST(Deforming, the_pose_of_another_time_is_found_wrong) {
    Setting setting = on_the_ground(must(scene::test::walking_figure().load()));
    pose_at(setting.scene, 0.1);
    const Traced traced = trace_lights(setting);
    pose_at(setting.scene, 0.13);
    for (const DeviceCase& device_case : drawing_devices()) {
        const auto device = shared_device(device_case);
        if (!device) continue;
        Film film((*device)->device);
        EXPECT_GT(judge_lights(traced, film.shoot(setting)).wrong(), 0U) << device_case.name;
    }
}

struct AnimatedModel {
    const char* file;
    std::vector<double> shares;  // of the animation's duration
};

class AnimatedModels : public testing::TestWithParam<AnimatedModel> {};

TEST_P(AnimatedModels, cast_their_shadow_in_every_frame) {
    const auto files = model_files();
    const auto found = files.find(GetParam().file);
    if (found == files.end()) GTEST_SKIP() << "no model " << GetParam().file;
    scene::Scene scene = must(scene::load_gltf(found->second));
    ASSERT_FALSE(scene.animations.empty());
    std::vector<double> times_s;
    for (const double share : GetParam().shares) {
        times_s.push_back(share * scene.animations[0].duration_s);
    }
    pose_at(scene, times_s.front());
    judge_over_time(on_the_ground(std::move(scene)), times_s);
}

const std::vector<double> shares{0.11, 0.37, 0.71};
INSTANTIATE_TEST_SUITE_P(All, AnimatedModels,
                         testing::Values(AnimatedModel{"cesium-man.glb", shares},
                                         AnimatedModel{"fox.glb", shares},
                                         AnimatedModel{"rigged-figure.glb", shares},
                                         AnimatedModel{"morph-stress-test.glb", shares},
                                         AnimatedModel{"kaykit-knight.glb", shares},
                                         AnimatedModel{"robot.glb", shares},
                                         AnimatedModel{"box-animated.glb", shares}),
                         [](const testing::TestParamInfo<AnimatedModel>& info) {
                             std::string name = info.param.file;
                             name.resize(name.size() - 4);
                             for (char& c : name) c = c == '-' ? '_' : c;
                             return name;
                         });

}  // namespace
}  // namespace gnomon::test
