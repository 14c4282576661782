// SPDX-License-Identifier: MIT
#include "internal/validate_bind_groups.hpp"

#include <algorithm>
#include <vector>

#include "internal/validate_transfers.hpp"

namespace gnomon::gpu {

namespace {

bool is_linear(const SamplerDesc& sampler) {
    return sampler.mag_filter == FilterMode::Linear || sampler.min_filter == FilterMode::Linear ||
           sampler.mipmap_filter == FilterMode::Linear;
}

/// Whether this aspect of this format is what a shader reads as that type.
bool reads_as(SampleType type, Format format, Aspect aspect) {
    switch (type) {
        case SampleType::Float:
            return aspect == Aspect::Color && has_color(format) && !is_uint(format);
        case SampleType::Uint:
            return aspect == Aspect::Color ? is_uint(format)
                                           : aspect == Aspect::StencilOnly && has_stencil(format);
        case SampleType::Depth: return aspect == Aspect::DepthOnly && has_depth(format);
    }
    return false;
}

class BindGroupCheck {
public:
    BindGroupCheck(const DeviceState& device, BindGroupRecord& record)
        : device_(device), record_(record) {}

    Status entry(const BindGroupLayoutEntry& layout, const BindGroupEntry& entry) {
        return layout.type == BindingType::UniformBuffer ? buffer(layout, entry)
                                                         : texture(layout, entry);
    }

private:
    Status buffer(const BindGroupLayoutEntry& layout, const BindGroupEntry& entry) {
        if (entry.texture || entry.sampler) {
            return invalid("Its layout has a UniformBuffer there, but the entry names a {}.",
                           entry.texture ? "Texture" : "Sampler");
        }
        const BufferDesc* buffer = device_.find(entry.buffer);
        if (buffer == nullptr) return invalid("{}", device_.absence(entry.buffer));
        const std::string name = device_.name(entry.buffer);
        if (!has(buffer->usage, BufferUsage::Uniform)) {
            return invalid("The usage ({}) of {} lacks Uniform.", to_text(buffer->usage), name);
        }
        const Limits& limits = device_.caps().limits;
        if (entry.offset % limits.min_uniform_buffer_offset_alignment != 0) {
            return invalid(
                "The offset ({}) is not a multiple of min_uniform_buffer_offset_alignment ({}).",
                entry.offset, limits.min_uniform_buffer_offset_alignment);
        }
        if (entry.offset >= buffer->size || !range_fits(entry.offset, entry.size, buffer->size)) {
            return invalid("The range (offset {}, size {}) does not fit in {} (size {}).",
                           entry.offset, entry.size, name, buffer->size);
        }
        const std::uint64_t size = entry.size != 0 ? entry.size : buffer->size - entry.offset;
        if (size < layout.min_binding_size) {
            return invalid("The size ({}) of {} as it is bound is below min_binding_size ({}).",
                           size, name, layout.min_binding_size);
        }
        if (size > limits.max_uniform_buffer_binding_size) {
            return invalid(
                "The size ({}) of {} as it is bound exceeds max_uniform_buffer_binding_size ({}).",
                size, name, limits.max_uniform_buffer_binding_size);
        }
        record_.buffers.push_back(entry.buffer);
        if (layout.has_dynamic_offset) {
            record_.dynamic_bindings.push_back(
                {entry.binding, entry.buffer, entry.offset, size, buffer->size});
        }
        return {};
    }

    Status texture(const BindGroupLayoutEntry& layout, const BindGroupEntry& entry) {
        if (entry.buffer) {
            return invalid("Its layout has a SampledTexture there, but the entry names a Buffer.");
        }
        const TextureDesc* texture = device_.find(entry.texture);
        if (texture == nullptr) return invalid("{}", device_.absence(entry.texture));
        const std::string name = device_.name(entry.texture);
        if (!has(texture->usage, TextureUsage::TextureBinding)) {
            return invalid("The usage ({}) of {} lacks TextureBinding.", to_text(texture->usage),
                           name);
        }
        if (!reads_as(layout.sample_type, texture->format, entry.aspect)) {
            return invalid("The aspect {} of {} ({}) cannot be read as {}.", to_text(entry.aspect),
                           name, to_text(texture->format), to_text(layout.sample_type));
        }
        if (entry.aspect == Aspect::StencilOnly && !device_.caps().features.sampled_stencil) {
            return invalid(
                "The aspect StencilOnly of {} needs sampled_stencil, which this adapter "
                "does not have.",
                name);
        }
        if (layout.multisampled != (texture->sample_count > 1)) {
            return invalid("Its layout says multisampled = {}, but the sample count of {} is {}.",
                           layout.multisampled, name, texture->sample_count);
        }
        record_.textures.push_back(entry.texture);
        return sampler(layout, entry);
    }

