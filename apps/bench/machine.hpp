// SPDX-License-Identifier: MIT
//
// Where and when something was measured: processor, caches, system, compiler, date. No names.
#pragma once

#include <nlohmann/json.hpp>

namespace gnomon::bench {

/// What the system does not say is left out.
[[nodiscard]] nlohmann::ordered_json describe_machine();

}  // namespace gnomon::bench
