// SPDX-License-Identifier: MIT
#include <gnomon/sun_study/criteria.hpp>

#include <numbers>

#include <fmt/format.h>

namespace gnomon::sun_study {

namespace {

struct Rule {
    std::string_view id;
    std::string_view title;
    std::string_view rule;
    double hours;
    double share_needed;
};

constexpr std::array<Rule, 4> rules{{
    {"bre209", "BRE 209: amenity areas",
     "BRE 209 (third edition, 2022), section 3.3: at least half of a garden or amenity area should "
     "receive at least two hours of sunlight on 21 March.",
     2.0, 0.5},
    {"en17037-minimum", "EN 17037: minimum",
     "EN 17037:2018, section 5.3: at least 1.5 hours of exposure to sunlight at a window's "
     "reference point, on a day between 1 February and 21 March.",
     1.5, 0.0},
    {"en17037-medium", "EN 17037: medium",
     "EN 17037:2018, section 5.3: at least 3 hours of exposure to sunlight at a window's reference "
     "point, on a day between 1 February and 21 March.",
     3.0, 0.0},
    {"en17037-high", "EN 17037: high",
     "EN 17037:2018, section 5.3: at least 4 hours of exposure to sunlight at a window's reference "
     "point, on a day between 1 February and 21 March.",
     4.0, 0.0},
}};

// Whether the sun is up before the first step or after the last: part of the day is missing then.
bool leaves_sun_out(std::span<const Step> steps) {
    return steps.empty() || steps.front().counts || steps.back().counts;
}

std::string objection_to(const Rule& rule, const sun::Date& date, std::span<const Step> steps) {
    const std::chrono::month_day day{date.month(), date.day()};
    const std::chrono::month_day equinox{std::chrono::March, std::chrono::day(21)};
    const std::chrono::month_day first_of_february{std::chrono::February, std::chrono::day(1)};
    const bool is_area = rule.share_needed > 0.0;
    if (is_area && day != equinox) {
        return fmt::format("The rule is for 21 March; this is {}.", sun::to_text(date));
    }
    if (!is_area && (day < first_of_february || day > equinox)) {
        return fmt::format("The rule is for a day between 1 February and 21 March; this is {}.",
                           sun::to_text(date));
    }
    if (leaves_sun_out(steps)) {
        return "The sun counts at the first or at the last step: the rule is for the whole day.";
    }
    if (!is_area) {
        return "The rule is for a window's reference point; cells of a plan are an indication.";
    }
    return {};
}

}  // namespace

std::vector<Criterion> judge_criteria(const SunHours& hours, std::span<const std::uint8_t> open,
                                      const sun::Date& date, std::span<const Step> steps) {
    std::vector<Criterion> criteria;
    for (const Rule& rule : rules) {
        Criterion c{.id = rule.id,
                    .title = rule.title,
                    .rule = rule.rule,
                    .hours = rule.hours,
                    .share = share_with(hours, open, rule.hours),
                    .share_needed = rule.share_needed,
                    .objection = objection_to(rule, date, steps)};
        c.met = rule.share_needed > 0.0 && c.share >= rule.share_needed;
        criteria.push_back(std::move(c));
    }
    return criteria;
}

}  // namespace gnomon::sun_study
