// SPDX-License-Identifier: MIT
//
// The options of gnomon profile.
#pragma once

#include <CLI/CLI.hpp>

#include "profile/profile_options.hpp"

namespace gnomon::cli {

/// Adds the subcommand; `options` outlives the parsing.
const CLI::App* add_profile(CLI::App& app, ProfileOptions& options);

}  // namespace gnomon::cli
