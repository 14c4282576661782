// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>

#include <glm/glm.hpp>

namespace gnomon::game {

/// "1280x720": two whole numbers from 1 to 16384.
[[nodiscard]] inline std::optional<glm::uvec2> size_from_text(std::string_view text) {
    const auto read = [](std::string_view number, std::uint32_t& value) {
        const char* end = number.data() + number.size();
        const auto [stop, error] = std::from_chars(number.data(), end, value);
        return error == std::errc{} && stop == end && value >= 1 && value <= 16384;
    };
    const std::size_t cross = text.find('x');
    glm::uvec2 size(0);
    if (cross == std::string_view::npos || !read(text.substr(0, cross), size.x) ||
        !read(text.substr(cross + 1), size.y)) {
        return std::nullopt;
    }
    return size;
}

}  // namespace gnomon::game
