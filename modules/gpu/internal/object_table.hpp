// SPDX-License-Identifier: MIT
//
// A table of GPU objects of one kind: slots that are used again under a new generation, so that an
// id of an object that is gone is recognised, by the label it had. It is not a resource manager:
// what lies in a slot is what the front end remembers of an object, nothing of a graphics API.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gnomon/gpu/handle.hpp>

namespace gnomon::gpu {

template <class Tag, class Record>
class ObjectTable {
public:
    [[nodiscard]] Id<Tag> insert(const std::string& label, Record record) {
        if (free_.empty()) {
            free_.push_back(static_cast<std::uint32_t>(slots_.size()));
            slots_.emplace_back();
            labels_.emplace_back();
        }
        const std::uint32_t index = free_.back();
        free_.pop_back();
        Slot& slot = slots_[index];
        slot.record.emplace(std::move(record));
        labels_[index][slot.generation % remembered_labels] = {slot.generation, label};
        return {index, slot.generation};
    }

    void erase(Id<Tag> id) {
        if (find(id) == nullptr) return;
        Slot& slot = slots_[id.index];
        slot.record.reset();
        // Generation 0 means "names nothing", also after four thousand million reuses.
        if (++slot.generation == 0) slot.generation = 1;
        free_.push_back(id.index);
    }

    /// Null when the object is gone or never was.
    [[nodiscard]] const Record* find(Id<Tag> id) const {
        if (id.index >= slots_.size()) return nullptr;
        const Slot& slot = slots_[id.index];
        return slot.generation == id.generation && slot.record ? &*slot.record : nullptr;
    }

    /// True for an id that this table gave out, whether its object is still alive or not.
    [[nodiscard]] bool gave_out(Id<Tag> id) const {
        if (!id || id.index >= slots_.size()) return false;
        const Slot& slot = slots_[id.index];
        return id.generation < slot.generation || find(id) != nullptr;
    }

    /// Null when the slot has been used so often since then that the label is forgotten.
    [[nodiscard]] const std::string* label(Id<Tag> id) const {
        if (!gave_out(id)) return nullptr;
        const Label& label = labels_[id.index][id.generation % remembered_labels];
        return label.generation == id.generation ? &label.text : nullptr;
    }

    [[nodiscard]] std::size_t size() const { return slots_.size() - free_.size(); }

    /// The ids of all objects that are alive.
    [[nodiscard]] std::vector<Id<Tag>> ids() const {
        std::vector<Id<Tag>> result;
        for (std::uint32_t i = 0; i < slots_.size(); ++i) {
            if (slots_[i].record) result.push_back({i, slots_[i].generation});
        }
        return result;
    }

private:
    // A few labels per slot, not all: a program that makes an object each frame must not grow.
    static constexpr std::uint32_t remembered_labels = 4;
    struct Slot {
        std::uint32_t generation = 1;
        std::optional<Record> record;
    };
    struct Label {
        std::uint32_t generation = 0;
        std::string text;
    };
    std::vector<Slot> slots_;
    std::vector<std::array<Label, remembered_labels>> labels_;  // apart: only error paths read it
    std::vector<std::uint32_t> free_;
};

}  // namespace gnomon::gpu
