// SPDX-License-Identifier: MIT
//
// Volumes that nobody holds any more, with the room that their lists have, for the next ones: in a
// scene where everything moves, all volumes are made anew each frame.
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>

#include <gnomon/shadows/volume.hpp>

namespace gnomon::shadows::internal {

/// What a volume holds, its lists' capacities included; not what sharing it takes.
[[nodiscard]] std::size_t bytes_of(const Volume& volume);

class VolumePool {
public:
    VolumePool();
    VolumePool(const VolumePool&) = delete;
    VolumePool& operator=(const VolumePool&) = delete;
    VolumePool(VolumePool&&) = delete;
    VolumePool& operator=(VolumePool&&) = delete;
    ~VolumePool();

    /// A volume whose content is not said: one that was made before, the longest unused first, so
    /// that where all pairs are worked on in turn each finds its own room. It comes back when its
    /// last holder lets go of it, on whatever thread, also after the pool is gone: then it is
    /// freed.
    [[nodiscard]] std::shared_ptr<Volume> take();

    /// Frees those that are unused; others that come back are kept.
    void clear();
    /// Once a frame: frees what is more than twice as many as were taken since the last call.
    void trim();

    [[nodiscard]] std::size_t memory_bytes() const;

private:
    struct Unused {
        std::mutex mutex;
        bool closed = false;
        std::size_t taken = 0;
        std::deque<std::unique_ptr<Volume>> volumes;
    };
    std::shared_ptr<Unused> unused_;
};

}  // namespace gnomon::shadows::internal
