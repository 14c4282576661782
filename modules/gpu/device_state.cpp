// SPDX-License-Identifier: MIT
#include "internal/device_state.hpp"

#include <algorithm>
#include <utility>

#include <gnomon/core/expects.hpp>

namespace gnomon::gpu {

DeviceState::DeviceState(std::unique_ptr<Backend> backend) : backend_(std::move(backend)) {
    GNOMON_EXPECTS(backend_ != nullptr);
}

DeviceState::~DeviceState() {
    // Users before what they use: a backend never sees a part go before the whole.
    destroy_all<BindGroupTag>();
    destroy_all<RenderPipelineTag>();
    destroy_all<BindGroupLayoutTag>();
    destroy_all<ShaderTag>();
    destroy_all<SamplerTag>();
    destroy_all<TextureTag>();
    destroy_all<BufferTag>();
    destroy_all<QuerySetTag>();
}

const LayoutShape* DeviceState::intern(std::vector<BindGroupLayoutEntry> entries) {
    LayoutShape shape;
    for (BindGroupLayoutEntry& entry : entries) {
        if (entry.type == BindingType::UniformBuffer) {
            entry.sample_type = SampleType::Float;
            entry.multisampled = false;
            if (entry.has_dynamic_offset) ++shape.dynamic_offset_count;
        } else {
            entry.min_binding_size = 0;
        }
    }
    shape.entries = std::move(entries);
    std::ranges::sort(shape.entries, {}, &BindGroupLayoutEntry::binding);
    for (const LayoutShape& known : shapes_) {
        if (known.entries == shape.entries) return &known;
    }
    return &shapes_.emplace_back(std::move(shape));
}

std::uint64_t DeviceState::objects_alive() const {
    return std::apply([](const auto&... table) { return (std::uint64_t{0} + ... + table.size()); },
                      tables_);
}

template <class Tag>
void Owned<Tag>::reset() {
    if (const std::shared_ptr<DeviceState> device = device_.lock()) device->destroy(id_);
    device_.reset();
    id_ = {};
}

template class Owned<BufferTag>;
template class Owned<TextureTag>;
template class Owned<SamplerTag>;
template class Owned<ShaderTag>;
template class Owned<BindGroupLayoutTag>;
template class Owned<BindGroupTag>;
template class Owned<RenderPipelineTag>;
template class Owned<QuerySetTag>;

}  // namespace gnomon::gpu
