// SPDX-License-Identifier: MIT
//
// Files that the programs read whole, and those that they write: all of a run's to temporary names
// first, then renamed, so that a reader never meets half a file and a failed run leaves the old
// ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <gnomon/core/result.hpp>

namespace gnomon::cli {

/// A small file, whole. `what` is what sentences call it: "the recording". Fails with ErrorCode::Io
/// where it cannot be read, has more than `most_bytes`, or is no plain file: nobody waits for what
/// comes out of a pipe, or fills the memory with what a device has.
[[nodiscard]] Result<std::string> read_file(const std::filesystem::path& path,
                                            std::string_view what, std::size_t most_bytes);

/// Whether a file could be written there: cheap, before the work that it is to hold. Fails with
/// ErrorCode::Io.
[[nodiscard]] Status check_writable(const std::filesystem::path& path);

/// The files of one run. What was added appears under its name with commit(); without it, nothing
/// does.
class OutputFiles {
public:
    OutputFiles() = default;
    OutputFiles(const OutputFiles&) = delete;
    OutputFiles& operator=(const OutputFiles&) = delete;
    ~OutputFiles();

    /// Fails with ErrorCode::Io, and with ErrorCode::InvalidInput for a name that was added before.
    /// What is there and no plain file (a device, a pipe) is written at once: it cannot be renamed
    /// over.
    [[nodiscard]] Status add(const std::filesystem::path& path, std::span<const std::byte> bytes);
    [[nodiscard]] Status add(const std::filesystem::path& path, std::string_view text);
    /// Four bytes a pixel, row 0 on top.
    [[nodiscard]] Status add_png(const std::filesystem::path& path, std::uint32_t width,
                                 std::uint32_t height, std::span<const std::byte> rgba);
    /// Binary PGM, one byte a pixel, row 0 on top.
    [[nodiscard]] Status add_pgm(const std::filesystem::path& path, std::uint32_t width,
                                 std::uint32_t height, std::span<const std::byte> values);

    [[nodiscard]] Status commit();

private:
    struct Pending {
        std::filesystem::path path;
        std::filesystem::path temporary;
    };
    std::vector<Pending> pending_;
};

}  // namespace gnomon::cli
