// SPDX-License-Identifier: MIT
//
// What to use for which kind of place. Every sentence with a figure is made from the figures.
#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <gnomon/report/writers.hpp>

#include "internal/page_parts.hpp"
#include "internal/plot.hpp"

namespace gnomon::report::internal {

namespace {

bool is_hardly_wrong_and_faster(const Row& row) {
    return row.skipped.empty() && row.technique != "auto" &&
           row.errors.wrong_share_worst <= hardly_wrong && row.against_auto.high < 0.95;
}

/// Cells of one backend.
struct Group {
    std::string backend;
    Cells cells;
};

std::vector<Group> by_backend(const Cells& cells) {
    std::vector<Group> groups;
    for (const Cell* cell : cells) {
        auto group = std::ranges::find(groups, cell->backend, &Group::backend);
        if (group == groups.end()) group = groups.insert(group, {cell->backend, {}});
        group->cells.push_back(cell);
    }
    return groups;
}

// What is said of each backend; once where it is the same of all.
template <class Say>
std::string of_each(const std::vector<Group>& groups, Say&& say) {
    std::vector<std::string> texts;
    for (const Group& group : groups) texts.push_back(say(group.cells));
    const bool are_equal =
        std::ranges::all_of(texts, [&](const std::string& text) { return text == texts.front(); });
    if (are_equal) return texts.front();
    std::string text;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        text += fmt::format("{}<b>{}</b>: {}", i > 0 ? "<br>" : "", escaped(groups[i].backend),
                            texts[i]);
    }
    return text;
}

// Techniques that are as little wrong and faster: where, and why they are not the default.
std::string rivals(const Cells& cells) {
    struct Rival {
        const Row* row = nullptr;
        std::string where;
    };
    std::vector<Rival> found;
    for (const Cell* cell : cells) {
        for (const std::size_t i : better_than_auto(*cell)) {
            const Row& row = cell->rows[i];
            auto rival = std::ranges::find_if(
                found, [&](const Rival& r) { return r.row->technique == row.technique; });
            if (rival == found.end()) rival = found.insert(found.end(), {&row, {}});
            rival->where +=
                fmt::format("{}{:.2f} of its time in {}", rival->where.empty() ? "" : ", ",
                            row.against_auto.mean, escaped(cell->scene));
        }
    }
    if (found.empty()) return "Nothing was found that is faster by more than 5 %.";
    std::string text;
    for (const auto& [row, where] : found) {
        text += fmt::format("{}<code>{}</code> ({}). {}", text.empty() ? "" : " ",
                            escaped(row->technique), where, escaped(row->caveat));
    }
    return text;
}

// What is faster in every one of the measurements, and at most hardly wrong; the fastest of those.
std::string cheaper(const Cells& cells) {
    const Row* best = nullptr;
    double best_ratio = 1.0;
    double worst_share = 0.0;
    for (const Row& candidate : cells.front()->rows) {
        double logs = 0.0;
        double share = 0.0;
        const bool everywhere = std::ranges::all_of(cells, [&](const Cell* cell) {
            const Row* row = find_row(*cell, candidate.technique);
            if (row == nullptr || !is_hardly_wrong_and_faster(*row)) return false;
            logs += std::log(row->against_auto.mean);
            share = std::max(share, row->errors.wrong_share_worst);
            return true;
        });
        const double ratio = std::exp(logs / static_cast<double>(cells.size()));
        if (!everywhere || ratio >= best_ratio) continue;
        best = &candidate;
        best_ratio = ratio;
        worst_share = share;
    }
    if (best == nullptr) {
        return "Nothing that is wrong in at most 1 pixel of 1,000 is faster in each of these "
               "scenes.";
    }
    return fmt::format(
        "<code>{}</code> takes {:.0f} % of its time and gets at most {} of the "
        "pixels wrong. {}",
        escaped(best->technique), best_ratio * 100.0, percent(worst_share), escaped(best->summary));
}

std::string maps_instead(const Cells& cells) {
    double fewest = 1e300;
    double most = 0.0;
    double least_times = 1e300;
    double most_times = 0.0;
    for (const Cell* cell : cells) {
        const Row* map = least_wrong(*cell, "shadow maps");
        if (map == nullptr) continue;
        fewest = std::min(fewest, static_cast<double>(map->errors.wrong_worst));
        most = std::max(most, static_cast<double>(map->errors.wrong_worst));
        least_times = std::min(least_times, map->against_auto.mean);
        most_times = std::max(most_times, map->against_auto.mean);
    }
    if (most_times == 0.0) return "None was measured.";
    const auto range = [](double a, double b, auto&& text) {
        return text(a) == text(b) ? text(a) : text(a) + " to " + text(b);
    };
    return fmt::format(
        "The least wrong map gets {} pixels wrong and takes {} times as long here.",
        range(fewest, most, [](double v) { return with_commas(static_cast<std::uint64_t>(v)); }),
        range(least_times, most_times, [](double v) { return fmt::format("{:.2g}", v); }));
}

// The same scene on all backends; the first one's choice of techniques.
std::string short_table(const Cells& same_scene) {
    const bool several = same_scene.size() > 1;
    std::string text = "<table><tr><th>technique</th>";
    for (const Cell* cell : same_scene) {
        text += several ? fmt::format("<th>ms,<br>{}</th>", escaped(cell->backend))
                        : std::string("<th>ms</th>");
    }
    text += "<th>wrong<br>pixels</th><th>of all</th></tr>\n";
    for (const std::size_t place : rivals_of_each_kind(*same_scene.front())) {
        const Row& first = same_scene.front()->rows[place];
        text +=
            fmt::format("<tr><td>{}{}</td>", marker_svg(first.family), escaped(first.technique));
        std::uint64_t wrong = 0;
        double share = 0.0;
        for (const Cell* cell : same_scene) {
            const Row* row = find_row(*cell, first.technique);
            text += fmt::format("<td>{}</td>", row == nullptr
                                                   ? std::string("–")
                                                   : three_digits(comparable_ms(*cell, *row)));
            if (row == nullptr) continue;
            wrong = std::max(wrong, row->errors.wrong_worst);
            share = std::max(share, row->errors.wrong_share_worst);
        }
        text += fmt::format("<td class=\"{}\">{}</td><td>{}</td></tr>\n",
                            wrong == 0 ? "good" : "bad", with_commas(wrong), percent(share));
    }
    return text + "</table>\n";
}

std::string pictures(const Cell& cell) {
    std::string text = "<div class=\"pair\">";
    text += fmt::format("<figure>{}<figcaption>the true shadows</figcaption></figure>",
                        image_html(cell.truth, "true shadows in " + cell.scene));
    const Row* map = least_wrong(cell, "shadow maps");
    if (map != nullptr && map->errors.wrong_worst > 0) {
        text += fmt::format(
            "<figure>{}<figcaption>where <code>{}</code> is wrong</figcaption>"
            "</figure>",
            image_html(map->difference, "errors of " + map->technique), escaped(map->technique));
    }
    return text + "</div>\n";
}

struct Place {
    Kind kind;
    const char* title;
    const char* words;
};
constexpr Place places[] = {
    {Kind::Indoor, "An indoor game",
     "Lamps stand among the things they light, so that shadows fall in all directions and the "
     "camera stands in them. A shadow map may need up to six pictures a lamp."},
    {Kind::Outdoor, "A city in the sun",
     "One light, very far away, and many casters over a wide ground. A shadow map has to cover all "
     "that is seen of it."},
    {Kind::Hero, "A single hero object",
     "One caster that the camera looks at closely, where a jagged edge is what everybody sees."},
    {Kind::Other, "Other scenes", "Whatever else was measured."}};

std::string card(const Place& place, const Cells& cells) {
    const std::vector<Group> groups = by_backend(cells);
    std::string text = fmt::format("<div class=\"card\"><h3>{}</h3><p class=\"small\">{}</p>\n",
                                   place.title, place.words);
    text += fmt::format("<p class=\"verdict\">{}</p>\n", of_each(groups, [](const Cells& some) {
                            const Recommendation advice = recommend(some);
                            return advice.technique.empty() ? std::string("Nothing was measured.")
                                                            : advice.reason;
                        }));
    text += fmt::format(
        "<ul><li><b>As right, and faster?</b> {}</li>\n"
        "<li><b>Cheaper, and a little wrong?</b> {}</li>\n"
        "<li><b>Shadow maps instead?</b> {}</li></ul>\n",
        of_each(groups, rivals), of_each(groups, cheaper), of_each(groups, maps_instead));
    std::set<std::string> shown;
    for (const Cell* cell : cells) {
        if (!shown.insert(cell->scene).second) continue;
        Cells same_scene;
        std::vector<std::string> backends;
        for (const Cell* other : cells) {
            if (other->scene != cell->scene) continue;
            same_scene.push_back(other);
            backends.push_back(escaped(other->backend));
        }
        text +=
            fmt::format("<h4>{} <span class=\"small\">({})</span></h4>\n{}{}", escaped(cell->scene),
                        fmt::join(backends, ", "), pictures(*cell), short_table(same_scene));
    }
    return text + "</div>\n";
}

}  // namespace

std::string advice_html(const Report& report) {
    std::string text = "<h2>What to use</h2>\n";
    std::set<std::string> software;
    std::set<std::string> all;
    for (const Cell& cell : report.cells) {
        all.insert(cell.backend);
        if (draws_in_software(cell.adapter)) software.insert(cell.backend);
    }
    text += fmt::format(
        "<p class=\"small\">Milliseconds are those of this machine{}; on another one, measure "
        "again, by one command. Errors hardly depend on the machine.</p>\n",
        software.empty()
            ? std::string()
            : fmt::format(", where no graphics chip but a program on the processor draws{}. It "
                          "fills pixels slowly, so that large shadow maps look dearer than they "
                          "are on a graphics chip",
                          software.size() < all.size()
                              ? fmt::format(" on {}", fmt::join(software, " and "))
                              : std::string()));
    text += "<div class=\"cards\">\n";
    for (const Place& place : places) {
        Cells cells;
        for (const Cell& cell : report.cells) {
            if (cell.kind == place.kind) cells.push_back(&cell);
        }
        if (!cells.empty()) text += card(place, cells);
    }
    return text + "</div>\n";
}

}  // namespace gnomon::report::internal
