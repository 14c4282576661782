// SPDX-License-Identifier: MIT
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <imgui.h>
#include <glm/glm.hpp>

#include <gnomon/ui/ui_pass.hpp>
#include <gnomon_shaders/ui.hpp>

namespace gnomon::ui {

namespace {

static_assert(sizeof(ImDrawVert) == 20);
static_assert(sizeof(ImDrawIdx) == 2);  // IndexFormat::Uint16

/// Pixels of a clip rectangle, which may be larger than any target, or than an int.
glm::ivec2 whole_pixels(const glm::vec2& pixels) {
    constexpr float most = 1 << 20;
    return glm::ivec2(glm::clamp(pixels, glm::vec2(-most), glm::vec2(most)));
}

/// Buffers grow by half as much again, so that a panel that grows line by line makes few.
std::uint64_t roomy(std::uint64_t bytes) { return (bytes + bytes / 2 + 4095) / 4096 * 4096; }

template <class T>
Status keep(Result<T> made, T& out) {
    if (!made) return forward_error(made);
    out = std::move(*made);
    return {};
}

struct GrowingBuffer {
    gpu::Buffer buffer;
    std::uint64_t size = 0;
};

// One indexed draw, in pixels of the target.
struct Item {
    glm::ivec2 clip_min{0};
    glm::ivec2 clip_max{0};
    std::uint32_t index_count = 0;
    std::uint32_t first_index = 0;
    std::int32_t base_vertex = 0;
};

}  // namespace

struct UiPass::State {
    gpu::Device* device = nullptr;
    gpu::Texture atlas;
    gpu::Sampler sampler;
    gpu::Buffer frame;
    gpu::BindGroupLayout layout;
    gpu::BindGroup group;
    gpu::RenderPipeline pipeline;
    GrowingBuffer vertices, indices;
    std::vector<std::byte> vertex_bytes, index_bytes;
    std::vector<Item> items;
    ImTextureID atlas_id = nullptr;

