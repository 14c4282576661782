// SPDX-License-Identifier: MIT
//
// What a command encoder and its passes write into.
#pragma once

#include <string>
#include <vector>

#include <gnomon/gpu/command.hpp>

namespace gnomon::gpu {

struct Recording {
    CommandBuffer buffer;
    std::vector<std::string> misuse;  ///< what the commands themselves cannot show
};

}  // namespace gnomon::gpu
