// SPDX-License-Identifier: MIT
#include <utility>

#include <fmt/format.h>

#include <gnomon/core/expects.hpp>
#include <gnomon/gpu/fault_backend.hpp>

namespace gnomon::gpu {

namespace {

class FaultBackend final : public Backend {
public:
    FaultBackend(std::unique_ptr<Backend> inner, FaultPlan& plan)
        : inner_(std::move(inner)), plan_(plan) {
        GNOMON_EXPECTS(inner_ != nullptr);
    }

    const Caps& caps() const override { return inner_->caps(); }

    Status create_buffer(BufferId id, const BufferDesc& desc) override {
        return guard("create_buffer", &Backend::create_buffer, id, desc);
    }
    Status create_texture(TextureId id, const TextureDesc& desc) override {
        return guard("create_texture", &Backend::create_texture, id, desc);
    }
    Status import_texture(TextureId id, const TextureDesc& desc,
                          const NativeTexture& native) override {
        return guard("import_texture", &Backend::import_texture, id, desc, native);
    }
    ClipDepth clip_depth(TextureId id) const override { return inner_->clip_depth(id); }
    Status takes_colors_beside(TextureId id) const override {
        return inner_->takes_colors_beside(id);
    }
    Status create_sampler(SamplerId id, const SamplerDesc& desc) override {
        return guard("create_sampler", &Backend::create_sampler, id, desc);
    }
    Status create_shader(ShaderId id, const ShaderDesc& desc) override {
        return guard("create_shader", &Backend::create_shader, id, desc);
    }
    Status create_bind_group_layout(BindGroupLayoutId id,
                                    const BindGroupLayoutDesc& desc) override {
        return guard("create_bind_group_layout", &Backend::create_bind_group_layout, id, desc);
    }
    Status create_bind_group(BindGroupId id, const BindGroupDesc& desc) override {
        return guard("create_bind_group", &Backend::create_bind_group, id, desc);
    }
    Status create_render_pipeline(RenderPipelineId id, const RenderPipelineDesc& desc) override {
        return guard("create_render_pipeline", &Backend::create_render_pipeline, id, desc);
    }
    Status create_query_set(QuerySetId id, const QuerySetDesc& desc) override {
        return guard("create_query_set", &Backend::create_query_set, id, desc);
    }

    void destroy(BufferId id) override { inner_->destroy(id); }
    void destroy(TextureId id) override { inner_->destroy(id); }
    void destroy(SamplerId id) override { inner_->destroy(id); }
    void destroy(ShaderId id) override { inner_->destroy(id); }
    void destroy(BindGroupLayoutId id) override { inner_->destroy(id); }
    void destroy(BindGroupId id) override { inner_->destroy(id); }
    void destroy(RenderPipelineId id) override { inner_->destroy(id); }
    void destroy(QuerySetId id) override { inner_->destroy(id); }

    Status write_buffer(BufferId id, std::uint64_t offset,
                        std::span<const std::byte> data) override {
        return guard("write_buffer", &Backend::write_buffer, id, offset, data);
    }
    Status write_texture(TextureId id, std::uint32_t mip_level,
                         std::span<const std::byte> data) override {
        return guard("write_texture", &Backend::write_texture, id, mip_level, data);
    }
    Status submit(const CommandBuffer& commands) override {
        return guard("submit", &Backend::submit, commands);
    }
    Status wait_idle() override { return guard("wait_idle", &Backend::wait_idle); }
    Status read_buffer(BufferId id, std::uint64_t offset, std::span<std::byte> data) override {
        return guard("read_buffer", &Backend::read_buffer, id, offset, data);
    }
    Status read_texture(TextureId id, Aspect aspect, std::span<std::byte> data) override {
        return guard("read_texture", &Backend::read_texture, id, aspect, data);
    }
    Result<std::vector<std::uint64_t>> read_query_set(QuerySetId id) override {
        return guard("read_query_set", &Backend::read_query_set, id);
    }
    Status present(TextureId id) override { return guard("present", &Backend::present, id); }

private:
    template <class Returned, class... Parameters, class... Arguments>
    Returned guard(const char* function, Returned (Backend::*call)(Parameters...),
                   const Arguments&... arguments) {
        if (++plan_.calls == plan_.fail_at) {
            return fail(plan_.code, fmt::format("The fault plan let call {}, {}, fail.",
                                                plan_.calls, function));
        }
        return ((*inner_).*call)(arguments...);
    }

    std::unique_ptr<Backend> inner_;
    FaultPlan& plan_;
};

}  // namespace

std::unique_ptr<Backend> create_fault_backend(std::unique_ptr<Backend> inner, FaultPlan& plan) {
    return std::make_unique<FaultBackend>(std::move(inner), plan);
}

}  // namespace gnomon::gpu
