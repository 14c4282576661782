// SPDX-License-Identifier: MIT
#include "internal/gpu_quads.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>
#include <utility>

#include <gnomon/shadows/edge_quads.hpp>
#include <gnomon_shaders/shadow_pass.hpp>

#include "internal/volume_instances.hpp"

namespace gnomon::shadow_pass::internal {

using shadows::QuadFacing;

namespace {

constexpr std::uint32_t row = 4096;  // texels; the shaders know it

using Texel = std::array<std::uint32_t, 4>;

// As the shaders have it (std140).
struct QuadUniforms {
    glm::mat4 clip_from_local;
    glm::mat4 clip_from_far;
    glm::vec4 far_offset;
    glm::vec4 far_scale;  // x alone
    glm::vec4 light;
    glm::uvec4 ranges;
};

bool has_one_far_point(const shadows::VolumeDraw& draw) {
    return draw.quads->light.is_directional() && draw.extrusion.offset.w == 0.0F;
}

QuadUniforms uniforms_of(const shadows::VolumeDraw& draw, const glm::dmat4& clip_from_world) {
    const VolumeInstance of_all = instance_of(draw, clip_from_world);
    const shadows::QuadRanges ranges = shadows::quad_ranges(*draw.mesh, has_one_far_point(draw));
    return {of_all.clip_from_local,
            of_all.clip_from_far,
            of_all.far_offset,
            glm::vec4(of_all.far_scale, 0.0F, 0.0F, 0.0F),
            shadows::light_of_planes(*draw.mesh, draw.quads->light),
            {ranges.side_vertices, ranges.near_cap.first, ranges.far_cap.first,
             draw.quads->near_caps == shadows::NearCaps::Averted ? 1U : 0U}};
}

}  // namespace

shadows::Volume ranges_of(const shadows::VolumeDraw& draw) {
    const shadows::QuadRanges ranges = shadows::quad_ranges(*draw.mesh, has_one_far_point(draw));
    shadows::Volume volume;
    volume.sides = ranges.sides;
    volume.far_cap = ranges.far_cap;
    const bool averted = draw.quads->near_caps == shadows::NearCaps::Averted;
    shadows::CapList& caps = averted ? volume.near_cap_averted : volume.near_cap;
    caps.triples = ranges.near_cap;
    caps.faces = ranges.near_cap.count / 3;
    return volume;
}

shadows::DrawList without_quads(const shadows::DrawList& list) {
    // Bits keep their revision; what single precision decides is new with every light.
    static std::atomic<std::uint64_t> next{std::uint64_t{1} << 63U};
    shadows::DrawList result = list;
    for (shadows::VolumeDraw& draw : result.draws) {
        if (!draw.quads) continue;
        const shadows::QuadCasting casting = *std::exchange(draw.quads, std::nullopt);
        const bool one_far_point =
            casting.light.is_directional() && draw.extrusion.offset.w == 0.0F;
        const shadows::FaceBits bits = casting.bits != nullptr
                                           ? *casting.bits
                                           : shadows::face_bits_in_single_precision(
                                                 *draw.mesh, casting.light, casting.near_caps);
        draw.volume = std::make_shared<const shadows::Volume>(
            shadows::quad_volume(*draw.mesh, bits, casting.near_caps, one_far_point));
        if (casting.facing == QuadFacing::InShader) draw.revision = next.fetch_add(1);
    }
    return result;
}

Result<GpuQuads> GpuQuads::create(gpu::Device& device) {
    GpuQuads quads(device);
    if (const Status created = quads.create_objects(); !created) return forward_error(created);
    return quads;
}

Status GpuQuads::create_objects() {
    auto uniforms = device_->create_bind_group_layout(
        {.label = "edge quads",
         .entries = {{.binding = 0,
                      .visibility = gpu::ShaderStage::Vertex,
                      .has_dynamic_offset = true,
                      .min_binding_size = sizeof(QuadUniforms)}}});
    if (!uniforms) return forward_error(uniforms);
    uniform_layout_ = std::move(*uniforms);

    gpu::BindGroupLayoutDesc desc{.label = "mesh of edge quads"};
    for (std::uint32_t binding = 1; binding <= 4; ++binding) {
        desc.entries.push_back({.binding = binding,
                                .visibility = gpu::ShaderStage::Vertex,
                                .type = gpu::BindingType::SampledTexture,
                                .sample_type = gpu::SampleType::Uint});
    }
    auto textures = device_->create_bind_group_layout(desc);
    if (!textures) return forward_error(textures);
    texture_layout_ = std::move(*textures);

    const std::array sources{shaders::quads_uploaded_vert, shaders::quads_in_shader_vert};
    for (std::size_t i = 0; i < sources.size(); ++i) {
        auto shader = device_->create_shader(
            {.label = "edge quads", .stage = gpu::ShaderStage::Vertex, .source = sources[i]});
        if (!shader) return forward_error(shader);
        shaders_[i] = std::move(*shader);
    }
    return {};
}

gpu::ShaderId GpuQuads::vertex_shader(QuadFacing facing) const {
    return shaders_[facing == QuadFacing::Uploaded ? 0 : 1];
}

Result<gpu::Texture> GpuQuads::make_texture(const std::string& label, std::size_t elements,
                                            gpu::Format format) {
    const std::uint32_t limit = device_->caps().limits.max_texture_dimension_2d;
    const std::size_t rows = (elements + row - 1) / row;
    if (limit < row || rows > limit) {
        return fail(ErrorCode::Unsupported, "The edge quads of a mesh need a texture of " +
                                                std::to_string(row) + " x " + std::to_string(rows) +
                                                " texels for their " + label + "; " +
                                                device_->caps().adapter + " has no more than " +
                                                std::to_string(limit) + " a side.");
    }
    return device_->create_texture(
        {.label = "edge quads: " + label,
         .width = static_cast<std::uint32_t>(std::min<std::size_t>(elements, row)),
         .height = static_cast<std::uint32_t>(rows),
         .format = format,
         .usage = gpu::TextureUsage::TextureBinding | gpu::TextureUsage::CopyDst});
}

Status GpuQuads::fill(const gpu::Texture& texture, std::span<const std::byte> bytes,
                      std::size_t element_bytes, std::uint64_t& uploaded) {
    const std::size_t elements = bytes.size() / element_bytes;
    uploaded += bytes.size();
    if (elements <= row || elements % row == 0) return device_->write_texture(texture, 0, bytes);
    std::vector<std::byte> whole_rows(bytes.begin(), bytes.end());
    whole_rows.resize((elements + row - 1) / row * row * element_bytes);
    uploaded += whole_rows.size() - bytes.size();
    return device_->write_texture(texture, 0, whole_rows);
}

template <class T>
Result<gpu::Texture> GpuQuads::texture_of(const std::string& label, const std::vector<T>& elements,
                                          std::uint64_t& uploaded) {
    static_assert(sizeof(T) == sizeof(Texel));
    auto texture = make_texture(label, elements.size(), gpu::Format::Rgba32Uint);
    if (!texture) return texture;
    const Status filled =
        fill(*texture, std::as_bytes(std::span(elements)), sizeof(Texel), uploaded);
    if (!filled) return forward_error(filled);
    return texture;
}

Result<GpuQuads::Mesh*> GpuQuads::mesh_of(const shadows::ShadowMesh& mesh, std::uint64_t frame,
                                          std::uint64_t& uploaded) {
    if (const auto found = meshes_.find(mesh.id()); found != meshes_.end()) {
        found->second.used = frame;
        return &found->second;
    }
    std::vector<Texel> positions;
    positions.reserve(mesh.positions().size());
    for (const glm::vec3& p : mesh.positions()) {
        positions.push_back({std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y),
                             std::bit_cast<std::uint32_t>(p.z), 0});
    }
    std::vector<Texel> faces;
    faces.reserve(mesh.faces().size());
    for (const auto& [a, b, c] : mesh.faces()) faces.push_back({a, b, c, 0});

