// SPDX-License-Identifier: MIT
//
// How names, numbers and families are written in a page.
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "internal/plot.hpp"

namespace gnomon::report::internal {

// A shape a family, so that colours are not needed to tell them apart.
std::string marker_shape(std::string_view family, double x, double y, double r) {
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
        marker_shape(family, 0.0, 0.0, 5.5), family_color(family));
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
    // Of a time in milliseconds less than ten nanoseconds mean nothing.
    if (value < 5e-6) return "0";
    int decimals = 0;
    for (double limit = 99.95; value < limit && decimals < 5; limit /= 10.0) ++decimals;
    return fmt::format("{:.{}f}", value, decimals);
}

std::string with_commas(std::uint64_t value) {
    std::string text = std::to_string(value);
    for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, ",");
    return text;
}

}  // namespace gnomon::report::internal
