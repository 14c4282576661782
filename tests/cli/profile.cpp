// SPDX-License-Identifier: MIT
#include "tests/cli/profile.hpp"

namespace gnomon::cli::test {

namespace {

constexpr const char* tower = R"({"primitives": [
    {"shape": "box", "name": "tower", "size": [4, 10, 4], "translation": [0, 5, 0]},
    {"shape": "box", "name": "shed", "size": [2, 2, 2], "translation": [8, 1, 6]}]})";

}  // namespace

Arguments profile(const std::string& out, const Arguments& more) {
    return joined({"profile", "site.scene.json",
                   "--lat",   "48.306",
                   "--lon",   "14.286",
                   "--tz",    "+01:00",
                   "--date",  "2026-03-21",
                   "--from",  "09:00",
                   "--to",    "15:00",
                   "--step",  "1h",
                   "--grid",  "0.5m",
                   "--plane", "0.1",
                   "--area",  "-20,-16,20,24",
                   "--out",   out,
                   "--quiet"},
                  more);
}

void Profile::SetUp() {
    ProgramTest::SetUp();
    write("site.scene.json", tower);
}

nlohmann::json Profile::summary(const std::string& folder) const {
    return nlohmann::json::parse(read(folder + "/summary.json"));
}

std::vector<std::string> Profile::mask(const std::string& file, std::size_t columns,
                                       std::size_t rows) const {
    const std::string bytes = read(file);
    EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
    const std::size_t begin = 10 + static_cast<unsigned char>(bytes[8]) +
                              256 * std::size_t{static_cast<unsigned char>(bytes[9])};
    EXPECT_EQ(begin % 64, 0U);
    const std::size_t stride = (columns + 7) / 8;
    EXPECT_EQ(bytes.size(), begin + stride * rows);
    std::vector<std::string> lines(rows);
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            const auto byte = static_cast<unsigned char>(bytes[begin + row * stride + column / 8]);
            lines[row] += (byte >> (7 - column % 8) & 1) != 0 ? '1' : '0';
        }
    }
    return lines;
}

void Profile::expect_same_files(const std::string& a, const std::string& b) const {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path(a))) {
        if (!entry.is_regular_file()) continue;
        const std::string name = entry.path().lexically_relative(path(a)).string();
        EXPECT_EQ(read(a + "/" + name), read(b + "/" + name)) << name;
    }
}

}  // namespace gnomon::cli::test
