// SPDX-License-Identifier: MIT
//
// A cell as JSON, with or without its thumbnails.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include <gnomon/report/report.hpp>

namespace gnomon::report::internal {

[[nodiscard]] nlohmann::ordered_json json_of(const Cell& cell, bool with_thumbnails);
[[nodiscard]] std::string base64(const std::vector<std::byte>& bytes);

}  // namespace gnomon::report::internal
