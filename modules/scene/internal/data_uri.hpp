// SPDX-License-Identifier: MIT
//
// What a glTF file's "uri" members hold: base64 data, or a percent-encoded path beside the file.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::scene::internal {

[[nodiscard]] bool is_data_uri(std::string_view uri);

/// The bytes of "data:…;base64,…"; none when it is not base64 or holds a character that base64 has
/// not.
[[nodiscard]] std::optional<std::vector<std::byte>> decode_data_uri(std::string_view uri);

/// "a%20b.bin" -> "a b.bin"; none when it does not name a file in or below the folder of the file
/// that says so: absolute, with a scheme, a drive, a backslash, a zero byte or a "..".
[[nodiscard]] std::optional<std::string> decode_relative_path(std::string_view uri);

}  // namespace gnomon::scene::internal
