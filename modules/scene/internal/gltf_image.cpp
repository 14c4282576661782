// SPDX-License-Identifier: MIT
#include "internal/gltf_image.hpp"

#include <array>
#include <cstring>
#include <optional>

#include <fmt/format.h>

#include "internal/data_uri.hpp"
#include "internal/json_place.hpp"

namespace gnomon::scene::internal {
namespace {

constexpr std::uint64_t most_pixels = std::uint64_t{1} << 26U;
/// Neither format packs more pixels into a byte: deflate gains at most 1032 times, over one-bit
/// pixels.
constexpr std::uint64_t most_pixels_per_byte = 8 * 1032;

struct Size {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

std::uint32_t read_big_endian(std::span<const std::byte> bytes, std::size_t offset,
                              std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
        value = (value << 8U) | std::to_integer<std::uint32_t>(bytes[offset + i]);
    }
    return value;
}

std::optional<Size> png_size(std::span<const std::byte> bytes) {
    constexpr std::array<unsigned char, 8> signature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    if (bytes.size() < 24 || std::memcmp(bytes.data(), signature.data(), signature.size()) != 0) {
        return std::nullopt;
    }
    return Size{read_big_endian(bytes, 16, 4), read_big_endian(bytes, 20, 4)};
}

std::optional<Size> jpeg_size(std::span<const std::byte> bytes) {
    if (bytes.size() < 4 || read_big_endian(bytes, 0, 2) != 0xFFD8) return std::nullopt;
    std::size_t at = 2;
    while (at + 9 <= bytes.size()) {
        if (read_big_endian(bytes, at, 1) != 0xFF) return std::nullopt;
        const std::uint32_t marker = read_big_endian(bytes, at + 1, 1);
        if (marker == 0xFF) {  // a fill byte
            ++at;
            continue;
        }
        const bool is_frame_header =
            marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
        if (is_frame_header) {
            return Size{read_big_endian(bytes, at + 7, 2), read_big_endian(bytes, at + 5, 2)};
        }
        at += 2 + read_big_endian(bytes, at + 2, 2);
    }
    return std::nullopt;
}

std::vector<std::byte> image_bytes(const GltfModel& model, const ImageSource& source,
                                   const std::string& place) {
    if (source.buffer_view >= 0) {
        const auto bytes = view_bytes(model, source.buffer_view);
        return {bytes.begin(), bytes.end()};
    }
    if (is_data_uri(source.uri)) {
        auto decoded = decode_data_uri(source.uri);
        if (!decoded) refuse_input(place, "the data URI is not valid base64");
        return *std::move(decoded);
    }
    const auto path = decode_relative_path(source.uri);
    if (!path) {
        refuse_input(place, fmt::format("the uri \"{:.60}\" is not a path in or below the folder "
                                        "of the file",
                                        source.uri));
    }
    if (!model.folder) refuse_input(place, "other files are not read for a file from memory");
    return read_file(*model.folder / *path, place);
}

Image decode(std::span<const std::byte> bytes, const ImageSource& source,
             const std::string& place) {
    auto size = png_size(bytes);
    if (!size) size = jpeg_size(bytes);
    if (!size) refuse_input(place, "the image is neither a PNG nor a JPEG with a frame header");
    const std::uint64_t pixels = std::uint64_t{size->width} * size->height;
    if (pixels > most_pixels || pixels > bytes.size() * most_pixels_per_byte) {
        refuse_input(place, fmt::format("the image claims {} x {} pixels, which is more than {} "
                                        "bytes can hold or than the limit of {}",
                                        size->width, size->height, bytes.size(), most_pixels));
    }
    tinygltf::Image decoded;
    std::string errors;
    std::string warnings;
    const bool done = tinygltf::LoadImageData(&decoded, 0, &errors, &warnings, 0, 0,
                                              reinterpret_cast<const unsigned char*>(bytes.data()),
                                              static_cast<int>(bytes.size()), nullptr);
    const std::size_t values = static_cast<std::size_t>(pixels) * 4;
    const bool as_expected = done && decoded.component == 4 &&
                             decoded.image.size() == values * (decoded.bits == 16 ? 2 : 1);
    if (!as_expected) refuse_input(place, "the image cannot be decoded");

    Image image{source.name, size->width, size->height, {}};
    if (decoded.bits == 16) {
        image.rgba.resize(values);
        for (std::size_t i = 0; i < values; ++i) {
            std::uint16_t value = 0;
            std::memcpy(&value, &decoded.image[2 * i], sizeof value);
            image.rgba[i] = static_cast<std::uint8_t>(value >> 8U);
        }
    } else {
        image.rgba = std::move(decoded.image);
    }
    return image;
}

}  // namespace

std::shared_ptr<const Image> load_image(const GltfModel& model, std::size_t index,
                                        std::vector<std::string>& messages) {
    const ImageSource& source = model.images[index];
    const std::string place = fmt::format("{}: images[{}]", model.file, index);
    try {
        return std::make_shared<const Image>(
            decode(image_bytes(model, source, place), source, place));
    } catch (const InputError& error) {
        // A picture less is no reason to refuse a scene whose shadows are right without it.
        messages.push_back(error.error.message);
        return nullptr;
    }
}

}  // namespace gnomon::scene::internal
