// SPDX-License-Identifier: MIT
#include <gnomon/shadow_pass/light_masks.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <gnomon_shaders/shadow_pass.hpp>

#include "internal/guest_target.hpp"

namespace gnomon::shadow_pass {

namespace {

// In which bits of eight lights a channel are added up: integers cannot be blended.
constexpr gpu::Format sum_format = gpu::Format::Rgba8Unorm;
constexpr std::size_t bits_a_channel = 8;

std::string name_of(const gpu::TextureDesc& mask) { return "[Texture \"" + mask.label + "\"]"; }

Status refuse(const std::string& sentence) { return fail(ErrorCode::InvalidInput, sentence); }

Status check_mask(const gpu::TextureDesc& mask, const GuestPassDesc& host) {
    const bool bits = mask.format == gpu::Format::R32Uint;
    if (!bits && mask.format != gpu::Format::R8Unorm) {
        return refuse("The light mask " + name_of(mask) +
                      " is neither R32Uint, a bit a light, nor R8Unorm, a texture a light.");
    }
    const TargetSize size{mask.width, mask.height};
    if (size != host.size) {
        return refuse("The light mask " + name_of(mask) + " has " + internal::size_words(size) +
                      ", but the depth " + internal::size_words(host.size) + ".");
    }
    if (!gpu::has(mask.usage, gpu::TextureUsage::RenderAttachment)) {
        return refuse("The light mask " + name_of(mask) +
                      " cannot be drawn to: make it with TextureUsage::RenderAttachment.");
    }
    if (mask.mip_level_count != 1) {
        return refuse("The light mask " + name_of(mask) + " has " +
                      std::to_string(mask.mip_level_count) + " mip levels instead of 1.");
    }
    if (mask.sample_count == host.sample_count) return {};
    const std::string counts = "The light mask " + name_of(mask) + " has " +
                               internal::sample_words(mask.sample_count) + ", but the depth " +
                               internal::sample_words(host.sample_count);
    if (host.sample_count == 1) return refuse(counts + ": give the mask as many.");
    if (!bits) return {};
    return refuse(counts +
                  ": give the mask as many, for bits of each, or name a texture of R8Unorm and one "
                  "sample for each light, for its share of them.");
}

// How many lights go into them.
std::size_t capacity_of(const std::vector<gpu::TextureId>& masks, bool bits) {
    return bits ? LightMasks::max_lights : masks.size();
}

Status check_masks(const gpu::Device& device, const LightMasksDesc& desc, bool& bits) {
    const std::vector<gpu::TextureId>& masks = desc.masks;
    if (masks.empty()) {
        return refuse(
            "The light masks have no texture to go to: name one of R32Uint, or one of R8Unorm for "
            "each light.");
    }
    if (masks.size() > LightMasks::max_lights) {
        return refuse("There are " + std::to_string(masks.size()) +
                      " textures for light masks, of which " +
                      std::to_string(LightMasks::max_lights) +
                      " are written at a time: name as many, and resolve in rounds.");
    }
    for (std::size_t i = 0; i < masks.size(); ++i) {
        const std::optional<gpu::TextureDesc> mask = device.desc_of(masks[i]);
        if (!mask) {
            return refuse("The texture of light mask " + std::to_string(i) +
                          " was freed, or belongs to another device.");
        }
        if (const Status checked = check_mask(*mask, desc.host); !checked) return checked;
        if (std::find(masks.begin(), masks.begin() + static_cast<std::ptrdiff_t>(i), masks[i]) !=
            masks.begin() + static_cast<std::ptrdiff_t>(i)) {
            return refuse("The light mask " + name_of(*mask) + " is named for two lights.");
        }
        const bool is_bits = mask->format == gpu::Format::R32Uint;
        if (is_bits && masks.size() > 1) {
            return refuse("The light mask " + name_of(*mask) +
                          " has bits for 32 lights, but is one of " + std::to_string(masks.size()) +
                          " textures: name it alone.");
        }
        if (mask->sample_count != device.desc_of(masks[0])->sample_count) {
            return refuse("The light masks " + name_of(*device.desc_of(masks[0])) + " and " +
                          name_of(*mask) + " differ in their number of samples.");
        }
        bits = is_bits;
    }
    return {};
}

}  // namespace

struct LightMasks::State {
    gpu::Device* device = nullptr;
    LightMasksDesc desc;
    bool bits = false;
    ShadowPass pass;
    /// What lights are added up in, of the mask's samples; or the samples whose shares go to masks.
    gpu::Texture sum;
    gpu::RenderPipeline add;  ///< where the stencil is not 0, which it is afterwards
    // From bytes to bits.
    gpu::Sampler nearest;
    gpu::BindGroup bytes;
    gpu::RenderPipeline pack;

