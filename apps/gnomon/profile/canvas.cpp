// SPDX-License-Identifier: MIT
#include "profile/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <cairo.h>

namespace gnomon::cli {

namespace {

void use(cairo_t* cairo, const Color& c) { cairo_set_source_rgba(cairo, c.r, c.g, c.b, c.a); }

std::uint32_t argb(const Color& c) {  // premultiplied, as cairo keeps it
    const auto byte = [&](double v) {
        return static_cast<std::uint32_t>(std::lround(std::clamp(v, 0.0, 1.0) * 255.0));
    };
    return byte(c.a) << 24U | byte(c.r * c.a) << 16U | byte(c.g * c.a) << 8U | byte(c.b * c.a);
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
    const auto* begin = reinterpret_cast<const std::byte*>(data);
    auto& out = *static_cast<std::vector<std::byte>*>(bytes);
    out.insert(out.end(), begin, begin + length);
    return CAIRO_STATUS_SUCCESS;
}

}  // namespace

Color mix(const Color& a, const Color& b, double t) {
    return {a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t,
            a.a + (b.a - a.a) * t};
}

Color ramp(std::span<const Color> colors, double t) {
    const double at = std::clamp(t, 0.0, 1.0) * static_cast<double>(colors.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(at), colors.size() - 2);
    return mix(colors[i], colors[i + 1], at - static_cast<double>(i));
}

struct Canvas::State {
    cairo_surface_t* surface = nullptr;
    cairo_t* cairo = nullptr;
};

void Canvas::Free::operator()(State* state) const {
    cairo_destroy(state->cairo);
    cairo_surface_destroy(state->surface);
    delete state;
}

Canvas::Canvas(std::uint32_t width, std::uint32_t height, const Color& background)
    : state_(new State) {
    state_->surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, static_cast<int>(width),
                                                 static_cast<int>(height));
    state_->cairo = cairo_create(state_->surface);
    use(state_->cairo, background);
    cairo_paint(state_->cairo);
    cairo_set_line_join(state_->cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(state_->cairo, CAIRO_LINE_CAP_ROUND);
}

void Canvas::rectangle(const glm::dvec2& at, const glm::dvec2& size, const Color& color) {
    use(state_->cairo, color);
    cairo_rectangle(state_->cairo, at.x, at.y, size.x, size.y);
    cairo_fill(state_->cairo);
}

void Canvas::frame(const glm::dvec2& at, const glm::dvec2& size, const Color& color, double width) {
    use(state_->cairo, color);
    cairo_set_line_width(state_->cairo, width);
    cairo_rectangle(state_->cairo, at.x, at.y, size.x, size.y);
    cairo_stroke(state_->cairo);
}

void Canvas::segments(std::span<const glm::dvec2> points, const Color& color, double width) {
    use(state_->cairo, color);
    cairo_set_line_width(state_->cairo, width);
    for (std::size_t i = 0; i + 1 < points.size(); i += 2) {
        cairo_move_to(state_->cairo, points[i].x, points[i].y);
        cairo_line_to(state_->cairo, points[i + 1].x, points[i + 1].y);
    }
    cairo_stroke(state_->cairo);
}

void Canvas::path(std::span<const glm::dvec2> points, const Color& color, double width) {
    use(state_->cairo, color);
    cairo_set_line_width(state_->cairo, width);
    for (const glm::dvec2& p : points) cairo_line_to(state_->cairo, p.x, p.y);
    cairo_stroke(state_->cairo);
}

void Canvas::polygon(std::span<const glm::dvec2> points, const Color& color) {
    use(state_->cairo, color);
    for (const glm::dvec2& p : points) cairo_line_to(state_->cairo, p.x, p.y);
    cairo_close_path(state_->cairo);
    cairo_fill(state_->cairo);
}

void Canvas::solid_polygon(std::span<const glm::dvec2> points, const Color& color) {
    cairo_set_antialias(state_->cairo, CAIRO_ANTIALIAS_NONE);
    polygon(points, color);
    cairo_set_antialias(state_->cairo, CAIRO_ANTIALIAS_DEFAULT);
}

void Canvas::circle(const glm::dvec2& center, double radius, const Color& color, double width) {
    use(state_->cairo, color);
    cairo_set_line_width(state_->cairo, width);
    cairo_new_sub_path(state_->cairo);
    cairo_arc(state_->cairo, center.x, center.y, radius, 0.0, 2.0 * std::numbers::pi);
    cairo_stroke(state_->cairo);
}

void Canvas::disc(const glm::dvec2& center, double radius, const Color& color) {
    use(state_->cairo, color);
    cairo_new_sub_path(state_->cairo);
    cairo_arc(state_->cairo, center.x, center.y, radius, 0.0, 2.0 * std::numbers::pi);
    cairo_fill(state_->cairo);
}

void Canvas::text(const glm::dvec2& at, const std::string& text, const TextStyle& style) {
    cairo_t* cairo = state_->cairo;
    cairo_select_font_face(cairo, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo, style.size);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo, text.c_str(), &extents);
    double x = at.x;
    if (style.align == Align::Center) x -= extents.x_advance / 2.0;
    if (style.align == Align::Right) x -= extents.x_advance;
    use(cairo, style.color);
    cairo_move_to(cairo, x, at.y);
    cairo_show_text(cairo, text.c_str());
    cairo_new_path(cairo);
}

void Canvas::cells(const glm::dvec2& at, std::span<const Color> colors, std::uint32_t columns,
                   double scale) {
    const auto width = static_cast<int>(columns);
    const int height = static_cast<int>(colors.size()) / width;
    const int stride = cairo_format_stride_for_width(CAIRO_FORMAT_ARGB32, width);
    std::vector<std::uint32_t> pixels(static_cast<std::size_t>(stride) / 4 *
                                      static_cast<std::size_t>(height));
    for (std::size_t i = 0; i < colors.size(); ++i) {
        pixels[i / columns * static_cast<std::size_t>(stride) / 4 + i % columns] = argb(colors[i]);
    }
    cairo_surface_t* image =
        cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels.data()),
                                            CAIRO_FORMAT_ARGB32, width, height, stride);
    cairo_t* cairo = state_->cairo;
    cairo_save(cairo);
    cairo_translate(cairo, at.x, at.y);
    cairo_scale(cairo, scale, scale);
    cairo_set_source_surface(cairo, image, 0.0, 0.0);
    cairo_pattern_set_filter(cairo_get_source(cairo), CAIRO_FILTER_NEAREST);
    cairo_rectangle(cairo, 0.0, 0.0, width, height);
    cairo_fill(cairo);
    cairo_restore(cairo);
    cairo_surface_destroy(image);
}

Result<std::vector<std::byte>> Canvas::png() const {
    std::vector<std::byte> bytes;
    cairo_surface_flush(state_->surface);
    const cairo_status_t written =
        cairo_surface_write_to_png_stream(state_->surface, append, &bytes);
    const cairo_status_t drawn = cairo_status(state_->cairo);
    const cairo_status_t bad = drawn != CAIRO_STATUS_SUCCESS ? drawn : written;
    if (bad != CAIRO_STATUS_SUCCESS) {
        return fail(ErrorCode::OutOfMemory, std::string("A picture could not be drawn: ") +
                                                cairo_status_to_string(bad) + ".");
    }
    return bytes;
}

}  // namespace gnomon::cli
