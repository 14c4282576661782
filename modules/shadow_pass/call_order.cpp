// SPDX-License-Identifier: MIT
#include <algorithm>
#include <tuple>

#include "internal/prepared_light.hpp"

namespace gnomon::shadow_pass::internal {

void sort_calls(std::vector<Call>& calls, const shadows::PixelRect& everything) {
    const auto key = [&](const Call& c) {
        return std::tuple(c.batch, c.quads, c.pipeline, !(c.scissor == everything), c.depth.min,
                          c.depth.max, c.vertices.index, c.indices.index, c.instance, c.first);
    };
    const auto before = [&](const Call& a, const Call& b) { return key(a) < key(b); };
    // Mostly they are in order: those of one batch with one pipeline and no scissor.
    if (!std::is_sorted(calls.begin(), calls.end(), before)) {
        std::sort(calls.begin(), calls.end(), before);
    }
}

}  // namespace gnomon::shadow_pass::internal
