// SPDX-License-Identifier: MIT
#include "internal/plot.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include <gnomon/report/writers.hpp>

namespace gnomon::report::internal {

namespace {

constexpr double width = 900.0;
constexpr double left = 128.0;
constexpr double right = 888.0;
constexpr double top = 30.0;
constexpr double one_wrong = 318.0;     // y of one wrong pixel
constexpr double panel_bottom = 330.0;  // of those with wrong pixels
constexpr double lanes_top = 358.0;     // of those with none
constexpr double lane_height = 26.0;
constexpr double room_for_names = 185.0;  // left of the fastest
constexpr double radius = 4.6;
constexpr double letter_width = 7.0;  // of 12 px: no browser is asked
// Scaled to less than this share of a decade, an axis has too few ticks to be read.
constexpr double fewest_decades = 0.7;

struct Axis {
    double low = 0.0;  // logarithms
    double high = 1.0;
    double from = 0.0;  // pixels
    double to = 1.0;
    [[nodiscard]] double operator()(double value) const {
        return from + (std::log10(value) - low) / (high - low) * (to - from);
    }
    [[nodiscard]] double log_at(double pixel) const {
        return low + (pixel - from) / (to - from) * (high - low);
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

/// Where a name may stand beside its dot.
struct NamePlace {
    double dx, dy;
    const char* anchor;
    bool with_line = false;
};

std::string tick_text(double value) {
    return value >= 1000.0 ? with_commas(static_cast<std::uint64_t>(std::llround(value)))
                           : fmt::format("{:.6g}", value);
}

// 1, 2, 5 of each decade where there are few decades, else 1 alone.
std::vector<double> ticks(double low, double high, double few_decades) {
    std::vector<double> values;
    const bool fine = high - low < few_decades;
    for (int decade = static_cast<int>(std::floor(low)); decade <= high; ++decade) {
        for (const double step : {1.0, 2.0, 5.0}) {
            if (step > 1.0 && !fine) continue;
            const double value = step * std::pow(10.0, decade);
            const double log = std::log10(value);
            if (log >= low - 1e-9 && log <= high + 1e-9) values.push_back(value);
        }
    }
    return values;
}

bool is_drawn(const Cell& cell, const Row& row) {
    return row.skipped.empty() && comparable_ms(cell, row) > 0.0;
}

class Plot {
public:
    explicit Plot(const Cell& cell) : cell_(cell) {}
    std::string svg();

private:
    bool scale();
    void place_dots();
    void draw_panel();
    void draw_lanes();
    void draw_auto();
    void draw_front();
    void draw_dots();
    void name(const Dot& dot, bool on_front);
    void name_all();
    [[nodiscard]] const Row& row(const Dot& dot) const { return cell_.rows[dot.row]; }
    [[nodiscard]] bool is_right(const Dot& dot) const { return row(dot).errors.wrong_worst == 0; }
    [[nodiscard]] double lane_of(std::string_view family) const;
    [[nodiscard]] double bottom() const {
        return lanes_top + lane_height * static_cast<double>(lanes_.size());
    }
    [[nodiscard]] bool is_free(const Rectangle& box) const;

    const Cell& cell_;
    Axis x_;
    Axis y_;
    std::vector<std::string_view> lanes_;  // families, downwards
    std::vector<Dot> dots_;
    std::vector<Rectangle> taken_;
    std::string svg_;
};

bool Plot::scale() {
    double fastest = 1e300;
    double slowest = 0.0;
    double most = 10.0;
    for (const Row& row : cell_.rows) {
        if (!is_drawn(cell_, row)) continue;
        fastest = std::min(fastest, comparable_ms(cell_, row));
        slowest = std::max(slowest, comparable_ms(cell_, row));
        most = std::max(most, static_cast<double>(row.errors.wrong_worst));
    }
    if (!(slowest > 0.0)) return false;
    const double low = std::log10(fastest);
    x_ = {low, std::max(std::log10(slowest), low + fewest_decades), left + room_for_names,
          right - 18.0};
    y_ = {0.0, std::log10(most * 1.6), one_wrong, top};
    for (const std::string_view family : families) {
        const bool there = std::ranges::any_of(cell_.rows, [&](const Row& row) {
            return row.family == family && is_drawn(cell_, row);
        });
        if (there) lanes_.push_back(family);
    }
    return true;
}

double Plot::lane_of(std::string_view family) const {
    const auto lane = static_cast<double>(std::ranges::find(lanes_, family) - lanes_.begin());
    return lanes_top + lane_height * (lane + 0.5);
}

// Within a lane many would lie on each other: they go up and down a little. What has a name
// comes first and stays in the middle.
void Plot::place_dots() {
    std::vector<std::size_t> order = worth_a_name(cell_);
    for (std::size_t i = 0; i < cell_.rows.size(); ++i) {
        if (std::ranges::find(order, i) == order.end()) order.push_back(i);
    }
    for (const std::size_t i : order) {
        const Row& row = cell_.rows[i];
        if (!is_drawn(cell_, row)) continue;
        Dot dot{i, x_(comparable_ms(cell_, row)), 0.0};
        if (row.errors.wrong_worst > 0) {
            dot.y = y_(static_cast<double>(row.errors.wrong_worst));
        } else {
            const double middle = lane_of(row.family);
            for (const double away : {0.0, 7.0, -7.0, 0.0}) {
                dot.y = middle + away;
                const bool free = std::ranges::none_of(dots_, [&](const Dot& other) {
                    return std::abs(other.y - dot.y) < 7.0 &&
                           std::abs(other.x - dot.x) < 1.7 * radius;
                });
                if (free) break;
            }
        }
        dots_.push_back(dot);
        taken_.push_back({dot.x - radius, dot.y - radius, dot.x + radius, dot.y + radius});
    }
}

void Plot::draw_panel() {
    for (const double value : ticks(x_.log_at(left), x_.log_at(right), 3.2)) {
        const double x = x_(value);
        svg_ += fmt::format(
            "<path d=\"M{0:.1f} {1}V{2}M{0:.1f} {3}V{4}\" class=\"grid\"/><text x=\"{0:.1f}\" "
            "y=\"{5}\" text-anchor=\"middle\">{6}</text>\n",
            x, top, panel_bottom, lanes_top, bottom(), bottom() + 17.0, tick_text(value));
    }
    for (const double value : ticks(y_.low, y_.high, 1.5)) {
        svg_ += fmt::format(
            "<path d=\"M{0} {1:.1f}H{2}\" class=\"grid\"/><text x=\"{3}\" y=\"{4:.1f}\" "
            "text-anchor=\"end\">{5}</text>\n",
            left, y_(value), right, left - 8.0, y_(value) + 4.0, tick_text(value));
    }
    svg_ += fmt::format(
        "<path d=\"M{0} {1}V{2}H{3}\" class=\"frame\"/><text transform=\"translate(60 {4}) "
        "rotate(-90)\" text-anchor=\"middle\" class=\"axis\">wrong pixels (worst frame)</text>"
        "<text transform=\"translate(78 {4}) rotate(-90)\" text-anchor=\"middle\">lower is better"
        "</text>\n<text x=\"{5}\" y=\"{6}\" text-anchor=\"middle\" class=\"axis\">milliseconds a "
        "frame, beside auto · further left is faster</text>\n",
        left, top, panel_bottom, right, (top + panel_bottom) / 2.0, (left + right) / 2.0,
        bottom() + 38.0);
}

// Their names and marks are the legend of the panel above, too.
void Plot::draw_lanes() {
    svg_ += fmt::format(
        "<text x=\"{}\" y=\"{}\" class=\"axis\" text-anchor=\"start\">no wrong pixel in any frame"
        "</text>\n",
        10.0, lanes_top - 9.0);  // further left than any line may run
    for (std::size_t i = 0; i < lanes_.size(); ++i) {
        const double y = lanes_top + lane_height * static_cast<double>(i);
        svg_ += fmt::format(
            "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>{} fill=\"{}\"/>"
            "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>\n",
            left, y, right - left, lane_height, i % 2 == 0 ? "#e3f1e9" : "#eef7f2",
            marker_shape(lanes_[i], left - 14.0, y + lane_height / 2.0, radius + 0.6),
            family_color(lanes_[i]), left - 27.0, y + lane_height / 2.0 + 4.0, lanes_[i]);
        const bool has_any = std::ranges::any_of(
            dots_, [&](const Dot& dot) { return is_right(dot) && row(dot).family == lanes_[i]; });
        if (has_any) continue;
        svg_ +=
            fmt::format("<text x=\"{}\" y=\"{}\" class=\"muted\">all have wrong pixels</text>\n",
                        left + 10.0, y + lane_height / 2.0 + 4.0);
    }
}

void Plot::draw_auto() {
    const auto dot =
        std::ranges::find_if(dots_, [&](const Dot& d) { return row(d).technique == "auto"; });
    if (dot == dots_.end()) return;
    svg_ += fmt::format(
        "<path d=\"M{0:.1f} {1}V{2}\" class=\"auto\"/><text x=\"{0:.1f}\" y=\"{3}\" "
        "text-anchor=\"middle\" class=\"name\" font-weight=\"600\">auto: {4} ms, {5} "
        "wrong</text>\n",
        dot->x, top - 8.0, bottom(), top - 13.0, three_digits(comparable_ms(cell_, row(*dot))),
        is_right(*dot) ? "none" : with_commas(row(*dot).errors.wrong_worst));
    taken_.push_back({dot->x - 1.0, top, dot->x + 1.0, bottom()});
}

void Plot::draw_front() {
    std::string path;
    double last_x = 0.0;
    double last_y = top;
    for (const std::size_t at : pareto_front(cell_)) {
        const auto dot = std::ranges::find(dots_, at, &Dot::row);
        if (dot == dots_.end()) continue;
        path += path.empty() ? fmt::format("M{:.1f} {:.1f}", dot->x, top)
                             : fmt::format("H{:.1f}", dot->x);
        path += fmt::format("V{:.1f}", dot->y);
        if (last_x > 0.0) taken_.push_back({last_x, last_y - 1.0, dot->x, last_y + 1.0});
        taken_.push_back({dot->x - 1.0, last_y, dot->x + 1.0, dot->y});
        last_x = dot->x;
        last_y = dot->y;
    }
    if (path.empty()) return;
    // Nothing is beyond "none".
    if (last_y < panel_bottom) path += fmt::format("H{}", right);
    svg_ += fmt::format("<path d=\"{}\" class=\"pareto\"/>\n", path);
}

// The others first, then those on the front with a dark rim, "auto" on top.
void Plot::draw_dots() {
    const std::vector<std::size_t> front = pareto_front(cell_);
    const auto weight = [&](const Dot& dot) {
        if (row(dot).technique == "auto") return 2;
        return std::ranges::find(front, dot.row) != front.end() ? 1 : 0;
    };
    for (int layer = 0; layer <= 2; ++layer) {
        for (const Dot& dot : dots_) {
            if (weight(dot) != layer) continue;
            svg_ += fmt::format(
                "{} fill=\"{}\" stroke=\"{}\" stroke-width=\"{}\">"
                "<title>{}: {} ms, {} wrong</title></path>\n",
                marker_shape(row(dot).family, dot.x, dot.y, layer == 2 ? radius + 2.4 : radius),
                family_color(row(dot).family), layer > 0 ? "#000" : "#fff", layer == 2 ? 2 : 1,
                escaped(row(dot).technique), three_digits(comparable_ms(cell_, row(dot))),
                with_commas(row(dot).errors.wrong_worst));
        }
    }
}

bool Plot::is_free(const Rectangle& box) const {
    return box.x0 > left + 2.0 && box.x1 < width - 2.0 && box.y0 > top - 6.0 && box.y1 < bottom() &&
           std::ranges::none_of(taken_, [&](const Rectangle& other) { return box.meets(other); });
}

// Beside its dot where there is room, else, above the lanes, at the end of a line; nowhere if there
// is none at all. Left of the front there is nothing else.
void Plot::name(const Dot& dot, bool on_front) {
    const std::string& text = row(dot).technique;
    const double text_width = letter_width * static_cast<double>(text.size());
    std::vector<NamePlace> places;
    if (on_front) places.push_back({-11.0, 4.0, "end"});
    if (is_right(dot)) {
        for (const double dy : {4.0, lane_of(row(dot).family) - dot.y + 4.0}) {
            places.push_back({-10.0, dy, "end"});
            places.push_back({10.0, dy, "start"});
        }
    } else {
        places.insert(places.end(), {{11.0, 4.0, "start"},
                                     {-11.0, 4.0, "end"},
                                     {0.0, -11.0, "middle"},
                                     {0.0, 20.0, "middle"}});
        for (const double away : {22.0, 34.0, 48.0, 64.0}) {
            places.push_back({away * 0.7, -away * 0.7, "start", true});
            places.push_back({-away * 0.7, -away * 0.7, "end", true});
            places.push_back({away * 0.7, away * 0.7, "start", true});
            places.push_back({-away * 0.7, away * 0.7, "end", true});
        }
    }
    const double lowest = is_right(dot) ? bottom() : panel_bottom;
    for (const auto& [dx, dy, anchor, with_line] : places) {
        const double x = dot.x + dx;
        const double y = dot.y + dy;
        const double x0 = *anchor == 's' ? x : *anchor == 'e' ? x - text_width : x - text_width / 2;
        const Rectangle box{x0 - 2.0, y - 10.0, x0 + text_width + 2.0, y + 2.5};
        if (box.y1 > lowest || !is_free(box)) continue;
        taken_.push_back(box);
        if (with_line) {
            svg_ += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" class=\"leader\"/>\n",
                                dot.x, dot.y, x, dy < 0.0 ? y + 3.0 : y - 9.0);
        }
        svg_ += fmt::format(
            "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" class=\"name\">{}</text>\n", x, y,
            anchor, escaped(text));
        return;
    }
}

void Plot::name_all() {
    const std::vector<std::size_t> front = pareto_front(cell_);
    for (const std::size_t at : worth_a_name(cell_)) {
        const auto dot = std::ranges::find(dots_, at, &Dot::row);
        if (dot != dots_.end()) name(*dot, std::ranges::find(front, at) != front.end());
    }
}

std::string Plot::svg() {
    if (!scale()) return {};
    svg_ = fmt::format(
        "<svg class=\"plot\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"Milliseconds against "
        "wrong pixels in {} on {}\">\n",
        width, bottom() + 48.0, escaped(cell_.scene), escaped(cell_.backend));
    place_dots();
    draw_lanes();
    draw_panel();
    draw_auto();
    draw_front();
    name_all();
    draw_dots();
    return svg_ + "</svg>\n";
}

}  // namespace

std::string plot_svg(const Cell& cell) { return Plot(cell).svg(); }

}  // namespace gnomon::report::internal