    Status sampler(const BindGroupLayoutEntry& layout, const BindGroupEntry& entry) {
        const bool only_fetched = layout.multisampled || layout.sample_type == SampleType::Uint;
        if (!entry.sampler && only_fetched) return {};
        const SamplerDesc* sampler = device_.find(entry.sampler);
        if (sampler == nullptr) return invalid("{}", device_.absence(entry.sampler));
        if (layout.sample_type == SampleType::Uint && is_linear(*sampler)) {
            return invalid("{} filters linearly, but the texture is read as Uint.",
                           device_.name(entry.sampler));
        }
        record_.samplers.push_back(entry.sampler);
        return {};
    }

    const DeviceState& device_;
    BindGroupRecord& record_;
};

}  // namespace

Result<BindGroupLayoutRecord> validate(DeviceState& device, const BindGroupLayoutDesc& desc) {
    const std::string name = object_name("BindGroupLayout", desc.label);
    std::vector<std::uint32_t> bindings;
    std::uint32_t dynamic_offsets = 0;
    for (const BindGroupLayoutEntry& entry : desc.entries) {
        if (entry.visibility == ShaderStage::None) {
            return invalid("Binding {} of {} is visible to no shader stage.", entry.binding, name);
        }
        if ((static_cast<std::uint32_t>(entry.visibility) & ~3U) != 0) {
            return invalid("The visibility ({}) of binding {} of {} has unknown bits.",
                           to_text(entry.visibility), entry.binding, name);
        }
        if (entry.has_dynamic_offset) {
            if (entry.type != BindingType::UniformBuffer) {
                return invalid("Binding {} of {} is a {}, which cannot have a dynamic offset.",
                               entry.binding, name, to_text(entry.type));
            }
            ++dynamic_offsets;
        }
        bindings.push_back(entry.binding);
    }
    std::ranges::sort(bindings);
    if (const auto twice = std::ranges::adjacent_find(bindings); twice != bindings.end()) {
        return invalid("Binding {} of {} is used twice.", *twice, name);
    }
    if (dynamic_offsets > max_dynamic_offsets) {
        return invalid("The number of dynamic offsets ({}) of {} exceeds max_dynamic_offsets ({}).",
                       dynamic_offsets, name, max_dynamic_offsets);
    }
    return BindGroupLayoutRecord{desc.label, device.intern(desc.entries)};
}

Result<BindGroupRecord> validate(DeviceState& device, const BindGroupDesc& desc) {
    const std::string name = object_name("BindGroup", desc.label);
    const BindGroupLayoutRecord* layout = device.find(desc.layout);
    if (layout == nullptr) return invalid("{}", device.absence(desc.layout));
    const LayoutShape& shape = *layout->shape;

    std::vector<const BindGroupEntry*> entries;
    for (const BindGroupEntry& entry : desc.entries) entries.push_back(&entry);
    std::ranges::sort(entries, {}, &BindGroupEntry::binding);

    BindGroupRecord record{desc.label, &shape, {}, {}, {}, {}};
    BindGroupCheck check(device, record);
    std::size_t matched = 0;
    for (const BindGroupEntry* entry : entries) {
        if (matched > 0 && shape.entries[matched - 1].binding == entry->binding) {
            return invalid("Binding {} of {} is given twice.", entry->binding, name);
        }
        const bool in_layout = std::ranges::binary_search(shape.entries, entry->binding, {},
                                                          &BindGroupLayoutEntry::binding);
        if (!in_layout) {
            return invalid("Binding {} of {} is not in {}.", entry->binding, name,
                           device.name(desc.layout));
        }
        if (shape.entries[matched].binding != entry->binding) break;  // one is left out
        if (const Status s = check.entry(shape.entries[matched], *entry); !s) {
            return in_frame(s, fmt::format("While checking binding {}.", entry->binding));
        }
        ++matched;
    }
    if (matched < shape.entries.size()) {
        return invalid("Binding {} of {} is missing in {}.", shape.entries[matched].binding,
                       device.name(desc.layout), name);
    }
    return record;
}

}  // namespace gnomon::gpu
