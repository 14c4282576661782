// SPDX-License-Identifier: MIT
//
// The little languages of the command line: what they take, and the sentence where they do not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "arguments.hpp"

namespace gnomon::cli {
namespace {

using testing::HasSubstr;

template <class T>
void expect_refused(const Result<T>& result, const std::string& text) {
    ASSERT_FALSE(result) << "\"" << text << "\" was taken";
    EXPECT_EQ(result.error().code, ErrorCode::InvalidInput) << text;
    EXPECT_THAT(result.error().message, HasSubstr("\"" + text + "\""));
    EXPECT_TRUE(result.error().message.ends_with('.')) << result.error().message;
}

TEST(Arguments, a_number_is_finite_and_nothing_follows_it) {
    EXPECT_DOUBLE_EQ(parse_number("2.5", "x").value(), 2.5);
    EXPECT_DOUBLE_EQ(parse_number("-1e3", "x").value(), -1000.0);
    for (const char* text : {"", " ", "nan", "-nan", "inf", "-inf", "infinity", "1e999", "1x", "1 ",
                             " 1", "0x10", "1,5", "--1", "1e", "."}) {
        const auto number = parse_number(text, "--near");
        expect_refused(number, text);
        EXPECT_THAT(number.error().message, HasSubstr("--near"));
    }
}

TEST(Arguments, a_number_keeps_to_its_limits) {
    EXPECT_DOUBLE_EQ(parse_number("1", "x", 1.0, 2.0).value(), 1.0);
    EXPECT_DOUBLE_EQ(parse_number("2", "x", 1.0, 2.0).value(), 2.0);
    for (const char* text : {"0.999", "2.001", "-1", "nan"})
        expect_refused(parse_number(text, "x", 1.0, 2.0), text);
}

TEST(Arguments, a_vector_is_three_numbers) {
    EXPECT_EQ(parse_vector("1,-2.5,3e2", "--eye").value(), glm::dvec3(1.0, -2.5, 300.0));
    for (const char* text : {"", "1", "1,2", "1,2,3,4", ",,,"})
        expect_refused(parse_vector(text, "--eye"), text);
    for (const char* text : {"1,2,", ",,", "1,nan,3", "1,2,1e999", "1,2,3 ", "1e31,0,0"})
        EXPECT_FALSE(parse_vector(text, "--eye")) << text;
}

TEST(Arguments, a_size_is_two_whole_numbers_within_the_limit) {
    const Size size = parse_size("160x120").value();
    EXPECT_EQ(size.width, 160U);
    EXPECT_EQ(size.height, 120U);
    EXPECT_EQ(parse_size("16384x1").value().width, 16384U);
    for (const char* text :
         {"", "x", "160", "160x", "x120", "0x5", "5x0", "-1x5", "16385x1", "1x16385",
          "4294967297x4", "99999999999999999999x4", "1.5x2", "160x120x1", "160X120", "160x120 "}) {
        expect_refused(parse_size(text), text);
    }
}

TEST(Arguments, a_light_is_a_point_or_a_direction) {
    const LightArgument point = parse_light("point:1,2,-3").value();
    EXPECT_FALSE(point.directional);
    EXPECT_EQ(point.value, glm::dvec3(1.0, 2.0, -3.0));
    EXPECT_FALSE(point.range_m);
    EXPECT_DOUBLE_EQ(parse_light("point:0,0,0,range=7.5").value().range_m.value(), 7.5);
    EXPECT_TRUE(parse_light("dir:0,-1,0").value().directional);
    for (const char* text : {"", "sun", "1,2,3", "spot:1,2,3", "dir:0,0,0", "dir:1e-40,0,0",
                             "dir:0,-1,0,range=5", "point", "Point:1,2,3"}) {
        expect_refused(parse_light(text), text);
    }
    for (const char* text :
         {"point:", "dir:", "point:1,2", "point:nan,0,0", "dir:inf,0,0", "point:1,2,3,range=0",
          "point:1,2,3,range=-1", "point:1,2,3,range=", "point:1,2,3,range=nan",
          "point:1,2,3,range=1,range=2", "point:1,2,3,5", "point:1e999,0,0"}) {
        EXPECT_FALSE(parse_light(text)) << text;
    }
}

TEST(Arguments, a_motion_is_one_of_five) {
    EXPECT_EQ(parse_motion("static").value().kind, MotionKind::Static);
    EXPECT_EQ(parse_motion("camera").value().kind, MotionKind::Camera);
    const Motion light = parse_motion("light:-0.5").value();
    EXPECT_EQ(light.kind, MotionKind::Light);
    EXPECT_DOUBLE_EQ(light.degrees, -0.5);
    const Motion casters = parse_motion("casters:12").value();
    EXPECT_EQ(casters.kind, MotionKind::Casters);
    EXPECT_EQ(casters.casters, 12U);
    const Motion time = parse_motion("time:-0.25").value();
    EXPECT_EQ(time.kind, MotionKind::Time);
    EXPECT_DOUBLE_EQ(time.seconds, -0.25);
    for (const char* text :
         {"", "spin", "light", "light:", "time", "time:", "casters", "casters:", "casters:-1",
          "casters:1.5", "casters:4294967296", "static:1", "camera:2", ":5"}) {
        expect_refused(parse_motion(text), text);
    }
    for (const char* text : {"light:nan", "light:1e999", "light:10deg", "time:nan", "time:1e10"})
        EXPECT_FALSE(parse_motion(text)) << text;
}

TEST(Arguments, overlays_are_a_list) {
    const render::Overlays some = parse_overlays("volumes,count").value();
    EXPECT_TRUE(some.volumes && some.count);
    EXPECT_FALSE(some.silhouettes || some.caps || some.wireframe);
    const render::Overlays all =
        parse_overlays("volumes,silhouettes,caps,wireframe,count,fill").value();
    EXPECT_TRUE(all.volumes && all.silhouettes && all.caps && all.wireframe && all.count &&
                all.fill);
    for (const char* text : {"", "volume", "Volumes", "caps ", "all"})
        expect_refused(parse_overlays(text), text);
    expect_refused(parse_overlays("volumes,"), "");
    expect_refused(parse_overlays("volumes,edges,caps"), "edges");
}

TEST(Arguments, messages_are_one_line) {
    EXPECT_EQ(one_line("a\nb\r\tc\x1b[31md\x7f"), "a b  c [31md ");
    EXPECT_EQ(one_line("später"), "später");
}

}  // namespace
}  // namespace gnomon::cli
