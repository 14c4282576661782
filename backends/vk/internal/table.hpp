// SPDX-License-Identifier: MIT
//
// What the backend keeps for each id of the front end.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include <gnomon/core/expects.hpp>
#include <gnomon/gpu/handle.hpp>

namespace gnomon::vk {

/// Objects by Id::index. The front end has checked that an id is alive.
template <class Tag, class Object>
class Table {
public:
    void insert(gpu::Id<Tag> id, Object object) {
        if (id.index >= slots_.size()) {
            slots_.resize(id.index + 1);
        }
        slots_[id.index] = std::move(object);
    }
    [[nodiscard]] Object& operator[](gpu::Id<Tag> id) {
        GNOMON_EXPECTS(id.index < slots_.size() && slots_[id.index].has_value());
        return *slots_[id.index];
    }
    [[nodiscard]] const Object& operator[](gpu::Id<Tag> id) const {
        GNOMON_EXPECTS(id.index < slots_.size() && slots_[id.index].has_value());
        return *slots_[id.index];
    }
    [[nodiscard]] Object take(gpu::Id<Tag> id) {
        Object object = std::move((*this)[id]);
        slots_[id.index].reset();
        return object;
    }
    template <class Function>
    void for_each(Function function) {
        for (std::optional<Object>& slot : slots_) {
            if (slot) {
                function(*slot);
            }
        }
    }

private:
    std::vector<std::optional<Object>> slots_;
};

}  // namespace gnomon::vk
