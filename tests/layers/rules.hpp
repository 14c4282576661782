// SPDX-License-Identifier: MIT
//
// The rules that hold for the repository's text: who may include whom, how long a file may be, how
// it begins and what it must not name. They judge text alone; whether it compiles is the compiler's
// business.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/layers/source_tree.hpp"

namespace gnomon::layers {

/// One file that breaks one rule: a sentence that names both.
using Violation = std::string;

/// The arrows of docs/architecture.md, "Layout": which modules, private headers and libraries the
/// files of each folder may include.
[[nodiscard]] std::vector<Violation> check_includes(std::span<const SourceFile> tree);
/// At most one file of the apps includes both backends.
[[nodiscard]] std::vector<Violation> check_backend_choice(std::span<const SourceFile> tree);
/// Headers have at most 300 lines, sources at most 600.
[[nodiscard]] std::vector<Violation> check_lengths(std::span<const SourceFile> tree);
/// C++ files begin with the licence line.
[[nodiscard]] std::vector<Violation> check_licence_lines(std::span<const SourceFile> tree);
/// Public headers of what is installed say that shared libraries show what they declare.
[[nodiscard]] std::vector<Violation> check_visibility(std::span<const SourceFile> tree);
/// No text names a folder that exists on one machine only.
[[nodiscard]] std::vector<Violation> check_machine_paths(std::span<const SourceFile> tree);

struct Include {
    std::string_view name;  ///< what stands between the brackets or quotes
    bool quoted = false;
    std::size_t line = 0;  ///< from 1
};
/// The #include lines of a text. Lines within comments are not told apart: no file has such.
[[nodiscard]] std::vector<Include> includes_of(std::string_view text);

}  // namespace gnomon::layers
