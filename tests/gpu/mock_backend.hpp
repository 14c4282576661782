// SPDX-License-Identifier: MIT
//
// A backend whose every call can be expected or made to fail.
#pragma once

#include <gmock/gmock.h>

#include <gnomon/gpu/backend.hpp>

namespace gnomon::gpu::test {

class MockBackend : public Backend {
public:
    MockBackend() {
        caps_.limits = {.max_texture_dimension_2d = 16,
                        .max_color_attachments = 1,
                        .max_vertex_buffers = 1,
                        .max_vertex_attributes = 1,
                        .max_buffer_size = 64,
                        .max_uniform_buffer_binding_size = 64};
    }
    ~MockBackend() override { gone(); }

    const Caps& caps() const override { return caps_; }
    Caps caps_;

    MOCK_METHOD(void, gone, ());
    MOCK_METHOD(Status, create_buffer, (BufferId, const BufferDesc&), (override));
    MOCK_METHOD(Status, create_texture, (TextureId, const TextureDesc&), (override));
    MOCK_METHOD(Status, create_sampler, (SamplerId, const SamplerDesc&), (override));
    MOCK_METHOD(Status, create_shader, (ShaderId, const ShaderDesc&), (override));
    MOCK_METHOD(Status, create_bind_group_layout, (BindGroupLayoutId, const BindGroupLayoutDesc&),
                (override));
    MOCK_METHOD(Status, create_bind_group, (BindGroupId, const BindGroupDesc&), (override));
    MOCK_METHOD(Status, create_render_pipeline, (RenderPipelineId, const RenderPipelineDesc&),
                (override));
    MOCK_METHOD(Status, create_query_set, (QuerySetId, const QuerySetDesc&), (override));
    MOCK_METHOD(void, destroy, (BufferId), (override));
    MOCK_METHOD(void, destroy, (TextureId), (override));
    MOCK_METHOD(void, destroy, (SamplerId), (override));
    MOCK_METHOD(void, destroy, (ShaderId), (override));
    MOCK_METHOD(void, destroy, (BindGroupLayoutId), (override));
    MOCK_METHOD(void, destroy, (BindGroupId), (override));
    MOCK_METHOD(void, destroy, (RenderPipelineId), (override));
    MOCK_METHOD(void, destroy, (QuerySetId), (override));
    MOCK_METHOD(Status, write_buffer, (BufferId, std::uint64_t, std::span<const std::byte>),
                (override));
    MOCK_METHOD(Status, write_texture, (TextureId, std::uint32_t, std::span<const std::byte>),
                (override));
    MOCK_METHOD(Status, submit, (const CommandBuffer&), (override));
    MOCK_METHOD(Status, wait_idle, (), (override));
    MOCK_METHOD(Status, read_buffer, (BufferId, std::uint64_t, std::span<std::byte>), (override));
    MOCK_METHOD(Status, read_texture, (TextureId, Aspect, std::span<std::byte>), (override));
    MOCK_METHOD(Result<std::vector<std::uint64_t>>, read_query_set, (QuerySetId), (override));
    MOCK_METHOD(Status, present, (TextureId), (override));
};

}  // namespace gnomon::gpu::test
