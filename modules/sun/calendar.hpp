// SPDX-License-Identifier: MIT
//
// Dates, clocks and offsets as people write them, and the instants that they mean. A time zone is
// the offset that the user names: what is in force where and when (daylight saving above all) is
// decided by governments, and is not guessed here.
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include <gnomon/core/result.hpp>

namespace gnomon::sun {

/// A day of the Gregorian calendar; of the place's own time, whatever its offset from UTC is.
using Date = std::chrono::year_month_day;

/// UTC, without leap seconds: days of 86400 s.
using Instant = std::chrono::sys_seconds;

/// Positions of the sun are tested over these years, and no other is accepted.
inline constexpr int first_year = 1950;
inline constexpr int last_year = 2100;

/// YYYY-MM-DD. Fails with ErrorCode::InvalidInput, and one sentence that names the text, for what
/// is not written so, a day that does not exist, and a year that is out of range.
[[nodiscard]] Result<Date> parse_date(std::string_view text);

/// Dates with commas, and ranges of them: A..B has every day from A to B, A..B/N every N-th of
/// them. In the order that they are named; fails as parse_date() does, for a range that runs
/// backwards, for a date that is named twice, and for more than 400 of them.
[[nodiscard]] Result<std::vector<Date>> parse_dates(std::string_view text);

/// HH:MM from 00:00 to 24:00, as minutes since the midnight before.
[[nodiscard]] Result<std::chrono::minutes> parse_clock(std::string_view text);

/// The offset of a clock from UTC: Z, +HH:MM or -HH:MM, at most 14 hours.
[[nodiscard]] Result<std::chrono::minutes> parse_offset(std::string_view text);

/// A whole number with s, m, min or h behind it (a bare number is minutes): from 1 s to 24 h.
[[nodiscard]] Result<std::chrono::seconds> parse_duration(std::string_view text);

/// When the clock shows this on that day.
[[nodiscard]] Instant instant_of(const Date& date, std::chrono::seconds clock,
                                 std::chrono::minutes offset);

[[nodiscard]] std::string to_text(const Date& date);                 ///< 2026-03-21
[[nodiscard]] std::string to_text(Instant utc);                      ///< 2026-03-21T11:00:00Z
[[nodiscard]] std::string clock_text(std::chrono::seconds at);       ///< 09:30, or 09:30:15
[[nodiscard]] std::string offset_text(std::chrono::minutes offset);  ///< UTC+01:00

}  // namespace gnomon::sun
