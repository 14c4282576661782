// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gnomon/panel/light_table.hpp>

#include <string>

#include <imgui.h>
#include <gnomon/scene/transforms.hpp>
#include <gnomon/ui/context.hpp>

#include <glm/gtc/quaternion.hpp>

namespace gnomon::panel {
namespace {

using testing::ElementsAre;

class Lights : public testing::Test {
protected:
    template <class Light>
    scene::Entity add(const std::string& name, Light light, const glm::dvec3& at = {}) {
        const scene::Entity node = scene.create_node(name, {.translation = at});
        scene.registry.emplace<Light>(node, std::move(light));
        return node;
    }
    static std::vector<std::string> names(const std::vector<LightLine>& lights) {
        std::vector<std::string> all;
        for (const LightLine& light : lights) all.push_back(light.name);
        return all;
    }
    scene::Scene scene;
};

TEST_F(Lights, have_names_that_tell_them_apart) {
    add("", scene::SpotLight{});
    add("by hand", scene::PointLight{});
    add("hall", scene::PointLight{});
    add("hall", scene::SpotLight{});
    add("two\nlines", scene::PointLight{});
    add("", scene::DirectionalLight{});
    add("by hand", scene::DirectionalLight{});
    EXPECT_THAT(names(lights_of(scene, "by hand")),
                ElementsAre("sun", "sun 2", "lamp", "hall", "two lines", "lamp 2", "hall 2"));
}

TEST_F(Lights, that_are_off_are_in_no_list_of_those_that_shine) {
    add("sun", scene::DirectionalLight{});
    add("one", scene::PointLight{});
    add("two", scene::PointLight{});
    std::vector<LightLine> lights = lights_of(scene);
    EXPECT_EQ(switched(lights), SwitchedLights{});
    lights[0].on = false;
    lights[0].casts = false;
    lights[2].casts = false;
    const SwitchedLights found = switched(lights);
    EXPECT_THAT(found.off, ElementsAre(lights[0].entity));
    EXPECT_THAT(found.unshadowed, ElementsAre(lights[2].entity));
}

TEST_F(Lights, have_handles_where_they_are_and_suns_outside_of_the_scene) {
    const auto lamp = add("lamp", scene::PointLight{.color = {1, 2, 3}}, {4, 5, 6});
    const auto sun = add("sun", scene::DirectionalLight{.color = {3, 2, 1}});
    // It shines along -Z: down.
    scene.registry.get<scene::LocalTransform>(sun).rotation =
        glm::angleAxis(glm::radians(-90.0), glm::dvec3(1, 0, 0));
    scene::update_world_transforms(scene.registry);
    scene::Bounds bounds;
    bounds.include({0, 0, 0});
    bounds.include({2, 0, 0});
    EXPECT_EQ(handle_of(scene.registry, lamp, bounds), glm::dvec3(4, 5, 6));
    const glm::dvec3 above = handle_of(scene.registry, sun, bounds);
    EXPECT_NEAR(glm::distance(above, glm::dvec3(1.0, 1.1, 0.0)), 0.0, 1e-9);
    EXPECT_EQ(color_of_light(scene.registry, lamp), glm::vec3(1, 2, 3));
    EXPECT_EQ(color_of_light(scene.registry, sun), glm::vec3(3, 2, 1));
    EXPECT_TRUE(is_directional(scene.registry, sun));
    EXPECT_FALSE(is_directional(scene.registry, lamp));
}

// Whoever clicks everywhere meets every switch, and each switches its own light.
TEST_F(Lights, are_switched_by_their_boxes_and_clicked_by_their_names) {
    add("one", scene::PointLight{});
    add("two", scene::PointLight{});
    std::vector<LightLine> lights = lights_of(scene);
    ui::Context context{{.fonts = {}}};
    input::Input input;
    std::optional<std::size_t> clicked;
    const auto frame = [&] {
        context.begin_frame(input, {400, 200}, 1.0 / 60.0);
        ImGui::SetNextWindowPos({0, 0});
        ImGui::SetNextWindowSize({400, 200});
        ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoTitleBar);
        if (const auto place = show_lights(lights)) clicked = place;
        ImGui::End();
        static_cast<void>(context.end_frame());
        input.begin_frame();
    };
    std::vector<std::string> met;
    for (double y = 4.0; y < 80.0; y += 6.0) {
        for (double x = 6.0; x < 400.0; x += 12.0) {
            lights = lights_of(scene);
            clicked.reset();
            input.move_cursor({x, y});
            frame();
            frame();
            input.press(input::MouseButton::Left);
            frame();
            input.release(input::MouseButton::Left);
            frame();
            std::string what;
            if (clicked) what = "name " + lights[*clicked].name;
            for (const LightLine& light : lights) {
                if (!light.on) what += "on " + light.name;
                if (!light.casts) what += "shadow " + light.name;
            }
            if (!what.empty() && std::ranges::find(met, what) == met.end()) met.push_back(what);
        }
    }
    EXPECT_THAT(met, testing::UnorderedElementsAre("name one", "on one", "shadow one", "name two",
                                                   "on two", "shadow two"));
}

}  // namespace
}  // namespace gnomon::panel
