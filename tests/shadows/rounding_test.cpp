// SPDX-License-Identifier: MIT
//
// What the arithmetic of gnomon::shadows takes for granted of the compiler, and what one compiler
// did not grant.
#include <gtest/gtest.h>

#include <glm/glm.hpp>

namespace gnomon::shadows {
namespace {

[[gnu::noinline]] void round_middle(const glm::vec3& low, const glm::vec3& high, glm::vec3& middle,
                                    glm::dvec3& same) {
    middle = glm::vec3((glm::dvec3(low) + glm::dvec3(high)) * 0.5);
    same = glm::dvec3(middle);
}

TEST(Rounding, OfADoubleToAFloatIsNotForgottenWhenItIsReadBack) {
    glm::vec3 middle(0.0F);
    glm::dvec3 same(0.0);
    // Between two floats, in all three coordinates: `same` has no bits that `middle` lacks.
    round_middle(glm::vec3(-807592.0F), glm::vec3(-807589.3125F), middle, same);
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(middle[i], -807590.625F);
        EXPECT_EQ(same[i], -807590.625);
    }
}

}  // namespace
}  // namespace gnomon::shadows
