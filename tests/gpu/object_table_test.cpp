// SPDX-License-Identifier: MIT
//
// The table of objects: generations, reuse of slots, labels of the dead.
#include <gtest/gtest.h>

#include "internal/object_table.hpp"

namespace gnomon::gpu::test {
namespace {

using Table = ObjectTable<BufferTag, int>;

TEST(ObjectTable, FindsWhatIsAliveAndNothingElse) {
    Table table;
    const BufferId a = table.insert("a", 1);
    const BufferId b = table.insert("b", 2);
    EXPECT_EQ(*table.find(a), 1);
    EXPECT_EQ(*table.find(b), 2);
    EXPECT_EQ(table.find({}), nullptr);
    EXPECT_EQ(table.find({2, 1}), nullptr);
    EXPECT_EQ(table.find({0, 2}), nullptr);
    table.erase(a);
    EXPECT_EQ(table.find(a), nullptr);
    EXPECT_EQ(table.find({a.index, a.generation + 1}), nullptr);
    EXPECT_EQ(table.size(), 1U);
    table.erase(a);
    EXPECT_EQ(table.size(), 1U);
    EXPECT_EQ(table.ids(), std::vector{b});
}

TEST(ObjectTable, SlotsAreUsedAgainUnderANewGeneration) {
    Table table;
    const BufferId first = table.insert("first", 1);
    table.erase(first);
    const BufferId second = table.insert("second", 2);
    EXPECT_EQ(second.index, first.index);
    EXPECT_NE(second.generation, first.generation);
    EXPECT_EQ(table.find(first), nullptr);
    EXPECT_EQ(*table.label(first), "first");
    EXPECT_EQ(*table.label(second), "second");
}

TEST(ObjectTable, RemembersTheLastFourLabelsOfASlot) {
    Table table;
    std::vector<BufferId> ids;
    for (int i = 0; i < 6; ++i) {
        ids.push_back(table.insert(std::to_string(i), i));
        table.erase(ids.back());
    }
    EXPECT_EQ(table.label(ids[1]), nullptr);
    EXPECT_EQ(*table.label(ids[2]), "2");
    EXPECT_EQ(*table.label(ids[5]), "5");
    EXPECT_TRUE(table.gave_out(ids[1]));
    EXPECT_FALSE(table.gave_out({0, 7}));
    EXPECT_FALSE(table.gave_out({1, 1}));
    EXPECT_FALSE(table.gave_out({}));
}

}  // namespace
}  // namespace gnomon::gpu::test
