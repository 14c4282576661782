// SPDX-License-Identifier: MIT
#include "internal/gpu_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>

namespace gnomon::render::internal {

namespace {

// std140, as in surface.glsl.
struct MaterialUniforms {
    glm::vec4 base_color;
    glm::vec4 emissive;
    glm::vec4 parameters;
};
constexpr std::uint32_t material_stride = 256;

struct Attributes {
    glm::vec3 normal;
    glm::vec2 texcoord;
};

double srgb_to_linear(double x) {
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}
double linear_to_srgb(double x) {
    return x <= 0.0031308 ? x * 12.92 : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}

// The next mip level: a box filter, in linear light.
scene::Image half_size(const scene::Image& image) {
    static const std::array<float, 256> to_linear = [] {
        std::array<float, 256> table{};
        for (std::size_t i = 0; i < table.size(); ++i) {
            table[i] = static_cast<float>(srgb_to_linear(static_cast<double>(i) / 255.0));
        }
        return table;
    }();
    scene::Image half;
    half.width = std::max(1U, image.width / 2);
    half.height = std::max(1U, image.height / 2);
    half.rgba.resize(std::size_t{4} * half.width * half.height);
    for (std::uint32_t y = 0; y < half.height; ++y) {
        for (std::uint32_t x = 0; x < half.width; ++x) {
            for (std::size_t channel = 0; channel < 4; ++channel) {
                float sum = 0.0F;
                for (std::uint32_t k = 0; k < 4; ++k) {
                    const std::uint32_t sx = std::min(2 * x + (k & 1U), image.width - 1);
                    const std::uint32_t sy = std::min(2 * y + (k >> 1U), image.height - 1);
                    const std::uint8_t value =
                        image.rgba[(std::size_t{sy} * image.width + sx) * 4 + channel];
                    sum += channel < 3 ? to_linear[value] : static_cast<float>(value) / 255.0F;
                }
                const double mean = static_cast<double>(sum) / 4.0;
                const double encoded = channel < 3 ? linear_to_srgb(mean) : mean;
                half.rgba[(std::size_t{y} * half.width + x) * 4 + channel] =
                    static_cast<std::uint8_t>(std::lround(std::clamp(encoded, 0.0, 1.0) * 255.0));
            }
        }
    }
    return half;
}

}  // namespace

Status GpuScene::create() {
    auto layout = device_->create_bind_group_layout(
        {.label = "material",
         .entries = {{.binding = 2,
                      .visibility = gpu::ShaderStage::Fragment,
                      .min_binding_size = sizeof(MaterialUniforms)},
                     {.binding = 3,
                      .visibility = gpu::ShaderStage::Fragment,
                      .type = gpu::BindingType::SampledTexture}}});
    if (!layout) return forward_error(layout);
    material_layout_ = std::move(*layout);
    auto sampler = device_->create_sampler({.label = "material",
                                            .address_mode_u = gpu::AddressMode::Repeat,
                                            .address_mode_v = gpu::AddressMode::Repeat,
                                            .mag_filter = gpu::FilterMode::Linear,
                                            .min_filter = gpu::FilterMode::Linear,
                                            .mipmap_filter = gpu::FilterMode::Linear});
    if (!sampler) return forward_error(sampler);
    sampler_ = std::move(*sampler);
    auto white = device_->create_texture(
        {.label = "white",
         .width = 1,
         .height = 1,
         .format = gpu::Format::Rgba8UnormSrgb,
         .usage = gpu::TextureUsage::TextureBinding | gpu::TextureUsage::CopyDst});
    if (!white) return forward_error(white);
    white_ = std::move(*white);
    const std::array<std::byte, 4> pixel{std::byte{255}, std::byte{255}, std::byte{255},
                                         std::byte{255}};
    return device_->write_texture(white_, 0, pixel);
}

Result<gpu::Buffer> GpuScene::create_buffer(const char* label, std::span<const std::byte> bytes,
                                            gpu::BufferUsage usage) {
    auto buffer = device_->create_buffer(
        {.label = label, .size = bytes.size(), .usage = usage | gpu::BufferUsage::CopyDst});
    if (!buffer) return buffer;
    if (const Status written = device_->write_buffer(*buffer, 0, bytes); !written)
        return forward_error(written);
    return buffer;
}

Status GpuScene::upload_mesh(const std::shared_ptr<const scene::Mesh>& mesh) {
    GpuMesh gpu_mesh;
    gpu_mesh.mesh = mesh;
    auto indices =
        create_buffer("indices", std::as_bytes(std::span(mesh->indices)), gpu::BufferUsage::Index);
    if (!indices) return forward_error(indices);
    gpu_mesh.indices = std::move(*indices);
    meshes_.emplace(mesh.get(), std::move(gpu_mesh));
    return {};
}

// Into the buffers that are there, where there are any: an instance keeps its number of vertices.
Status GpuScene::write_vertices(GpuVertices& vertices, const scene::Mesh& mesh,
                                const scene::Geometry& geometry) {
    std::vector<Attributes> attributes(geometry.positions.size());
    for (std::size_t i = 0; i < attributes.size(); ++i) {
        attributes[i] = {geometry.normals[i],
                         mesh.texcoords.empty() ? glm::vec2(0.0F) : mesh.texcoords[i]};
    }
    const auto write = [&](gpu::Buffer& buffer, const char* label,
                           std::span<const std::byte> bytes) -> Status {
        if (buffer) return device_->write_buffer(buffer, 0, bytes);
        auto created = create_buffer(label, bytes, gpu::BufferUsage::Vertex);
        if (!created) return forward_error(created);
        buffer = std::move(*created);
        return {};
    };
    const Status written =
        write(vertices.positions, "positions", std::as_bytes(geometry.positions));
    if (!written) return written;
    return write(vertices.attributes, "normals and texcoords",
                 std::as_bytes(std::span(attributes)));
}

Result<const GpuVertices*> GpuScene::vertices_of(scene::Entity entity, GpuMesh& mesh,
                                                 const scene::Geometry& geometry) {
    if (geometry.revision == 0) {
        if (!mesh.vertices) {
            GpuVertices vertices;
            const Status written = write_vertices(vertices, *mesh.mesh, geometry);
            if (!written) return forward_error(written);
            mesh.vertices = std::move(vertices);
        }
        return &*mesh.vertices;
    }
    DeformedVertices& deformed = deformed_[entity.key()];
    if (deformed.mesh != mesh.mesh.get()) deformed = {};
    if (deformed.revision != geometry.revision) {
        const Status written = write_vertices(deformed.vertices, *mesh.mesh, geometry);
        if (!written) return forward_error(written);
        deformed.revision = geometry.revision;
        deformed.mesh = mesh.mesh.get();
    }
    return &deformed.vertices;
}

Status GpuScene::ensure_lines(GpuMesh& mesh) {
    if (mesh.line_indices) return {};
    std::vector<std::uint32_t> lines;
    lines.reserve(mesh.mesh->indices.size() * 2);
    for (std::size_t i = 0; i + 2 < mesh.mesh->indices.size(); i += 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            lines.push_back(mesh.mesh->indices[i + k]);
            lines.push_back(mesh.mesh->indices[i + (k + 1) % 3]);
        }
    }
    auto buffer =
        create_buffer("wireframe", std::as_bytes(std::span(lines)), gpu::BufferUsage::Index);
    if (!buffer) return forward_error(buffer);
    mesh.line_indices = std::move(*buffer);
    return {};
}

