// SPDX-License-Identifier: MIT
//
// What a shader asks of its pipeline, in words that are the same for GLSL and WGSL: one line for
// each texture, member of a uniform block, input and output. It reads the WGSL that this repository
// writes, not any WGSL.
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace gnomon::test {

using Interface = std::set<std::string>;

/// Of the JSON that `spirv-cross --reflect` prints.
[[nodiscard]] Interface interface_of_reflection(const std::string& json);

/// Of one stage in WGSL, with what it includes. A sampler is no line of its own: it belongs to the
/// texture of its number less 100, and one without that texture is a line that no GLSL has.
[[nodiscard]] Interface interface_of_wgsl(std::string text);

}  // namespace gnomon::test
