// SPDX-License-Identifier: MIT
//
// The backend itself: it makes the context current, keeps the tables and hands each call to the
// file whose job it is.
#include <gnomon/gl/backend.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "internal/adapter.hpp"
#include "internal/bindings.hpp"
#include "internal/command_executor.hpp"
#include "internal/debug_output.hpp"
#include "internal/framebuffer_cache.hpp"
#include "internal/host_target.hpp"
#include "internal/kept_state.hpp"
#include "internal/objects.hpp"
#include "internal/pipeline.hpp"
#include "internal/present.hpp"
#include "internal/read_back.hpp"
#include "internal/textures.hpp"

namespace gnomon::gl {
namespace {

/// The context is current while one of these lives. A host that shares the context finds its
/// default framebuffer bound afterwards, not one of ours; one whose context was adopted, all as it
/// was.
class Session {
public:
    /// `asks`: for errors, before it ends.
    Session(Context& context, const Adapter& adapter, KeptScope scope, KeptState::Bound bound,
            bool asks)
        : gl_(adapter.gl), status_(context.make_current()) {
        if (!status_) return;
        // Those of the host's would be taken for ours.
        if (context.is_adopted() && asks) drop_errors(gl_);
        if (context.restores_state()) kept_.emplace(adapter, scope, bound);
    }
    ~Session() {
        if (status_) gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
    }
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    [[nodiscard]] const Status& status() const { return status_; }

private:
    const GlFunctions& gl_;
    Status status_;
    std::optional<KeptState> kept_;  // gives back what it keeps after all else
};

class GlBackend final : public gpu::Backend {
public:
    GlBackend(std::unique_ptr<Context> context, Adapter adapter, gpu::MessageSink sink)
        : context_(std::move(context)), adapter_(std::move(adapter)), sink_(std::move(sink)) {
        gl_.GenVertexArrays(1, &vertex_array_);
        if (adapter_.debug) install_debug_output(gl_, sink_);
    }

    ~GlBackend() override {
        const Session session = open(KeptScope::Bindings, false);
        if (!session.status()) return;  // the objects went with the context
        if (adapter_.debug) uninstall_debug_output(gl_);
        framebuffers_.clear(gl_);
        objects_.buffers.for_each([this](auto& buffer) { free(buffer); });
        objects_.textures.for_each([this](auto& texture) { free(texture); });
        objects_.samplers.for_each([this](auto& sampler) { free(sampler); });
        objects_.shaders.for_each([this](auto& shader) { free(shader); });
        objects_.pipelines.for_each([this](auto& pipeline) { free(pipeline); });
        objects_.query_sets.for_each([this](auto& set) { free(set); });
        gl_.DeleteVertexArrays(1, &vertex_array_);
    }

    [[nodiscard]] const gpu::Caps& caps() const override { return adapter_.caps; }

    Status create_buffer(gpu::BufferId id, const gpu::BufferDesc& desc) override {
        return create(objects_.buffers, id, [&] { return make_buffer(adapter_, desc); });
    }
    Status create_texture(gpu::TextureId id, const gpu::TextureDesc& desc) override {
        return create(
            objects_.textures, id, [&] { return make_texture(adapter_, framebuffers_, desc); },
            KeptScope::Everything);
    }
    Status import_texture(gpu::TextureId id, const gpu::TextureDesc& desc,
                          const gpu::NativeTexture& native) override {
        const auto* host = std::any_cast<HostTarget>(&native);
        if (host == nullptr) {
            return fail(ErrorCode::InvalidInput,
                        fmt::format("[Texture \"{}\"] cannot be imported: what OpenGL imports is a "
                                    "gl::HostTarget.",
                                    desc.label));
        }
        imported_any_ = true;
        const auto import = [&] {
            auto texture = import_host_target(adapter_, desc, *host);
            // Hosts' names are handed out again as well.
            if (texture) forget_framebuffers(gl_, framebuffers_, *texture);
            return texture;
        };
        return create(objects_.textures, id, import, KeptScope::Everything);
    }
    [[nodiscard]] gpu::ClipDepth clip_depth(gpu::TextureId id) const override {
        const TextureObject& texture = objects_.textures[id];
        return texture.host && texture.host->clip_depth == GL_NEGATIVE_ONE_TO_ONE
                   ? gpu::ClipDepth::MinusOneToOne
                   : gpu::ClipDepth::ZeroToOne;
    }
    [[nodiscard]] Status takes_colors_beside(gpu::TextureId id) const override {
        return gnomon::gl::takes_colors_beside(objects_.textures[id]);
    }
    Status create_sampler(gpu::SamplerId id, const gpu::SamplerDesc& desc) override {
        return create(objects_.samplers, id, [&] { return make_sampler(adapter_, desc); });
    }
    Status create_shader(gpu::ShaderId id, const gpu::ShaderDesc& desc) override {
        return create(objects_.shaders, id, [&] { return make_shader(adapter_, desc); });
    }
    Status create_bind_group_layout(gpu::BindGroupLayoutId id,
                                    const gpu::BindGroupLayoutDesc& desc) override {
        for (const gpu::BindGroupLayoutEntry& entry : desc.entries) {
            GLuint& used = entry.type == gpu::BindingType::UniformBuffer ? bound_.uniform_buffers
                                                                         : bound_.texture_units;
            used = std::max(used, entry.binding + 1);
        }
        return create(objects_.bind_group_layouts, id,
                      [&] { return make_bind_group_layout(adapter_, desc); });
    }
    Status create_bind_group(gpu::BindGroupId id, const gpu::BindGroupDesc& desc) override {
        objects_.bind_groups.put(id, make_bind_group(objects_, desc));
        return {};
    }
    Status create_render_pipeline(gpu::RenderPipelineId id,
                                  const gpu::RenderPipelineDesc& desc) override {
        return create(objects_.pipelines, id, [&] {
            const ShaderObject* fragment =
                desc.fragment ? &objects_.shaders[desc.fragment] : nullptr;
            return make_pipeline(adapter_, desc, objects_.shaders[desc.vertex], fragment);
        });
    }
    Status create_query_set(gpu::QuerySetId id, const gpu::QuerySetDesc& desc) override {
        return create(objects_.query_sets, id, [&] { return make_query_set(adapter_, desc); });
    }

