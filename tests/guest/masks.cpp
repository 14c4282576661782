// SPDX-License-Identifier: MIT
#include "tests/guest/masks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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
    auto system = must(shadows::ShadowSystem::create(
        {.force_technique = options.technique, .receivers = options.receivers}));
    auto frame = system.begin_frame();
    scene::ShadowAdapter adapter;
    must(adapter.submit(setting_of(row).scene, frame));
    return std::move(frame).finish(view);
}

void expect_true(const std::string& row, const MaskOptions& options,
                 const std::vector<std::vector<std::uint8_t>>& masks) {
    const Traced& traced = truth_of(row);
    ASSERT_EQ(masks.size(), traced.size());
    const truth::Judgement judgement = judge_lights(traced, masks);
    EXPECT_EQ(judgement.false_shadow, 0U) << wrong_places(judgement, row_width);
    EXPECT_EQ(judgement.false_light, 0U) << wrong_places(judgement, row_width);
    EXPECT_GT(judgement.shadowed, judgement.judged() / 20);
    EXPECT_GT(judgement.lit, judgement.judged() / 20);

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

}  // namespace gnomon::test
