// SPDX-License-Identifier: MIT
//
// The logical device with its function table, and the names that tools show for its objects.
#pragma once

#include <memory>
#include <string>

#include "internal/adapter.hpp"

namespace gnomon::vk {

class Device {
public:
    [[nodiscard]] static Result<std::unique_ptr<Device>> create(const BackendOptions& options);
    /// The host's, which is not destroyed here.
    [[nodiscard]] static Result<std::unique_ptr<Device>> adopt(const HostDevice& host);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    std::unique_ptr<Instance> instance;
    Adapter adapter;
    DeviceFunctions fn;
    VkDevice handle = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    YUp y_up = YUp::VertexStages;

    [[nodiscard]] bool is_adopted() const { return !owned_; }

    template <class Handle>
    void set_name(VkObjectType type, Handle object, const std::string& name) const {
        set_name_of(type, reinterpret_cast<std::uint64_t>(object), name);
    }

private:
    Device() = default;
    bool owned_ = true;
    void set_name_of(VkObjectType type, std::uint64_t object, const std::string& name) const;
};

}  // namespace gnomon::vk
