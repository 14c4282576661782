// SPDX-License-Identifier: MIT
#include "internal/volume_pool.hpp"

#include <utility>

namespace gnomon::shadows::internal {

std::size_t bytes_of(const Volume& volume) {
    return sizeof(Volume) + volume.indices.capacity() * sizeof(std::uint32_t) +
           volume.ranges.capacity() * sizeof(FaceRange);
}

VolumePool::VolumePool() : unused_(std::make_shared<Unused>()) {}

VolumePool::~VolumePool() {
    const std::lock_guard lock(unused_->mutex);
    unused_->closed = true;
    unused_->volumes.clear();
}

std::shared_ptr<Volume> VolumePool::take() {
    std::unique_ptr<Volume> volume;
    {
        const std::lock_guard lock(unused_->mutex);
        ++unused_->taken;
        if (!unused_->volumes.empty()) {
            volume = std::move(unused_->volumes.front());
            unused_->volumes.pop_front();
        }
    }
    if (volume == nullptr) volume = std::make_unique<Volume>();
    return {volume.release(), [unused = unused_](Volume* made) {
                std::unique_ptr<Volume> owned(made);
                const std::lock_guard lock(unused->mutex);
                if (!unused->closed) unused->volumes.push_back(std::move(owned));
            }};
}

void VolumePool::clear() {
    const std::lock_guard lock(unused_->mutex);
    unused_->volumes.clear();
    unused_->volumes.shrink_to_fit();
}

void VolumePool::trim() {
    const std::lock_guard lock(unused_->mutex);
    auto& volumes = unused_->volumes;
    const std::size_t most = 2 * std::exchange(unused_->taken, 0);
    if (volumes.size() > most) {
        volumes.erase(volumes.begin(),
                      volumes.begin() + static_cast<std::ptrdiff_t>(volumes.size() - most));
    }
}

std::size_t VolumePool::memory_bytes() const {
    const std::lock_guard lock(unused_->mutex);
    std::size_t sum = sizeof(Unused) + unused_->volumes.size() * sizeof(void*);
    for (const auto& volume : unused_->volumes) sum += bytes_of(*volume);
    return sum;
}

}  // namespace gnomon::shadows::internal
