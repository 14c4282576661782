// SPDX-License-Identifier: MIT
//
// Any bytes as calls on a device that draws nothing: descriptors that are valid but for a few
// members, and commands in any order. Each call does what it says or gives a sentence; what
// finish() accepted can be submitted.
#include "tests/gpu/world.hpp"

#include "fuzz_input.hpp"

namespace gnomon::test {
namespace {

using namespace gpu;

constexpr std::initializer_list<std::uint64_t> sizes{0, 4, 12, 64, 256, 1024, 3, ~std::uint64_t{0}};
constexpr std::initializer_list<std::uint32_t> counts{1, 2, 0, 3, 4, 8, 64, ~0U};

template <class T>
bool done(const Result<T>& result) {
    if (!result) require_sentence(result.error(), ErrorCode::Validation);
    return result.has_value();
}

/// The objects of one kind: ids that are alive, were once, and never were.
template <class Tag>
struct Pool {
    std::vector<Owned<Tag>> owners = {};
    std::vector<Id<Tag>> ids = {};

    void add(Result<Owned<Tag>> made) {
        if (!done(made)) return;
        ids.push_back(made->id());
        owners.push_back(std::move(*made));
    }
    Id<Tag> pick(FuzzInput& input) const {
        const std::uint32_t index = input.below(ids.size() + 2);
        if (index < ids.size()) return ids[index];
        return index == ids.size() ? Id<Tag>{} : Id<Tag>{input.below(64), input.below(4)};
    }
    void free_one(FuzzInput& input) {
        if (!owners.empty()) owners[input.below(owners.size())].reset();
    }
};

class Caller {
public:
    explicit Caller(FuzzInput& input) : input_(input) {
        buffers_.ids = {world_.vertices, world_.instances, world_.indices, world_.uniforms};
        textures_.ids = {world_.color, world_.depth, world_.color4, world_.albedo};
        samplers_.ids = {world_.sampler};
        shaders_.ids = {world_.vertex_shader, world_.fragment_shader};
        layouts_.ids = {world_.uniform_layout, world_.texture_layout};
        groups_.ids = {world_.uniform_group, world_.texture_group};
        pipelines_.ids = {world_.pipeline};
        query_sets_.ids = {world_.occlusion, world_.timestamps};
    }

    void call() {
        Device& device = world_.device;
        switch (input_.below(14)) {
            case 0: return buffers_.add(device.create_buffer(buffer()));
            case 1: return textures_.add(device.create_texture(texture()));
            case 2: return samplers_.add(device.create_sampler({}));
            case 3: return shaders_.add(device.create_shader(shader()));
            case 4: return layouts_.add(device.create_bind_group_layout(layout()));
            case 5: return groups_.add(device.create_bind_group(group()));
            case 6: return pipelines_.add(device.create_render_pipeline(pipeline()));
            case 7: return query_sets_.add(device.create_query_set(query_set()));
            case 8: return free_one();
            case 9: return write();
            case 10: return read();
            default: return submit();
        }
    }

private:
    bool sometimes() { return input_.below(8) == 7; }
    std::uint64_t size() { return input_.one_of(sizes); }
    std::uint32_t count() { return input_.one_of(counts); }

