// SPDX-License-Identifier: MIT
#include "internal/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include <gnomon/report/writers.hpp>

namespace gnomon::report::internal {

namespace {

constexpr double width = 900.0;
constexpr double height = 540.0;
constexpr double left = 70.0;
constexpr double right = 884.0;
constexpr double top = 16.0;
constexpr double one_wrong = 352.0;  // y of one wrong pixel
constexpr double zero_top = 370.0;   // the strip of none
constexpr double zero_bottom = 446.0;
constexpr double radius = 5.0;

struct Axis {
    double low = 0.0;  // logarithms
    double high = 1.0;
    double from = 0.0;  // pixels
    double to = 1.0;
    [[nodiscard]] double operator()(double value) const {
        return from + (std::log10(value) - low) / (high - low) * (to - from);
    }
};

struct Dot {
    std::size_t row = 0;
    double x = 0.0;
    double y = 0.0;
};

struct Rectangle {
    double x0 = 0.0, y0 = 0.0, x1 = 0.0, y1 = 0.0;
    [[nodiscard]] bool meets(const Rectangle& other) const {
        return x0 < other.x1 && other.x0 < x1 && y0 < other.y1 && other.y0 < y1;
    }
};

std::string tick_text(double value) {
    return value >= 1000.0 ? with_commas(static_cast<std::uint64_t>(std::llround(value)))
                           : fmt::format("{:g}", value);
}

// 1, 2, 5 of each decade where there are few decades, else 1 alone.
std::vector<double> ticks(const Axis& axis, double few_decades) {
    std::vector<double> values;
    const bool fine = axis.high - axis.low < few_decades;
    for (int decade = static_cast<int>(std::floor(axis.low)); decade <= axis.high; ++decade) {
        for (const double step : {1.0, 2.0, 5.0}) {
            if (step > 1.0 && !fine) continue;
            const double value = step * std::pow(10.0, decade);
            const double log = std::log10(value);
            if (log >= axis.low - 1e-9 && log <= axis.high + 1e-9) values.push_back(value);
        }
    }
    return values;
}

// A shape a family, so that colours are not needed to tell them apart.
std::string marker(std::string_view family, double x, double y, double r) {
    const auto polygon = [&](std::initializer_list<std::pair<double, double>> corners) {
        std::string path = "M";
        for (const auto& [cx, cy] : corners) {
            path += fmt::format("{:.1f} {:.1f}L", x + cx * r, y + cy * r);
        }
        path.back() = 'Z';
        return fmt::format("<path d=\"{}\"", path);
    };
    if (family == "projection") return polygon({{-.9, -.9}, {.9, -.9}, {.9, .9}, {-.9, .9}});
    if (family == "silhouettes") return polygon({{0, -1.2}, {1.1, .8}, {-1.1, .8}});
    if (family == "approximate") return polygon({{0, -1.25}, {1.25, 0}, {0, 1.25}, {-1.25, 0}});
    if (family == "shadow maps") return polygon({{0, 1.2}, {1.1, -.8}, {-1.1, -.8}});
    if (family == "planar") {
        return polygon({{-.4, -1.2},
                        {.4, -1.2},
                        {.4, -.4},
                        {1.2, -.4},
                        {1.2, .4},
                        {.4, .4},
                        {.4, 1.2},
                        {-.4, 1.2},
                        {-.4, .4},
                        {-1.2, .4},
                        {-1.2, -.4},
                        {-.4, -.4}});
    }
    if (family == "rays") {
        return polygon({{0, -1.3},
                        {.35, -.35},
                        {1.3, 0},
                        {.35, .35},
                        {0, 1.3},
                        {-.35, .35},
                        {-1.3, 0},
                        {-.35, -.35}});
    }
    return fmt::format(
        "<path d=\"M{0:.1f} {1:.1f}a{2:.1f} {2:.1f} 0 1 0 {3:.1f} 0a{2:.1f} {2:.1f} 0 "
        "1 0 -{3:.1f} 0Z\"",
        x - r, y, r, 2.0 * r);
}

bool is_drawn(const Row& row) { return row.skipped.empty() && row.frame_ms.median > 0.0; }

class Plot {
public:
    explicit Plot(const Cell& cell) : cell_(cell) {}
    std::string svg();

private:
    bool scale();
    void place_dots();
    void draw_grid();
    void draw_front();
    void draw_dots();
    void draw_legend();
    void label_all();
    void label(const Dot& dot);
    [[nodiscard]] std::vector<std::size_t> worth_a_label() const;
    [[nodiscard]] bool is_free(const Rectangle& box) const;

