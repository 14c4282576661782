// SPDX-License-Identifier: MIT
//
// Samplers against values worked out by hand, looping, what animations do to components, and every
// way in which a file's animation can be wrong.
#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include <gnomon/scene/animation.hpp>
#include <gnomon/scene/scene.hpp>

#include "tests/scene/walking_figure.hpp"

namespace gnomon::scene::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<double> value_at(const AnimationSampler& sampler, double time_s,
                             AnimationPath path = AnimationPath::Translation) {
    std::vector<double> value(sampler.width);
    evaluate(sampler, path, time_s, value.data());
    return value;
}

TEST(AnimationSampler, steps_hold_until_the_next_key) {
    const AnimationSampler s{Interpolation::Step, {1, 2, 4}, 1, {10, 20, 40}};
    EXPECT_THAT(value_at(s, 0.0), ElementsAre(10));
    EXPECT_THAT(value_at(s, 1.999), ElementsAre(10));
    EXPECT_THAT(value_at(s, 2.0), ElementsAre(20));
    EXPECT_THAT(value_at(s, 3.999), ElementsAre(20));
    EXPECT_THAT(value_at(s, 4.0), ElementsAre(40));
    EXPECT_THAT(value_at(s, 9.0), ElementsAre(40));
}

TEST(AnimationSampler, lines_meet_their_keys_and_clamp) {
    const AnimationSampler s{Interpolation::Linear, {1, 2, 4}, 2, {0, 0, 8, -4, 8, 4}};
    EXPECT_THAT(value_at(s, 0.0), ElementsAre(0, 0));
    EXPECT_THAT(value_at(s, 1.0), ElementsAre(0, 0));
    EXPECT_THAT(value_at(s, 1.25), ElementsAre(2, -1));
    EXPECT_THAT(value_at(s, 2.0), ElementsAre(8, -4));
    EXPECT_THAT(value_at(s, 3.0), ElementsAre(8, 0));
    EXPECT_THAT(value_at(s, 5.0), ElementsAre(8, 4));
}

TEST(AnimationSampler, rotations_go_the_shorter_way_at_even_speed) {
    // From none to 120 degrees about z, the second key written as its negative.
    const float s60 = std::sqrt(0.75F);
    const AnimationSampler s{Interpolation::Linear, {0, 1}, 4, {0, 0, 0, 1, 0, 0, -s60, -0.5F}};
    for (const double u : {0.25, 0.5, 0.75}) {
        const auto q = value_at(s, u, AnimationPath::Rotation);
        const double half_rad = u * 60.0 * 3.14159265358979 / 180.0;
        EXPECT_NEAR(q[2], std::sin(half_rad), 1e-7);
        EXPECT_NEAR(q[3], std::cos(half_rad), 1e-7);
    }
    // Keys that are not unit come out unit.
    const AnimationSampler loose{Interpolation::Step, {0}, 4, {0, 0, 0, 3}};
    EXPECT_THAT(value_at(loose, 0.0, AnimationPath::Rotation), ElementsAre(0, 0, 0, 1));
}

TEST(AnimationSampler, splines_are_hermite_with_tangents_per_second) {
    // Two seconds apart: value 1 leaving at 3 a second, value 5 arriving at -1 a second.
    const AnimationSampler s{Interpolation::CubicSpline, {1, 3}, 1, {99, 1, 3, -1, 5, 99}};
    EXPECT_THAT(value_at(s, 1.0), ElementsAre(1));
    EXPECT_THAT(value_at(s, 3.0), ElementsAre(5));
    // u = 1/2: (1 + 5) / 2 + 2 * (3 - -1) / 8 = 4.
    EXPECT_NEAR(value_at(s, 2.0)[0], 4.0, 1e-12);
    // u = 1/4: 27/32 * 1 + 2 * 9/64 * 3 + 5/32 * 5 + 2 * -3/64 * -1.
    EXPECT_NEAR(value_at(s, 1.5)[0], 27.0 / 32 + 54.0 / 64 + 25.0 / 32 + 6.0 / 64, 1e-12);
    const AnimationSampler turn{
        Interpolation::CubicSpline, {0, 1}, 4, {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0,  //
                                                0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}};
    const auto half = value_at(turn, 0.5, AnimationPath::Rotation);
    EXPECT_NEAR(half[0], std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(half[3], std::sqrt(0.5), 1e-12);
}

/// A triangle that moves from 0 to (2, 0, 0) in two seconds.
GltfBuilder moving_file() {
    GltfBuilder file = triangle_file();
    const std::vector<float> times{0, 2};
    const std::vector<float> places{0, 0, 0, 2, 0, 0};
    const std::size_t input = file.accessor_of(times, f32, "SCALAR", 1);
    const std::size_t output = file.accessor_of(places, f32, "VEC3", 3);
    file.json["animations"] = Json::array(
        {{{"name", "move"},
          {"samplers", Json::array({{{"input", input}, {"output", output}}})},
          {"channels",
           Json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}})}}});
    return file;
}

