// SPDX-License-Identifier: MIT
//
// What a report is written as: figures arrive, names are escaped, nothing is fetched from outside.
#include <gnomon/report/writers.hpp>

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "internal/page_parts.hpp"

namespace gnomon::report {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

Row row(const std::string& technique, double ms, std::uint64_t wrong) {
    Row row;
    row.technique = technique;
    row.family = "volumes";
    row.summary = "What it does.";
    row.general = true;
    row.frame_ms = {ms, ms * 1.5, ms * 0.9, ms * 2.0};
    row.against_auto = {ms / 2.0, ms / 2.0, ms / 2.0};  // "auto" takes 2 ms
    row.errors.wrong_worst = wrong;
    row.errors.wrong_share_worst = static_cast<double>(wrong) / 1000.0;
    row.mask = {1, 1, {std::byte{1}, std::byte{2}}};
    row.difference = {1, 1, {std::byte{3}}};
    return row;
}

Cell cell() {
    Cell cell;
    cell.scene = "a <b> & \"c\", d";
    cell.source = "builtin:knot";
    cell.kind = Kind::Hero;
    cell.backend = "gl";
    cell.adapter = "soft, and \"slow\"";
    cell.triangles = 12345;
    cell.lights = 1;
    cell.rounds = 3;
    cell.empty_frame_ms = 0.012;
    cell.truth = {2, 1, {std::byte{9}}};
    cell.notes = {"A <note>."};
    cell.rows = {row("auto", 2.0, 0), row("slower", 3.0, 0), row("quick & wrong", 1.0, 70),
                 row("equal", 2.0, 0), row("worse", 2.5, 70)};
    cell.rows[2].errors.edge_displacement_px = std::numeric_limits<double>::infinity();
    cell.rows[1].against_auto = {1.5, 1.4, std::numeric_limits<double>::infinity()};
    Row skipped;
    skipped.technique = "not here";
    skipped.family = "rays";
    skipped.skipped = "It is <missing>.";
    cell.rows.push_back(skipped);
    return cell;
}

Report report() {
    Report report;
    report.options.version = "1.2.3";
    report.machine = {.processor = "A <processor>", .cores = 2, .system = "A system"};
    report.command = "gnomon report --quick";
    report.cells = {cell()};
    return report;
}

TEST(Pareto, NothingOnTheFrontIsBeaten) { EXPECT_THAT(pareto_front(cell()), ElementsAre(2U, 0U)); }

TEST(Pareto, WhatCannotBeToldFromAutoDoesNotBeatIt) {
    Cell c = cell();
    c.rows[3].against_auto = {0.9, 0.7, 1.1};  // as right, and faster by luck
    EXPECT_THAT(pareto_front(c), ElementsAre(2U, 0U));
    c.rows[3].against_auto = {0.9, 0.85, 0.96};
    EXPECT_THAT(pareto_front(c), ElementsAre(2U, 3U));
}

TEST(BetterThanAuto, TakesTheWholeIntervalAndNoMoreErrors) {
    Cell c = cell();
    EXPECT_THAT(better_than_auto(c), IsEmpty());
    EXPECT_DOUBLE_EQ(comparable_ms(c, c.rows[4]), 2.5);
    c.rows[3].against_auto = {0.9, 0.86, 0.94};
    EXPECT_THAT(better_than_auto(c), ElementsAre(3U));
    c.rows[3].against_auto.high = 0.96;  // less than 5 % for all that is known
    EXPECT_THAT(better_than_auto(c), IsEmpty());
    c.rows[2].against_auto = {0.5, 0.5, 0.5};  // but wrong
    EXPECT_THAT(better_than_auto(c), IsEmpty());
}

TEST(Csv, QuotesWhatNeedsIt) {
    const std::string csv = to_csv(report());
    EXPECT_THAT(csv,
                HasSubstr("\"a <b> & \"\"c\"\", d\",hero,gl,\"soft, and \"\"slow\"\"\",auto,"));
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7);
    // As many columns in a line as in the head, for what was skipped too.
    const auto columns = [&](std::size_t line) {
        std::size_t begin = 0;
        for (std::size_t i = 0; i < line; ++i) begin = csv.find('\n', begin) + 1;
        bool quoted = false;
        std::size_t count = 1;
        for (std::size_t i = begin; csv[i] != '\n'; ++i) {
            if (csv[i] == '"') quoted = !quoted;
            if (csv[i] == ',' && !quoted) ++count;
        }
        return count;
    };
    EXPECT_EQ(columns(1), columns(0));
    EXPECT_EQ(columns(6), columns(0));
}