    const Cell& cell_;
    Axis x_;
    Axis y_;
    std::vector<Dot> dots_;
    std::vector<Rectangle> taken_;
    std::string svg_;
};

bool Plot::scale() {
    double fastest = 1e300;
    double slowest = 0.0;
    double most = 10.0;
    for (const Row& row : cell_.rows) {
        if (!is_drawn(row)) continue;
        fastest = std::min(fastest, comparable_ms(cell_, row));
        slowest = std::max(slowest, comparable_ms(cell_, row));
        most = std::max(most, static_cast<double>(row.errors.wrong_worst));
    }
    if (!(slowest > 0.0)) return false;
    x_ = {std::log10(fastest * 0.85), std::log10(slowest * 1.25), left + 8.0, right};
    y_ = {0.0, std::log10(most * 1.6), one_wrong, top};
    return true;
}

// Where many have nothing wrong they would lie on each other: they go up and down within the strip.
void Plot::place_dots() {
    for (std::size_t i = 0; i < cell_.rows.size(); ++i) {
        const Row& row = cell_.rows[i];
        if (!is_drawn(row)) continue;
        Dot dot{i, x_(comparable_ms(cell_, row)), 0.0};
        if (row.errors.wrong_worst > 0) {
            dot.y = y_(static_cast<double>(row.errors.wrong_worst));
        } else {
            const double middle = (zero_top + zero_bottom) / 2.0;
            dot.y = middle;
            for (const double away : {0.0, 10.0, -10.0, 20.0, -20.0, 30.0, -30.0}) {
                dot.y = middle + away;
                const bool free = std::ranges::none_of(dots_, [&](const Dot& other) {
                    return std::abs(other.y - dot.y) < 2.0 * radius &&
                           std::abs(other.x - dot.x) < 2.0 * radius;
                });
                if (free) break;
            }
        }
        dots_.push_back(dot);
        taken_.push_back({dot.x - radius, dot.y - radius, dot.x + radius, dot.y + radius});
    }
}

void Plot::draw_grid() {
    svg_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"#e6f3ec\"/>\n",
                        left, zero_top, right - left, zero_bottom - zero_top);
    for (const double value : ticks(x_, 3.2)) {
        svg_ += fmt::format(
            "<line x1=\"{0:.1f}\" y1=\"{1}\" x2=\"{0:.1f}\" y2=\"{2}\" "
            "class=\"grid\"/><text x=\"{0:.1f}\" y=\"{3}\" "
            "text-anchor=\"middle\">{4}</text>\n",
            x_(value), top, zero_bottom, zero_bottom + 17.0, tick_text(value));
    }
    for (const double value : ticks(y_, 1.5)) {
        svg_ += fmt::format(
            "<line x1=\"{0}\" y1=\"{1:.1f}\" x2=\"{2}\" y2=\"{1:.1f}\" "
            "class=\"grid\"/><text x=\"{3}\" y=\"{4:.1f}\" "
            "text-anchor=\"end\">{5}</text>\n",
            left, y_(value), right, left - 7.0, y_(value) + 4.0, tick_text(value));
    }
    svg_ += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\" class=\"axis\">none</text>\n",
                        left - 7.0, (zero_top + zero_bottom) / 2.0 + 4.0);
    svg_ += fmt::format(
        "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\" class=\"axis\">"
        "milliseconds a frame, beside auto · further left is faster</text>\n",
        (left + right) / 2.0, zero_bottom + 38.0);
    svg_ += fmt::format(
        "<text transform=\"translate(14 {}) rotate(-90)\" text-anchor=\"middle\" "
        "class=\"axis\">wrong pixels (worst frame) · lower is better</text>\n",
        (top + zero_bottom) / 2.0);
}

