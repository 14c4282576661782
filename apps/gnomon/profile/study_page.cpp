// SPDX-License-Identifier: MIT
#include "profile/study_page.hpp"

#include <cmath>

#include <fmt/format.h>

namespace gnomon::cli {

namespace {

std::string html_text(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        switch (c) {
            case '&': safe += "&amp;"; break;
            case '<': safe += "&lt;"; break;
            case '>': safe += "&gt;"; break;
            case '"': safe += "&quot;"; break;
            default: safe += c;
        }
    }
    return safe;
}

constexpr const char* style =
    "body{font-family:sans-serif;max-width:80rem;margin:2rem auto;padding:0 1rem;color:#222}"
    "img{max-width:100%;height:auto;border:1px solid #ddd}table{border-collapse:collapse}"
    "td,th{border:1px solid #ccc;padding:.3rem .6rem;text-align:left;vertical-align:top}"
    "td.n{text-align:right}small{color:#666}";

std::string criteria_table(const PageDay& day) {
    std::string html =
        "<table><tr><th>Criterion</th><th>Share of the open area</th><th>Held against this "
        "study</th></tr>\n";
    for (const sun_study::Criterion& c : day.criteria) {
        std::string verdict = c.objection.empty() ? (c.met ? "met" : "not met") : c.objection;
        html += fmt::format(
            "<tr><td>{} ({:g} h)<br><small>{}</small></td><td class=n>{:.1f} %{}</td>"
            "<td>{}</td></tr>\n",
            c.title, c.hours, c.rule, 100.0 * c.share,
            c.share_needed > 0.0 ? fmt::format(" of {:.0f} %", 100.0 * c.share_needed) : "",
            verdict);
    }
    return html + "</table>\n";
}

}  // namespace

PageDay page_day(const DayResult& day, const std::string& folder) {
    return {day.date, folder, day.summary, day.most_hours(), day.no_sun, day.criteria};
}

std::string study_page(const Study& study, const std::vector<PageDay>& days, bool has_scene) {
    const sun_study::PlanGrid& grid = study.grid;
    std::string html = fmt::format(
        "<!DOCTYPE html>\n<html lang=en><meta charset=utf-8><title>Sun study: {0}</title>"
        "<style>{1}</style>\n<h1>Sun study: {0}</h1>\n",
        html_text(study.model), style);
    html += fmt::format(
        "<p>{:.6g}\u00b0 {}, {:.6g}\u00b0 {}; {} to {} ({}), every {:g} minutes. A plan of {} "
        "\u00d7 {} cells of {:g} m at a height of {:g} m; true north lies {:g}\u00b0 clockwise "
        "from the plan's y.{} Hours are of the sun's centre above the horizon of a flat Earth, "
        "without clouds.</p>\n",
        std::abs(study.latitude_deg), study.latitude_deg < 0.0 ? "S" : "N",
        std::abs(study.longitude_deg), study.longitude_deg < 0.0 ? "W" : "E",
        sun::clock_text(study.from), sun::clock_text(study.to), sun::offset_text(study.offset),
        static_cast<double>(study.step.count()) / 60.0, grid.columns, grid.rows, grid.cell_m,
        grid.height_m, study.north_deg,
        study.casters.empty()
            ? ""
            : fmt::format(" Only \u201c{}\u201d casts.", html_text(study.casters)));
    for (const PageDay& day : days) {
        const std::string folder = day.folder.empty() ? "" : day.folder + "/";
        html += fmt::format(
            "<h2>{}</h2>\n<p>Open area {:.0f} m\u00b2: {:.2f} h at least, {:.2f} h on average, "
            "{:.2f} h at most, of {:.2f} h.</p>\n",
            sun::to_text(day.date),
            static_cast<double>(day.summary.open_cells) * grid.cell_m * grid.cell_m,
            day.summary.min_h, day.summary.mean_h, day.summary.max_h, day.possible_h);
        if (!day.no_sun.empty()) html += fmt::format("<p>{}</p>\n", html_text(day.no_sun));
        html += criteria_table(day);
        html += fmt::format(
            "<p><img src=\"{0}hours.png\" alt=\"Hours of sun\"></p>\n"
            "<p><img src=\"{0}profile.png\" alt=\"Shadow profile\"></p>\n"
            "<p><a href=\"{0}summary.json\">summary.json</a>, "
            "<a href=\"{0}hours.csv\">hours.csv</a></p>\n",
            folder);
        if (has_scene) {
            html += fmt::format(
                "<p><img src=\"{}scene.png\" alt=\"Hours of sun, in perspective\"></p>\n", folder);
        }
        if (!study.before.empty()) {
            html += fmt::format(
                "<p><img src=\"{0}difference.png\" alt=\"Hours gained and lost\"></p>\n"
                "<p><a href=\"{0}difference.csv\">difference.csv</a></p>\n",
                folder);
        }
        if (study.surface_points > 0) {
            html += fmt::format(
                "<p><img src=\"{0}surfaces.png\" alt=\"Hours of sun on surfaces\"></p>\n"
                "<p><a href=\"{0}surfaces.csv\">surfaces.csv</a></p>\n",
                folder);
        }
    }
    html += "<h2>Sun path</h2>\n<p><img src=\"sun-path.png\" alt=\"Sun path\"></p>\n</html>\n";
    return html;
}

}  // namespace gnomon::cli
