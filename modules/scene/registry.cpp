// SPDX-License-Identifier: MIT
#include <gnomon/scene/registry.hpp>

namespace gnomon::scene {

Entity Registry::create() {
    std::uint32_t index = 0;
    if (free_.empty()) {
        index = static_cast<std::uint32_t>(generations_.size());
        generations_.push_back(0);
    } else {
        index = free_.back();
        free_.pop_back();
    }
    ++alive_;
    return Entity{index, generations_[index]};
}

void Registry::destroy(Entity entity) {
    GNOMON_EXPECTS(valid(entity));
    for (const auto& pool : pools_) {
        if (pool) pool->remove(entity.index);
    }
    --alive_;
    // A slot whose generations are used up is retired: a key must never come back.
    ++generations_[entity.index];
    if (generations_[entity.index] != std::numeric_limits<std::uint32_t>::max()) {
        free_.push_back(entity.index);
    }
}

bool Registry::valid(Entity entity) const {
    return entity.index < generations_.size() && generations_[entity.index] == entity.generation;
}

}  // namespace gnomon::scene
