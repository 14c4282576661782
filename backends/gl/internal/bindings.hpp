// SPDX-License-Identifier: MIT
//
// Buffers, samplers, bind groups and query sets: the objects that take a few lines each.
#pragma once

#include "internal/adapter.hpp"
#include "internal/objects.hpp"

namespace gnomon::gl {

[[nodiscard]] Result<BufferObject> make_buffer(const Adapter& adapter, const gpu::BufferDesc& desc);
[[nodiscard]] Result<SamplerObject> make_sampler(const Adapter& adapter,
                                                 const gpu::SamplerDesc& desc);
[[nodiscard]] Result<QuerySetObject> make_query_set(const Adapter& adapter,
                                                    const gpu::QuerySetDesc& desc);
/// Fails when a binding number is beyond what GL counts (WebGPU has no such limit).
[[nodiscard]] Result<BindGroupLayoutObject> make_bind_group_layout(
    const Adapter& adapter, const gpu::BindGroupLayoutDesc& desc);
[[nodiscard]] BindGroupObject make_bind_group(const Objects& objects,
                                              const gpu::BindGroupDesc& desc);

}  // namespace gnomon::gl
