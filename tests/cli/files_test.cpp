// SPDX-License-Identifier: MIT
//
// Output files: whole or not at all.
#include <gmock/gmock.h>

#include <sys/stat.h>

#include "files.hpp"
#include "tests/cli/program.hpp"

namespace gnomon::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Files : public test::ProgramTest {};

TEST_F(Files, nothing_appears_before_commit) {
    write("old", "old");
    OutputFiles output;
    ASSERT_TRUE(output.add(path("old"), "new"));
    ASSERT_TRUE(output.add(path("other"), "more"));
    EXPECT_EQ(read("old"), "old");
    EXPECT_FALSE(std::filesystem::exists(path("other")));
    ASSERT_TRUE(output.commit());
    EXPECT_EQ(read("old"), "new");
    EXPECT_EQ(read("other"), "more");
    EXPECT_THAT(files(), ElementsAre("old", "other"));
}

TEST_F(Files, without_commit_nothing_is_left) {
    write("old", "old");
    {
        OutputFiles output;
        ASSERT_TRUE(output.add(path("old"), "new"));
        ASSERT_FALSE(output.add(path("missing/file"), "x"));
    }
    EXPECT_EQ(read("old"), "old");
    EXPECT_THAT(files(), ElementsAre("old"));
}

TEST_F(Files, one_name_is_taken_once) {
    OutputFiles output;
    ASSERT_TRUE(output.add(path("a"), "1"));
    const Status again = output.add(path("./a"), "2");
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().code, ErrorCode::InvalidInput);
    ASSERT_TRUE(output.commit());
    EXPECT_EQ(read("a"), "1");
}

TEST_F(Files, a_link_stays_a_link) {
    write("target", "old");
    std::filesystem::create_symlink("target", path("link"));
    OutputFiles output;
    ASSERT_TRUE(output.add(path("link"), "new"));
    ASSERT_TRUE(output.commit());
    EXPECT_TRUE(std::filesystem::is_symlink(path("link")));
    EXPECT_EQ(read("target"), "new");
}

TEST_F(Files, a_device_is_written_in_place) {
    OutputFiles output;
    EXPECT_TRUE(output.add("/dev/null", "x"));
    EXPECT_TRUE(output.commit());
    const Status full = output.add("/dev/full", "x");
    ASSERT_FALSE(full);
    EXPECT_EQ(full.error().code, ErrorCode::Io);
    EXPECT_THAT(full.error().message, HasSubstr("/dev/full"));
}

TEST_F(Files, what_cannot_be_written_is_known_before) {
    write("file", "x");
    EXPECT_TRUE(check_writable(path("file")));
    EXPECT_TRUE(check_writable(path("new")));
    EXPECT_TRUE(check_writable("new"));
    EXPECT_TRUE(check_writable("/dev/null"));
    for (const auto& bad : {path("missing/new"), path("file/new"), path("")}) {
        const Status status = check_writable(bad);
        ASSERT_FALSE(status) << bad;
        EXPECT_EQ(status.error().code, ErrorCode::Io);
        EXPECT_THAT(status.error().message, HasSubstr(bad.string()));
    }
    EXPECT_THAT(files(), ElementsAre("file"));
}

TEST_F(Files, a_pgm_is_its_header_and_its_bytes) {
    OutputFiles output;
    const std::vector<std::byte> values{std::byte{0}, std::byte{10}, std::byte{255},
                                        std::byte{3}, std::byte{4},  std::byte{5}};
    ASSERT_TRUE(output.add_pgm(path("a.pgm"), 3, 2, values));
    ASSERT_TRUE(output.commit());
    const test::Mask mask = read_mask("a.pgm");
    EXPECT_EQ(mask.width, 3U);
    EXPECT_EQ(mask.height, 2U);
    EXPECT_EQ(mask.at(1, 0), 10);
    EXPECT_EQ(mask.at(2, 1), 5);
}

TEST_F(Files, a_png_has_its_size_in_its_header) {
    OutputFiles output;
    ASSERT_TRUE(output.add_png(path("a.png"), 3, 2, std::vector<std::byte>(24)));
    ASSERT_TRUE(output.commit());
    const std::string png = read("a.png");
    EXPECT_EQ(png.substr(1, 3), "PNG");
    EXPECT_EQ(png.substr(16, 8), std::string("\0\0\0\3\0\0\0\2", 8));
}

TEST_F(Files, a_small_file_is_read_whole) {
    for (const std::string& text :
         {std::string(), std::string("a\0b\r\n", 5), std::string(64, 'x')}) {
        write("text", text);
        EXPECT_EQ(read_file(path("text"), "the text", 64), text);
    }
    // It says that it is empty.
    const auto status = read_file("/proc/self/status", "the status", 1U << 20U);
    ASSERT_TRUE(status) << status.error().message;
    EXPECT_THAT(*status, HasSubstr("Pid:"));
}

TEST_F(Files, what_is_none_or_too_large_is_refused) {
    write("large", std::string(65, 'x'));
    std::filesystem::create_directories(path("folder"));
    // A pipe that nobody will ever write to.
    ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
    const auto refusal = [](const std::filesystem::path& file) {
        const auto text = read_file(file, "the text", 64);
        EXPECT_FALSE(text) << file;
        if (text) return std::string();
        EXPECT_EQ(text.error().code, ErrorCode::Io);
        EXPECT_TRUE(text.error().message.starts_with(file.string() + ": the text "));
        return text.error().message.substr(file.string().size() + 11);
    };
    EXPECT_EQ(refusal(path("large")), "has 65 bytes, but must have 64 at most.");
    EXPECT_EQ(refusal(path("missing")), "cannot be read: No such file or directory.");
    for (const auto& none : {path("folder"), path("pipe"), std::filesystem::path("/dev/zero")}) {
        EXPECT_EQ(refusal(none), "must be a plain file, no folder, pipe or device.");
    }
    // One that grows without end, of which its size says nothing.
    const auto grown = read_file("/proc/self/status", "the status", 64);
    ASSERT_FALSE(grown);
    EXPECT_THAT(grown.error().message, HasSubstr(", but must have 64 at most."));
}

}  // namespace
}  // namespace gnomon::cli
