// SPDX-License-Identifier: MIT
//
// report.html of a sun study: its pictures, figures and criteria on one page.
#pragma once

#include <string>
#include <vector>

#include "profile/day_result.hpp"

namespace gnomon::cli {

/// What the page says of a day: what is left of it once its pictures are written.
struct PageDay {
    sun::Date date{};
    std::string folder;  ///< of its pictures, from the page's; empty: the same
    sun_study::HoursSummary summary;
    double possible_h = 0.0;
    std::string no_sun;  ///< as DayResult has it
    std::vector<sun_study::Criterion> criteria;
};

[[nodiscard]] PageDay page_day(const DayResult& day, const std::string& folder);
/// `has_scene`: each day has a scene.png.
[[nodiscard]] std::string study_page(const Study& study, const std::vector<PageDay>& days,
                                     bool has_scene);

}  // namespace gnomon::cli