Result<gpu::TextureId> GpuScene::texture_of(const std::shared_ptr<const scene::Image>& image) {
    const std::uint32_t limit = device_->caps().limits.max_texture_dimension_2d;
    if (image == nullptr || image->width == 0 || image->height == 0) return white_.id();
    if (const auto found = textures_.find(image.get()); found != textures_.end())
        return found->second.id();

    std::vector<scene::Image> smaller;
    const scene::Image* level = image.get();
    while (level->width > limit || level->height > limit) {
        smaller = {half_size(*level)};
        level = &smaller.back();
    }
    std::uint32_t levels = 1;
    while ((std::max(level->width, level->height) >> levels) > 0) ++levels;
    auto texture = device_->create_texture(
        {.label = "image " + image->name,
         .width = level->width,
         .height = level->height,
         .format = gpu::Format::Rgba8UnormSrgb,
         .usage = gpu::TextureUsage::TextureBinding | gpu::TextureUsage::CopyDst,
         .mip_level_count = levels});
    if (!texture) return forward_error(texture);
    scene::Image current = *level;
    for (std::uint32_t mip = 0; mip < levels; ++mip) {
        if (mip > 0) current = half_size(current);
        const Status written =
            device_->write_texture(*texture, mip, std::as_bytes(std::span(current.rgba)));
        if (!written) return forward_error(written);
    }
    return textures_.emplace(image.get(), std::move(*texture)).first->second.id();
}

