// SPDX-License-Identifier: MIT
//
// The page: for a reader who knows nothing of gnomon. First what to use, then how it was measured,
// then every figure.
#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gnomon/report/writers.hpp>

#include "internal/page_parts.hpp"
#include "internal/plot.hpp"

namespace gnomon::report {

namespace {

using internal::escaped;
using internal::with_commas;

constexpr const char* style = R"(
:root{color-scheme:light}
*{box-sizing:border-box}
body{margin:0 auto;max-width:80rem;padding:1.2rem;font:16px/1.5 system-ui,sans-serif;color:#1d1d1f;background:#fdfcfa}
h1{font-size:1.9rem;line-height:1.2;margin:.4rem 0}h2{font-size:1.35rem;margin:2.2rem 0 .5rem;border-top:1px solid #ddd6cb;padding-top:1.2rem}
h3{font-size:1.15rem;margin:1.3rem 0 .3rem}h4{font-size:.95rem;margin:1.1rem 0 .3rem}
p,li{max-width:48rem}.small{font-size:.86rem;color:#55524c;font-weight:400}ul{padding-left:1.1rem}
code{font-size:.9em;overflow-wrap:anywhere;background:#f1eee8;padding:.05em .3em;border-radius:3px}
.scroll{overflow-x:auto;margin:.5rem 0}
table{border-collapse:collapse;font-size:.86rem;font-variant-numeric:tabular-nums}
th,td{padding:.28rem .55rem;text-align:right;border-bottom:1px solid #e9e4db;white-space:nowrap;vertical-align:middle}
th{background:#f4f0e9;font-weight:600;vertical-align:bottom}
th:first-child,td:first-child{text-align:left;position:sticky;left:0;background:#fdfcfa}
tr:first-child th:first-child{background:#f4f0e9}table.all tr:nth-child(2) th{position:static;text-align:right;background:#f4f0e9}
table.all{font-size:.77rem}table.all th,table.all td{padding:.22rem .34rem}
td.text,th.text{white-space:normal;text-align:left;min-width:16rem}
tr.auto td{background:#fff3e4!important;font-weight:600}tr.front td:first-child::after{content:" ◆";color:#8a8377}
.good{color:#166534}.bad{color:#9f1239}
.mark{width:.95em;height:.95em;margin-right:.4em;vertical-align:-.1em}
.legend span{margin-right:1rem;white-space:nowrap;font-size:.86rem}
.plot{width:100%;min-width:40rem;max-width:60rem;display:block}
.plot text{font-family:system-ui,sans-serif;font-size:12px;fill:#44413b}.plot .name{fill:#1d1d1f;paint-order:stroke;stroke:#fdfcfa;stroke-width:3px}
.plot .axis{font-size:13px;fill:#1d1d1f}.plot .muted{fill:#8a8377;font-style:italic}.grid{stroke:#e3ddd2;stroke-width:1}.leader{stroke:#8a8377;stroke-width:.8}
.frame{fill:none;stroke:#8a8377}.plot .auto{fill:none;stroke:#d55e00;stroke-width:1.2;opacity:.75}.pareto{fill:none;stroke:#55524c;stroke-width:1.5;stroke-dasharray:5 3}
img{border:1px solid #ddd6cb;display:block;max-width:100%;height:auto}
.cards{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,19rem),1fr));gap:1rem}
.card{border:1px solid #ddd6cb;border-radius:8px;padding:.9rem 1rem;background:#fff;min-width:0}.card h3{margin-top:0}
.card table{width:100%}.card td,.card th{white-space:normal;padding:.25rem .3rem}
.card td:first-child,.card th:first-child{position:static;background:none}.card th{background:none!important}
.card li{margin:.3rem 0;font-size:.93rem}.verdict{border-left:4px solid #009e73;padding:.15rem 0 .15rem .7rem;font-size:1.02rem}
.pair{display:grid;grid-template-columns:1fr 1fr;gap:.6rem;margin:.4rem 0}
figure{margin:0}figcaption{font-size:.8rem;line-height:1.35;margin-top:.2rem;color:#55524c}.pair img{width:100%}
.gallery{display:grid;grid-template-columns:repeat(auto-fill,minmax(200px,1fr));gap:.8rem;margin:.6rem 0}.gallery img{width:100%}
details{margin:.6rem 0}summary{cursor:pointer;font-weight:600}
)";

// The fastest but "auto" of what is as little wrong.
const Row* nearest_rival(const Cell& cell) {
    const Row* automatic = internal::find_row(cell, "auto");
    const Row* best = nullptr;
    for (const Row& row : cell.rows) {
        if (automatic == nullptr || !row.skipped.empty() || &row == automatic ||
            row.errors.wrong_worst > automatic->errors.wrong_worst) {
            continue;
        }
        if (best == nullptr || row.against_auto.mean < best->against_auto.mean) best = &row;
    }
    return best;
}

std::string verdict(const Ratio& ratio) {
    if (ratio.low > 1.0) return "Slower.";
    if (ratio.low >= 0.95) return "Not faster by more than 5 %.";
    if (ratio.high < 1.0) return "Faster, perhaps by more than 5 %: more rounds would tell.";
    return "Not told apart; more rounds would tell.";
}

std::string rivals_of_auto(const Cell& cell) {
    const Row* automatic = internal::find_row(cell, "auto");
    if (automatic == nullptr) return {};
    const std::string where = escaped(cell.scene) + " on " + escaped(cell.backend);
    const auto line = [&](const Row& row, const std::string& verdict) {
        return fmt::format(
            "<tr><td>{}</td><td class=\"{}\">{}</td><td>{}{}</td><td>{}</td><td class=\"text\">{}"
            "</td></tr>\n",
            where, automatic->errors.wrong_worst == 0 ? "good" : "bad",
            with_commas(automatic->errors.wrong_worst), internal::marker_svg(row.family),
            escaped(row.technique), internal::ratio_text(row.against_auto), verdict);
    };
    std::string text;
    for (const std::size_t i : better_than_auto(cell)) {
        text += line(cell.rows[i], "Faster. " + escaped(cell.rows[i].caveat));
    }
    const Row* rival = nearest_rival(cell);
    if (text.empty() && rival != nullptr) text = line(*rival, verdict(rival->against_auto));
    return text;
}

std::vector<std::string> backends_of(const Report& report) {
    std::vector<std::string> names;
    for (const Cell& cell : report.cells) {
        if (std::ranges::find(names, cell.backend) == names.end()) names.push_back(cell.backend);
    }
    return names;
}

// One sentence a backend.
std::string default_in_short(const Report& report) {
    std::string text;
    for (const std::string& backend : backends_of(report)) {
        std::size_t scenes = 0;
        std::size_t right = 0;
        std::size_t unbeaten = 0;
        for (const Cell& cell : report.cells) {
            const Row* automatic = internal::find_row(cell, "auto");
            if (cell.backend != backend || automatic == nullptr) continue;
            ++scenes;
            if (automatic->errors.wrong_worst == 0) ++right;
            if (better_than_auto(cell).empty()) ++unbeaten;
        }
        text += fmt::format(
            "<p>On <b>{}</b>, <code>auto</code> has no wrong pixel in {} of {} scene{}; nothing "
            "that "
            "is as right is faster in {} of {}.</p>\n",
            escaped(backend), right, scenes, scenes == 1 ? "" : "s", unbeaten, scenes);
    }
    return text;
}

// Figures of every backend against the first's.
std::string backends_compared(const Report& report) {
    const std::vector<std::string> backends = backends_of(report);
    if (backends.size() < 2) return {};
    std::string text = fmt::format(
        "<h2>Do {} agree?</h2>\n<p>gnomon promises the same masks of shadow volumes on each. Maps "
        "and "
        "flattened shadows are left to the rasterisers, which may differ at edges.</p>\n<ul>\n",
        escaped(fmt::format("{}", fmt::join(backends, " and "))));
    for (std::size_t i = 1; i < backends.size(); ++i) {
        std::size_t compared = 0;
        std::string different;
        for (const Cell& first : report.cells) {
            const auto other = std::ranges::find_if(report.cells, [&](const Cell& cell) {
                return cell.scene == first.scene && cell.backend == backends[i];
            });
            if (first.backend != backends[0] || other == report.cells.end()) continue;
            for (const Row& row : first.rows) {
                const Row* there = internal::find_row(*other, row.technique);
                if (!row.skipped.empty() || there == nullptr) continue;
                ++compared;
                if (row.errors == there->errors) continue;
                different += fmt::format("{}<code>{}</code> in {}", different.empty() ? "" : ", ",
                                         escaped(row.technique), escaped(first.scene));
            }
        }
        text += fmt::format("<li>{} and {}: of {} pairs of measurements, {}.</li>\n",
                            escaped(backends[0]), escaped(backends[i]), compared,
                            different.empty() ? std::string("all have the same error figures")
                                              : "all have the same error figures but " + different);
    }
    return text + "</ul>\n";
}

std::string against_auto(const Report& report) {
    std::string text =
        "<h2>Is <code>auto</code> the right default?</h2>\n<p>Only what is as little wrong is "
        "compared. Such a technique and <code>auto</code> are timed frame by frame in turn, in "
        "either order; it counts as faster if the whole 95 % interval of the ratio lies "
        "below 0.95. Where none is, the one that comes closest is listed.</p>\n" +
        default_in_short(report) +
        "<div class=\"scroll\"><table>\n<tr><th>scene</th><th>wrong pixels<br>of auto</th>"
        "<th>rival</th><th>of auto’s time<br>[95 %]</th><th class=\"text\">verdict</th></tr>\n";
    for (const Cell& cell : report.cells) text += rivals_of_auto(cell);
    return text + "</table></div>\n";
}

std::string legend() {
    std::string text;
    for (const std::string_view family : internal::families) {
        text += fmt::format("<span>{}{}</span>", internal::marker_svg(family), family);
    }
    return text;
}

// Frames, degrees, width, height, rounds, their plural, the legend.
constexpr char reading[] = R"(<h2>How to read this page</h2>
<p>A <b>shadow mask</b> says for each pixel and light whether the light arrives. Every technique makes
the masks of the same {} frames, in which the lights turn by {} degrees a frame about the scene’s middle,
at {}×{} pixels. Each mask is held against the truth, which is traced in double precision. A pixel is
<b>wrong</b> if its answer is not the true one, although the true one is the same everywhere within 1/16
pixel of its centre; all others lie on the very edge of a shadow, in the <b>band</b>, where two
rasterisers may rightly differ.</p>
<p>A <b>millisecond</b> counts from the poses to finished masks: finding out what changed, uploading, the
depth of the scene, the shadows. No shading, which would be the same for all. What is drawn is waited for:
how long an empty frame takes stands with each scene, and is part of every time. Techniques took turns for at
least {} round{}, so that what slows the machine down slows all of them; what is wrong and more than three times
as slow as <code>auto</code> was left out after three. Plots show what a
technique took beside <code>auto</code>: its ratio times auto’s median. Left of their coloured line is what
is faster than <code>auto</code>. On their dashed line, marked ◆ in the tables, is what nothing else beats in both;
what is as right as <code>auto</code>, and not faster beyond the 95 % interval, is not.</p>
<p class="legend">{}</p>
)";

std::string how_to_read(const Report& report) {
    const Options& o = report.options;
    return fmt::format(reading, o.frames, fmt::format("{:g}", o.degrees_per_frame), o.width,
                       o.height, o.rounds, o.rounds == 1 ? "" : "s", legend());
}

std::string glossary(const Report& report) {
    std::string text =
        "<h2>The techniques</h2>\n<div class=\"scroll\"><table>\n<tr><th>name</th><th "
        "class=\"text\">"
        "what it does, and what it gives up</th></tr>\n";
    std::set<std::string> seen;
    for (const Cell& cell : report.cells) {
        for (const Row& row : cell.rows) {
            if (!seen.insert(row.technique).second) continue;
            text += fmt::format("<tr><td>{}{}</td><td class=\"text\">{}</td></tr>\n",
                                internal::marker_svg(row.family), escaped(row.technique),
                                escaped(row.summary));
        }
    }
    return text + "</table></div>\n";
}

// One line for those with one reason.
std::string left_out(const Report& report) {
    if (report.left_out.empty()) return {};
    std::map<std::string, std::string> by_reason;
    for (const LeftOut& scene : report.left_out) {
        std::string& scenes = by_reason[scene.reason];
        scenes += fmt::format("{}<b>{}</b> (<code>{}</code>)", scenes.empty() ? "" : ", ",
                              escaped(scene.scene), escaped(scene.source));
    }
    std::string text =
        "<h2>What was left out</h2>\n<p>Scenes of the standard set that are not on this page:</p>"
        "\n<ul>\n";
    for (const auto& [reason, scenes] : by_reason) {
        text += fmt::format("<li>{}: {}.</li>\n", scenes, escaped(reason));
    }
    return text + "</ul>\n";
}

}  // namespace

std::string to_html(const Report& report) {
    std::string page = fmt::format(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
        "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">"
        "<title>Hard shadows: speed against error</title><style>{}</style></head><body>\n"
        "<h1>Hard shadows: speed against error</h1>\n"
        "<p>How long do the usual ways to draw sharp shadows take, and how many pixels do they get "
        "wrong? Measured on the same moving scenes, against ray-traced truth. <b>auto</b> means "
        "gnomon’s shadow volumes as they are drawn unless one asks for something else.</p>\n"
        "<p class=\"small\">gnomon {} · {}, {} cores, {} · <code>{}</code></p>\n",
        style, escaped(report.options.version), escaped(report.machine.processor),
        report.machine.cores, escaped(report.machine.system), escaped(report.command));
    page += internal::advice_html(report) + against_auto(report) + backends_compared(report) +
            how_to_read(report);
    for (const Cell& cell : report.cells) page += internal::cell_html(cell);
    page += glossary(report) + left_out(report);
    return page + "</body></html>\n";
}

}  // namespace gnomon::report
