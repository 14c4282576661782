// SPDX-License-Identifier: MIT
#include "profile/mask_files.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

namespace gnomon::cli {

namespace {

constexpr const char* byte_type = "|u1";
constexpr const char* number_type = "<f8";

// Version 1.0 of the format: the magic word, the header's length, a Python dictionary, blanks up to
// a multiple of 64 bytes.
std::string npy_header(const char* type, std::uint32_t rows, std::uint32_t columns) {
    std::string dictionary = fmt::format(
        "{{'descr': '{}', 'fortran_order': False, 'shape': ({}, {}), }}", type, rows, columns);
    constexpr std::size_t before = 10;
    const std::size_t total = (before + dictionary.size() + 1 + 63) / 64 * 64;
    dictionary.append(total - before - dictionary.size() - 1, ' ');
    dictionary += '\n';
    std::string header("\x93NUMPY\x01\x00", 8);
    header += static_cast<char>(dictionary.size() & 0xFFU);
    header += static_cast<char>(dictionary.size() >> 8U);
    return header + dictionary;
}

// Ones and zeros as the bits of a byte, the first of them the highest.
char byte_of(const std::uint8_t* cells, std::uint32_t count) {
    static_assert(std::endian::native == std::endian::little);
    std::uint64_t eight = 0;
    std::memcpy(&eight, cells, count);
    // Moves the i-th byte's lowest bit to bit 63 - i; no two of the products share a bit.
    return static_cast<char>(eight * 0x8040201008040201ULL >> 56U);
}

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

std::string number_matrix(std::span<const double> numbers, std::uint32_t columns) {
    static_assert(std::endian::native == std::endian::little);
    std::string bytes =
        npy_header(number_type, static_cast<std::uint32_t>(numbers.size() / columns), columns);
    bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes());
    return bytes;
}

namespace {

Result<std::vector<double>> numbers_in(const std::string& bytes, const std::filesystem::path& path,
                                       std::uint32_t columns, std::uint32_t rows) {
    if (bytes.empty()) return fail(ErrorCode::Io, fmt::format("{} cannot be read.", path.string()));
    const std::string header = npy_header(number_type, rows, columns);
    const std::size_t count = std::size_t{rows} * columns;
    if (!bytes.starts_with(header) || bytes.size() != header.size() + count * 8) {
        return fail(ErrorCode::InvalidInput, fmt::format("{} is no matrix of {} x {} numbers.",
                                                         path.string(), rows, columns));
    }
    std::vector<double> numbers(count);
    std::memcpy(numbers.data(), bytes.data() + header.size(), numbers.size() * 8);
    return numbers;
}

}  // namespace

Result<std::vector<double>> read_numbers(const std::filesystem::path& path, std::uint32_t columns,
                                         std::uint32_t rows) {
    return numbers_in(bytes_of(path), path, columns, rows);
}

Result<std::vector<double>> read_all_numbers(const std::filesystem::path& path,
                                             std::uint32_t columns) {
    const std::string bytes = bytes_of(path);
    // Headers of all row counts have one length.
    const std::size_t header = npy_header(number_type, 0, columns).size();
    const std::size_t rows = bytes.size() < header ? 0 : (bytes.size() - header) / (8UL * columns);
    return numbers_in(bytes, path, columns, static_cast<std::uint32_t>(rows));
}

std::string packed_mask(const sun_study::PlanMask& mask, std::uint32_t columns,
                        std::uint32_t rows) {
    const std::uint32_t bytes_a_row = (columns + 7) / 8;
    std::string bytes = npy_header(byte_type, rows, bytes_a_row);
    const std::size_t begin = bytes.size();
    bytes.resize(begin + std::size_t{bytes_a_row} * rows, '\0');
    for (std::uint32_t row = 0; row < rows; ++row) {
        const std::uint8_t* cell = mask.data() + std::size_t{row} * columns;
        char* byte = bytes.data() + begin + std::size_t{row} * bytes_a_row;
        for (std::uint32_t left = columns; left > 0;) {
            const std::uint32_t count = std::min(left, 8U);
            *byte++ = byte_of(cell, count);
            cell += count;
            left -= count;
        }
    }
    return bytes;
}

Result<sun_study::PlanMask> read_mask(const std::filesystem::path& path, std::uint32_t columns,
                                      std::uint32_t rows) {
    const std::string bytes = bytes_of(path);
    if (bytes.empty()) return fail(ErrorCode::Io, fmt::format("{} cannot be read.", path.string()));
    const std::uint32_t bytes_a_row = (columns + 7) / 8;
    const std::string header = npy_header(byte_type, rows, bytes_a_row);
    if (!bytes.starts_with(header) ||
        bytes.size() != header.size() + std::size_t{bytes_a_row} * rows) {
        return fail(ErrorCode::InvalidInput,
                    fmt::format("{} is no mask of {} x {} cells.", path.string(), columns, rows));
    }
    sun_study::PlanMask mask(std::size_t{columns} * rows);
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < columns; ++column) {
            const auto byte = static_cast<unsigned char>(
                bytes[header.size() + std::size_t{row} * bytes_a_row + column / 8]);
            mask[std::size_t{row} * columns + column] =
                static_cast<std::uint8_t>(byte >> (7 - column % 8) & 1U);
        }
    }
    return mask;
}

}  // namespace gnomon::cli