Status GpuScene::upload_materials(const std::vector<scene::Material>& materials) {
    materials_.clear();
    has_holes_.clear();
    if (materials.empty()) return {};
    std::vector<std::byte> bytes(materials.size() * material_stride);
    for (std::size_t i = 0; i < materials.size(); ++i) {
        const scene::Material& m = materials[i];
        has_holes_.push_back(m.alpha_mode == scene::AlphaMode::Mask);
        const float cutoff = m.alpha_mode == scene::AlphaMode::Mask ? m.alpha_cutoff : -1.0F;
        const MaterialUniforms u{m.base_color, glm::vec4(m.emissive, 0.0F),
                                 glm::vec4(m.metallic, m.roughness, cutoff, 0.0F)};
        std::memcpy(bytes.data() + i * material_stride, &u, sizeof u);
    }
    auto uniforms = create_buffer("materials", bytes, gpu::BufferUsage::Uniform);
    if (!uniforms) return forward_error(uniforms);
    material_uniforms_ = std::move(*uniforms);
    for (std::size_t i = 0; i < materials.size(); ++i) {
        auto texture = texture_of(materials[i].base_color_image);
        if (!texture) return forward_error(texture);
        auto group = device_->create_bind_group(
            {.label = "material " + materials[i].name,
             .layout = material_layout_,
             .entries = {{.binding = 2,
                          .buffer = material_uniforms_,
                          .offset = i * material_stride,
                          .size = sizeof(MaterialUniforms)},
                         {.binding = 3, .texture = *texture, .sampler = sampler_}}});
        if (!group) return forward_error(group);
        materials_.push_back(std::move(*group));
    }
    return {};
}

Status GpuScene::upload(const scene::Scene& scene) {
    std::unordered_map<const scene::Mesh*, bool> present;
    Status status;
    scene.registry.each<scene::MeshInstance>([&](scene::Entity entity,
                                                 const scene::MeshInstance& instance) {
        present[instance.mesh.get()] = true;
        if (status && !meshes_.contains(instance.mesh.get())) status = upload_mesh(instance.mesh);
        if (!status) return;
        const auto vertices = vertices_of(entity, *find(instance.mesh.get()),
                                          scene::geometry_of(scene.registry, entity, instance, {}));
        if (!vertices) status = forward_error(vertices);
    });
    if (!status) return status;
    std::erase_if(meshes_, [&](const auto& entry) { return !present.contains(entry.first); });
    std::erase_if(deformed_, [&](const auto& entry) {
        return !scene.registry.has<scene::Deformed>(scene::Entity::from_key(entry.first)) ||
               !present.contains(entry.second.mesh);
    });
    return upload_materials(scene.materials);
}

GpuMesh* GpuScene::find(const scene::Mesh* mesh) {
    const auto found = meshes_.find(mesh);
    return found == meshes_.end() ? nullptr : &found->second;
}

}  // namespace gnomon::render::internal