    // GL itself keeps what work in flight still uses.
    void destroy(gpu::BufferId id) override { take_and_free(objects_.buffers, id); }
    void destroy(gpu::TextureId id) override { take_and_free(objects_.textures, id); }
    void destroy(gpu::SamplerId id) override { take_and_free(objects_.samplers, id); }
    void destroy(gpu::ShaderId id) override { take_and_free(objects_.shaders, id); }
    void destroy(gpu::RenderPipelineId id) override { take_and_free(objects_.pipelines, id); }
    void destroy(gpu::QuerySetId id) override { take_and_free(objects_.query_sets, id); }
    void destroy(gpu::BindGroupLayoutId id) override {
        static_cast<void>(objects_.bind_group_layouts.take(id));
    }
    void destroy(gpu::BindGroupId id) override { static_cast<void>(objects_.bind_groups.take(id)); }

    Status write_buffer(gpu::BufferId id, std::uint64_t offset,
                        std::span<const std::byte> data) override {
        const Session session = open(KeptScope::Bindings, asks_always());
        if (!session.status()) return session.status();
        gl_.BindBuffer(GL_COPY_WRITE_BUFFER, objects_.buffers[id].name);
        gl_.BufferSubData(GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(offset),
                          static_cast<GLsizeiptr>(data.size()), data.data());
        return check_if_asked("Writing to a buffer");
    }
    Status write_texture(gpu::TextureId id, std::uint32_t mip_level,
                         std::span<const std::byte> data) override {
        const Session session = open(KeptScope::Everything, asks_always());
        if (!session.status()) return session.status();
        const TextureObject& texture = objects_.textures[id];
        upload(gl_, texture, mip_level, data);
        return check_if_asked(
            fmt::format("Writing mip level {} of [Texture \"{}\"]", mip_level, texture.label));
    }

    Status submit(const gpu::CommandBuffer& commands) override {
        const Session session = open(KeptScope::Everything, asks_always());
        if (!session.status()) return session.status();
        GLint provoking_vertex = GL_LAST_VERTEX_CONVENTION;
        if (imported_any_) gl_.GetIntegerv(GL_PROVOKING_VERTEX, &provoking_vertex);
        CommandExecutor executor(adapter_, objects_, framebuffers_,
                                 {vertex_array_, static_cast<GLenum>(provoking_vertex)}, commands);
        if (Status run = executor.run(); !run) return run;
        return check_if_asked(fmt::format("Submitting [CommandBuffer \"{}\"]", commands.label));
    }
    Status wait_idle() override {
        const Session session = open(KeptScope::Bindings);
        if (!session.status()) return session.status();
        gl_.Finish();
        return check_errors(gl_, "Waiting for the device");
    }

