// SPDX-License-Identifier: MIT
#include <gnomon/sun_study/criteria.hpp>

#include <algorithm>

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
     "EN 17037:2018+A1:2021, section 5.3: at least 1.5 hours of exposure to sunlight at a window's "
     "reference point, on a day between 1 February and 21 March.",
     1.5, 0.0},
    {"en17037-medium", "EN 17037: medium",
     "EN 17037:2018+A1:2021, section 5.3: at least 3 hours of exposure to sunlight at a window's "
     "reference "
     "point, on a day between 1 February and 21 March.",
     3.0, 0.0},
    {"en17037-high", "EN 17037: high",
     "EN 17037:2018+A1:2021, section 5.3: at least 4 hours of exposure to sunlight at a window's "
     "reference "
     "point, on a day between 1 February and 21 March.",
     4.0, 0.0},
}};

// Whether the sun is up before the first step or after the last: part of the day is missing then.
bool ends_in_daylight(std::span<const Step> steps) {
    return steps.empty() || steps.front().sun.altitude_rad > 0.0 ||
           steps.back().sun.altitude_rad > 0.0;
}

// For how long the sun is up at steps that do not count.
double hours_left_out(std::span<const Step> steps) {
    std::uint64_t sum = 0;
    for (const Step& step : steps) {
        if (step.sun.altitude_rad > 0.0 && !step.counts) sum += step.half_seconds;
    }
    return static_cast<double>(sum) / half_seconds_an_hour;
}

std::chrono::seconds longest_step(std::span<const Step> steps) {
    std::chrono::seconds longest(0);
    for (std::size_t i = 1; i < steps.size(); ++i) {
        longest = std::max(longest, steps[i].clock - steps[i - 1].clock);
    }
    return longest;
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
    if (std::ranges::none_of(steps, &Step::counts)) {
        return "The sun counts at no step: there is nothing to judge.";
    }
    if (ends_in_daylight(steps)) {
        return "The sun is up at the first or at the last step: the rule is for the whole day.";
    }
    if (const double left_out = hours_left_out(steps); is_area && left_out > most_left_out_h) {
        return fmt::format(
            "{:.2f} h of sun are left out by the least altitude or about sunrise and "
            "sunset; the rule has none, and more than {:g} h are too much.",
            left_out, most_left_out_h);
    }
    if (const auto step = longest_step(steps); step > longest_step_allowed) {
        return fmt::format("Steps of {:g} minutes are too coarse: at most {} will do.",
                           static_cast<double>(step.count()) / 60.0, longest_step_allowed.count());
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
