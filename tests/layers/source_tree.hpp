// SPDX-License-Identifier: MIT
//
// The repository's text files, read into memory, so that the rules can be tried on made-up trees
// too.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::layers {

struct SourceFile {
    std::string path;  ///< from the repository's root, with forward slashes
    std::string text;
};

/// All text files below `root`, sorted by path. What is built, what version control keeps for
/// itself and files with zero bytes in them are left out.
[[nodiscard]] std::vector<SourceFile> read_tree(const std::filesystem::path& root);

}  // namespace gnomon::layers
