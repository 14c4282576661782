// SPDX-License-Identifier: MIT
#include <gnomon/sun/calendar.hpp>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <optional>

#include <fmt/format.h>

namespace gnomon::sun {

namespace {

using std::chrono::minutes;
using std::chrono::seconds;

constexpr std::size_t most_dates = 400;

// Digits alone: from_chars would take a sign.
std::optional<int> digits(std::string_view text) {
    int value = 0;
    if (text.empty() || text.size() > 9 || text.front() < '0' || text.front() > '9') return {};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return {};
    return value;
}

// HH:MM.
std::optional<minutes> hours_and_minutes(std::string_view text) {
    if (text.size() != 5 || text[2] != ':') return {};
    const auto hours = digits(text.substr(0, 2));
    const auto rest = digits(text.substr(3));
    if (!hours || !rest || *rest > 59) return {};
    return minutes(*hours * 60 + *rest);
}

Status append_range(std::string_view text, std::size_t dots, std::vector<Date>& dates) {
    std::string_view last_text = text.substr(dots + 2);
    int stride = 1;
    if (const auto slash = last_text.find('/'); slash != std::string_view::npos) {
        const auto days = digits(last_text.substr(slash + 1));
        if (!days || *days < 1) {
            return fail(ErrorCode::InvalidInput,
                        fmt::format("The range of dates \"{}\" ends with \"{}\", where a whole "
                                    "number of days from 1 on is needed.",
                                    text, last_text.substr(slash)));
        }
        stride = *days;
        last_text = last_text.substr(0, slash);
    }
    const auto first = parse_date(text.substr(0, dots));
    if (!first) return forward_error(first);
    const auto last = parse_date(last_text);
    if (!last) return forward_error(last);
    if (*last < *first) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("The range of dates \"{}\" runs backwards.", text));
    }
    for (auto day = std::chrono::sys_days(*first); day <= std::chrono::sys_days(*last);
         day += std::chrono::days(stride)) {
        dates.emplace_back(day);
        if (dates.size() > most_dates) break;
    }
    return {};
}

}  // namespace

Result<Date> parse_date(std::string_view text) {
    std::optional<int> year;
    std::optional<int> month;
    std::optional<int> day;
    if (text.size() == 10 && text[4] == '-' && text[7] == '-') {
        year = digits(text.substr(0, 4));
        month = digits(text.substr(5, 2));
        day = digits(text.substr(8));
    }
    if (!year || !month || !day) {
        return fail(
            ErrorCode::InvalidInput,
            fmt::format("The date \"{}\" is not written as YYYY-MM-DD, as in 2026-03-21.", text));
    }
    if (*year < first_year || *year > last_year) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("The date \"{}\" is out of range: years from {} to {} are known.",
                                text, first_year, last_year));
    }
    const Date date{std::chrono::year(*year), std::chrono::month(static_cast<unsigned>(*month)),
                    std::chrono::day(static_cast<unsigned>(*day))};
    if (!date.ok()) {
        return fail(ErrorCode::InvalidInput, fmt::format("The date \"{}\" does not exist.", text));
    }
    return date;
}

Result<std::vector<Date>> parse_dates(std::string_view text) {
    std::vector<Date> dates;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        const std::string_view part = text.substr(at, end - at);
        if (const auto dots = part.find(".."); dots != std::string_view::npos) {
            if (const Status added = append_range(part, dots, dates); !added) {
                return forward_error(added);
            }
        } else {
            const auto date = parse_date(part);
            if (!date) return forward_error(date);
            dates.push_back(*date);
        }
        if (dates.size() > most_dates) {
            return fail(ErrorCode::InvalidInput,
                        fmt::format("The dates \"{}\" are more than {}, the most at a time.", text,
                                    most_dates));
        }
        at = end + 1;
    }
    std::vector<Date> sorted = dates;
    std::ranges::sort(sorted);
    if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end()) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("The date {} is named twice.", to_text(*twice)));
    }
    return dates;
}

Result<minutes> parse_clock(std::string_view text) {
    const auto clock = hours_and_minutes(text);
    if (!clock || *clock > minutes(24 * 60)) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("The time \"{}\" is not HH:MM from 00:00 to 24:00.", text));
    }
    return *clock;
}

Result<minutes> parse_offset(std::string_view text) {
    if (text == "Z") return minutes(0);
    const bool has_sign = text.starts_with('+') || text.starts_with('-');
    const auto size = has_sign ? hours_and_minutes(text.substr(1)) : std::nullopt;
    if (!size || *size > minutes(14 * 60)) {
        return fail(
            ErrorCode::InvalidInput,
            fmt::format("The offset \"{}\" is not Z, +HH:MM or -HH:MM of at most 14 hours.", text));
    }
    return text.front() == '-' ? -*size : *size;
}

Result<seconds> parse_duration(std::string_view text) {
    const std::size_t unit_at = std::min(text.find_first_not_of("0123456789"), text.size());
    const std::string_view unit = text.substr(unit_at);
    const auto count = digits(text.substr(0, unit_at));
    std::optional<int> unit_s;
    if (unit == "s") unit_s = 1;
    if (unit == "m" || unit == "min" || unit.empty()) unit_s = 60;
    if (unit == "h") unit_s = 3600;
    constexpr long long day_s = 86400;
    if (!count || !unit_s || *count < 1 || 1LL * *count * *unit_s > day_s) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("The duration \"{}\" is not a whole number with s, m or h behind "
                                "it, from 1s to 24h.",
                                text));
    }
    return seconds(*count * *unit_s);
}

Instant instant_of(const Date& date, seconds clock, minutes offset) {
    return std::chrono::sys_days(date) + clock - offset;
}

std::string to_text(const Date& date) {
    return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(date.year()),
                       static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()));
}

std::string to_text(Instant utc) {
    const auto day = std::chrono::floor<std::chrono::days>(utc);
    const auto rest = utc - day;
    const long long s = rest.count();
    return fmt::format("{}T{:02}:{:02}:{:02}Z", to_text(Date(day)), s / 3600, s / 60 % 60, s % 60);
}

std::string clock_text(seconds at) {
    const long long s = at.count();
    std::string text = fmt::format("{:02}:{:02}", s / 3600, s / 60 % 60);
    if (s % 60 != 0) text += fmt::format(":{:02}", s % 60);
    return text;
}

std::string offset_text(minutes offset) {
    const long long size = std::abs(offset.count());
    return fmt::format("UTC{}{:02}:{:02}", offset.count() < 0 ? '-' : '+', size / 60, size % 60);
}

}  // namespace gnomon::sun