    Mesh made{.used = frame};
    auto texture = texture_of("positions", positions, uploaded);
    if (!texture) return forward_error(texture);
    made.positions = std::move(*texture);
    texture = texture_of("edges", shadows::edge_quads(mesh), uploaded);
    if (!texture) return forward_error(texture);
    made.edges = std::move(*texture);
    texture = texture_of("faces", faces, uploaded);
    if (!texture) return forward_error(texture);
    made.faces = std::move(*texture);
    return &meshes_.emplace(mesh.id(), std::move(made)).first->second;
}

Status GpuQuads::bind(const Mesh& mesh, Facing& facing) {
    auto group =
        device_->create_bind_group({.label = "edge quads",
                                    .layout = texture_layout_,
                                    .entries = {{.binding = 1, .texture = mesh.positions},
                                                {.binding = 2, .texture = mesh.edges},
                                                {.binding = 3, .texture = mesh.faces},
                                                {.binding = 4, .texture = facing.texture}}});
    if (!group) return forward_error(group);
    facing.group = std::move(*group);
    return {};
}

Result<gpu::BindGroupId> GpuQuads::textures_of(const shadows::VolumeDraw& draw, std::uint64_t frame,
                                               std::uint64_t& uploaded) {
    auto found_mesh = mesh_of(*draw.mesh, frame, uploaded);
    if (!found_mesh) return forward_error(found_mesh);
    Mesh& mesh = **found_mesh;

    if (draw.quads->facing == QuadFacing::InShader) {
        if (mesh.planes.group.id()) return mesh.planes.group.id();
        const shadows::FacePlanes& planes = draw.mesh->planes();
        std::vector<glm::vec4> texels;
        texels.reserve(draw.mesh->faces().size());
        for (std::size_t f = 0; f < draw.mesh->faces().size(); ++f) {
            texels.emplace_back(planes.normal_x[f], planes.normal_y[f], planes.normal_z[f],
                                planes.offset[f]);
        }
        auto texture = texture_of("planes", texels, uploaded);
        if (!texture) return forward_error(texture);
        mesh.planes.texture = std::move(*texture);
        if (const Status bound = bind(mesh, mesh.planes); !bound) return forward_error(bound);
        return mesh.planes.group.id();
    }

    if (const auto found = volumes_.find(draw.revision); found != volumes_.end()) {
        found->second.used = frame;
        return found->second.facing.group.id();
    }
    Facing facing;
    if (!mesh.free.empty()) {
        facing = std::move(mesh.free.back());
        mesh.free.pop_back();
    } else {
        auto texture = make_texture("facing", draw.quads->bits->size(), gpu::Format::R32Uint);
        if (!texture) return forward_error(texture);
        facing.texture = std::move(*texture);
        if (const Status bound = bind(mesh, facing); !bound) return forward_error(bound);
    }
    const Status filled = fill(facing.texture, std::as_bytes(std::span(*draw.quads->bits)),
                               sizeof(std::uint32_t), uploaded);
    if (!filled) return forward_error(filled);
    const auto [placed, inserted] = volumes_.emplace(
        draw.revision, Volume{.facing = std::move(facing), .mesh = draw.mesh->id(), .used = frame});
    return placed->second.facing.group.id();
}

