// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gnomon/sun/calendar.hpp>

namespace gnomon::sun {
namespace {

using std::chrono::minutes;
using std::chrono::seconds;
using testing::HasSubstr;

template <class T>
std::string message_of(const Result<T>& result) {
    if (result) return "accepted";
    EXPECT_EQ(result.error().code, ErrorCode::InvalidInput);
    return result.error().message;
}

TEST(ParseDate, TakesDaysThatExist) {
    EXPECT_EQ(to_text(*parse_date("2024-02-29")), "2024-02-29");
    EXPECT_EQ(to_text(*parse_date("1950-01-01")), "1950-01-01");
    EXPECT_EQ(to_text(*parse_date("2100-12-31")), "2100-12-31");
}

TEST(ParseDate, SaysWhatIsWrong) {
    EXPECT_THAT(message_of(parse_date("2023-02-29")), HasSubstr("\"2023-02-29\" does not exist"));
    EXPECT_THAT(message_of(parse_date("2100-02-29")), HasSubstr("does not exist"));
    EXPECT_THAT(message_of(parse_date("2026-13-01")), HasSubstr("does not exist"));
    EXPECT_THAT(message_of(parse_date("2026-00-10")), HasSubstr("does not exist"));
    EXPECT_THAT(message_of(parse_date("1949-12-31")), HasSubstr("1950 to 2100"));
    for (const char* text : {"", "2026-3-21", "21.03.2026", "2026-03-21 ", "2026-+3-21"}) {
        EXPECT_THAT(message_of(parse_date(text)), HasSubstr("YYYY-MM-DD")) << text;
    }
}

TEST(ParseDates, TakesListsAndRanges) {
    const auto dates = parse_dates("2026-06-21,2026-02-27..2026-03-02,2026-12-01..2026-12-31/10");
    ASSERT_TRUE(dates) << dates.error().message;
    std::vector<std::string> texts;
    for (const Date& date : *dates) texts.push_back(to_text(date));
    EXPECT_THAT(texts, testing::ElementsAre("2026-06-21", "2026-02-27", "2026-02-28", "2026-03-01",
                                            "2026-03-02", "2026-12-01", "2026-12-11", "2026-12-21",
                                            "2026-12-31"));
    EXPECT_EQ(parse_dates("2024-01-01..2024-12-31")->size(), 366U);
}

TEST(ParseDates, SaysWhatIsWrong) {
    EXPECT_THAT(message_of(parse_dates("2026-03-21,2026-03-21")), HasSubstr("named twice"));
    EXPECT_THAT(message_of(parse_dates("2026-03-21..2026-03-20")), HasSubstr("runs backwards"));
    EXPECT_THAT(message_of(parse_dates("2026-03-21..2026-04-21/0")), HasSubstr("\"/0\""));
    EXPECT_THAT(message_of(parse_dates("2026-01-01..2027-12-31")), HasSubstr("more than 400"));
    EXPECT_THAT(message_of(parse_dates("2026-03-21,")), HasSubstr("YYYY-MM-DD"));
}

TEST(ParseClock, TakesTheWholeDay) {
    EXPECT_EQ(*parse_clock("00:00"), minutes(0));
    EXPECT_EQ(*parse_clock("09:30"), minutes(570));
    EXPECT_EQ(*parse_clock("24:00"), minutes(1440));
    for (const char* text : {"", "9:30", "24:01", "12:60", "12-30", "ab:cd"}) {
        EXPECT_THAT(message_of(parse_clock(text)), HasSubstr("HH:MM")) << text;
    }
}

TEST(ParseOffset, TakesBothSigns) {
    EXPECT_EQ(*parse_offset("Z"), minutes(0));
    EXPECT_EQ(*parse_offset("+05:45"), minutes(345));
    EXPECT_EQ(*parse_offset("-03:30"), minutes(-210));
    EXPECT_EQ(offset_text(minutes(-210)), "UTC-03:30");
    for (const char* text : {"", "01:00", "+1:00", "+14:01", "CET"}) {
        EXPECT_THAT(message_of(parse_offset(text)), HasSubstr("offset")) << text;
    }
}

TEST(ParseDuration, KnowsItsUnits) {
    EXPECT_EQ(*parse_duration("10m"), seconds(600));
    EXPECT_EQ(*parse_duration("10"), seconds(600));
    EXPECT_EQ(*parse_duration("90min"), seconds(5400));
    EXPECT_EQ(*parse_duration("30s"), seconds(30));
    EXPECT_EQ(*parse_duration("24h"), seconds(86400));
    for (const char* text : {"", "0m", "-5m", "1.5h", "10d", "25h", "999999999h"}) {
        EXPECT_THAT(message_of(parse_duration(text)), HasSubstr("duration")) << text;
    }
}

TEST(Instant, TakesTheOffsetOff) {
    const Date date = *parse_date("2026-01-01");
    EXPECT_EQ(to_text(instant_of(date, minutes(30), minutes(60))), "2025-12-31T23:30:00Z");
    EXPECT_EQ(to_text(instant_of(date, minutes(1440), minutes(-420))), "2026-01-02T07:00:00Z");
    EXPECT_EQ(clock_text(seconds(34215)), "09:30:15");
}

}  // namespace
}  // namespace gnomon::sun
