// SPDX-License-Identifier: MIT
#include "internal/buffer_arena.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <span>
#include <vector>

#include <gnomon/gpu/fault_backend.hpp>
#include <gnomon/gpu/null_backend.hpp>

namespace gnomon::shadow_pass::internal {
namespace {

ArenaDesc of_indices() {
    return {.label = "indices",
            .owner = "A volume",
            .elements = "indices",
            .usage = gpu::BufferUsage::Index};
}

std::vector<std::uint32_t> read(gpu::Device& device, const BufferArena& arena,
                                const ArenaRun& run) {
    const auto bytes = device.read_buffer(arena.buffer(run.chunk), std::uint64_t{run.first} * 4,
                                          std::uint64_t{run.count} * 4);
    std::vector<std::uint32_t> indices(run.count);
    std::memcpy(indices.data(), bytes->data(), bytes->size());
    return indices;
}

// Runs come and go at random; what is held is never touched by what is uploaded later.
TEST(BufferArena, holds_what_was_uploaded_until_it_is_freed) {
    constexpr unsigned seed = 20261122;
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    gpu::Device device(gpu::create_null_backend());
    BufferArena arena(device, of_indices());
    struct Held {
        ArenaRun run;
        std::vector<std::uint32_t> indices;
    };
    std::vector<Held> held;
    std::uint64_t in_use = 0;
    for (int step = 0; step < 400; ++step) {
        if (held.size() > 30 || (!held.empty() && random() % 3 == 0)) {
            const std::size_t i = random() % held.size();
            in_use -= held[i].run.count;
            arena.free(held[i].run);
            held[i] = std::move(held.back());
            held.pop_back();
        } else {
            std::vector<std::uint32_t> indices(1 + random() % 100000);
            for (auto& index : indices) index = static_cast<std::uint32_t>(random());
            const auto run = arena.upload(std::as_bytes(std::span(indices)));
            ASSERT_TRUE(run) << run.error().message;
            in_use += run->count;
            held.push_back({*run, std::move(indices)});
        }
        ASSERT_EQ(arena.elements_in_use(), in_use);
        if (step % 7 == 0) {
            ASSERT_TRUE(arena.flush());
        }
    }
    ASSERT_TRUE(arena.flush());
    for (const Held& h : held) EXPECT_EQ(read(device, arena, h.run), h.indices);
}

TEST(BufferArena, gives_freed_room_out_again) {
    gpu::Device device(gpu::create_null_backend());
    BufferArena arena(device, of_indices());
    const std::vector<std::uint32_t> big(700000);
    const std::uint64_t before = device.counters().objects_alive;
    for (int i = 0; i < 20; ++i) {
        const auto run = arena.upload(std::as_bytes(std::span(big)));
        ASSERT_TRUE(run);
        arena.free(*run);
    }
    EXPECT_EQ(device.counters().objects_alive, before + 1) << "one chunk is enough";
}

// A frame in which everything changes costs one call, also the second time.
TEST(BufferArena, writes_neighbours_in_one_piece) {
    gpu::FaultPlan plan;  // counts calls, fails none
    gpu::Device device(gpu::create_fault_backend(gpu::create_null_backend(), plan));
    BufferArena arena(device, of_indices());
    const std::vector<std::uint32_t> some(10, 3);
    std::vector<ArenaRun> held;
    for (int frame = 0; frame < 3; ++frame) {
        for (const ArenaRun& run : held) arena.free(run);
        held.clear();
        for (int i = 0; i < 100; ++i) {
            held.push_back(*arena.upload(std::as_bytes(std::span(some))));
        }
        const std::uint64_t before = plan.calls;
        ASSERT_TRUE(arena.flush());
        EXPECT_EQ(plan.calls - before, 1U) << frame;
        EXPECT_EQ(read(device, arena, held[99]), some);
    }
    ASSERT_TRUE(arena.flush()) << "nothing waits";
}

TEST(BufferArena, has_nothing_left_to_write_after_a_failure) {
    gpu::FaultPlan plan{.fail_at = 2};  // the chunk is made, writing fails
    gpu::Device device(gpu::create_fault_backend(gpu::create_null_backend(), plan));
    BufferArena arena(device, of_indices());
    const std::vector<std::uint32_t> some(10, 3);
    ASSERT_TRUE(arena.upload(std::as_bytes(std::span(some))));
    EXPECT_FALSE(arena.flush());
    arena.clear();
    EXPECT_EQ(arena.elements_in_use(), 0U);
    const auto again = arena.upload(std::as_bytes(std::span(some)));
    ASSERT_TRUE(again);
    EXPECT_EQ(again->first, 0U);
    ASSERT_TRUE(arena.flush());
    EXPECT_EQ(read(device, arena, *again), some);
}

TEST(BufferArena, a_volume_larger_than_a_chunk_gets_one_of_its_own) {
    gpu::Device device(gpu::create_null_backend());
    BufferArena arena(device, of_indices());
    const std::vector<std::uint32_t> huge(3000000, 7);
    const auto run = arena.upload(std::as_bytes(std::span(huge)));
    ASSERT_TRUE(run) << run.error().message;
    EXPECT_EQ(run->count, huge.size());
}

TEST(BufferArena, a_volume_larger_than_any_buffer_is_refused_in_a_sentence) {
    gpu::Device device(gpu::create_null_backend());
    BufferArena arena(device, of_indices());
    const std::vector<std::uint32_t> too_many(device.caps().limits.max_buffer_size / 4 + 1);
    const auto run = arena.upload(std::as_bytes(std::span(too_many)));
    ASSERT_FALSE(run);
    EXPECT_EQ(run.error().code, ErrorCode::OutOfMemory);
    EXPECT_NE(run.error().message.find(std::to_string(too_many.size()) + " indices"),
              std::string::npos);
}

}  // namespace
}  // namespace gnomon::shadow_pass::internal
