// SPDX-License-Identifier: MIT
//
// A scene on a backend: every figure of it.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <gnomon/report/writers.hpp>

#include "internal/json_forms.hpp"
#include "internal/page_parts.hpp"
#include "internal/plot.hpp"

namespace gnomon::report::internal {

namespace {

constexpr const char* table_head =
    "<tr><th rowspan=\"2\">technique</th><th colspan=\"2\">frame, ms</th>"
    "<th rowspan=\"2\">of auto’s time<br>[95 %]</th><th colspan=\"3\">of it, ms</th>"
    "<th rowspan=\"2\">upload,<br>kB</th><th rowspan=\"2\">stencil<br>layers</th>"
    "<th colspan=\"4\">wrong pixels</th><th rowspan=\"2\">with the<br>band</th>"
    "<th rowspan=\"2\">edge off<br>by, px</th><th rowspan=\"2\">IoU,<br>worst</th></tr>\n"
    "<tr><th>median</th><th>p95</th><th>detect</th><th>build</th><th>record</th><th>worst</th>"
    "<th>median</th><th>false<br>shadow</th><th>false<br>light</th></tr>\n";
constexpr int table_columns = 16;

std::string row_html(const Row& row, bool on_front) {
    if (!row.skipped.empty()) {
        return fmt::format("<tr><td>{}{}</td><td class=\"text\" colspan=\"{}\">{}</td></tr>\n",
                           marker_svg(row.family), escaped(row.technique), table_columns - 1,
                           escaped(row.skipped));
    }
    const Errors& e = row.errors;
    const bool is_auto = row.technique == "auto";
    std::string text = fmt::format(
        "<tr class=\"{}{}\"><td title=\"{}\">{}{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
        "<td>{}</td><td>{}</td><td>{}</td><td>{}</td>",
        is_auto ? "auto " : "", on_front ? "front" : "", escaped(row.summary),
        marker_svg(row.family), escaped(row.technique), three_digits(row.frame_ms.median),
        three_digits(row.frame_ms.p95), is_auto ? "1" : ratio_text(row.against_auto),
        three_digits(row.detect_ms.median), three_digits(row.build_ms.median),
        three_digits(row.record_ms.median), with_commas(row.upload_bytes / 1000),
        row.layers > 0 ? with_commas(row.layers) : "–");
    text += fmt::format(
        "<td class=\"{}\">{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
        "<td>{}</td><td>{:.4f}</td></tr>\n",
        e.wrong_worst == 0 ? "good" : "bad", with_commas(e.wrong_worst),
        with_commas(e.wrong_median), with_commas(e.false_shadow_worst),
        with_commas(e.false_light_worst), with_commas(e.wrong_at_all_worst),
        three_digits(e.edge_displacement_px), e.iou_worst);
    return text;
}

std::string wrong_in_words(const Row& row) {
    if (row.errors.wrong_worst == 0) return "no wrong pixel";
    return fmt::format("{} wrong pixels ({})", with_commas(row.errors.wrong_worst),
                       percent(row.errors.wrong_share_worst));
}

std::string gallery(const Cell& cell) {
    std::string text = fmt::format(
        "<div class=\"gallery\"><figure>{}<figcaption>the truth, last "
        "frame</figcaption></figure>\n",
        image_html(cell.truth, "true shadows"));
    for (const Row& row : cell.rows) {
        if (!row.skipped.empty()) continue;
        const bool is_auto = row.technique == "auto";
        if (row.errors.wrong_worst == 0 && !is_auto) continue;
        if (is_auto || row.family == "shadow maps" || row.family == "planar") {
            text += fmt::format("<figure>{}<figcaption>{}: mask</figcaption></figure>\n",
                                image_html(row.mask, "mask of " + row.technique),
                                escaped(row.technique));
        }
        text += fmt::format("<figure>{}<figcaption>{}: {}</figcaption></figure>\n",
                            image_html(row.difference, "errors of " + row.technique),
                            escaped(row.technique), wrong_in_words(row));
    }
    return text + "</div>\n";
}

}  // namespace

std::string image_html(const Thumbnail& thumbnail, std::string_view alt) {
    if (thumbnail.png.empty()) return {};
    return fmt::format(
        "<img loading=\"lazy\" width=\"{}\" height=\"{}\" alt=\"{}\" "
        "src=\"data:image/png;base64,{}\">",
        thumbnail.width, thumbnail.height, escaped(alt), base64(thumbnail.png));
}

std::string percent(double share) {
    if (share == 0.0) return "0 %";
    if (share < 5e-5) return "under 0.01 %";
    if (share < 0.0995) return fmt::format("{:.2g} %", share * 100.0);
    return fmt::format("{:.0f} %", share * 100.0);
}

std::string ratio_text(const Ratio& ratio) {
    return fmt::format("{:.2f} [{:.2f}, {}]", ratio.mean, ratio.low,
                       std::isfinite(ratio.high) ? fmt::format("{:.2f}", ratio.high) : "∞");
}

std::string cell_html(const Cell& cell) {
    std::string text = fmt::format(
        "<h2>{} on {}</h2>\n<p class=\"small\">{} · {} triangles, {} caster{}, {} light{} · "
        "{} · {} round{}{}</p>\n",
        escaped(cell.scene), escaped(cell.backend), escaped(cell.source),
        with_commas(cell.triangles), with_commas(cell.casters), cell.casters == 1 ? "" : "s",
        cell.lights, cell.lights == 1 ? "" : "s", escaped(cell.adapter), cell.rounds,
        cell.rounds == 1 ? "" : "s",
        cell.empty_frame_ms > 0.0
            ? fmt::format(" · an empty frame: {} ms", three_digits(cell.empty_frame_ms))
            : std::string());
    for (const std::string& note : cell.notes) {
        text += fmt::format("<p class=\"small\">{}</p>\n", escaped(note));
    }
    text += "<div class=\"scroll\">" + plot_svg(cell) + "</div>\n";
    text +=
        "<details><summary>Masks and where they are wrong</summary><p class=\"small\">Dark: no "
        "light arrives. Grey: no surface, or averted. In the errors: <span class=\"bad\">red"
        "</span> is shadow where there is none, blue is light where there is none, pale is "
        "within the band. A picture shows the worst of the pixels that fall together.</p>\n" +
        gallery(cell) + "</details>\n";
    text += std::string("<div class=\"scroll\"><table class=\"all\">\n") + table_head;
    const std::vector<std::size_t> front = pareto_front(cell);
    for (std::size_t i = 0; i < cell.rows.size(); ++i) {
        text += row_html(cell.rows[i], std::ranges::find(front, i) != front.end());
    }
    text += "</table></div>\n";
    if (const Row* automatic = find_row(cell, "auto")) {
        text += fmt::format(
            "<p class=\"small\">{} of the pixels that have an answer lie in the band.</p>\n",
            percent(automatic->errors.band_share));
    }
    return text;
}

}  // namespace gnomon::report::internal
