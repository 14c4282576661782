// SPDX-License-Identifier: MIT
#include "meshlets.hpp"

namespace gnomon::bench {

std::optional<Contestant> meshlets() { return std::nullopt; }

}  // namespace gnomon::bench