TEST(Animation, it_loops_and_stands_at_its_end_at_its_end) {
    auto scene = moving_file().load();
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->animations.size(), 1U);
    EXPECT_EQ(scene->animations[0].name, "move");
    EXPECT_EQ(scene->animations[0].duration_s, 2.0);
    const Entity node = find_entity(*scene, "triangle");
    const auto x_at = [&](double time_s) {
        EXPECT_TRUE(animate(*scene, 0, time_s));
        return scene->registry.get<LocalTransform>(node).translation.x;
    };
    EXPECT_EQ(x_at(0.5), 0.5);
    EXPECT_EQ(x_at(2.0), 2.0);
    EXPECT_EQ(x_at(2.5), 0.5);
    EXPECT_EQ(x_at(4.0), 0.0);
    EXPECT_EQ(x_at(-0.5), 1.5);
    EXPECT_EQ(x_at(1e6 + 1.0), 1.0);
    EXPECT_EQ(x_at(0.0), 0.0);
}

TEST(Animation, what_cannot_be_played_is_named) {
    auto scene = moving_file().load();
    ASSERT_TRUE(scene);
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
        const Status status = animate(*scene, 0, bad);
        ASSERT_FALSE(status);
        EXPECT_EQ(status.error().code, ErrorCode::InvalidInput);
        EXPECT_THAT(status.error().message, HasSubstr("must be finite"));
    }
    EXPECT_THAT(animate(*scene, 1, 0.0).error().message, HasSubstr("the scene has 1"));
    // A target that is gone is passed over.
    scene->registry.destroy(find_entity(*scene, "triangle"));
    EXPECT_TRUE(animate(*scene, 0, 1.0));
}

TEST(Animation, it_is_found_by_name_or_number_once_a_model) {
    Scene scene;
    for (std::uint32_t model = 0; model < 2; ++model) {
        for (std::uint32_t place = 0; place < 3; ++place) {
            Animation animation;
            animation.name = place == 2 && model == 1 ? "1" : std::string("abc").substr(place, 1);
            animation.model = model;
            animation.place = place;
            scene.animations.push_back(animation);
        }
    }
    EXPECT_THAT(find_animations(scene), ElementsAre(0U, 3U));
    EXPECT_THAT(find_animations(scene, "b"), ElementsAre(1U, 4U));
    EXPECT_THAT(find_animations(scene, "2"), ElementsAre(2U, 5U));
    EXPECT_THAT(find_animations(scene, "1"), ElementsAre(1U, 5U));  // names go first
    EXPECT_TRUE(find_animations(scene, "d").empty());
}

TEST(Animation, all_four_paths_are_written) {
    auto scene = walking_figure().load();
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_TRUE(animate(*scene, 0, 0.375));
    const auto& hips = scene->registry.get<LocalTransform>(find_entity(*scene, "hips"));
    EXPECT_NEAR(hips.translation.z, -0.125 * 1.2, 1e-6);
    EXPECT_NEAR(hips.scale.y, 1.05, 1e-6);  // a step
    const auto& thigh = scene->registry.get<LocalTransform>(find_entity(*scene, "left thigh"));
    EXPECT_NEAR(2.0 * std::asin(thigh.rotation.x), -0.3, 1e-6);
    scene->registry.each<MorphWeights>([](Entity, const MorphWeights& weights) {
        EXPECT_THAT(weights.values, ElementsAre(testing::DoubleNear(0.75, 1e-6)));
    });
}

struct BadAnimation {
    const char* name;
    void (*spoil)(GltfBuilder& file);
    std::vector<std::string> parts;
};

template <class T>
void replace_accessor(GltfBuilder& file, const char* member, const std::vector<T>& values,
                      const char* type, std::size_t components) {
    file.json["animations"][0]["samplers"][0][member] =
        file.accessor_of(values, f32, type, components);
}

const float nan = std::numeric_limits<float>::quiet_NaN();