    Status read_buffer(gpu::BufferId id, std::uint64_t offset, std::span<std::byte> out) override {
        const Session session = open(KeptScope::Bindings);
        if (!session.status()) return session.status();
        gl::read_buffer(gl_, objects_.buffers[id], offset, out);
        return check_errors(gl_, "Reading a buffer");
    }
    Status read_texture(gpu::TextureId id, gpu::Aspect aspect, std::span<std::byte> out) override {
        const Session session = open(KeptScope::Everything);
        if (!session.status()) return session.status();
        const TextureObject& texture = objects_.textures[id];
        if (Status read = gl::read_texture(gl_, framebuffers_, texture, aspect, out); !read) {
            return read;
        }
        return check_errors(gl_, fmt::format("Reading [Texture \"{}\"]", texture.label));
    }
    Result<std::vector<std::uint64_t>> read_query_set(gpu::QuerySetId id) override {
        const Session session = open(KeptScope::Bindings);
        if (!session.status()) return forward_error(session.status());
        auto values = gl::read_query_set(gl_, objects_.query_sets[id]);
        if (const Status read = check_errors(gl_, "Reading a query set"); !read) {
            return forward_error(read);
        }
        return values;
    }

    Status present(gpu::TextureId id) override {
        const Session session = open(KeptScope::Everything);
        if (!session.status()) return session.status();
        const TextureObject& texture = objects_.textures[id];
        if (Status presented = gl::present(gl_, framebuffers_, *context_, texture); !presented) {
            return presented;
        }
        return check_errors(gl_, fmt::format("Presenting [Texture \"{}\"]", texture.label));
    }

private:
    [[nodiscard]] Session open(KeptScope scope, bool asks = true) const {
        return Session(*context_, adapter_, scope, bound_, asks);
    }

    template <class Tag, class Object, class Make>
    Status create(Table<Tag, Object>& table, gpu::Id<Tag> id, Make&& make,
                  KeptScope scope = KeptScope::Bindings) {
        const Session session = open(scope);
        if (!session.status()) return session.status();
        Result<Object> made = make();
        if (!made) return forward_error(made);
        table.put(id, std::move(*made));
        return {};
    }

    template <class Tag, class Object>
    void take_and_free(Table<Tag, Object>& table, gpu::Id<Tag> id) {
        if (auto object = table.take(id)) {
            const Session session = open(KeptScope::Bindings, false);
            if (session.status()) free(*object);
        }
    }

    void free(const BufferObject& buffer) { gl_.DeleteBuffers(1, &buffer.name); }
    void free(const TextureObject& texture) { delete_texture(gl_, framebuffers_, texture); }
    void free(const SamplerObject& sampler) { gl_.DeleteSamplers(1, &sampler.name); }
    void free(const ShaderObject& shader) { gl_.DeleteShader(shader.name); }
    void free(const PipelineObject& pipeline) { gl_.DeleteProgram(pipeline.program); }
    void free(const QuerySetObject& set) {
        gl_.DeleteQueries(static_cast<GLsizei>(set.names.size()), set.names.data());
    }

    /// Asking GL for errors can make a threaded driver wait, so not all calls do, but for debugging
    /// and where state is asked for anyway. Creation, reading and waiting always do; an error of a
    /// write or a submission shows there at the latest, unless a host lives in the same context.
    [[nodiscard]] bool asks_always() const { return adapter_.debug || context_->restores_state(); }
    [[nodiscard]] Status check_if_asked(const std::string& action) const {
        return asks_always() ? check_errors(gl_, action) : Status{};
    }

    std::unique_ptr<Context> context_;
    Adapter adapter_;
    const GlFunctions& gl_ = adapter_.gl;
    gpu::MessageSink sink_;
    GLuint vertex_array_ = 0;
    KeptState::Bound bound_;  // by any bind group
    bool imported_any_ = false;
    FramebufferCache framebuffers_;
    Objects objects_;
};

}  // namespace

Result<std::unique_ptr<gpu::Backend>> create_backend(std::unique_ptr<Context> context,
                                                     const BackendOptions& options) {
    if (context == nullptr) {
        return fail(ErrorCode::InvalidInput,
                    "There is no OpenGL context (null) to make a backend from.");
    }
    if (options.debug && context->is_adopted()) {
        return fail(ErrorCode::Unsupported,
                    "BackendOptions::debug is not for a context that was adopted, since its debug "
                    "callback is the host's: set one there, which hears of gnomon's calls too.");
    }
    if (const Status current = context->make_current(); !current) return forward_error(current);
    Result<Adapter> adapter = open_adapter(*context, options);
    if (!adapter) return forward_error(adapter);
    drop_errors(adapter->gl);  // of a host that used the context before
    return std::make_unique<GlBackend>(std::move(context), std::move(*adapter),
                                       options.message_sink);
}

}  // namespace gnomon::gl
