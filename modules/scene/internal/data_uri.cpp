// SPDX-License-Identifier: MIT
#include "internal/data_uri.hpp"

#include <array>
#include <cstdint>
#include <filesystem>

namespace gnomon::scene::internal {
namespace {

constexpr std::uint8_t no_digit = 255;

constexpr std::array<std::uint8_t, 256> base64_digits = [] {
    std::array<std::uint8_t, 256> digits{};
    for (auto& digit : digits) digit = no_digit;
    constexpr std::string_view alphabet =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < alphabet.size(); ++i) {
        digits[static_cast<unsigned char>(alphabet[i])] = static_cast<std::uint8_t>(i);
    }
    return digits;
}();

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

}  // namespace

bool is_data_uri(std::string_view uri) { return uri.substr(0, 5) == "data:"; }

std::optional<std::vector<std::byte>> decode_data_uri(std::string_view uri) {
    constexpr std::string_view marker = ";base64,";
    const std::size_t start = uri.find(marker);
    if (!is_data_uri(uri) || start == std::string_view::npos || start > 200) return std::nullopt;
    std::string_view text = uri.substr(start + marker.size());
    for (int padding = 0; padding < 2 && !text.empty() && text.back() == '='; ++padding) {
        text.remove_suffix(1);
    }
    if (text.size() % 4 == 1) return std::nullopt;

    std::vector<std::byte> bytes;
    bytes.reserve(text.size() * 3 / 4);
    std::uint32_t bits = 0;
    int bit_count = 0;
    for (const char c : text) {
        const std::uint8_t digit = base64_digits[static_cast<unsigned char>(c)];
        if (digit == no_digit) return std::nullopt;
        bits = (bits << 6U) | digit;
        bit_count += 6;
        if (bit_count >= 8) {
            bit_count -= 8;
            bytes.push_back(
                static_cast<std::byte>((bits >> static_cast<unsigned>(bit_count)) & 0xFFU));
        }
    }
    return bytes;
}

std::optional<std::string> decode_relative_path(std::string_view uri) {
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        char c = uri[i];
        if (c == '%') {
            if (i + 2 >= uri.size()) return std::nullopt;
            const int high = hex_digit(uri[i + 1]);
            const int low = hex_digit(uri[i + 2]);
            if (high < 0 || low < 0) return std::nullopt;
            c = static_cast<char>(high * 16 + low);
            i += 2;
        }
        if (c == '\0' || c == '\\' || c == ':') return std::nullopt;
        path.push_back(c);
    }
    const std::filesystem::path relative(path);
    if (path.empty() || relative.is_absolute()) return std::nullopt;
    for (const auto& part : relative) {
        if (part == "..") return std::nullopt;
    }
    return path;
}

}  // namespace gnomon::scene::internal