    BufferDesc buffer() { return {"", size(), static_cast<BufferUsage>(input_.below(64))}; }
    TextureDesc texture() {
        TextureDesc desc{.width = count(), .height = count()};
        desc.format = input_.up_to(Format::Depth32FloatStencil8);
        desc.usage = static_cast<TextureUsage>(input_.below(32));
        if (sometimes()) desc.mip_level_count = count();
        if (sometimes()) desc.sample_count = count();
        return desc;
    }
    ShaderDesc shader() {
        ShaderDesc desc = gpu::test::shader_desc("", static_cast<ShaderStage>(input_.below(5)));
        if (sometimes()) desc.source = {};
        return desc;
    }
    BindGroupLayoutDesc layout() {
        BindGroupLayoutDesc desc;
        desc.entries.resize(input_.below(4));
        for (BindGroupLayoutEntry& entry : desc.entries) {
            entry.binding = count();
            entry.visibility = static_cast<ShaderStage>(input_.below(5));
            entry.type = input_.up_to(BindingType::SampledTexture);
            entry.has_dynamic_offset = input_.flag();
            entry.min_binding_size = size();
            entry.sample_type = input_.up_to(SampleType::Depth);
            entry.multisampled = input_.flag();
        }
        return desc;
    }
    BindGroupDesc group() {
        BindGroupDesc desc{.layout = layouts_.pick(input_)};
        desc.entries.resize(input_.below(4));
        for (BindGroupEntry& entry : desc.entries) {
            entry.binding = count();
            if (input_.flag()) entry.buffer = buffers_.pick(input_);
            entry.offset = size();
            entry.size = size();
            if (input_.flag()) entry.texture = textures_.pick(input_);
            if (input_.flag()) entry.sampler = samplers_.pick(input_);
            entry.aspect = input_.up_to(Aspect::StencilOnly);
        }
        return desc;
    }
    RenderPipelineDesc pipeline() {
        RenderPipelineDesc desc = world_.pipeline_desc();
        if (sometimes()) desc.vertex = shaders_.pick(input_);
        if (sometimes()) desc.fragment = shaders_.pick(input_);
        if (sometimes()) desc.bind_group_layouts.push_back(layouts_.pick(input_));
        if (sometimes()) desc.bind_group_layouts.clear();
        if (sometimes()) desc.sample_count = count();
        if (sometimes()) desc.depth_stencil = std::nullopt;
        if (sometimes()) desc.targets.resize(input_.below(10));
        for (ColorTargetState& target : desc.targets) {
            if (sometimes()) target.format = input_.up_to(Format::Depth32FloatStencil8);
            if (sometimes()) target.blend = BlendState{};
        }
        if (sometimes()) desc.vertex_buffers.resize(input_.below(10));
        for (VertexBufferLayout& vertices : desc.vertex_buffers) {
            if (sometimes()) vertices.array_stride = size();
            if (sometimes()) vertices.attributes.resize(input_.below(18));
            for (VertexAttribute& attribute : vertices.attributes) {
                if (sometimes()) attribute.shader_location = count();
                if (sometimes()) attribute.offset = size();
            }
        }
        if (desc.depth_stencil && sometimes()) {
            desc.depth_stencil->format = input_.up_to(Format::Depth32FloatStencil8);
            desc.depth_stencil->depth_compare = input_.up_to(Compare::Always);
            desc.depth_stencil->depth_bias_slope_scale = input_.value<float>();
        }
        return desc;
    }
    QuerySetDesc query_set() { return {"", input_.up_to(QueryType::Timestamp), count()}; }

    void free_one() {
        switch (input_.below(4)) {
            case 0: return buffers_.free_one(input_);
            case 1: return textures_.free_one(input_);
            case 2: return pipelines_.free_one(input_);
            default: return groups_.free_one(input_);
        }
    }
    void write() {
        const std::vector<std::byte> data(input_.one_of<std::size_t>({0, 4, 128, 16, 3, 8192}));
        static_cast<void>(done(world_.device.write_buffer(buffers_.pick(input_), size(), data)));
        static_cast<void>(done(world_.device.write_texture(textures_.pick(input_), count(), data)));
    }
    void read() {
        static_cast<void>(done(world_.device.read_buffer(buffers_.pick(input_), size(), size())));
        static_cast<void>(done(
            world_.device.read_texture(textures_.pick(input_), input_.up_to(Aspect::StencilOnly))));
        static_cast<void>(done(world_.device.read_query_set(query_sets_.pick(input_))));
        static_cast<void>(done(world_.device.present(textures_.pick(input_))));
    }

