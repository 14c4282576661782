// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "profile/perspective.hpp"

namespace gnomon::cli {
namespace {

constexpr Color red{1.0, 0.0, 0.0};
constexpr Color green{0.0, 1.0, 0.0};
constexpr Color blue{0.0, 0.0, 1.0};

// From the south, 10 m up, straight at the origin, far from zero.
const glm::dvec3 origin(533987.7, 5350123.3, 255.4);

Perspective picture() {
    return *Perspective::create({}, glm::dvec3(-1.0), glm::dvec3(1.0),
                                {origin + glm::dvec3(0.0, -20.0, 10.0), origin});
}

// An upright square across the line of sight, seen from the south.
void add_wall(Perspective& to, double y, double half, const Color& color, double lift = 0.0) {
    const auto at = [&](double x, double z) { return origin + glm::dvec3(x, y, z); };
    to.triangle({at(-half, -half), at(half, -half), at(half, half)}, color, lift);
    to.triangle({at(-half, -half), at(half, half), at(-half, half)}, color, lift);
}

std::string at_middle(const Perspective& of) {
    const Color c = of.pixels()[std::size_t{Perspective::height / 2} * Perspective::width +
                                Perspective::width / 2];
    const auto is = [&](const Color& other) {
        return c.r == other.r && c.g == other.g && c.b == other.b;
    };
    return is(red) ? "red" : is(green) ? "green" : is(blue) ? "blue" : "another";
}

TEST(Perspective, HidesWhatIsFartherInAnyOrder) {
    for (const bool near_first : {true, false}) {
        Perspective p = picture();
        if (near_first) add_wall(p, -2.0, 3.0, red);
        add_wall(p, 2.0, 3.0, green);
        if (!near_first) add_wall(p, -2.0, 3.0, red);
        EXPECT_EQ(at_middle(p), "red");
    }
}

TEST(Perspective, LiftsAPatchBeforeItsFace) {
    // Of what is equally far, the first stays.
    for (const double lift : {0.0, 1e-5}) {
        Perspective p = picture();
        add_wall(p, 0.0, 3.0, green);
        add_wall(p, 0.0, 1.0, red, lift);
        EXPECT_EQ(at_middle(p), lift == 0.0 ? "green" : "red");
    }
}

TEST(Perspective, HasAPlaneThatHidesWhatIsBelow) {
    Perspective p = picture();
    std::size_t asked = 0;
    glm::dvec2 nearest(1e30);
    p.plane(origin.z, [&](const glm::dvec2& at) {
        ++asked;
        if (glm::distance(at, glm::dvec2(origin)) < glm::distance(nearest, glm::dvec2(origin))) {
            nearest = at;
        }
        return blue;
    });
    // The horizon is above the picture: the plane fills it, and the middle is the origin.
    EXPECT_EQ(asked, std::size_t{4} * Perspective::width * Perspective::height);
    EXPECT_LT(glm::distance(nearest, glm::dvec2(origin)), 0.02);
    EXPECT_EQ(at_middle(p), "blue");
    add_wall(p, 5.0, 3.0, green);  // where the sight meets it, it is below the plane
    EXPECT_EQ(at_middle(p), "blue");
    add_wall(p, -2.0, 3.0, red);
    EXPECT_EQ(at_middle(p), "red");
}

// A face that runs from before the eye to behind it.
TEST(Perspective, CutsWhatPassesTheEye) {
    Perspective p = picture();
    p.triangle({origin + glm::dvec3(-5.0, 5.0, 0.0), origin + glm::dvec3(5.0, 5.0, 0.0),
                origin + glm::dvec3(0.0, -400.0, 0.0)},
               red);
    EXPECT_EQ(at_middle(p), "red");
    const std::vector<Color> pixels = p.pixels();
    EXPECT_NE(pixels.front().g, 0.0);  // above: the sky
}

TEST(Perspective, RefusesAnEyeThatIsItsTarget) {
    const auto refused =
        Perspective::create({}, glm::dvec3(0.0), glm::dvec3(1.0), {origin, origin});
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, testing::HasSubstr("--eye"));
}

}  // namespace
}  // namespace gnomon::cli