    Status create(ImFontAtlas& fonts, const UiPassDesc& desc);
    Status create_atlas(ImFontAtlas& fonts);
    Status create_pipeline(const UiPassDesc& desc);
    Status upload(GrowingBuffer& target, gpu::BufferUsage usage, const char* label,
                  std::vector<std::byte>& bytes) const;
    void collect(const ImDrawData& data);
    Status upload_all(const ImDrawData& data);
};

Status UiPass::State::create_atlas(ImFontAtlas& fonts) {
    unsigned char* texels = nullptr;
    int width = 0;
    int height = 0;
    fonts.GetTexDataAsAlpha8(&texels, &width, &height);
    if (texels == nullptr || width <= 0 || height <= 0) {
        return fail(ErrorCode::InvalidInput, "The font atlas of the panel could not be built.");
    }
    atlas_id = fonts.TexID;
    if (const Status made =
            keep(device->create_texture(
                     {.label = "font atlas",
                      .width = static_cast<std::uint32_t>(width),
                      .height = static_cast<std::uint32_t>(height),
                      .format = gpu::Format::R8Unorm,
                      .usage = gpu::TextureUsage::TextureBinding | gpu::TextureUsage::CopyDst}),
                 atlas);
        !made) {
        return made;
    }
    const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    return device->write_texture(atlas, 0, std::as_bytes(std::span(texels, count)));
}

Status UiPass::State::create_pipeline(const UiPassDesc& desc) {
    gpu::Shader vertex;
    gpu::Shader fragment;
    if (const Status made = keep(
            device->create_shader(
                {.label = "ui", .stage = gpu::ShaderStage::Vertex, .source = shaders::ui_vert}),
            vertex);
        !made) {
        return made;
    }
    if (const Status made = keep(
            device->create_shader(
                {.label = "ui", .stage = gpu::ShaderStage::Fragment, .source = shaders::ui_frag}),
            fragment);
        !made) {
        return made;
    }
    constexpr gpu::BlendComponent over{.src_factor = gpu::BlendFactor::One,
                                       .dst_factor = gpu::BlendFactor::OneMinusSrcAlpha};
    return keep(device->create_render_pipeline(
                    {.label = "ui",
                     .bind_group_layouts = {layout},
                     .vertex = vertex,
                     .fragment = fragment,
                     .vertex_buffers = {{.array_stride = sizeof(ImDrawVert),
                                         .attributes = {{gpu::VertexFormat::Float32x2, 0, 0},
                                                        {gpu::VertexFormat::Float32x2, 8, 1},
                                                        {gpu::VertexFormat::Unorm8x4, 16, 2}}}},
                     .targets = {{.format = desc.target_format,
                                  .blend = gpu::BlendState{.color = over, .alpha = over}}}}),
                pipeline);
}

Status UiPass::State::create(ImFontAtlas& fonts, const UiPassDesc& desc) {
    if (const Status made = create_atlas(fonts); !made) return made;
    Status made = keep(device->create_sampler({.label = "font atlas",
                                               .mag_filter = gpu::FilterMode::Linear,
                                               .min_filter = gpu::FilterMode::Linear}),
                       sampler);
    if (!made) return made;
    made = keep(
        device->create_buffer({.label = "ui frame",
                               .size = sizeof(glm::vec4),
                               .usage = gpu::BufferUsage::Uniform | gpu::BufferUsage::CopyDst}),
        frame);
    if (!made) return made;
    made = keep(
        device->create_bind_group_layout({.label = "ui",
                                          .entries = {{.binding = 0,
                                                       .visibility = gpu::ShaderStage::Vertex,
                                                       .min_binding_size = sizeof(glm::vec4)},
                                                      {.binding = 1,
                                                       .visibility = gpu::ShaderStage::Fragment,
                                                       .type = gpu::BindingType::SampledTexture}}}),
        layout);
    if (!made) return made;
    made = keep(device->create_bind_group(
                    {.label = "ui",
                     .layout = layout,
                     .entries = {{.binding = 0, .buffer = frame},
                                 {.binding = 1, .texture = atlas, .sampler = sampler}}}),
                group);
    if (!made) return made;
    return create_pipeline(desc);
}

Status UiPass::State::upload(GrowingBuffer& target, gpu::BufferUsage usage, const char* label,
                             std::vector<std::byte>& bytes) const {
    if (bytes.empty()) return {};
    bytes.resize((bytes.size() + 3) / 4 * 4);
    if (bytes.size() > target.size) {
        const std::uint64_t size = roomy(bytes.size());
        if (const Status made = keep(
                device->create_buffer(
                    {.label = label, .size = size, .usage = usage | gpu::BufferUsage::CopyDst}),
                target.buffer);
            !made) {
            return made;
        }
        target.size = size;
    }
    return device->write_buffer(target.buffer, 0, bytes);
}

void UiPass::State::collect(const ImDrawData& data) {
    vertex_bytes.clear();
    index_bytes.clear();
    items.clear();
    const auto append = [](std::vector<std::byte>& out, const auto& in) {
        const auto bytes = std::as_bytes(std::span(in.Data, static_cast<std::size_t>(in.Size)));
        out.insert(out.end(), bytes.begin(), bytes.end());
    };
    const glm::vec2 origin(data.DisplayPos.x, data.DisplayPos.y);
    const glm::vec2 scale(data.FramebufferScale.x, data.FramebufferScale.y);
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        const auto first_vertex = vertex_bytes.size() / sizeof(ImDrawVert);
        const auto first_index = index_bytes.size() / sizeof(ImDrawIdx);
        append(vertex_bytes, list.VtxBuffer);
        append(index_bytes, list.IdxBuffer);
        for (const ImDrawCmd& command : list.CmdBuffer) {
            if (command.UserCallback != nullptr || command.GetTexID() != atlas_id) continue;
            const glm::vec4 clip(command.ClipRect.x, command.ClipRect.y, command.ClipRect.z,
                                 command.ClipRect.w);
            items.push_back(
                {.clip_min = whole_pixels((glm::vec2(clip) - origin) * scale),
                 .clip_max = whole_pixels((glm::vec2(clip.z, clip.w) - origin) * scale),
                 .index_count = command.ElemCount,
                 .first_index = static_cast<std::uint32_t>(first_index + command.IdxOffset),
                 .base_vertex = static_cast<std::int32_t>(first_vertex + command.VtxOffset)});
        }
    }
}