    RenderPassDesc pass() {
        RenderPassDesc desc = world_.pass_desc();
        if (sometimes()) desc.color_attachments.resize(input_.below(10));
        for (ColorAttachment& color : desc.color_attachments) {
            if (sometimes()) color.texture = textures_.pick(input_);
            if (sometimes()) color.resolve_target = textures_.pick(input_);
            if (sometimes()) color.clear_value.r = input_.value<double>();
            if (sometimes()) color.store_op = StoreOp::Discard;
        }
        if (sometimes()) desc.depth_stencil = std::nullopt;
        if (desc.depth_stencil && sometimes()) {
            desc.depth_stencil->texture = textures_.pick(input_);
            desc.depth_stencil->depth_clear_value = input_.value<float>();
            desc.depth_stencil->stencil_clear_value = count();
            desc.depth_stencil->depth_load_op = input_.up_to(LoadOp::Clear);
            desc.depth_stencil->depth_read_only = input_.flag();
        }
        if (sometimes()) desc.occlusion_query_set = query_sets_.pick(input_);
        if (sometimes()) desc.timestamp_writes = {{query_sets_.pick(input_), count(), count()}};
        return desc;
    }

    void command(RenderPassEncoder& pass) {
        const std::uint32_t offsets[] = {0, 256, 4, 1, 512};
        switch (input_.below(14)) {
            case 0: return world_.set_state(pass);
            case 1: return pass.set_pipeline(pipelines_.pick(input_));
            case 2:
                return pass.set_bind_group(input_.below(6), groups_.pick(input_),
                                           std::span(offsets).first(input_.below(6)));
            case 3: return pass.set_vertex_buffer(input_.below(10), buffers_.pick(input_), size());
            case 4:
                return pass.set_index_buffer(buffers_.pick(input_),
                                             input_.up_to(IndexFormat::Uint32), size());
            case 5: return pass.set_stencil_reference(count());
            case 6:
                return pass.set_viewport(input_.value<float>(), 0.0F, input_.value<float>(), 32.0F,
                                         input_.value<float>());
            case 7: return pass.set_scissor_rect(count(), count(), count(), count());
            case 8: return pass.draw(count(), count(), count(), count());
            case 9:
                return pass.draw_indexed(count(), count(), count(), input_.value<std::int32_t>(),
                                         count());
            case 10: return pass.begin_occlusion_query(count());
            case 11: return pass.end_occlusion_query();
            case 12: return input_.flag() ? pass.push_debug_group("group") : pass.pop_debug_group();
            default:
                if (sometimes()) return pass.end();
                if (input_.flag()) return pass.set_blend_constant({});
                return pass.set_depth_bounds(input_.value<float>(), input_.value<float>());
        }
    }

    void submit() {
        CommandEncoder encoder = world_.device.create_command_encoder("frame");
        for (std::uint32_t left = input_.below(4); left > 0; --left) {
            if (sometimes()) {
                encoder.copy_buffer_to_buffer(buffers_.pick(input_), size(), buffers_.pick(input_),
                                              size(), size());
            }
            if (sometimes()) encoder.pop_debug_group();
            RenderPassEncoder encoded = encoder.begin_render_pass(pass());
            for (std::uint32_t n = input_.below(16); n > 0; --n) command(encoded);
        }
        const Result<CommandBuffer> commands = encoder.finish();
        if (!done(commands)) return;
        const bool freed = sometimes();
        if (freed) free_one();
        const bool submitted = done(world_.device.submit(*commands));
        require(submitted || freed, "what finish() accepted can be submitted");
    }

    FuzzInput& input_;
    gpu::test::World world_;
    Pool<BufferTag> buffers_;
    Pool<TextureTag> textures_;
    Pool<SamplerTag> samplers_;
    Pool<ShaderTag> shaders_;
    Pool<BindGroupLayoutTag> layouts_;
    Pool<BindGroupTag> groups_;
    Pool<RenderPipelineTag> pipelines_;
    Pool<QuerySetTag> query_sets_;
};

}  // namespace
}  // namespace gnomon::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    gnomon::test::FuzzInput input(data, size);
    gnomon::test::Caller caller(input);
    for (int calls = 0; calls < 64 && !input.empty(); ++calls) caller.call();
    return 0;
}
