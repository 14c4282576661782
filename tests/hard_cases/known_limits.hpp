// SPDX-License-Identifier: MIT
//
// Where a device is known not to draw a hard case right, by how much, and why. A case that comes
// right fails as well: it has to be taken off the list.
#pragma once

#include <cstdint>
#include <string_view>

namespace gnomon::test {

struct KnownLimit {
    /// A name, or what several names begin with.
    std::string_view hard_case;
    /// A device's name, a rasteriser's (rasteriser_of), or "every device".
    std::string_view device;
    /// So many pixels at most are wrong, or differ from the other devices', in all frames, lights
    /// and samples together.
    std::uint64_t most_pixels;
    std::string_view because;
};

/// Null where the case has to be right.
[[nodiscard]] const KnownLimit* known_limit(std::string_view hard_case, std::string_view device,
                                            std::string_view rasteriser);

}  // namespace gnomon::test
