// SPDX-License-Identifier: MIT
#include "tests/guest/masks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <tuple>
#include <utility>

#include <gnomon/scene/shadow_adapter.hpp>

#include "tests/rows/picture.hpp"
#include "tests/support/devices.hpp"
#include "tests/truth/traced.hpp"

namespace gnomon::test {

namespace {

const Traced& truth_of(const std::string& row) {
    static std::map<std::string, Traced> traced;
    const auto found = traced.find(row);
    if (found != traced.end()) return found->second;
    return traced.emplace(row, trace_lights(setting_of(row))).first->second;
}

// Four places a pixel, as row 0 at the bottom has them.
const Traced& truth_of_samples(const std::string& row, bool mirrored) {
    static std::map<std::pair<std::string, bool>, Traced> traced;
    const auto found = traced.find({row, mirrored});
    if (found != traced.end()) return found->second;
    truth::Options options{.width = row_width, .height = row_height};
    if (!mirrored) {
        return traced.emplace(std::pair(row, mirrored), trace_lights(setting_of(row), options, 4))
            .first->second;
    }
    constexpr std::array<glm::dvec2, 4> places{
        {{0.375, 0.875}, {0.875, 0.625}, {0.125, 0.375}, {0.625, 0.125}}};
    Traced of_samples;
    for (const glm::dvec2& place : places) {
        options.sample_position = place;
        Traced one = trace_lights(setting_of(row), options);
        of_samples.resize(one.size());
        for (std::size_t light = 0; light < one.size(); ++light) {
            of_samples[light].push_back(std::move(one[light][0]));
        }
    }
    return traced.emplace(std::pair(row, mirrored), std::move(of_samples)).first->second;
}

void expect_none_wrong(const truth::Judgement& judgement) {
    EXPECT_EQ(judgement.false_shadow, 0U) << wrong_places(judgement, row_width);
    EXPECT_EQ(judgement.false_light, 0U) << wrong_places(judgement, row_width);
    EXPECT_GT(judgement.shadowed, judgement.judged() / 20);
    EXPECT_GT(judgement.lit, judgement.judged() / 20);
}

const Picture& our_picture(const std::string& row, const MaskOptions& options) {
    static std::map<std::tuple<std::string, bool, shadows::Receivers>, Picture> pictures;
    const auto key = std::tuple(row, options.technique.has_value(), options.receivers);
    const auto found = pictures.find(key);
    if (found != pictures.end()) return found->second;
    gpu::Device& device = must(shared_device(drawing_devices().front()))->device;
    return pictures
        .emplace(key, must(take_picture(
                          device, setting_of(row),
                          {.technique = options.technique, .receivers = options.receivers})))
        .first->second;
}

}  // namespace

const Setting& setting_of(const std::string& row) {
    static std::map<std::string, Setting> settings;
    if (const auto found = settings.find(row); found != settings.end()) return found->second;
    const auto of_row =
        std::find_if(rows().begin(), rows().end(), [&](const Row& r) { return r.name == row; });
    return settings.emplace(row, of_row->make()).first->second;
}

shadows::DrawList list_of(const std::string& row, const MaskOptions& options,
                          const shadows::View& view) {
    auto system = must(shadows::ShadowSystem::create({.force_technique = options.technique,
                                                      .silhouette = options.silhouette,
                                                      .receivers = options.receivers}));
    auto frame = system.begin_frame();
    scene::ShadowAdapter adapter;
    must(adapter.submit(setting_of(row).scene, frame));
    return std::move(frame).finish(view);
}

void expect_true(const std::string& row, const MaskOptions& options,
                 const std::vector<std::vector<std::uint8_t>>& masks) {
    const Traced& traced = truth_of(row);
    ASSERT_EQ(masks.size(), traced.size());
    expect_none_wrong(judge_lights(traced, masks));

    // Not only the same shadow: the same number of layers, with the same sign.
    const Picture& picture = our_picture(row, options);
    std::size_t compared = 0;
    std::size_t different = 0;
    for (std::size_t light = 0; light < masks.size(); ++light) {
        for (std::size_t i = 0; i < masks[light].size(); ++i) {
            const truth::Verdict verdict = traced[light][0].verdicts[i];
            if (verdict != truth::Verdict::Lit && verdict != truth::Verdict::Shadowed) continue;
            ++compared;
            different += masks[light][i] != picture.masks[light][0][i] ? 1 : 0;
        }
    }
    std::printf("%zu of %zu counts differ from our renderer's\n", different, compared);
    EXPECT_LE(different, compared / 500);
}

void expect_true_samples(const std::string& row,
                         const std::vector<std::vector<std::vector<std::uint8_t>>>& masks,
                         bool mirrored) {
    const Traced& traced = truth_of_samples(row, mirrored);
    ASSERT_EQ(masks.size(), traced.size());
    expect_none_wrong(judge_lights(traced, masks));
}

void expect_true_bits(const std::string& row, const std::vector<std::uint32_t>& bits) {
    const Traced& traced = truth_of(row);
    std::vector<std::vector<std::uint8_t>> masks(traced.size());
    for (std::size_t light = 0; light < masks.size(); ++light) {
        for (const std::uint32_t word : bits) {
            masks[light].push_back((word >> light & 1U) != 0 ? 255 : 0);
        }
    }
    expect_none_wrong(judge_lights(traced, masks));
}

std::size_t wrong_bits(const std::vector<std::uint32_t>& bits,
                       const std::vector<std::vector<std::uint8_t>>& stencils) {
    std::vector<std::uint32_t> expected(bits.size(), 0);
    for (std::size_t light = 0; light < stencils.size(); ++light) {
        for (std::size_t i = 0; i < expected.size(); ++i) {
            if (stencils[light].at(i) != 0) expected[i] |= 1U << light;
        }
    }
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < bits.size(); ++i) wrong += bits[i] != expected[i] ? 1 : 0;
    return wrong;
}

}  // namespace gnomon::test
