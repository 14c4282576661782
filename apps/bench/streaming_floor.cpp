// SPDX-License-Identifier: MIT
#include "streaming_floor.hpp"

#include <numeric>

namespace gnomon::bench {

namespace {

constexpr std::size_t lanes = 8;  // independent sums, which the compiler makes vectors of

}  // namespace

StreamingFloor::StreamingFloor(std::size_t triangles)
    : words_((triangles * bytes_per_triangle / sizeof(std::uint64_t) + lanes) / lanes * lanes) {
    std::iota(words_.begin(), words_.end(), std::uint64_t{1});
}

std::uint64_t StreamingFloor::read() const {
    std::uint64_t sums[lanes] = {};
    for (std::size_t i = 0; i < words_.size(); i += lanes) {
        for (std::size_t lane = 0; lane < lanes; ++lane) sums[lane] += words_[i + lane];
    }
    return std::accumulate(sums, sums + lanes, std::uint64_t{0});
}

}  // namespace gnomon::bench
