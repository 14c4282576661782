// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "profile/batch_size.hpp"

namespace gnomon::cli {
namespace {

TEST(BatchSize, IsWhatIsDrawnInTwoSeconds) {
    BatchSize size(8);
    EXPECT_EQ(size.next(), 8U);
    size.took(1, 100.0);  // of fewer than are drawn side by side
    EXPECT_EQ(size.next(), 8U);
    size.took(8, 0.5);
    EXPECT_EQ(size.next(), 32U);
    size.took(32, 3.0);  // 21.3 in two seconds
    EXPECT_EQ(size.next(), 16U);
    size.took(16, 1e-6);
    EXPECT_EQ(size.next(), 64U);
    size.took(64, 1000.0);
    EXPECT_EQ(size.next(), 8U);
    BatchSize many(500);
    many.took(500, 1e-6);
    EXPECT_EQ(many.next(), 500U);
}

}  // namespace
}  // namespace gnomon::cli
