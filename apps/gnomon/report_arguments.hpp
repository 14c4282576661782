// SPDX-License-Identifier: MIT
//
// The options of gnomon report.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "report_command.hpp"

namespace gnomon::cli {

/// Adds the subcommand; both arguments must outlive the parsing.
const CLI::App* add_report(CLI::App& app, ReportOptions& options, bool& list_techniques);

/// For --list-techniques: a name a line.
[[nodiscard]] std::string technique_list();

/// What was called, as one could call it again: the program's own name without its folder.
[[nodiscard]] std::string command_line(const std::vector<std::string>& arguments);

}  // namespace gnomon::cli