Status GpuQuads::write_uniforms(const shadows::DrawList& list, const shadows::View& view,
                                std::uint64_t& uploaded) {
    const std::uint32_t alignment = device_->caps().limits.min_uniform_buffer_offset_alignment;
    const auto stride =
        static_cast<std::uint32_t>((sizeof(QuadUniforms) + alignment - 1) / alignment * alignment);
    const glm::dmat4 clip_from_world = view.clip_from_world();
    offsets_.assign(list.draws.size(), 0);
    uniform_bytes_.clear();
    for (std::size_t i = 0; i < list.draws.size(); ++i) {
        if (!list.draws[i].quads) continue;
        const std::size_t offset = uniform_bytes_.size();
        offsets_[i] = static_cast<std::uint32_t>(offset);
        const QuadUniforms u = uniforms_of(list.draws[i], clip_from_world);
        uniform_bytes_.resize(offset + stride);
        std::memcpy(uniform_bytes_.data() + offset, &u, sizeof u);
    }
    if (uniform_bytes_.empty()) return {};
    const std::uint64_t needed = uniform_bytes_.size();
    if (needed > uniform_capacity_) {
        const std::uint64_t capacity = needed + needed / 2 / stride * stride;
        uniform_capacity_ = 0;
        uniform_group_.reset();
        auto buffer = device_->create_buffer(
            {.label = "edge quads' matrices",
             .size = capacity,
             .usage = gpu::BufferUsage::Uniform | gpu::BufferUsage::CopyDst});
        if (!buffer) return forward_error(buffer);
        uniform_buffer_ = std::move(*buffer);
        auto group = device_->create_bind_group(
            {.label = "edge quads",
             .layout = uniform_layout_,
             .entries = {{.binding = 0, .buffer = uniform_buffer_, .size = sizeof(QuadUniforms)}}});
        if (!group) return forward_error(group);
        uniform_group_ = std::move(*group);
        uniform_capacity_ = capacity;
    }
    uploaded += needed;
    return device_->write_buffer(uniform_buffer_, 0, uniform_bytes_);
}

void GpuQuads::keep(std::uint64_t revision, std::uint64_t frame) {
    if (const auto found = volumes_.find(revision); found != volumes_.end()) {
        found->second.used = frame;
    }
}

void GpuQuads::free_unused(std::uint64_t frame) {
    for (auto it = volumes_.begin(); it != volumes_.end();) {
        Volume& volume = it->second;
        if (volume.used == frame) {
            ++it;
            continue;
        }
        if (const auto mesh = meshes_.find(volume.mesh); mesh != meshes_.end()) {
            mesh->second.free.push_back(std::move(volume.facing));
        }
        it = volumes_.erase(it);
    }
    constexpr std::uint64_t patience = 300;  // a mesh may be out of range for a while and come back
    std::erase_if(meshes_, [&](const auto& entry) { return entry.second.used + patience < frame; });
}

}  // namespace gnomon::shadow_pass::internal
