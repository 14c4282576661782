// SPDX-License-Identifier: MIT
//
// What "auto" does about a light that jumped: faces by the hierarchy of boxes or in turn, and edges
// by theirs or in turn, each the way that costs less (strategies/jump.cpp).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gnomon/shadows/detector.hpp>

#include "side_detection.hpp"
#include "strategies.hpp"
#include "work.hpp"

namespace gnomon::shadows::internal {

/// When to try again what did not pay: after `first` times, then after twice as many each time that
/// it did not, up to `most`.
class Backoff {
public:
    Backoff(std::uint32_t first, std::uint32_t most) : first_(first), most_(most), next_(first) {}

    /// Whether it is time. Counts the calls.
    [[nodiscard]] bool is_due() {
        if (wait_ == 0) return true;
        --wait_;
        return false;
    }
    void failed() {
        wait_ = next_;
        next_ = std::min(most_, 2 * next_);
    }
    void paid() { wait_ = 0, next_ = first_; }

private:
    std::uint32_t first_;
    std::uint32_t most_;
    std::uint32_t next_;
    std::uint32_t wait_ = 0;
};

/// A search ends as soon as it has met more of the blocks than are worth it, so that a wrong guess
/// costs a fraction of a frame, and is not tried again at once. No answer depends on that.
class Jump {
public:
    /// `may_search`: false where there are so few faces, or no tables, that it does not pay.
    Detection& detect(const ShadowMesh& mesh, LightLocal light, NearCaps near_caps,
                      bool may_search);

    /// Of the last call: the edges, which cost most, were searched.
    [[nodiscard]] bool searched() const { return searched_; }
    /// What the last call cost.
    [[nodiscard]] double work() const { return work_; }
    /// Another mesh comes: what was learned is of no use.
    void forget() { faces_.paid(), edges_.paid(); }

    [[nodiscard]] std::size_t memory_bytes() const {
        return sides_.memory_bytes() + memory_of(found_) +
               crossed_.capacity() * sizeof(std::uint32_t);
    }

private:
    [[nodiscard]] double decide_faces(const ShadowMesh& mesh, const BlockClassifier& classifier,
                                      bool may_search);
    void find_silhouette(const ShadowMesh& mesh, const FilterLight& light, bool may_search);

    Sides sides_;
    std::vector<std::uint32_t> crossed_;
    Detection found_;
    Backoff faces_{1, 8};
    Backoff edges_{1, 8};
    bool searched_ = false;
    double work_ = 0.0;
};

}  // namespace gnomon::shadows::internal