void Plot::draw_front() {
    const auto dot_of = [&](std::size_t row) { return std::ranges::find(dots_, row, &Dot::row); };
    std::string path;
    double last_y = top;
    for (const std::size_t row : pareto_front(cell_)) {
        const auto dot = dot_of(row);
        if (dot == dots_.end()) continue;
        path += path.empty() ? fmt::format("M{:.1f} {:.1f}L", dot->x, top)
                             : fmt::format("L{:.1f} {:.1f}L", dot->x, last_y);
        path += fmt::format("{:.1f} {:.1f}", dot->x, dot->y);
        last_y = dot->y;
    }
    if (path.empty()) return;
    path += fmt::format("L{} {:.1f}", right, last_y);
    svg_ += fmt::format("<path d=\"{}\" class=\"pareto\"/>\n", path);
}

void Plot::draw_dots() {
    for (const Dot& dot : dots_) {
        const Row& row = cell_.rows[dot.row];
        const bool is_auto = row.technique == "auto";
        svg_ += fmt::format(
            "{} fill=\"{}\" stroke=\"{}\" stroke-width=\"{}\">"
            "<title>{}: {} ms, {} wrong</title></path>\n",
            marker(row.family, dot.x, dot.y, is_auto ? radius + 2.5 : radius),
            family_color(row.family), is_auto ? "#000" : "#fff", is_auto ? 2 : 1,
            escaped(row.technique), three_digits(comparable_ms(cell_, row)),
            with_commas(row.errors.wrong_worst));
    }
}

void Plot::draw_legend() {
    double x = left;
    for (const std::string_view family : families) {
        const bool there = std::ranges::any_of(
            dots_, [&](const Dot& dot) { return cell_.rows[dot.row].family == family; });
        if (!there) continue;
        svg_ += fmt::format("{} fill=\"{}\"/><text x=\"{:.1f}\" y=\"{}\">{}</text>\n",
                            marker(family, x + 6.0, height - 16.0, radius), family_color(family),
                            x + 16.0, height - 12.0, family);
        x += 34.0 + 6.4 * static_cast<double>(family.size());
    }
}

// "auto", what nothing beats, and of each family the least wrong and the fastest.
std::vector<std::size_t> Plot::worth_a_label() const {
    std::vector<std::size_t> rows;
    const auto add = [&](std::size_t row) {
        if (std::ranges::find(rows, row) == rows.end()) rows.push_back(row);
    };
    if (!cell_.rows.empty() && is_drawn(cell_.rows[0])) add(0);
    for (const std::size_t row : pareto_front(cell_)) add(row);
    struct Best {
        std::optional<std::size_t> least, fastest;
    };
    std::map<std::string, Best> best;
    for (const Dot& dot : dots_) {
        const Row& row = cell_.rows[dot.row];
        Best& b = best[row.family];
        const auto wrong = [&](const Row& r) {
            return std::pair(r.errors.wrong_worst, comparable_ms(cell_, r));
        };
        if (!b.least || wrong(row) < wrong(cell_.rows[*b.least])) b.least = dot.row;
        if (!b.fastest ||
            comparable_ms(cell_, row) < comparable_ms(cell_, cell_.rows[*b.fastest])) {
            b.fastest = dot.row;
        }
    }
    for (const auto& [family, b] : best) {
        if (family == "volumes" || family == "silhouettes") continue;
        add(*b.least);
        add(*b.fastest);
    }
    // The most wrong and the slowest of all: what lies at the edges of a picture is asked about.
    const auto by = [&](auto&& value) {
        return std::ranges::max_element(dots_, {},
                                        [&](const Dot& dot) { return value(cell_.rows[dot.row]); });
    };
    if (!dots_.empty()) {
        add(by([](const Row& r) { return r.errors.wrong_worst; })->row);
        add(by([&](const Row& r) { return comparable_ms(cell_, r); })->row);
    }
    return rows;
}

bool Plot::is_free(const Rectangle& box) const {
    return box.x0 > left && box.x1 < width - 2.0 && box.y0 > 0.0 && box.y1 < zero_bottom &&
           std::ranges::none_of(taken_, [&](const Rectangle& other) { return box.meets(other); });
}

