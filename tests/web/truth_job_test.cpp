// SPDX-License-Identifier: MIT
//
// What the page's workers are given (apps/web/truth_job.hpp), without a browser: it comes through
// as it was, is judged as the suites of the truth judge, and bytes that are none are refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "tests/rows/rows.hpp"
#include "tests/support/devices.hpp"
#include "tests/truth/traced.hpp"
#include "truth_job.hpp"

namespace gnomon::web {
namespace {

constexpr std::uint32_t width = 48;
constexpr std::uint32_t height = 36;

TruthJob some_job(const test::Setting& setting, std::uint32_t samples) {
    TruthJob job = job_of(truth::instances_of(setting.scene));
    job.width = width;
    job.height = height;
    job.samples = samples;
    job.view = setting.view;
    job.lights.push_back({.key = 1, .position_world = {0.4, 1.0, 0.3, 0.0}});
    job.lights.push_back({.key = 2, .position_world = {1.0, 4.0, 2.0, 1.0}, .range_m = 30.0});
    return job;
}

TEST(TruthJob, comes_through_as_it_was) {
    const test::Setting setting = test::rows()[0].make();
    const TruthJob job = some_job(setting, 4);
    const std::vector<std::uint8_t> bytes = write_job(job);
    const TruthJob read = test::must(read_job(bytes));
    EXPECT_EQ(write_job(read), bytes);
    EXPECT_EQ(read.width, width);
    EXPECT_EQ(read.samples, 4U);
    ASSERT_EQ(read.lights.size(), 2U);
    EXPECT_FALSE(read.lights[0].range_m);
    EXPECT_EQ(read.lights[1].range_m, 30.0);
    ASSERT_EQ(read.meshes.size(), job.meshes.size());
    EXPECT_EQ(read.meshes[0].positions, job.meshes[0].positions);
    EXPECT_EQ(read.meshes[0].casts, job.meshes[0].casts);
}

TEST(TruthJob, is_refused_where_it_is_none) {
    const std::vector<std::uint8_t> bytes = write_job(some_job(test::rows()[0].make(), 1));
    const auto refused = [](std::vector<std::uint8_t> changed) {
        const auto read = read_job(changed);
        return !read && read.error().code == ErrorCode::InvalidInput &&
               read.error().message.back() == '.';
    };
    EXPECT_TRUE(refused({}));
    for (std::size_t size = 1; size < bytes.size(); size += bytes.size() / 97 + 1) {
        EXPECT_TRUE(refused({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)}))
            << size << " bytes";
    }
    auto longer = bytes;
    longer.push_back(0);
    EXPECT_TRUE(refused(longer));
    const auto with_word = [&](std::size_t place, std::uint32_t word) {
        auto changed = bytes;
        std::memcpy(changed.data() + place, &word, sizeof word);
        return changed;
    };
    EXPECT_TRUE(refused(with_word(0, 1)));            // another mark
    EXPECT_TRUE(refused(with_word(4, 0)));            // no width
    EXPECT_TRUE(refused(with_word(8, 8193)));         // too high
    EXPECT_TRUE(refused(with_word(12, 2)));           // samples
    EXPECT_TRUE(refused(with_word(20, 0xffffffff)));  // a band that is no number
    const TruthBench bench = test::must(TruthBench::create(bytes));
    EXPECT_TRUE(bench.judge(4, 2, std::vector<std::uint8_t>(2 * width * 2)));
    EXPECT_FALSE(bench.judge(4, 2, std::vector<std::uint8_t>(width * 2)));  // half a technique
    EXPECT_FALSE(bench.judge(4, 2, {}));
    // Rows that it does not have.
    EXPECT_FALSE(bench.judge(height, 1, std::vector<std::uint8_t>(2 * width)));
    EXPECT_FALSE(bench.judge(height - 1, 2, std::vector<std::uint8_t>(2 * width * 2)));
    EXPECT_FALSE(bench.judge(4, 0, std::vector<std::uint8_t>(2 * width)));
}

TEST(TruthJob, whatever_its_bytes_are_it_is_read_or_refused) {
    const std::vector<std::uint8_t> bytes = write_job(some_job(test::rows()[0].make(), 1));
    std::mt19937 random(11);  // the same each time
    for (int i = 0; i < 2000; ++i) {
        auto changed = bytes;
        for (int n = 0; n < 3; ++n) {
            // Most of it is positions; what counts is at the beginning.
            const std::size_t place = random() % (n == 0 ? 400 : changed.size());
            changed[place] = static_cast<std::uint8_t>(random());
        }
        const auto read = read_job(changed);
        EXPECT_TRUE(read || read.error().code == ErrorCode::InvalidInput);
    }
}

/// In pixels, as the specification of WebGPU places them.
std::vector<glm::dvec2> places_of(std::uint32_t samples) {
    if (samples == 1) return {{0.5, 0.5}};
    return {{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}};
}

// In parts, by one technique that is right by definition and one that is wrong all over.
TEST(TruthBench, judges_as_the_truth_does) {
    const test::Setting setting = test::rows()[0].make();
    for (const std::uint32_t samples : {1U, 4U}) {
        const TruthJob job = some_job(setting, samples);
        const glm::dvec3 eye(glm::inverse(job.view.view_from_world)[3]);
        const auto instances = job.instances();
        const truth::Tracer tracer = test::must(truth::Tracer::build(instances, eye));
        std::vector<std::uint8_t> right;
        std::uint64_t judged = 0;
        for (const shadows::Light& light : job.lights) {
            for (const glm::dvec2& place : places_of(samples)) {
                const truth::Picture picture = tracer.trace(
                    job.view, light, {.width = width, .height = height, .sample_position = place});
                for (const truth::Verdict verdict : picture.verdicts) {
                    right.push_back(verdict == truth::Verdict::Shadowed ? 1 : 0);
                    judged += verdict == truth::Verdict::Lit || verdict == truth::Verdict::Shadowed;
                }
            }
        }
        std::vector<std::uint8_t> masks = right;
        for (const std::uint8_t byte : right) masks.push_back(byte == 0 ? 1 : 0);
        const TruthBench bench = test::must(TruthBench::create(write_job(job)));
        std::vector<truth::Judgement> sum(2);
        for (std::uint32_t row = 0; row < height; row += 10) {
            const std::uint32_t rows = std::min(10U, height - row);
            std::vector<std::uint8_t> of_rows;
            for (std::size_t mask = 0; mask < masks.size(); mask += width * height) {
                const auto* first = masks.data() + mask + row * width;
                of_rows.insert(of_rows.end(), first, first + rows * width);
            }
            const auto part = test::must(bench.judge(row, rows, of_rows));
            ASSERT_EQ(part.size(), 2U);
            sum[0] += part[0];
            sum[1] += part[1];
        }
        EXPECT_GT(judged, 0U);
        EXPECT_EQ(sum[0].pixels, std::uint64_t{width} * height * samples * job.lights.size());
        EXPECT_EQ(sum[0].judged(), judged);
        EXPECT_EQ(sum[0].wrong(), 0U);
        EXPECT_EQ(sum[1].wrong(), judged);
        EXPECT_LT(sum[1].wrong_pixels.front(), width * height);
    }
}

}  // namespace
}  // namespace gnomon::web
