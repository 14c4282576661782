// SPDX-License-Identifier: MIT
//
// The container: glTF 2.0 specification, chapter 4, "GLB File Format Specification".
#include "internal/gltf_file.hpp"

#include <cstring>
#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include "internal/json_place.hpp"

namespace gnomon::scene::internal {
namespace {

constexpr std::uint32_t magic_gltf = 0x46546C67;
constexpr std::uint32_t chunk_json = 0x4E4F534A;
constexpr std::uint32_t chunk_bin = 0x004E4942;

std::uint32_t read_u32(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        value |= std::to_integer<std::uint32_t>(bytes[offset + i]) << (8 * i);
    }
    return value;
}

std::string_view as_text(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

struct Chunk {
    std::uint32_t type = 0;
    std::span<const std::byte> bytes;
    std::size_t end = 0;
};

Chunk read_chunk(std::span<const std::byte> bytes, std::size_t start, const std::string& name) {
    if (bytes.size() - start < 8) {
        refuse_input(name, fmt::format("the chunk at byte {} has {} bytes left for its header of 8",
                                       start, bytes.size() - start));
    }
    const std::uint32_t length = read_u32(bytes, start);
    const std::size_t room = bytes.size() - start - 8;
    if (length > room) {
        refuse_input(name, fmt::format("the chunk at byte {} claims {} bytes, but only {} follow",
                                       start, length, room));
    }
    return {read_u32(bytes, start + 4), bytes.subspan(start + 8, length), start + 8 + length};
}

}  // namespace

std::vector<std::byte> read_file(const std::filesystem::path& path, const std::string& asked_by) {
    const auto refuse = [&](const std::string& why) {
        refuse_input(asked_by, fmt::format("the file \"{}\" {}", path.string(), why),
                     ErrorCode::Io);
    };
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) refuse("does not exist");
    if (!std::filesystem::is_regular_file(status)) refuse("is not a regular file");
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error) refuse("cannot be read: " + error.message());
    if (size > largest_file) {
        refuse(fmt::format("has {} bytes, but at most {} are read", size, largest_file));
    }
    std::vector<std::byte> bytes(static_cast<std::size_t>(size));
    std::ifstream stream(path, std::ios::binary);
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (!stream) refuse("cannot be read");
    return bytes;
}

GltfFile take_apart(std::span<const std::byte> bytes, const std::string& name) {
    if (bytes.size() > largest_file) {
        refuse_input(name, fmt::format("the file has {} bytes, but at most {} are read",
                                       bytes.size(), largest_file));
    }
    if (bytes.empty()) refuse_input(name, "the file is empty");
    GltfFile file;
    file.name = name;
    if (bytes.size() < 4 || read_u32(bytes, 0) != magic_gltf) {
        file.json = parse_json(as_text(bytes), name);
        return file;
    }
    if (bytes.size() < 12) {
        refuse_input(name, fmt::format("the file has {} bytes, but the header of a .glb has 12",
                                       bytes.size()));
    }
    if (const std::uint32_t version = read_u32(bytes, 4); version != 2) {
        refuse_input(name, fmt::format("the header's version is {}, but must be 2", version));
    }
    const std::uint32_t length = read_u32(bytes, 8);
    if (length < 12 || length > bytes.size()) {
        refuse_input(name, fmt::format("the header's length is {}, but must be from 12 to {}, the "
                                       "size of the file",
                                       length, bytes.size()));
    }
    bytes = bytes.first(length);

    const Chunk json = read_chunk(bytes, 12, name);
    if (json.type != chunk_json) {
        refuse_input(
            name, fmt::format("the first chunk's type is {:#010x}, but must be JSON", json.type));
    }
    file.json = parse_json(as_text(json.bytes), name);
    if (json.end < bytes.size()) {
        const Chunk binary = read_chunk(bytes, json.end, name);
        if (binary.type == chunk_bin) {
            file.binary_chunk.emplace(binary.bytes.begin(), binary.bytes.end());
        }
    }
    return file;
}

}  // namespace gnomon::scene::internal