    std::vector<shadows::LightDraws> lights;
    bool prepared = false;  // `lights` are of the last prepare()
    // What resolve() submitted last, while the pass's revision stays.
    std::optional<gpu::CommandBuffer> recorded;
    std::uint64_t recorded_revision = 0;
    std::size_t recorded_first = 0;
    std::size_t recorded_count = 0;

    Status create_sum(std::uint32_t samples);
    Status create_add();
    Status create_pack();
    void count(gpu::RenderPassEncoder& encoder, std::size_t light, double value,
               std::size_t channel) const;
    [[nodiscard]] gpu::DepthStencilAttachment depth() const {
        return {.texture = desc.host.target, .stencil_load_op = gpu::LoadOp::Clear};
    }
    void record_bits(gpu::CommandEncoder& encoder, std::size_t first,
                     std::size_t count_of_lights) const;
    void record_bytes(gpu::CommandEncoder& encoder, std::size_t first,
                      std::size_t count_of_lights) const;
};

Status LightMasks::State::create_sum(std::uint32_t samples) {
    const bool shares = samples != desc.host.sample_count;
    if (!bits && !shares) return {};
    gpu::TextureDesc texture{.label = bits ? "bytes of light masks" : "samples of light masks",
                             .width = desc.host.size.width,
                             .height = desc.host.size.height,
                             .format = bits ? sum_format : gpu::Format::R8Unorm,
                             .usage = gpu::TextureUsage::RenderAttachment,
                             .sample_count = desc.host.sample_count};
    if (bits) texture.usage = texture.usage | gpu::TextureUsage::TextureBinding;
    auto made = device->create_texture(texture);
    if (!made) return forward_error(made);
    sum = std::move(*made);
    return {};
}

Status LightMasks::State::create_add() {
    auto vertex = device->create_shader({.label = "full screen",
                                         .stage = gpu::ShaderStage::Vertex,
                                         .source = shaders::full_screen_vert});
    if (!vertex) return forward_error(vertex);
    auto fragment = device->create_shader({.label = "light mask",
                                           .stage = gpu::ShaderStage::Fragment,
                                           .source = shaders::light_mask_frag});
    if (!fragment) return forward_error(fragment);
    const gpu::StencilFaceState shadowed{.compare = gpu::Compare::NotEqual,
                                         .pass_op = gpu::StencilOp::Zero};
    gpu::ColorTargetState target{.format = bits ? sum_format : gpu::Format::R8Unorm};
    if (bits) {
        const gpu::BlendComponent add_constant{.src_factor = gpu::BlendFactor::Constant,
                                               .dst_factor = gpu::BlendFactor::One};
        target.blend = gpu::BlendState{.color = add_constant, .alpha = add_constant};
    }
    auto made = device->create_render_pipeline(
        {.label = "light mask",
         .vertex = *vertex,
         .fragment = *fragment,
         .depth_stencil = gpu::DepthStencilState{.format = desc.host.format,
                                                 .depth_compare = gpu::Compare::Always,
                                                 .stencil_front = shadowed,
                                                 .stencil_back = shadowed},
         .targets = {target},
         .sample_count = desc.host.sample_count});
    if (!made) return forward_error(made);
    add = std::move(*made);
    return {};
}

Status LightMasks::State::create_pack() {
    if (!bits) return {};
    const bool multisampled = desc.host.sample_count > 1;
    auto vertex = device->create_shader({.label = "full screen",
                                         .stage = gpu::ShaderStage::Vertex,
                                         .source = shaders::full_screen_vert});
    if (!vertex) return forward_error(vertex);
    auto fragment =
        device->create_shader({.label = "light bits",
                               .stage = gpu::ShaderStage::Fragment,
                               .source = multisampled ? shaders::light_bits_multisampled_frag
                                                      : shaders::light_bits_frag});
    if (!fragment) return forward_error(fragment);
    auto layout =
        device->create_bind_group_layout({.label = "light bits",
                                          .entries = {{.binding = 0,
                                                       .visibility = gpu::ShaderStage::Fragment,
                                                       .type = gpu::BindingType::SampledTexture,
                                                       .multisampled = multisampled}}});
    if (!layout) return forward_error(layout);
    auto sampler = device->create_sampler({.label = "light bits"});
    if (!sampler) return forward_error(sampler);
    auto group = device->create_bind_group(
        {.label = "light bits",
         .layout = *layout,
         .entries = {{.binding = 0, .texture = sum, .sampler = *sampler}}});
    if (!group) return forward_error(group);
    auto made = device->create_render_pipeline({.label = "light bits",
                                                .bind_group_layouts = {*layout},
                                                .vertex = *vertex,
                                                .fragment = *fragment,
                                                .targets = {{.format = gpu::Format::R32Uint}},
                                                .sample_count = desc.host.sample_count});
    if (!made) return forward_error(made);
    nearest = std::move(*sampler);
    bytes = std::move(*group);
    pack = std::move(*made);
    return {};
}

Result<LightMasks> LightMasks::create(gpu::Device& device, const LightMasksDesc& desc) {
    const Status fits = internal::check_guest(device, desc.host, "the light masks");
    if (!fits) return forward_error(fits);
    bool bits = false;
    if (const Status checked = check_masks(device, desc, bits); !checked) {
        return forward_error(checked);
    }
    if (const Status beside = device.takes_colors_beside(desc.host.target); !beside) {
        return forward_error(beside);
    }
    auto pass = ShadowPass::create(
        device, internal::shadow_pass_of(desc.host, {bits ? sum_format : gpu::Format::R8Unorm}));
    if (!pass) return forward_error(pass);
    auto state = std::make_unique<State>(State{.device = &device,
                                               .desc = desc,
                                               .bits = bits,
                                               .pass = std::move(*pass),
                                               .sum = {},
                                               .add = {},
                                               .nearest = {},
                                               .bytes = {},
                                               .pack = {},
                                               .lights = {},
                                               .recorded = {}});
    Status made = state->create_sum(device.desc_of(desc.masks[0])->sample_count);
    if (made) made = state->create_add();
    if (made) made = state->create_pack();
    if (!made) return forward_error(made);
    return LightMasks(std::move(state));
}

LightMasks::LightMasks(std::unique_ptr<State> state) : state_(std::move(state)) {}
LightMasks::LightMasks(LightMasks&&) noexcept = default;
LightMasks& LightMasks::operator=(LightMasks&&) noexcept = default;
LightMasks::~LightMasks() = default;

Status LightMasks::prepare(const shadows::DrawList& list, const shadows::HostView& view) {
    State& s = *state_;
    s.prepared = false;
    s.lights.clear();
    const Status fits = internal::check_view(s.desc.host, view, "the light masks");
    if (!fits) return fits;
    if (const Status prepared = s.pass.prepare(list, view.as_drawn, s.desc.host.size); !prepared) {
        return prepared;
    }
    s.lights = list.lights;
    s.prepared = true;
    return {};
}

Status LightMasks::resolve() { return resolve(0, state_->lights.size()); }

Status LightMasks::resolve(std::size_t first, std::size_t count) {
    State& s = *state_;
    const Status in_list =
        internal::check_lights(s.prepared ? std::optional(s.lights.size()) : std::nullopt, first,
                               count, "the light masks", "be resolved");
    if (!in_list) return in_list;
    const std::size_t capacity = capacity_of(s.desc.masks, s.bits);
    if (count > capacity) {
        return refuse("There are " + std::to_string(count) + " lights, but " +
                      (s.bits ? "a light mask has bits for " : "textures for the masks of ") +
                      std::to_string(capacity) + ": resolve them in rounds, and shade after each.");
    }
    const bool known = s.recorded && s.recorded_revision == s.pass.revision() &&
                       s.recorded_first == first && s.recorded_count == count;
    if (!known) {
        s.recorded.reset();
        gpu::CommandEncoder encoder = s.device->create_command_encoder("light masks");
        if (s.bits) {
            s.record_bits(encoder, first, count);
        } else {
            s.record_bytes(encoder, first, count);
        }
        auto finished = encoder.finish();
        if (!finished) return forward_error(finished);
        s.recorded = std::move(*finished);
        s.recorded_revision = s.pass.revision();
        s.recorded_first = first;
        s.recorded_count = count;
    }
    return s.device->submit(*s.recorded);
}

// Counts a light's volumes and adds `value` to a channel where it does not arrive. The stencil is 0
// before and afterwards.
void LightMasks::State::count(gpu::RenderPassEncoder& encoder, std::size_t light, double value,
                              std::size_t channel) const {
    const TargetSize size = desc.host.size;
    const shadows::LightDraws& draws = lights[light];
    shadows::PixelRect changed = shadows::pixels_of(draws.bounds, size.width, size.height);
    if (draws.count == 0 || changed.width == 0 || changed.height == 0) return;
    pass.record(encoder, light);
    // With several samples not every scissor cuts exactly.
    if (desc.host.sample_count > 1) changed = {0, 0, size.width, size.height};
    encoder.set_pipeline(add);
    encoder.set_stencil_reference(0);
    encoder.set_blend_constant({channel == 0 ? value : 0.0, channel == 1 ? value : 0.0,
                                channel == 2 ? value : 0.0, channel == 3 ? value : 0.0});
    encoder.set_scissor_rect(changed.x, changed.y, changed.width, changed.height);
    encoder.draw(3);
    encoder.set_scissor_rect(0, 0, size.width, size.height);
}

void LightMasks::State::record_bits(gpu::CommandEncoder& encoder, std::size_t first,
                                    std::size_t count_of_lights) const {
    {
        auto adding = encoder.begin_render_pass(
            {.label = "shadow volumes, added up",
             .color_attachments = {{.texture = sum, .load_op = gpu::LoadOp::Clear}},
             .depth_stencil = depth()});
        for (std::size_t i = 0; i < count_of_lights; ++i) {
            const double bit = static_cast<double>(1U << i % bits_a_channel) / 255.0;
            count(adding, first + i, bit, i / bits_a_channel);
        }
    }
    auto packing = encoder.begin_render_pass(
        {.label = "light bits",
         .color_attachments = {{.texture = desc.masks[0], .load_op = gpu::LoadOp::Clear}}});
    packing.set_pipeline(pack);
    packing.set_bind_group(0, bytes);
    packing.draw(3);
}

void LightMasks::State::record_bytes(gpu::CommandEncoder& encoder, std::size_t first,
                                     std::size_t count_of_lights) const {
    for (std::size_t i = 0; i < desc.masks.size(); ++i) {
        gpu::ColorAttachment mask{.texture = desc.masks[i], .load_op = gpu::LoadOp::Clear};
        if (sum) {
            mask = {.texture = sum,
                    .resolve_target = desc.masks[i],
                    .load_op = gpu::LoadOp::Clear,
                    .store_op = gpu::StoreOp::Discard};
        }
        auto writing = encoder.begin_render_pass({.label = "shadow volumes, a light's mask",
                                                  .color_attachments = {mask},
                                                  .depth_stencil = depth()});
        if (i < count_of_lights) count(writing, first + i, 1.0, 0);
    }
}

const PassStats& LightMasks::stats() const { return state_->pass.stats(); }

}  // namespace gnomon::shadow_pass
