// SPDX-License-Identifier: MIT
//
// Planning criteria: what the rules of daylight planning ask for, held against a grid's sun hours,
// and whether this study is one that the rule may be held against.
//
// BRE 209 (P. Littlefair et al., "Site layout planning for daylight and sunlight: a guide to good
// practice", third edition, 2022), section 3.3: a garden or amenity area appears adequately sunlit
// throughout the year if at least half of it receives at least two hours of sunlight on 21 March.
//
// EN 17037:2018+A1:2021, section 5.3 and table A.6: exposure to sunlight is at least 1.5 h
// (minimum), 3 h (medium) or 4 h (high) on a day between 1 February and 21 March, at a reference
// point of a window. A plan has no windows: what is said here is the share of the plan's cells that
// have so much, an indication and no assessment. The standard counts the sun from a least altitude
// that depends on the place; that is the caller's to set (SunRules).
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <gnomon/sun_study/sun_hours.hpp>

namespace gnomon::sun_study {

/// What a study may leave out of the sun of a day, by SunRules, and how long its steps may be, for
/// an area to be judged by it: a choice of gnomon's, the rules name neither.
inline constexpr double most_left_out_h = 0.25;
inline constexpr std::chrono::minutes longest_step_allowed{30};

struct Criterion {
    std::string_view id;        ///< "bre209", "en17037-minimum", …
    std::string_view title;     ///< as a table has it
    std::string_view rule;      ///< in a sentence, with its source
    double hours = 0.0;         ///< that a cell needs
    double share = 0.0;         ///< of the open cells that have them
    double share_needed = 0.0;  ///< 0: the rule asks about points, not about an area
    bool met = false;           ///< share_needed > 0 and reached; says nothing beside an objection
    /// Why the rule may not be held against this study; empty where it may.
    std::string objection;
};

/// The rules above, for the hours of one day. `steps` are that day's.
[[nodiscard]] std::vector<Criterion> judge_criteria(const SunHours& hours,
                                                    std::span<const std::uint8_t> open,
                                                    const sun::Date& date,
                                                    std::span<const Step> steps);

}  // namespace gnomon::sun_study
