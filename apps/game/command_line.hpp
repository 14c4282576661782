// SPDX-License-Identifier: MIT
#pragma once

namespace gnomon::game {

/// What the program does, and its exit code: 0 done; 2 bad usage or bad input, with one sentence on
/// stderr; 1 anything else.
[[nodiscard]] int run(int argc, char** argv);

}  // namespace gnomon::game
