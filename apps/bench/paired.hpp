// SPDX-License-Identifier: MIT
//
// The whole of the paired runs: every strategy on every mesh and motion, what their structures cost
// to build, and the literature's own comparison; as one JSON file, which
// scripts/performance-tables turns into the tables of docs/performance.md.
#pragma once

#include <filesystem>
#include <string>

#include <gnomon/core/result.hpp>

namespace gnomon::bench {

struct PairedOptions {
    std::filesystem::path out;     ///< the JSON file
    std::filesystem::path models;  ///< a folder that may not exist
    double seconds = 420.0;        ///< for the contests, about; building meshes comes on top
    bool quick = false;            ///< a few seconds, to see that it works: no numbers to publish
    std::string only;              ///< meshes whose name contains it
};

/// Prints a line a mesh to stderr. Fails with ErrorCode::Io where the file cannot be written, with
/// InvalidInput where a model cannot be read, and with Internal where strategies disagree: the file
/// is written all the same.
[[nodiscard]] Status run_paired(const PairedOptions& options);

}  // namespace gnomon::bench
