// SPDX-License-Identifier: MIT
//
// Things with keys in a dense array: places stay where they are while a thing lives, and are used
// again. Who submits the same things in the same order every frame finds them without a look-up.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

namespace gnomon::shadows::internal {

inline constexpr std::uint32_t no_slot = std::numeric_limits<std::uint32_t>::max();

/// What a thing in Slots begins with.
struct SlotHead {
    std::uint64_t key = 0;
    std::uint32_t position = 0;  ///< in the order of submission
    bool alive = false;
    bool fresh = false;  ///< added since by_key() was brought up to date
};

template <class T>  // derived from SlotHead
class Slots {
public:
    void begin_frame() {
        ++frame_;
        submitted_ = 0;
        if (!order_.empty()) last_order_.swap(order_);
        order_.clear();
        cursor_ = 0;
    }

    /// The slot of a key, a new one (T{} but for its head) where there is none. Cost: a comparison
    /// where the order is last frame's, else a look-up.
    std::uint32_t submit(std::uint64_t key) {
        std::uint32_t slot = no_slot;
        if (cursor_ < last_order_.size()) {
            const std::uint32_t expected = last_order_[cursor_];
            if (items_[expected].key == key && items_[expected].alive) slot = expected;
        }
        if (slot == no_slot) slot = look_up(key);
        T& item = items_[slot];
        cursor_ = static_cast<std::uint32_t>(item.position + 1U);
        const auto position = static_cast<std::uint32_t>(order_.size());
        if (item.position != position) item.position = position;
        order_.push_back(slot);
        if (stamps_[slot] != frame_) {
            stamps_[slot] = frame_;
            ++submitted_;
        }
        return slot;
    }

    [[nodiscard]] std::uint32_t find(std::uint64_t key) const {
        const auto found = by_hash_.find(key);
        return found == by_hash_.end() ? no_slot : found->second;
    }

    void remove(std::uint32_t slot) {
        if (stamps_[slot] == frame_) --submitted_;
        by_hash_.erase(items_[slot].key);
        items_[slot] = T{};
        stamps_[slot] = 0;
        free_.push_back(slot);
        removed_ = true;
    }

    [[nodiscard]] bool all_submitted() const { return submitted_ == by_hash_.size(); }
    [[nodiscard]] bool is_submitted(std::uint32_t slot) const { return stamps_[slot] == frame_; }

    /// Living things by key, as of the last sort().
    [[nodiscard]] const std::vector<std::uint32_t>& by_key() const { return by_key_; }
    /// Cost: linear, plus the sorting of what is new; nothing where nothing came or went.
    void sort() {
        if (!removed_ && added_.empty()) return;
        std::erase_if(by_key_,
                      [&](std::uint32_t s) { return !items_[s].alive || items_[s].fresh; });
        std::erase_if(added_, [&](std::uint32_t s) {
            const bool stays = items_[s].alive && items_[s].fresh;
            items_[s].fresh = false;
            return !stays;
        });
        const auto less = [&](std::uint32_t a, std::uint32_t b) {
            return items_[a].key < items_[b].key;
        };
        std::sort(added_.begin(), added_.end(), less);
        const auto old = static_cast<std::ptrdiff_t>(by_key_.size());
        by_key_.insert(by_key_.end(), added_.begin(), added_.end());
        std::inplace_merge(by_key_.begin(), by_key_.begin() + old, by_key_.end(), less);
        added_.clear();
        removed_ = false;
    }

    T& operator[](std::uint32_t slot) { return items_[slot]; }
    const T& operator[](std::uint32_t slot) const { return items_[slot]; }
    [[nodiscard]] std::size_t size() const { return by_hash_.size(); }
    /// Slots are below this.
    [[nodiscard]] std::size_t end() const { return items_.size(); }
    /// About: what the containers hold.
    [[nodiscard]] std::size_t memory_bytes() const {
        constexpr std::size_t node = 4 * sizeof(void*);
        return items_.capacity() * sizeof(T) + stamps_.capacity() * sizeof(std::uint64_t) +
               (order_.capacity() + last_order_.capacity() + by_key_.capacity() +
                added_.capacity() + free_.capacity()) *
                   sizeof(std::uint32_t) +
               by_hash_.size() * node + by_hash_.bucket_count() * sizeof(void*);
    }

private:
    std::uint32_t look_up(std::uint64_t key) {
        const auto [found, added] = by_hash_.try_emplace(key, no_slot);
        if (!added) return found->second;
        std::uint32_t slot = static_cast<std::uint32_t>(items_.size());
        if (free_.empty()) {
            items_.emplace_back();
            stamps_.push_back(0);
        } else {
            slot = free_.back();
            free_.pop_back();
        }
        found->second = slot;
        T& item = items_[slot];
        item.key = key;
        item.alive = true;
        item.fresh = true;
        // Whoever comes next is expected where the order of last frame was left.
        item.position = static_cast<std::uint32_t>(cursor_) - 1U;
        added_.push_back(slot);
        return slot;
    }

    std::vector<T> items_;
    std::vector<std::uint64_t> stamps_;  // the frame that a slot was last submitted in
    std::vector<std::uint32_t> order_, last_order_;
    std::size_t cursor_ = 0;
    std::uint64_t frame_ = 0;
    std::size_t submitted_ = 0;
    std::unordered_map<std::uint64_t, std::uint32_t> by_hash_;
    std::vector<std::uint32_t> by_key_, added_, free_;
    bool removed_ = false;
};

}  // namespace gnomon::shadows::internal
