// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include <gnomon/sun_study/criteria.hpp>

namespace gnomon::sun_study {
namespace {

using testing::HasSubstr;

// Ten steps of half an hour; the first and the last are before and after the sun.
std::vector<Step> ten_steps() {
    std::vector<Step> steps(10);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        steps[i].clock = std::chrono::minutes(30 * i);
        steps[i].half_seconds = 3600;
        steps[i].counts = i > 0 && i + 1 < steps.size();
        steps[i].sun.altitude_rad = steps[i].counts ? 0.5 : -0.1;
    }
    return steps;
}

// Cell i is lit at i steps of those that count; cell 9 at all eight and has a roof.
SunHours ladder(const std::vector<Step>& steps) {
    SunHours hours(10);
    for (std::size_t s = 0; s < steps.size(); ++s) {
        std::vector<std::uint8_t> lit(10);
        for (std::size_t i = 0; i < lit.size(); ++i) lit[i] = s >= 1 && s <= i ? 1 : 0;
        hours.add(lit, steps[s]);
    }
    return hours;
}

const std::vector<std::uint8_t> open{1, 1, 1, 1, 1, 1, 1, 1, 1, 0};

std::map<std::string, Criterion> judged(const char* date, const std::vector<Step>& steps) {
    std::map<std::string, Criterion> by_id;
    for (Criterion& c : judge_criteria(ladder(steps), open, *sun::parse_date(date), steps)) {
        by_id.emplace(c.id, std::move(c));
    }
    return by_id;
}

TEST(SunHours, AddUpStepsThatCount) {
    const SunHours hours = ladder(ten_steps());
    for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(hours.hours(i), 0.5 * static_cast<double>(i));
    const HoursSummary summary = summarise(hours, open);
    EXPECT_EQ(summary.open_cells, 9U);
    EXPECT_EQ(summary.min_h, 0.0);
    EXPECT_EQ(summary.max_h, 4.0);
    EXPECT_EQ(summary.mean_h, 2.0);
    EXPECT_DOUBLE_EQ(share_with(hours, open, 2.0), 5.0 / 9.0);
    EXPECT_EQ(share_with(hours, std::vector<std::uint8_t>(10, 0), 0.0), 0.0);
}

// The night before the equinox, say: nothing is lit, which no rule minds.
TEST(Criteria, AreNotHeldAgainstANight) {
    std::vector<Step> night = ten_steps();
    for (Step& step : night) {
        step.counts = false;
        step.sun.altitude_rad = -0.2;
    }
    for (const auto& [id, criterion] : judged("2026-03-21", night)) {
        EXPECT_THAT(criterion.objection, HasSubstr("at no step")) << id;
    }
}

TEST(Criteria, OfBre209AreForHalfOfAnAreaAtTheEquinox) {
    const auto c = judged("2026-03-21", ten_steps()).at("bre209");
    EXPECT_DOUBLE_EQ(c.share, 5.0 / 9.0);
    EXPECT_TRUE(c.met);
    EXPECT_EQ(c.objection, "");
    EXPECT_THAT(judged("2026-06-21", ten_steps()).at("bre209").objection, HasSubstr("21 March"));
}

TEST(Criteria, OfEn17037AreAnIndicationInAPlan) {
    const auto all = judged("2026-02-01", ten_steps());
    EXPECT_DOUBLE_EQ(all.at("en17037-minimum").share, 6.0 / 9.0);
    EXPECT_DOUBLE_EQ(all.at("en17037-medium").share, 3.0 / 9.0);
    EXPECT_DOUBLE_EQ(all.at("en17037-high").share, 1.0 / 9.0);
    EXPECT_THAT(all.at("en17037-high").objection, HasSubstr("window"));
    EXPECT_FALSE(all.at("en17037-high").met);
    EXPECT_THAT(judged("2026-03-22", ten_steps()).at("en17037-high").objection,
                HasSubstr("between 1 February and 21 March"));
}

TEST(Criteria, AreForTheWholeDay) {
    std::vector<Step> afternoon = ten_steps();
    afternoon.front().sun.altitude_rad = 0.1;  // whether or not it counts
    EXPECT_THAT(judged("2026-03-21", afternoon).at("bre209").objection, HasSubstr("whole day"));
}

TEST(Criteria, OfAreasObjectToSunThatIsLeftOut) {
    std::vector<Step> steps = ten_steps();
    steps[1].counts = false;  // half an hour
    EXPECT_THAT(judged("2026-03-21", steps).at("bre209").objection, HasSubstr("0.50 h"));
    // The standard has a least altitude of its own.
    EXPECT_THAT(judged("2026-03-21", steps).at("en17037-minimum").objection, HasSubstr("window"));
    steps[1].half_seconds = 1800;  // a quarter of an hour
    EXPECT_EQ(judged("2026-03-21", steps).at("bre209").objection, "");
}

TEST(Criteria, ObjectToCoarseSteps) {
    std::vector<Step> steps = ten_steps();
    for (Step& step : steps) step.clock = step.clock * 2;
    EXPECT_THAT(judged("2026-03-21", steps).at("bre209").objection, HasSubstr("60 minutes"));
}

}  // namespace
}  // namespace gnomon::sun_study
