// SPDX-License-Identifier: MIT
//
// gnomon-game: the command line.
#include <cstdio>
#include <exception>

#include <fmt/format.h>

#include "command_line.hpp"

int main(int argc, char** argv) {
    try {
        return gnomon::game::run(argc, argv);
    } catch (const std::exception& unexpected) {
        std::fprintf(stderr, "gnomon-game: %s\n", unexpected.what());
        return 1;
    }
}