// Beside its dot where there is room, else at the end of a line; nowhere if there is none at all.
void Plot::label(const Dot& dot) {
    const std::string& text = cell_.rows[dot.row].technique;
    const double text_width = 6.5 * static_cast<double>(text.size());
    struct Place {
        double dx, dy;
        const char* anchor;
    };
    std::vector<Place> places{
        {11.0, 4.0, "start"}, {-11.0, 4.0, "end"}, {0.0, -12.0, "middle"}, {0.0, 20.0, "middle"}};
    for (const double away : {22.0, 36.0, 50.0, 66.0, 84.0, 104.0}) {
        places.push_back({away * 0.7, -away * 0.7, "start"});
        places.push_back({-away * 0.7, -away * 0.7, "end"});
        places.push_back({0.0, -away, "middle"});
        places.push_back({away * 0.7, away * 0.7, "start"});
        places.push_back({-away * 0.7, away * 0.7, "end"});
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto& [dx, dy, anchor] = places[i];
        const double x = dot.x + dx;
        const double y = dot.y + dy;
        const double x0 = *anchor == 's' ? x : *anchor == 'e' ? x - text_width : x - text_width / 2;
        const Rectangle box{x0 - 1.0, y - 11.0, x0 + text_width + 1.0, y + 3.0};
        if (!is_free(box)) continue;
        taken_.push_back(box);
        if (i >= 4) {
            svg_ += fmt::format(
                "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" "
                "class=\"leader\"/>\n",
                dot.x, dot.y, x, dy < 0.0 ? y + 3.0 : y - 9.0);
        }
        svg_ += fmt::format(
            "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" class=\"name\">{}</text>\n", x, y,
            anchor, escaped(text));
        return;
    }
}

void Plot::label_all() {
    for (const std::size_t row : worth_a_label()) {
        const auto dot = std::ranges::find(dots_, row, &Dot::row);
        if (dot != dots_.end()) label(*dot);
    }
}

std::string Plot::svg() {
    if (!scale()) return {};
    svg_ = fmt::format(
        "<svg class=\"plot\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"Milliseconds against "
        "wrong pixels in {} on {}\">\n",
        width, height, escaped(cell_.scene), escaped(cell_.backend));
    place_dots();
    draw_grid();
    draw_front();
    label_all();
    draw_dots();
    draw_legend();
    return svg_ + "</svg>\n";
}

}  // namespace

// After M. Okabe and K. Ito's palette for all kinds of sight.
std::string_view family_color(std::string_view family) {
    constexpr std::array<std::string_view, 7> colors{"#d55e00", "#e69f00", "#cc79a7", "#009e73",
                                                     "#0072b2", "#56b4e9", "#000000"};
    static_assert(colors.size() == families.size());
    for (std::size_t i = 0; i < families.size(); ++i) {
        if (families[i] == family) return colors[i];
    }
    return "#808080";
}

std::string marker_svg(std::string_view family) {
    return fmt::format(
        "<svg class=\"mark\" viewBox=\"-8 -8 16 16\" aria-hidden=\"true\">{} fill=\"{}\"/></svg>",
        marker(family, 0.0, 0.0, 5.5), family_color(family));
}

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        switch (c) {
            case '&': out += "&amp;"; break;
            case '<': out += "&lt;"; break;
            case '>': out += "&gt;"; break;
            case '"': out += "&quot;"; break;
            case '\'': out += "&#39;"; break;
            default: out += c;
        }
    }
    return out;
}

std::string three_digits(double value) {
    if (!std::isfinite(value)) return "∞";
    if (value >= 99.95) return fmt::format("{:.0f}", value);
    if (value >= 9.995) return fmt::format("{:.1f}", value);
    if (value == 0.0) return "0";
    return value >= 0.0095 ? fmt::format("{:.2f}", value) : fmt::format("{:.1g}", value);
}

std::string with_commas(std::uint64_t value) {
    std::string text = std::to_string(value);
    for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, ",");
    return text;
}

std::string plot_svg(const Cell& cell) { return Plot(cell).svg(); }

}  // namespace gnomon::report::internal
