// SPDX-License-Identifier: MIT
//
// Models that are not part of the repository, and the table of what is in them. Tests skip, with
// the reason, where they are not there.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "tests/support/paths.hpp"

namespace gnomon::test {

/// All files of models_folder() that end in .glb, by name.
[[nodiscard]] std::map<std::string, std::filesystem::path> model_files();

/// The rows of MANIFEST.md's tables of figures: by file name, then by the heading of the column.
/// Empty where there is none.
using ManifestRow = std::map<std::string, std::string>;
[[nodiscard]] std::map<std::string, ManifestRow> read_manifest();

}  // namespace gnomon::test
