// SPDX-License-Identifier: MIT
//
// Canvas: a picture that is drawn on with lines, areas and text, by cairo. Coordinates are pixels,
// x to the right, y down, from the upper left corner.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>

namespace gnomon::cli {

/// sRGB, 0 .. 1, not premultiplied.
struct Color {
    double r = 0.0;
    double g = 0.0;
    double b = 0.0;
    double a = 1.0;

    [[nodiscard]] Color with_alpha(double alpha) const { return {r, g, b, alpha}; }
};

[[nodiscard]] Color mix(const Color& a, const Color& b, double t);
/// The colour at t (0 .. 1) of evenly spaced ones, at least two.
[[nodiscard]] Color ramp(std::span<const Color> colors, double t);

enum class Align : std::uint8_t { Left, Center, Right };

struct TextStyle {
    double size = 14.0;
    Color color{0.13, 0.13, 0.15};
    Align align = Align::Left;
    bool bold = false;
};

class Canvas {
public:
    Canvas(std::uint32_t width, std::uint32_t height, const Color& background);

    void rectangle(const glm::dvec2& at, const glm::dvec2& size, const Color& color);
    void frame(const glm::dvec2& at, const glm::dvec2& size, const Color& color, double width);
    /// From each even point to the one behind it.
    void segments(std::span<const glm::dvec2> points, const Color& color, double width);
    void path(std::span<const glm::dvec2> points, const Color& color, double width);
    void polygon(std::span<const glm::dvec2> points, const Color& color);
    /// Without smooth edges: neighbours leave no seam.
    void solid_polygon(std::span<const glm::dvec2> points, const Color& color);
    void circle(const glm::dvec2& center, double radius, const Color& color, double width);
    void disc(const glm::dvec2& center, double radius, const Color& color);
    /// `at` is on the base line.
    void text(const glm::dvec2& at, const std::string& text, const TextStyle& style = {});
    /// Cells of one colour each, `scale` pixels a side, row 0 on top.
    void cells(const glm::dvec2& at, std::span<const Color> colors, std::uint32_t columns,
               double scale);

    /// Fails with ErrorCode::OutOfMemory where cairo could not draw all of it.
    [[nodiscard]] Result<std::vector<std::byte>> png() const;

private:
    struct State;
    struct Free {
        void operator()(State* state) const;
    };
    std::unique_ptr<State, Free> state_;
};

}  // namespace gnomon::cli
