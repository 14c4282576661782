// SPDX-License-Identifier: MIT
//
// A command list as 32-bit words, which bridge.js reads where they lie: a command is its place
// among the alternatives of gpu::Command, then its members in order. Numbers of 64 bits are two
// words, the lower one first; text is its length in bytes and as many words as hold them; objects
// are their ids' indices, and no object is `no_object`.
#pragma once

#include <cstdint>
#include <vector>

#include <gnomon/gpu/command.hpp>

namespace gnomon::webgpu {

inline constexpr std::uint32_t no_object = 0xFFFF'FFFF;

/// Replaces `words`, whose memory is used again.
void write_words(const gpu::CommandBuffer& commands, std::vector<std::uint32_t>& words);

}  // namespace gnomon::webgpu