TEST(Json, HasTheFigures) {
    const auto json = nlohmann::json::parse(to_json(report()));
    EXPECT_EQ(json.at("version"), "1.2.3");
    const auto& rows = json.at("cells").at(0).at("rows");
    EXPECT_EQ(rows.at(0).at("frame_ms").at("median"), 2.0);
    EXPECT_EQ(rows.at(2).at("errors").at("wrong_worst"), 70);
    EXPECT_TRUE(rows.at(2).at("errors").at("edge_displacement_px").is_null());
    EXPECT_EQ(rows.at(5).at("skipped"), "It is <missing>.");
    EXPECT_FALSE(rows.at(0).contains("mask"));
    EXPECT_EQ(rows.at(4).at("comparable_ms"), 2.5);
    EXPECT_FALSE(rows.at(5).contains("comparable_ms"));
    const auto front = nlohmann::json::parse(R"(["quick & wrong", "auto"])");
    EXPECT_EQ(json.at("cells").at(0).at("front"), front);
    EXPECT_EQ(json.at("cells").at(0).at("worth_a_name").at(0), "auto");
}

TEST(Html, NeedsNothingElseAndEscapes) {
    const std::string page = to_html(report());
    for (const char* forbidden : {"<script", "http://", "https://", "<link", "<b> &", "<missing>",
                                  "<note>", "<processor>"}) {
        EXPECT_THAT(page, Not(HasSubstr(forbidden))) << forbidden;
    }
    for (const char* there : {"a &lt;b&gt; &amp; &quot;c&quot;, d", "It is &lt;missing&gt;.",
                              "data:image/png;base64,AQI=", "quick &amp; wrong",
                              "gnomon report --quick", "<svg", "</html>"}) {
        EXPECT_THAT(page, HasSubstr(there)) << there;
    }
}

// Times of microseconds, as a graphics chip takes, and of what takes none that a clock can tell.
TEST(Html, TinyTimesAreWrittenAndDrawn) {
    Report small = report();
    for (Row& r : small.cells[0].rows) {
        r.frame_ms = {0.0123, 0.02, 0.01, 0.03};
        r.detect_ms = {0.000041, 0.0, 0.0, 0.0};
        r.record_ms = {1e-7, 0.0, 0.0, 0.0};
    }
    const std::string page = to_html(small);
    for (const char* there : {"<td>0.0123</td>", "<td>0.00004</td>", "auto: 0.0123 ms"}) {
        EXPECT_THAT(page, HasSubstr(there)) << there;
    }
    for (const char* forbidden : {"e-0", "nan", "inf"}) {
        EXPECT_THAT(page.substr(page.find("<body")), Not(HasSubstr(forbidden))) << forbidden;
    }
    EXPECT_THAT(to_csv(small), HasSubstr(",0.012300,0.020000,0.000041,"));

    // Nothing at all was timed: no plot, but a page.
    for (Row& r : small.cells[0].rows) r.frame_ms = {};
    EXPECT_THAT(to_html(small), HasSubstr("</html>"));
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++found;
    }
    return found;
}

TEST(Html, SaysOfEachBackendWhatIsTrueOfIt) {
    Report both = report();
    both.cells.push_back(cell());
    both.cells[1].backend = "vk";
    std::string page = to_html(both);
    EXPECT_THAT(page, HasSubstr("of 5 pairs of measurements, all have the same error figures.<"));
    for (const char* backend : {"gl", "vk"}) {
        EXPECT_THAT(page, HasSubstr(std::string("<p>On <b>") + backend +
                                    "</b>, <code>auto</code> has no wrong pixel in 1 of 1 scene; "
                                    "nothing that is as right is faster in 1 of 1."));
    }
    // What is the same of both is said once.
    EXPECT_EQ(count(page, "Use <code>auto</code>"), 1U);
    EXPECT_EQ(count(page, "Nothing was found that is faster by more than 5 %."), 1U);
    EXPECT_THAT(page, HasSubstr("<th>ms,<br>gl</th><th>ms,<br>vk</th>"));

    both.cells[1].rows[3].against_auto = {0.5, 0.5, 0.5};
    both.cells[1].rows[2].errors.wrong_at_all_worst = 71;
    page = to_html(both);
    EXPECT_THAT(page, HasSubstr("all have the same error figures but <code>quick &amp; wrong</code>"
                                " in a &lt;b&gt;"));
    EXPECT_THAT(page, HasSubstr("<b>vk</b>: <code>equal</code> (0.50 of its time"));
    EXPECT_THAT(page, HasSubstr("scene; nothing that is as right is faster in 0 of 1."));
    EXPECT_THAT(to_html(report()), Not(HasSubstr("agree?")));
}

