// SPDX-License-Identifier: MIT
//
// DeviceState: the tables of a device and the backend behind them. Owners and encoders hold it
// weakly, so that they may outlive the device; when it goes, it frees what is left and then the
// backend.
#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include <gnomon/gpu/backend.hpp>
#include <gnomon/gpu/device.hpp>

#include "internal/object_table.hpp"
#include "internal/records.hpp"
#include "internal/wording.hpp"

namespace gnomon::gpu {

class DeviceState {
public:
    explicit DeviceState(std::unique_ptr<Backend> backend);
    DeviceState(const DeviceState&) = delete;
    DeviceState& operator=(const DeviceState&) = delete;
    ~DeviceState();

    template <class Tag>
    using Table = ObjectTable<Tag, typename ObjectKind<Tag>::Record>;

    template <class Tag>
    [[nodiscard]] Table<Tag>& table() {
        return std::get<Table<Tag>>(tables_);
    }

    /// Null when the object is gone or never was; `absence` then says which.
    template <class Tag>
    [[nodiscard]] const typename ObjectKind<Tag>::Record* find(Id<Tag> id) const {
        return std::get<Table<Tag>>(tables_).find(id);
    }

    /// `[Buffer "indices"]`, also for an object that is gone.
    template <class Tag>
    [[nodiscard]] std::string name(Id<Tag> id) const {
        const std::string* label = std::get<Table<Tag>>(tables_).label(id);
        return object_name(ObjectKind<Tag>::name, label != nullptr ? *label : std::string());
    }

    /// The sentence why `find` gave nothing.
    template <class Tag>
    [[nodiscard]] std::string absence(Id<Tag> id) const {
        if (!id) return fmt::format("A {} is needed, but the id is empty.", ObjectKind<Tag>::name);
        if (std::get<Table<Tag>>(tables_).gave_out(id)) {
            return fmt::format("{} was destroyed.", name(id));
        }
        return fmt::format("[{}] (index {}, generation {}) does not belong to this device.",
                           ObjectKind<Tag>::name, id.index, id.generation);
    }

    template <class Tag>
    void destroy(Id<Tag> id) {
        if (find(id) == nullptr) return;
        backend_->destroy(id);
        table<Tag>().erase(id);
    }

    /// The one shape that all layouts with these entries share.
    [[nodiscard]] const LayoutShape* intern(std::vector<BindGroupLayoutEntry> entries);

    [[nodiscard]] Backend& backend() { return *backend_; }
    [[nodiscard]] const Caps& caps() const { return backend_->caps(); }
    [[nodiscard]] std::uint64_t objects_alive() const;

    /// How many commands the last encoder recorded: the next, mostly a frame later, will need room
    /// for as many.
    std::atomic<std::size_t> commands_before = 0;
    DeviceCounters counters;  ///< objects_alive is left out: the tables know it

private:
    template <class Tag>
    void destroy_all() {
        for (const Id<Tag> id : table<Tag>().ids()) destroy(id);
    }

    std::unique_ptr<Backend> backend_;
    std::tuple<Table<BufferTag>, Table<TextureTag>, Table<SamplerTag>, Table<ShaderTag>,
               Table<BindGroupLayoutTag>, Table<BindGroupTag>, Table<RenderPipelineTag>,
               Table<QuerySetTag>>
        tables_;
    std::deque<LayoutShape> shapes_;  // few, and their addresses stay
};

}  // namespace gnomon::gpu
