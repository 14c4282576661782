// SPDX-License-Identifier: MIT
//
// The arithmetic of memory blocks, against a model that knows each byte. No device is needed.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "internal/memory.hpp"

namespace gnomon::vk {
namespace {

TEST(SpanAllocator, GivesAllItHas) {
    SpanAllocator space{64};
    EXPECT_EQ(space.allocate(64, 1), 0U);
    EXPECT_EQ(space.free_bytes(), 0U);
    EXPECT_EQ(space.gap_count(), 0U);
    EXPECT_FALSE(space.allocate(1, 1).has_value());
}

TEST(SpanAllocator, RefusesWhatDoesNotFit) {
    SpanAllocator space{64};
    EXPECT_FALSE(space.allocate(65, 1).has_value());
    EXPECT_TRUE(space.empty());
}

TEST(SpanAllocator, AlignsAndKeepsThePadding) {
    SpanAllocator space{256};
    EXPECT_EQ(space.allocate(3, 1), 0U);
    EXPECT_EQ(space.allocate(64, 64), 64U);
    EXPECT_EQ(space.free_bytes(), 256U - 67U);
    EXPECT_EQ(space.allocate(61, 1), 3U) << "the padding can be used";
}

TEST(SpanAllocator, AlignmentCountsWhenAGapIsJudged) {
    SpanAllocator space{100};
    ASSERT_EQ(space.allocate(1, 1), 0U);
    EXPECT_FALSE(space.allocate(90, 16).has_value()) << "99 bytes are free, but 84 from 16 on";
    EXPECT_FALSE(space.allocate(1, 128).has_value()) << "no multiple of 128 is left";
}

TEST(SpanAllocator, MergesWithBothNeighbours) {
    SpanAllocator space{30};
    ASSERT_EQ(space.allocate(10, 1), 0U);
    ASSERT_EQ(space.allocate(10, 1), 10U);
    ASSERT_EQ(space.allocate(10, 1), 20U);
    space.free(0, 10);
    space.free(20, 10);
    EXPECT_EQ(space.gap_count(), 2U);
    space.free(10, 10);
    EXPECT_EQ(space.gap_count(), 1U);
    EXPECT_TRUE(space.empty());
    EXPECT_EQ(space.allocate(30, 1), 0U);
}

/// A byte each: true where it is taken.
class Model {
public:
    explicit Model(std::size_t size) : taken_(size, false) {}

    [[nodiscard]] bool is_free(std::uint64_t offset, std::uint64_t size) const {
        if (offset + size > taken_.size()) {
            return false;
        }
        for (std::uint64_t i = offset; i < offset + size; ++i) {
            if (taken_[i]) {
                return false;
            }
        }
        return true;
    }
    void mark(std::uint64_t offset, std::uint64_t size, bool taken) {
        for (std::uint64_t i = offset; i < offset + size; ++i) {
            taken_[i] = taken;
        }
    }
    [[nodiscard]] bool could_give(std::uint64_t size, std::uint64_t alignment) const {
        for (std::uint64_t offset = 0; offset + size <= taken_.size(); offset += alignment) {
            if (is_free(offset, size)) {
                return true;
            }
        }
        return false;
    }
    [[nodiscard]] std::size_t gap_count() const {
        std::size_t gaps = 0;
        for (std::size_t i = 0; i < taken_.size(); ++i) {
            gaps += !taken_[i] && (i == 0 || taken_[i - 1]) ? 1 : 0;
        }
        return gaps;
    }

private:
    std::vector<bool> taken_;
};

TEST(SpanAllocator, AgreesWithAModelThroughRandomUse) {
    struct Taken {
        std::uint64_t offset, size;
    };
    constexpr std::uint64_t size = 1024;
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random{seed};
        const auto below = [&](std::uint64_t limit) { return random() % limit; };
        SpanAllocator space{size};
        Model model{size};
        std::vector<Taken> taken;
        for (int step = 0; step < 1000; ++step) {
            if (below(5) < 3) {
                const std::uint64_t wanted = 1 + below(80);
                const std::uint64_t alignment = std::uint64_t{1} << below(8);
                const auto offset = space.allocate(wanted, alignment);
                ASSERT_EQ(offset.has_value(), model.could_give(wanted, alignment));
                if (offset) {
                    ASSERT_EQ(*offset % alignment, 0U);
                    ASSERT_TRUE(model.is_free(*offset, wanted));
                    model.mark(*offset, wanted, true);
                    taken.push_back({*offset, wanted});
                }
            } else if (!taken.empty()) {
                const std::size_t index = below(taken.size());
                space.free(taken[index].offset, taken[index].size);
                model.mark(taken[index].offset, taken[index].size, false);
                taken[index] = taken.back();
                taken.pop_back();
            }
            ASSERT_EQ(space.gap_count(), model.gap_count()) << "free neighbours are merged";
        }
        for (const Taken& last : taken) {
            space.free(last.offset, last.size);
        }
        EXPECT_TRUE(space.empty());
        EXPECT_EQ(space.gap_count(), 1U);
    }
}

}  // namespace
}  // namespace gnomon::vk