class Recommend : public testing::Test {
protected:
    [[nodiscard]] internal::Recommendation made() const {
        return internal::recommend({&first, &second});
    }
    Cell first = cell();
    Cell second = cell();
};

TEST_F(Recommend, AutoUnlessSomethingIsFasterEverywhere) {
    EXPECT_EQ(made().technique, "auto");
    EXPECT_THAT(made().reason, HasSubstr("Not one wrong pixel"));
    first.rows[3].against_auto = {0.5, 0.45, 0.55};
    EXPECT_EQ(made().technique, "auto");  // in one of the two scenes
    second.rows[3].against_auto = {0.5, 0.45, 0.96};
    EXPECT_EQ(made().technique, "auto");  // not beyond the interval
    second.rows[3].against_auto = {0.5, 0.45, 0.55};
    EXPECT_EQ(made().technique, "equal");
    EXPECT_THAT(made().reason, HasSubstr("50 % of its time in each of these 2 scenes"));
    first.rows[3].general = false;  // right by luck
    EXPECT_EQ(made().technique, "auto");
}

TEST_F(Recommend, WhatIsLessWrongIfAutoIsNotRight) {
    first.rows[0].errors.wrong_worst = 1200;
    EXPECT_EQ(made().technique, "equal");  // the faster of two without a wrong pixel
    EXPECT_THAT(made().reason, HasSubstr("0 wrong pixels in the worst frames, where "
                                         "<code>auto</code> has 1,200"));
    for (Cell* c : {&first, &second}) {
        for (Row& r : c->rows) r.errors.wrong_worst = 3;
        c->rows[2].against_auto = {0.99, 0.98, 1.01};
    }
    EXPECT_EQ(made().technique, "auto");  // all are as wrong
    EXPECT_THAT(made().reason, HasSubstr("It has the fewest wrong pixels, 6"));
}

TEST_F(Recommend, OfWhatWasMeasuredInAllScenes) {
    first.rows[0].skipped = "It failed.";
    EXPECT_EQ(made().technique, "equal");
    EXPECT_THAT(made().reason, HasSubstr("could not be measured"));
    for (Row& r : second.rows) r.skipped = "It failed.";
    EXPECT_EQ(made().technique, "");
}

TEST(DrawsInSoftware, IsToldByTheAdaptersName) {
    for (const char* name :
         {"llvmpipe (LLVM 15.0.6, 256 bits)", "SwiftShader Device (Subzero)", "softpipe"}) {
        EXPECT_TRUE(draws_in_software(name)) << name;
    }
    for (const char* name : {"NVIDIA H100 80GB HBM3/PCIe/SSE2", "AMD Radeon Graphics (RADV)",
                             "Mesa Intel(R) UHD Graphics 620 (KBL GT2)", ""}) {
        EXPECT_FALSE(draws_in_software(name)) << name;
    }
    Report mixed = report();
    mixed.cells.push_back(cell());
    mixed.cells[0].adapter = "llvmpipe";
    mixed.cells[1].backend = "vk";
    EXPECT_THAT(to_html(mixed), HasSubstr("a program on the processor draws on gl."));
    mixed.cells[1].adapter = "llvmpipe";
    EXPECT_THAT(to_html(mixed), HasSubstr("a program on the processor draws."));
    EXPECT_THAT(to_html(report()), Not(HasSubstr("a program on the processor draws")));
}

TEST(Kept, ComesBackAsItWas) {
    const std::string text = cell_to_json(cell());
    const auto back = cell_from_json(text);
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(cell_to_json(*back), text);
    EXPECT_EQ(back->kind, Kind::Hero);
    EXPECT_EQ(back->rows[0].mask.png, cell().rows[0].mask.png);
    EXPECT_TRUE(std::isinf(back->rows[2].errors.edge_displacement_px));
    EXPECT_TRUE(std::isinf(back->rows[1].against_auto.high));
}

TEST(Kept, WhatIsBrokenIsRefused) {
    const std::string text = cell_to_json(cell());
    for (const std::string& broken :
         {std::string("{"), std::string("[]"), std::string(), text.substr(0, text.size() / 2)}) {
        const auto back = cell_from_json(broken);
        ASSERT_FALSE(back);
        EXPECT_EQ(back.error().code, ErrorCode::InvalidInput);
        EXPECT_THAT(back.error().message, HasSubstr("no kept part of a report"));
    }
}

}  // namespace
}  // namespace gnomon::report