Result<UiPass> UiPass::create(gpu::Device& device, ImFontAtlas& atlas, const UiPassDesc& desc) {
    auto state = std::make_unique<State>();
    state->device = &device;
    if (const Status created = state->create(atlas, desc); !created) return forward_error(created);
    return UiPass(std::move(state));
}

UiPass::UiPass(std::unique_ptr<State> state) : state_(std::move(state)) {}
UiPass::UiPass(UiPass&&) noexcept = default;
UiPass& UiPass::operator=(UiPass&&) noexcept = default;
UiPass::~UiPass() = default;

Status UiPass::prepare(const ImDrawData& data) {
    const Status uploaded = state_->upload_all(data);
    // What is not on the device is not drawn.
    if (!uploaded) state_->items.clear();
    return uploaded;
}

Status UiPass::State::upload_all(const ImDrawData& data) {
    collect(data);
    if (items.empty()) return {};
    const glm::vec2 scale(2.0F / data.DisplaySize.x, -2.0F / data.DisplaySize.y);
    const glm::vec2 offset =
        glm::vec2(-1.0F, 1.0F) - glm::vec2(data.DisplayPos.x, data.DisplayPos.y) * scale;
    const std::array<float, 4> uniforms{scale.x, scale.y, offset.x, offset.y};
    if (const Status written = device->write_buffer(frame, 0, std::as_bytes(std::span(uniforms)));
        !written) {
        return written;
    }
    if (const Status done = upload(vertices, gpu::BufferUsage::Vertex, "ui vertices", vertex_bytes);
        !done) {
        return done;
    }
    return upload(indices, gpu::BufferUsage::Index, "ui indices", index_bytes);
}

void UiPass::record(gpu::RenderPassEncoder& pass, std::uint32_t width, std::uint32_t height) const {
    const State& s = *state_;
    if (s.items.empty()) return;
    pass.set_pipeline(s.pipeline);
    pass.set_bind_group(0, s.group);
    pass.set_vertex_buffer(0, s.vertices.buffer);
    pass.set_index_buffer(s.indices.buffer, gpu::IndexFormat::Uint16);
    const glm::ivec2 size(width, height);
    for (const Item& item : s.items) {
        const glm::ivec2 min = glm::clamp(item.clip_min, glm::ivec2(0), size);
        const glm::ivec2 extent = glm::clamp(item.clip_max, glm::ivec2(0), size) - min;
        if (extent.x <= 0 || extent.y <= 0) continue;
        pass.set_scissor_rect(static_cast<std::uint32_t>(min.x), static_cast<std::uint32_t>(min.y),
                              static_cast<std::uint32_t>(extent.x),
                              static_cast<std::uint32_t>(extent.y));
        pass.draw_indexed(item.index_count, 1, item.first_index, item.base_vertex);
    }
    pass.set_scissor_rect(0, 0, width, height);
}

Status UiPass::draw(const ImDrawData& data, gpu::TextureId target, std::uint32_t width,
                    std::uint32_t height) {
    if (const Status prepared = prepare(data); !prepared) return prepared;
    if (state_->items.empty()) return {};
    gpu::CommandEncoder encoder = state_->device->create_command_encoder("ui");
    {
        auto pass = encoder.begin_render_pass(
            {.label = "ui",
             .color_attachments = {{.texture = target, .load_op = gpu::LoadOp::Load}}});
        record(pass, width, height);
    }
    const auto commands = encoder.finish();
    if (!commands) return forward_error(commands);
    return state_->device->submit(*commands);
}

}  // namespace gnomon::ui
