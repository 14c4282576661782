// SPDX-License-Identifier: MIT
#include <gnomon/sun_study/plan_projection.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <utility>

#include <gnomon/core/expects.hpp>

#include <gnomon_shaders/sun_study.hpp>

#include "internal/plan_tiles.hpp"
#include "internal/plan_triangles.hpp"

namespace gnomon::sun_study {

namespace {

constexpr std::size_t steps_a_buffer = PlanProjection::steps_a_buffer;
constexpr std::size_t buffers = 2;            // one is drawn while another is read
constexpr std::uint32_t matrix_stride = 256;  // WebGPU's largest alignment
constexpr std::uint32_t dark = 0xFF;

// Both sides of a face, or the one that is counter-clockwise; each by the bit that it writes.
using Pipelines = std::array<std::array<gpu::RenderPipeline, steps_a_buffer>, 2>;

struct Buffer {
    gpu::Texture stencil;
    gpu::Buffer matrices;
    gpu::BindGroup group;
};

// Eight steps, or fewer, of one tile.
struct Batch {
    internal::PlanTile tile;
    std::size_t first = 0;
    std::size_t count = 0;
};

Result<gpu::Buffer> filled_buffer(gpu::Device& device, const char* label, gpu::BufferUsage usage,
                                  std::span<const std::byte> bytes) {
    auto buffer = device.create_buffer(
        {.label = label, .size = bytes.size(), .usage = usage | gpu::BufferUsage::CopyDst});
    if (!buffer) return buffer;
    const Status written = device.write_buffer(*buffer, 0, bytes);
    if (!written) return forward_error(written);
    return buffer;
}

gpu::Format stencil_format(const gpu::Device& device) {
    return device.caps().features.depth24unorm_stencil8 ? gpu::Format::Depth24UnormStencil8
                                                        : gpu::Format::Depth32FloatStencil8;
}

Result<Pipelines> make_pipelines(gpu::Device& device, gpu::BindGroupLayoutId layout) {
    auto vertex = device.create_shader({.label = "flattened",
                                        .stage = gpu::ShaderStage::Vertex,
                                        .source = shaders::flattened_vert});
    if (!vertex) return forward_error(vertex);
    constexpr gpu::StencilFaceState set{.pass_op = gpu::StencilOp::Replace};
    Pipelines pipelines;
    for (std::size_t sides = 0; sides < 2; ++sides) {
        for (std::size_t bit = 0; bit < steps_a_buffer; ++bit) {
            auto made = device.create_render_pipeline(
                {.label = "flattened, bit " + std::to_string(bit),
                 .bind_group_layouts = {layout},
                 .vertex = *vertex,
                 .vertex_buffers = {{.array_stride = sizeof(glm::vec3),
                                     .attributes = {{.format = gpu::VertexFormat::Float32x3}}}},
                 .primitive = {.cull_mode = sides == 0 ? gpu::CullMode::None : gpu::CullMode::Back},
                 .depth_stencil = gpu::DepthStencilState{.format = stencil_format(device),
                                                         .depth_compare = gpu::Compare::Always,
                                                         .stencil_front = set,
                                                         .stencil_back = set,
                                                         .stencil_write_mask = 1U << bit}});
            if (!made) return forward_error(made);
            pipelines[sides][bit] = std::move(*made);
        }
    }
    return pipelines;
}

}  // namespace

struct PlanProjection::State {
    gpu::Device* device = nullptr;
    PlanGrid grid;
    shadows::Jobs jobs;
    std::uint32_t columns = 0;  // of a buffer
    std::uint32_t rows = 0;
    std::vector<internal::PlanTile> tiles;
    gpu::BindGroupLayout layout;
    Pipelines pipelines;
    std::array<Buffer, buffers> ring;
    std::uint32_t one_sided = 0;  // indices
    std::uint32_t two_sided = 0;
    gpu::Buffer vertices;
    gpu::Buffer indices;

