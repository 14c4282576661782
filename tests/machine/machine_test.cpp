// SPDX-License-Identifier: MIT
//
// A quota is read as the kernel writes it, and what is found out of this machine makes sense.
#include <gnomon/machine/machine.hpp>

#include <thread>

#include <gtest/gtest.h>

namespace gnomon::machine {
namespace {

TEST(CoresOfQuota, AreRoundedUp) {
    EXPECT_EQ(cores_of_quota("1600000 100000\n"), 16U);
    EXPECT_EQ(cores_of_quota("150000 100000"), 2U);
    EXPECT_EQ(cores_of_quota("1000 100000"), 1U);
}

TEST(CoresOfQuota, AreEmptyWithoutOne) {
    for (const char* text : {"max 100000", "", "100000", "100000 ", "1 0", "-1 100000", "x y"}) {
        EXPECT_FALSE(cores_of_quota(text)) << text;
    }
}

TEST(ThisMachine, HasNoMoreCoresThanProcessors) {
    const Machine machine = this_machine();
    EXPECT_GE(machine.cores, 1U);
    EXPECT_LE(machine.cores, std::max(1U, std::thread::hardware_concurrency()));
    EXPECT_EQ(machine.processor.find_first_of("\"\n:"), std::string::npos);
    EXPECT_EQ(machine.system.find_first_of("\"\n="), std::string::npos);
}

}  // namespace
}  // namespace gnomon::machine