const std::vector<BadAnimation> bad_animations{
    {"count",
     [](GltfBuilder& f) {
         replace_accessor<float>(f, "output", {1, 2, 3}, "VEC3", 3);
     },
     {"animations[0].samplers[0].output", "has 1 elements, but must have 2"}},
    {"spline_count",
     [](GltfBuilder& f) {
         f.json["animations"][0]["samplers"][0]["interpolation"] = "CUBICSPLINE";
     },
     {"has 2 elements, but must have 6"}},
    {"unsorted",
     [](GltfBuilder& f) {
         replace_accessor<float>(f, "input", {1, 0.5F}, "SCALAR", 1);
     },
     {"animations[0].samplers[0]", "time 1", "is 0.5 s", "more than 1"}},
    {"equal_times",
     [](GltfBuilder& f) {
         replace_accessor<float>(f, "input", {1, 1}, "SCALAR", 1);
     },
     {"time 1", "more than 1"}},
    {"negative",
     [](GltfBuilder& f) {
         replace_accessor<float>(f, "input", {-1, 1}, "SCALAR", 1);
     },
     {"time 0", "is -1 s", "not less than 0"}},
    {"nan_time",
     [](GltfBuilder& f) {
         replace_accessor<float>(f, "input", {0, nan}, "SCALAR", 1);
     },
     {"time 1", "must be finite"}},
    {"nan_value",
     [](GltfBuilder& f) {
         replace_accessor<float>(f, "output", {0, 0, 0, 0, nan, 0}, "VEC3", 3);
     },
     {"element 1 of its output", "must be finite"}},
    {"zero_quaternion",
     [](GltfBuilder& f) {
         replace_accessor<float>(f, "output", {0, 0, 0, 1, 0, 0, 0, 0}, "VEC4", 4);
         f.json["animations"][0]["channels"][0]["target"]["path"] = "rotation";
     },
     {"element 1 of its output", "a quaternion of length 1"}},
    {"type",
     [](GltfBuilder& f) { f.json["animations"][0]["channels"][0]["target"]["path"] = "rotation"; },
     {"must be VEC4"}},
    {"interpolation",
     [](GltfBuilder& f) { f.json["animations"][0]["samplers"][0]["interpolation"] = "SPLINE"; },
     {"samplers[0].interpolation is \"SPLINE\""}},
    {"sampler",
     [](GltfBuilder& f) { f.json["animations"][0]["channels"][0]["sampler"] = 1; },
     {"animations[0].channels[0].sampler is 1"}},
    {"node",
     [](GltfBuilder& f) { f.json["animations"][0]["channels"][0]["target"]["node"] = 9; },
     {"target.node is 9"}},
    {"input",
     [](GltfBuilder& f) { f.json["animations"][0]["samplers"][0]["input"] = -1; },
     {"samplers[0].input is -1"}},
    {"weights",
     [](GltfBuilder& f) {
         f.json["animations"][0]["channels"][0]["target"]["path"] = "weights";
         replace_accessor<float>(f, "output", {0, 1}, "SCALAR", 1);
     },
     {"animations[0].channels[0]", "nodes[0] has no morph targets"}},
};

TEST(Animation, what_is_wrong_in_a_file_is_named) {
    for (const BadAnimation& bad : bad_animations) {
        SCOPED_TRACE(bad.name);
        GltfBuilder file = moving_file();
        bad.spoil(file);
        const auto scene = file.load();
        ASSERT_FALSE(scene);
        EXPECT_EQ(scene.error().code, ErrorCode::InvalidInput);
        for (const std::string& part : bad.parts) {
            EXPECT_THAT(scene.error().message, HasSubstr(part));
        }
    }
}

TEST(Animation, channels_that_mean_nothing_here_are_left_out) {
    GltfBuilder file = moving_file();
    auto& channels = file.json["animations"][0]["channels"];
    channels.push_back({{"sampler", 0}, {"target", {{"path", "translation"}}}});
    channels.push_back({{"sampler", 0}, {"target", {{"node", 0}, {"path", "pointer"}}}});
    auto scene = file.load();
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->animations[0].channels.size(), 1U);
    EXPECT_THAT(scene->messages, testing::Contains(HasSubstr("2 channels that are left out")));
    // A node elsewhere, in another scene, does not matter and is not worth a word.
    file = moving_file();
    file.json["animations"][0]["channels"][0]["target"]["node"] = file.node(Json::object());
    scene = file.load();
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_TRUE(scene->animations[0].channels.empty());
    EXPECT_TRUE(scene->messages.empty());
}

}  // namespace
}  // namespace gnomon::scene::test
