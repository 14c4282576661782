// SPDX-License-Identifier: MIT
//
// The least that looking at every face and edge can cost: a sum over as many bytes as the planes
// and edges of a mesh have, 28 a triangle, one after the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::bench {

class StreamingFloor {
public:
    static constexpr std::size_t bytes_per_triangle = 16 + 8 * 3 / 2;

    explicit StreamingFloor(std::size_t triangles);
    /// Reads all of it. The sum is there to be used, so that nothing is optimised away.
    [[nodiscard]] std::uint64_t read() const;

private:
    std::vector<std::uint64_t> words_;
};

}  // namespace gnomon::bench
