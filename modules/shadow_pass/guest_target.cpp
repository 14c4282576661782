// SPDX-License-Identifier: MIT
#include "internal/guest_target.hpp"

#include <optional>
#include <utility>

namespace gnomon::shadow_pass::internal {

namespace {

using shadows::HostDepth;

std::string format_words(gpu::Format format) {
    switch (format) {
        case gpu::Format::Depth24UnormStencil8: return "Depth24UnormStencil8";
        case gpu::Format::Depth32FloatStencil8: return "Depth32FloatStencil8";
        default: return "a format without a stencil";
    }
}

std::string target_words(TargetSize size, gpu::Format format, std::uint32_t samples) {
    return size_words(size) + " of " + format_words(format) + " with " + sample_words(samples);
}

Status check_target(const gpu::Device& device, const GuestPassDesc& desc, const std::string& who) {
    if (!desc.target) {
        return fail(ErrorCode::InvalidInput,
                    "There is no target for " + who +
                        ": name the host's depth-stencil by Device::import_texture().");
    }
    const std::optional<gpu::TextureDesc> target = device.desc_of(desc.target);
    if (!target) {
        return fail(ErrorCode::InvalidInput,
                    "The target of " + who + " was freed, or belongs to another device.");
    }
    const TargetSize size{target->width, target->height};
    if (desc.size != size || desc.format != target->format ||
        desc.sample_count != target->sample_count) {
        return fail(ErrorCode::InvalidInput,
                    "The target [Texture \"" + target->label + "\"] of " + who + " has " +
                        target_words(size, target->format, target->sample_count) + ", not " +
                        target_words(desc.size, desc.format, desc.sample_count) + ".");
    }
    return {};
}

Status check_rows(const gpu::Device& device, const GuestPassDesc& desc, const std::string& who) {
    // Elsewhere it depends on who draws: a gpu::Device's own passes have the first row on top, too.
    if (device.caps().backend != "webgpu" || desc.conventions.rows == shadows::HostRows::FromOne) {
        return {};
    }
    return fail(ErrorCode::InvalidInput,
                "HostConventions::rows of " + who +
                    " is FromMinusOne, but on WebGPU the first row is where y / w is 1: set it to "
                    "FromOne.");
}

Status check_clip_space(const gpu::Device& device, const GuestPassDesc& desc,
                        const std::string& who) {
    const bool said = desc.conventions.depth == HostDepth::MinusOneToOne;
    const bool is = device.clip_depth_of(desc.target) == gpu::ClipDepth::MinusOneToOne;
    if (said == is) return {};
    const auto words = [](bool from_minus_one) {
        return std::string(from_minus_one ? "MinusOneToOne" : "ZeroToOne");
    };
    std::string sentence = "HostConventions::depth of " + who + " is " + words(said) +
                           ", but what is drawn into its target [Texture \"" +
                           device.desc_of(desc.target)->label + "\"] has depth from " +
                           (is ? "-1" : "0") + " to 1 in clip space: set it to " + words(is);
    if (device.caps().backend == "gl") {
        sentence +=
            ", or import the target while glClipControl() is set as the scene is drawn "
            "(HostTarget::clip_zero_to_one says it, too)";
    }
    return fail(ErrorCode::InvalidInput, sentence + ".");
}

}  // namespace

std::string size_words(TargetSize size) {
    return std::to_string(size.width) + " x " + std::to_string(size.height) + " pixels";
}

std::string sample_words(std::uint32_t samples) {
    return std::to_string(samples) + (samples == 1 ? " sample" : " samples");
}

Status check_guest(const gpu::Device& device, const GuestPassDesc& desc, const std::string& who) {
    if (const Status checked = check_target(device, desc, who); !checked) return checked;
    // The one that refuses such depth, and says why.
    if (desc.conventions.depth == HostDepth::Logarithmic) {
        return forward_error(
            shadows::view_of_host(glm::dmat4(1.0), glm::dmat4(1.0), desc.conventions));
    }
    if (const Status checked = check_rows(device, desc, who); !checked) return checked;
    return check_clip_space(device, desc, who);
}

ShadowPassDesc shadow_pass_of(const GuestPassDesc& desc, std::vector<gpu::Format> color_formats) {
    return {.depth_stencil_format = desc.format,
            .depth_compare = desc.conventions.reversed ? gpu::Compare::Greater : gpu::Compare::Less,
            .clip_from_minus_one = desc.conventions.depth == HostDepth::MinusOneToOne,
            .sample_count = desc.sample_count,
            .color_formats = std::move(color_formats),
            .cap_bias = desc.cap_bias};
}

Status check_view(const GuestPassDesc& desc, const shadows::HostView& view,
                  const std::string& who) {
    if (view.conventions.reversed == desc.conventions.reversed &&
        view.conventions.depth == desc.conventions.depth &&
        view.conventions.rows == desc.conventions.rows) {
        return {};
    }
    return fail(ErrorCode::InvalidInput,
                "The view's conventions of depth or rows are not those of " + who +
                    ": make another where they change.");
}

Status check_lights(std::optional<std::size_t> lights, std::size_t first, std::size_t count,
                    const std::string& who, const std::string& done) {
    const bool one = count == 1;
    const std::string subject =
        one ? "Light " + std::to_string(first)
            : std::to_string(count) + " lights from " + std::to_string(first) + " on";
    if (!lights) {
        return fail(ErrorCode::InvalidInput,
                    subject + " cannot " + done + ": no list is prepared for " + who +
                        ", since prepare() was not called or failed. Call it first, and look at "
                        "what it says.");
    }
    if (first <= *lights && count <= *lights - first) return {};
    return fail(ErrorCode::InvalidInput,
                subject + " cannot " + done + ": the list that was prepared last for " + who +
                    " has " + std::to_string(*lights) + (*lights == 1 ? " light" : " lights") +
                    ", which count from 0.");
}

}  // namespace gnomon::shadow_pass::internal
