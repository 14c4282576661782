// SPDX-License-Identifier: MIT
#include "shadows.hpp"

#include <limits>
#include <utility>

#include <gnomon/webgpu/backend.hpp>

namespace gnomon::npm {

namespace {

gpu::TextureDesc depth_desc(const Shadows::ViewDesc& desc) {
    return {.label = "depth",
            .width = desc.size.width,
            .height = desc.size.height,
            .format = gpu::Format::Depth32FloatStencil8,
            .usage = gpu::TextureUsage::RenderAttachment,
            .sample_count = desc.sample_count};
}

gpu::TextureDesc mask_desc(const Shadows::ViewDesc& desc) {
    return {.label = "mask",
            .width = desc.size.width,
            .height = desc.size.height,
            .format = desc.bits ? gpu::Format::R32Uint : gpu::Format::R8Unorm,
            .usage = gpu::TextureUsage::RenderAttachment};
}

// A light that is not finite has no volumes.
shadows::Light nowhere(std::uint64_t key) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return {.key = key, .position_world = {nan, nan, nan, 1.0}};
}

}  // namespace

Shadows::Shadows(gpu::Device device, shadows::ShadowSystem system, shadow_pass::CapBias cap_bias)
    : device_(std::move(device)), system_(std::move(system)), cap_bias_(cap_bias) {}

Result<std::unique_ptr<Shadows>> Shadows::create(shadow_pass::CapBias cap_bias) {
    auto backend = webgpu::create_backend();
    if (!backend) return forward_error(backend);
    auto system = shadows::ShadowSystem::create();
    if (!system) return forward_error(system);
    return std::unique_ptr<Shadows>(
        new Shadows(gpu::Device(std::move(*backend)), std::move(*system), cap_bias));
}

Result<std::uint32_t> Shadows::add_mesh(const shadows::MeshView& triangles) {
    auto mesh = shadows::ShadowMesh::build(triangles);
    if (!mesh) return forward_error(mesh);
    return meshes_.add(std::move(*mesh));
}

Result<std::uint32_t> Shadows::add_deformed(std::uint32_t mesh,
                                            std::span<const glm::vec3> positions) {
    auto deformed = meshes_[mesh]->deformed(positions);
    if (!deformed) return forward_error(deformed);
    return meshes_.add(std::move(*deformed));
}

std::uint32_t Shadows::add_caster(std::uint32_t mesh, const glm::dmat4& world_from_local,
                                  Manner manner) {
    const std::uint32_t number = casters_.add({});
    if (number >= is_changed_.size()) is_changed_.resize(number + 1);
    Caster& added = casters_[number];
    added.caster.key = number;
    added.caster.mesh = meshes_[mesh];
    added.caster.world_from_local = world_from_local;
    change(number, manner);
    return number;
}

void Shadows::changed(std::uint32_t caster) {
    if (is_changed_[caster] != 0) return;
    is_changed_[caster] = 1;
    changed_casters_.push_back(caster);
}

void Shadows::place(std::uint32_t caster, const glm::dmat4& world_from_local) {
    casters_[caster].caster.world_from_local = world_from_local;
    changed(caster);
}

void Shadows::change(std::uint32_t caster, Manner manner) {
    Caster& c = casters_[caster];
    c.visible = manner.visible;
    c.caster.in_depth_buffer = manner.in_depth;
    c.caster.near_caps =
        manner.averted_caps ? shadows::NearCaps::Averted : shadows::NearCaps::Facing;
    changed(caster);
}

void Shadows::change_mesh(std::uint32_t caster, std::uint32_t mesh) {
    casters_[caster].caster.mesh = meshes_[mesh];
    changed(caster);
}

// Its number may be another's before the system is told.
void Shadows::remove_caster(std::uint32_t caster) {
    casters_.remove(caster);
    changed(caster);
}

void Shadows::set_light(std::uint32_t bit, const glm::dvec4& position_world,
                        std::optional<double> range_m) {
    if (bit >= lights_.size()) lights_.resize(bit + 1);
    lights_[bit] = shadows::Light{.key = bit, .position_world = position_world, .range_m = range_m};
    lights_changed_ = true;
}

void Shadows::remove_light(std::uint32_t bit) {
    lights_[bit].reset();
    while (!lights_.empty() && !lights_.back()) lights_.pop_back();
    lights_changed_ = true;
}

void Shadows::submit(shadows::ShadowSystem::Frame& frame) {
    for (const std::uint32_t number : changed_casters_) {
        is_changed_[number] = 0;
        if (casters_.has(number) && casters_[number].visible) {
            frame.caster(casters_[number].caster);
        } else {
            frame.remove_caster(number);
        }
    }
    changed_casters_.clear();
    if (!std::exchange(lights_changed_, false)) return;
    for (std::size_t bit = 0; bit < lights_.size(); ++bit) {
        frame.light(lights_[bit].value_or(nowhere(bit)));
    }
    for (std::size_t bit = lights_.size(); bit < lights_told_; ++bit) frame.remove_light(bit);
    lights_told_ = lights_.size();
}

Result<std::uint32_t> Shadows::add_view(const ViewDesc& desc) {
    View view{
        .conventions = {shadows::HostDepth::ZeroToOne, desc.reversed, shadows::HostRows::FromOne},
        .depth = {},
        .masks = {},
        .light_masks = {}};
    auto depth = device_.import_texture(depth_desc(desc), webgpu::HostTexture{desc.depth});
    if (!depth) return forward_error(depth);
    view.depth = std::move(*depth);
    shadow_pass::LightMasksDesc masks{.host = {.target = view.depth,
                                               .size = desc.size,
                                               .format = gpu::Format::Depth32FloatStencil8,
                                               .sample_count = desc.sample_count,
                                               .conventions = view.conventions,
                                               .cap_bias = cap_bias_}};
    for (const std::uint32_t number : desc.masks) {
        auto mask = device_.import_texture(mask_desc(desc), webgpu::HostTexture{number});
        if (!mask) return forward_error(mask);
        masks.masks.push_back(*mask);
        view.masks.push_back(std::move(*mask));
    }
    auto made = shadow_pass::LightMasks::create(device_, masks);
    if (!made) return forward_error(made);
    view.light_masks.emplace(std::move(*made));
    return views_.add(std::move(view));
}

Status Shadows::render(std::uint32_t number, const glm::dmat4& view_from_world,
                       const glm::dmat4& clip_from_view) {
    View& view = views_[number];
    const auto host = shadows::view_of_host(view_from_world, clip_from_view, view.conventions);
    if (!host) return forward_error(host);
    auto frame = system_.begin_frame(shadows::Submission::Delta);
    submit(frame);
    const shadows::DrawList& list = std::move(frame).finish(host->view);
    frame_stats_ = list.stats;
    if (const Status prepared = view.light_masks->prepare(list, *host); !prepared) return prepared;
    pass_stats_ = view.light_masks->stats();
    return view.light_masks->resolve();
}

}  // namespace gnomon::npm
