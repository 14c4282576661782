// SPDX-License-Identifier: MIT
#include <gnomon/render/light_choice.hpp>

#include <gtest/gtest.h>

#include <string>

#include <gnomon/scene/transforms.hpp>

namespace gnomon::render {
namespace {

class LightChoiceTest : public testing::Test {
protected:
    LightChoiceTest() {
        bounds_.include(glm::dvec3(-10, 0, -10));
        bounds_.include(glm::dvec3(10, 5, 10));
        look({0, 2, 20}, {0, 2, 0});
    }
    void look(const glm::dvec3& eye, const glm::dvec3& target) {
        view_.view_from_world = shadows::look_at(eye, target, {0, 1, 0});
        view_.clip_from_view = shadows::infinite_perspective(0.8, 1.5, 0.01);
    }
    scene::Entity lamp(const glm::dvec3& at, float candela,
                       std::optional<double> range_m = std::nullopt,
                       const glm::vec3& color = glm::vec3(1.0F)) {
        scene::LocalTransform local;
        local.translation = at;
        const scene::Entity entity = scene_.create_node("lamp", local);
        scene_.registry.emplace<scene::PointLight>(entity, color, candela, range_m);
        return entity;
    }
    scene::Entity sun(float lux) {
        const scene::Entity entity = scene_.create_node("sun", scene::LocalTransform{});
        scene_.registry.emplace<scene::DirectionalLight>(entity, glm::vec3(1.0F), lux);
        return entity;
    }
    LightChoice choose(std::size_t most) {
        scene::update_world_transforms(scene_.registry);
        return choose_shadowed_lights(scene_, bounds_, view_, most);
    }
    using Entities = std::vector<scene::Entity>;

    scene::Scene scene_;
    scene::Bounds bounds_;
    shadows::View view_;
};

TEST_F(LightChoiceTest, the_nearer_to_what_is_looked_at_and_the_stronger_first) {
    const auto far = lamp({9, 4, 0}, 100);
    const auto near = lamp({1, 3, 0}, 100);
    const auto strong = lamp({9, 4, 3}, 10000);
    EXPECT_EQ(choose(1).shadowed, Entities{strong});
    EXPECT_EQ(choose(2).shadowed, (Entities{near, strong})) << "in the scene's order";
    EXPECT_EQ(choose(2).unshadowed, Entities{far});
    EXPECT_TRUE(choose(0).shadowed.empty());
    EXPECT_EQ(choose(0).unshadowed.size(), 3U);
    EXPECT_TRUE(choose(7).unshadowed.empty());
}

TEST_F(LightChoiceTest, follows_the_view) {
    const auto left = lamp({-8, 3, 0}, 100);
    const auto right = lamp({8, 3, 0}, 100);
    look({-8, 2, 20}, {-8, 2, 0});
    EXPECT_EQ(choose(1).shadowed, Entities{left});
    look({8, 2, 20}, {8, 2, 0});
    EXPECT_EQ(choose(1).shadowed, Entities{right});
    look({0, 2, 20}, {0, 2, 0});
    EXPECT_EQ(choose(1).shadowed, Entities{left}) << "of equals the earlier one";
    look({0, 50, 20}, {0, 60, -50});  // past everything: the middle of the bounds counts
    EXPECT_EQ(choose(1).shadowed, Entities{left});
}

TEST_F(LightChoiceTest, a_light_out_of_range_comes_last) {
    const auto out = lamp({9, 4, 0}, 1e6F, 5.0);
    const auto weak = lamp({9, 4, 1}, 0.01F);
    EXPECT_EQ(choose(1).shadowed, Entities{weak});
    EXPECT_EQ(choose(1).unshadowed, Entities{out});
}

TEST_F(LightChoiceTest, compares_lamps_and_suns_in_lux_and_by_luminance) {
    const auto green = lamp({1, 2, 0}, 1000, std::nullopt, {0, 1, 0});
    const auto blue = lamp({1, 2, 0.5}, 1000, std::nullopt, {0, 0, 1});
    const auto day = sun(100);  // between 715 and 72 lux
    EXPECT_EQ(choose(1).shadowed, Entities{green});
    EXPECT_EQ(choose(2).shadowed, (Entities{green, day}));
    EXPECT_EQ(choose(2).unshadowed, Entities{blue});
}

TEST_F(LightChoiceTest, a_light_that_is_off_is_in_neither_list) {
    const auto far = lamp({9, 4, 0}, 100);
    const auto near = lamp({1, 3, 0}, 100);
    const auto strong = lamp({9, 4, 3}, 10000);
    scene::update_world_transforms(scene_.registry);
    const Entities off{strong};
    const LightChoice choice = choose_shadowed_lights(scene_, bounds_, view_, 1, off);
    EXPECT_EQ(choice.shadowed, Entities{near});
    EXPECT_EQ(choice.unshadowed, Entities{far});
}

}  // namespace
}  // namespace gnomon::render