    Status upload(std::span<const shadows::Caster> casters);
    Status make_buffers();
    [[nodiscard]] glm::mat4 clip_from_plan(const internal::PlanTile& tile,
                                           const glm::dvec3& towards_sun) const;
    Status draw(const Batch& batch, std::span<const glm::dvec3> suns, const Buffer& buffer);
    void unpack(const Batch& batch, std::span<const std::byte> stencil,
                std::vector<PlanMask>& masks) const;
};

Status PlanProjection::State::upload(std::span<const shadows::Caster> casters) {
    const internal::PlanTriangles triangles = internal::plan_triangles(casters, grid);
    if (triangles.faces.empty()) return {};
    const std::vector<glm::vec3> positions(triangles.vertices.begin(), triangles.vertices.end());
    auto made = filled_buffer(*device, "casters' vertices", gpu::BufferUsage::Vertex,
                              std::as_bytes(std::span(positions)));
    if (!made) return forward_error(made);
    vertices = std::move(*made);
    made = filled_buffer(*device, "casters' faces", gpu::BufferUsage::Index,
                         std::as_bytes(std::span(triangles.faces)));
    if (!made) return forward_error(made);
    indices = std::move(*made);
    one_sided = static_cast<std::uint32_t>(3 * triangles.one_sided);
    two_sided = static_cast<std::uint32_t>(3 * triangles.faces.size()) - one_sided;
    return {};
}

Status PlanProjection::State::make_buffers() {
    for (Buffer& buffer : ring) {
        auto stencil = device->create_texture(
            {.label = "plan",
             .width = columns,
             .height = rows,
             .format = stencil_format(*device),
             .usage = gpu::TextureUsage::RenderAttachment | gpu::TextureUsage::CopySrc});
        if (!stencil) return forward_error(stencil);
        auto matrices =
            device->create_buffer({.label = "suns",
                                   .size = matrix_stride * steps_a_buffer,
                                   .usage = gpu::BufferUsage::Uniform | gpu::BufferUsage::CopyDst});
        if (!matrices) return forward_error(matrices);
        auto group = device->create_bind_group(
            {.label = "suns",
             .layout = layout,
             .entries = {{.binding = 0, .buffer = *matrices, .size = sizeof(glm::mat4)}}});
        if (!group) return forward_error(group);
        buffer = {std::move(*stencil), std::move(*matrices), std::move(*group)};
    }
    return {};
}

// In double precision, rounded once.
glm::mat4 PlanProjection::State::clip_from_plan(const internal::PlanTile& tile,
                                                const glm::dvec3& towards_sun) const {
    const glm::dvec2 half = glm::dvec2(columns, rows) * (0.5 * grid.cell_m);
    const glm::dvec2 middle = internal::middle_of(tile, columns, rows, grid);
    const glm::dvec2 shift = internal::shadow_of_height_1(towards_sun);
    glm::dmat4 clip(0.0);
    clip[0].x = 1.0 / half.x;
    clip[1].y = 1.0 / half.y;
    clip[2] = glm::dvec4(shift / half, 0.0, 0.0);
    // Nothing is below the plane, and nothing is in front of anything: one depth does for all.
    clip[3] = glm::dvec4(-middle / half, 0.5, 1.0);
    return glm::mat4(clip);
}

Status PlanProjection::State::draw(const Batch& batch, std::span<const glm::dvec3> suns,
                                   const Buffer& buffer) {
    std::array<std::byte, matrix_stride * steps_a_buffer> bytes{};
    for (std::size_t i = 0; i < batch.count; ++i) {
        const glm::mat4 matrix = clip_from_plan(batch.tile, suns[batch.first + i]);
        std::memcpy(bytes.data() + i * matrix_stride, &matrix, sizeof matrix);
    }
    const Status written = device->write_buffer(buffer.matrices, 0, bytes);
    if (!written) return written;
    auto encoder = device->create_command_encoder("plan");
    {
        auto pass = encoder.begin_render_pass(
            {.label = "plan",
             .depth_stencil = gpu::DepthStencilAttachment{.texture = buffer.stencil,
                                                          .depth_load_op = gpu::LoadOp::Clear,
                                                          .depth_store_op = gpu::StoreOp::Discard,
                                                          .stencil_load_op = gpu::LoadOp::Clear}});
        if (indices) {
            pass.set_vertex_buffer(0, vertices);
            pass.set_index_buffer(indices, gpu::IndexFormat::Uint32);
            pass.set_stencil_reference(dark);
        }
        for (std::uint32_t i = 0; i < batch.count; ++i) {
            const std::array offset{i * matrix_stride};
            if (one_sided > 0) {
                pass.set_pipeline(pipelines[1][i]);
                pass.set_bind_group(0, buffer.group, offset);
                pass.draw_indexed(one_sided);
            }
            if (two_sided > 0) {
                pass.set_pipeline(pipelines[0][i]);
                pass.set_bind_group(0, buffer.group, offset);
                pass.draw_indexed(two_sided, 1, one_sided);
            }
        }
    }
    auto commands = encoder.finish();
    if (!commands) return forward_error(commands);
    return device->submit(*commands);
}

void PlanProjection::State::unpack(const Batch& batch, std::span<const std::byte> stencil,
                                   std::vector<PlanMask>& masks) const {
    const auto task = [&](std::size_t bit) {
        PlanMask& mask = masks[batch.first + bit];
        mask.resize(grid.cell_count());
        for (std::uint32_t row = 0; row < batch.tile.rows; ++row) {
            const std::byte* from = stencil.data() + std::size_t{row} * columns;
            std::uint8_t* to =
                mask.data() + std::size_t{batch.tile.row + row} * grid.columns + batch.tile.column;
            for (std::uint32_t column = 0; column < batch.tile.columns; ++column) {
                const unsigned bits = std::to_integer<unsigned>(from[column]);
                to[column] = static_cast<std::uint8_t>(~(bits >> bit) & 1U);
            }
        }
    };
    if (jobs) {
        jobs(batch.count, task);
    } else {
        for (std::size_t bit = 0; bit < batch.count; ++bit) task(bit);
    }
}

PlanProjection::PlanProjection(std::unique_ptr<State> state) : state_(std::move(state)) {}
PlanProjection::PlanProjection(PlanProjection&&) noexcept = default;
PlanProjection& PlanProjection::operator=(PlanProjection&&) noexcept = default;
PlanProjection::~PlanProjection() = default;

Result<PlanProjection> PlanProjection::create(gpu::Device& device,
                                              std::span<const shadows::Caster> casters,
                                              const PlanGrid& grid,
                                              const PlanProjectionOptions& options) {
    auto state = std::make_unique<State>();
    State& s = *state;
    s.device = &device;
    s.grid = grid;
    s.jobs = options.jobs;
    const std::uint32_t wanted =
        options.most_cells_a_side > 0 ? options.most_cells_a_side : internal::usual_tile_side;
    const std::uint32_t side = std::min(wanted, device.caps().limits.max_texture_dimension_2d);
    s.tiles = internal::tiles_of(grid, side);
    s.columns = std::min(side, grid.columns);
    s.rows = std::min(side, grid.rows);
    auto layout =
        device.create_bind_group_layout({.label = "sun",
                                         .entries = {{.binding = 0,
                                                      .visibility = gpu::ShaderStage::Vertex,
                                                      .has_dynamic_offset = true,
                                                      .min_binding_size = sizeof(glm::mat4)}}});
    if (!layout) return forward_error(layout);
    s.layout = std::move(*layout);
    auto pipelines = make_pipelines(device, s.layout);
    if (!pipelines) return forward_error(pipelines);
    s.pipelines = std::move(*pipelines);
    if (const Status made = s.make_buffers(); !made) return forward_error(made);
    if (const Status uploaded = s.upload(casters); !uploaded) return forward_error(uploaded);
    return PlanProjection(std::move(state));
}

Result<std::vector<PlanMask>> PlanProjection::lit(std::span<const glm::dvec3> suns) {
    State& s = *state_;
    for (const glm::dvec3& sun : suns) GNOMON_EXPECTS(sun.z > 0.0);
    std::vector<Batch> batches;
    for (std::size_t first = 0; first < suns.size(); first += steps_a_buffer) {
        for (const internal::PlanTile& tile : s.tiles) {
            batches.push_back({tile, first, std::min(steps_a_buffer, suns.size() - first)});
        }
    }
    std::vector<PlanMask> masks(suns.size());
    // A buffer is drawn into again as soon as it is read, and unpacked while that is drawn.
    for (std::size_t i = 0; i < batches.size() + buffers; ++i) {
        const Buffer& buffer = s.ring[i % buffers];
        std::vector<std::byte> stencil;
        if (i >= buffers) {
            auto read = s.device->read_texture(buffer.stencil, gpu::Aspect::StencilOnly);
            if (!read) return forward_error(read);
            stencil = std::move(*read);
        }
        if (i < batches.size()) {
            if (const Status drawn = s.draw(batches[i], suns, buffer); !drawn) {
                return forward_error(drawn);
            }
        }
        if (i >= buffers) s.unpack(batches[i - buffers], stencil, masks);
    }
    return masks;
}

}  // namespace gnomon::sun_study
