// SPDX-License-Identifier: MIT
//
// The little languages of the command line: sizes, vectors, lights, motions. Each parser takes what
// the user wrote and gives a value or one sentence that names it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <glm/glm.hpp>

#include <gnomon/core/result.hpp>
#include <gnomon/render/renderer.hpp>
#include <gnomon/shadows/receiver.hpp>

namespace gnomon::cli {

struct Size {
    std::uint32_t width = 1280;
    std::uint32_t height = 720;
};

/// Coordinates and distances beyond it are refused: their squares must fit into a double.
inline constexpr double largest_coordinate = 1e30;
/// Shorter vectors have no direction.
inline constexpr double smallest_length = 1e-30;

/// `point:x,y,z[,range=R]` or `dir:x,y,z`, the way the light travels.
struct LightArgument {
    bool directional = false;
    glm::dvec3 value{0.0};
    std::optional<double> range_m = std::nullopt;
};

enum class MotionKind { Static, Camera, Light, Casters, Time };
struct Motion {
    MotionKind kind = MotionKind::Static;
    double degrees = 1.0;       ///< per frame
    std::uint32_t casters = 0;  ///< how many turn
    double seconds = 0.0;       ///< that the scene's animations advance per frame
};

[[nodiscard]] Result<double> parse_number(std::string_view text, std::string_view what);
/// A number from min to max, both included.
[[nodiscard]] Result<double> parse_number(std::string_view text, std::string_view what, double min,
                                          double max);
[[nodiscard]] Result<glm::dvec3> parse_vector(std::string_view text, std::string_view what);
[[nodiscard]] Result<Size> parse_size(std::string_view text);
[[nodiscard]] Result<LightArgument> parse_light(std::string_view text);
[[nodiscard]] Result<Motion> parse_motion(std::string_view text);
[[nodiscard]] Result<render::Overlays> parse_overlays(std::string_view text);
/// What is named is left out: view-cull, receiver-cull, umbra-cull, clamp, scissor,
/// depth-bounds, or all of them.
[[nodiscard]] Result<shadows::FillOptions> parse_without(std::string_view text);

/// `text` with every control character made a space: names in files may hold line breaks and
/// terminal codes, and a message is one line.
[[nodiscard]] inline std::string one_line(std::string text) {
    for (char& c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte == 0x7F) c = ' ';
    }
    return text;
}

}  // namespace gnomon::cli
