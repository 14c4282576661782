// SPDX-License-Identifier: MIT
#include "internal/validate_passes.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>

namespace gnomon::gpu {

namespace {

double largest_uint(Format format) {
    return format == Format::R8Uint ? 255.0 : double{std::numeric_limits<std::uint32_t>::max()};
}

class PassCheck {
public:
    PassCheck(const DeviceState& device, const RenderPassDesc& desc, Violations& violations)
        : device_(device), desc_(desc), violations_(violations) {}

    PassTargets run() {
        const std::uint32_t limit = device_.caps().limits.max_color_attachments;
        if (desc_.color_attachments.size() > limit) {
            violations_.add(
                "The number of color attachments ({}) exceeds max_color_attachments "
                "({}).",
                desc_.color_attachments.size(), limit);
        }
        if (desc_.color_attachments.empty() && !desc_.depth_stencil) {
            violations_.add("The pass has no attachment.");
            targets_.complete = false;
        }
        for (const ColorAttachment& attachment : desc_.color_attachments) color(attachment);
        if (desc_.depth_stencil) depth_stencil(*desc_.depth_stencil);
        occlusion();
        if (desc_.timestamp_writes) timestamps(*desc_.timestamp_writes);
        return std::move(targets_);
    }

private:
    /// Null, after the violation was added, when the texture cannot be an attachment at all.
    const TextureDesc* attach(TextureId id) {
        const TextureDesc* texture = device_.find(id);
        if (texture == nullptr) {
            violations_.add("{}", device_.absence(id));
            targets_.complete = false;
            return nullptr;
        }
        if (!has(texture->usage, TextureUsage::RenderAttachment)) {
            violations_.add("The usage ({}) of {} lacks RenderAttachment.", to_text(texture->usage),
                            device_.name(id));
        }
        if (std::ranges::find(targets_.textures, id) != targets_.textures.end()) {
            violations_.add("{} is attached twice.", device_.name(id));
        }
        targets_.textures.push_back(id);
        return texture;
    }

    void match_size(TextureId id, const TextureDesc& texture) {
        if (targets_.width == 0) {
            targets_.width = texture.width;
            targets_.height = texture.height;
            targets_.sample_count = texture.sample_count;
            return;
        }
        if (texture.width != targets_.width || texture.height != targets_.height) {
            violations_.add(
                "The size ({} x {}) of {} is not the size ({} x {}) of the first "
                "attachment.",
                texture.width, texture.height, device_.name(id), targets_.width, targets_.height);
        }
        if (texture.sample_count != targets_.sample_count) {
            violations_.add(
                "The sample count ({}) of {} is not the one ({}) of the first "
                "attachment.",
                texture.sample_count, device_.name(id), targets_.sample_count);
        }
    }

    void color(const ColorAttachment& attachment) {
        const TextureDesc* texture = attach(attachment.texture);
        if (texture == nullptr) return;
        match_size(attachment.texture, *texture);
        targets_.color_formats.push_back(texture->format);
        if (!has_color(texture->format)) {
            violations_.add("The format ({}) of {} is not a color format.",
                            to_text(texture->format), device_.name(attachment.texture));
        }
        if (attachment.load_op == LoadOp::Clear && is_uint(texture->format)) {
            const auto& [r, g, b, a] = attachment.clear_value;
            const double largest = largest_uint(texture->format);
            const std::size_t channels = texture->format == Format::Rgba32Uint ? 4 : 1;
            const std::array values{r, g, b, a};
            for (const double value : std::span(values).first(channels)) {
                if (value >= 0.0 && value <= largest) continue;
                violations_.add("The clear value ({}) of {} ({}) is not within 0 and {:.0f}.",
                                value, device_.name(attachment.texture), to_text(texture->format),
                                largest);
            }
        }
        if (attachment.resolve_target) resolve(attachment, *texture);
    }

    void resolve(const ColorAttachment& attachment, const TextureDesc& texture) {
        const TextureDesc* target = attach(attachment.resolve_target);
        if (target == nullptr) return;
        const std::string source_name = device_.name(attachment.texture);
        const std::string target_name = device_.name(attachment.resolve_target);
        if (texture.sample_count == 1) {
            violations_.add("{} is resolved, but is not multisampled.", source_name);
        }
        if (target->sample_count != 1) {
            violations_.add("The sample count of the resolve target {} is {} instead of 1.",
                            target_name, target->sample_count);
        }
        if (target->width != texture.width || target->height != texture.height) {
            violations_.add(
                "The size ({} x {}) of the resolve target {} is not the size ({} x {}) "
                "of {}.",
                target->width, target->height, target_name, texture.width, texture.height,
                source_name);
        }
        if (target->format != texture.format) {
            violations_.add(
                "The format ({}) of the resolve target {} is not the format ({}) of "
                "{}.",
                to_text(target->format), target_name, to_text(texture.format), source_name);
        }
        if (is_uint(texture.format)) {
            violations_.add("The format ({}) of {} is an integer format, which cannot be resolved.",
                            to_text(texture.format), source_name);
        }
    }

    void depth_stencil(const DepthStencilAttachment& attachment) {
        const TextureDesc* texture = attach(attachment.texture);
        if (texture == nullptr) return;
        match_size(attachment.texture, *texture);
        const std::string name = device_.name(attachment.texture);
        if (!has_depth(texture->format)) {
            violations_.add("The format ({}) of {} is not a depth-stencil format.",
                            to_text(texture->format), name);
            targets_.complete = false;
            return;
        }
        targets_.depth_stencil_format = texture->format;
        targets_.depth_read_only = attachment.depth_read_only;
        targets_.stencil_read_only = attachment.stencil_read_only;

        const bool clears_depth = attachment.depth_load_op == LoadOp::Clear;
        if (clears_depth &&
            !(attachment.depth_clear_value >= 0.0F && attachment.depth_clear_value <= 1.0F)) {
            violations_.add("The depth clear value ({}) of {} is not within 0 and 1.",
                            attachment.depth_clear_value, name);
        }
        if (attachment.depth_read_only &&
            (clears_depth || attachment.depth_store_op == StoreOp::Discard)) {
            violations_.add("The depth of {} is read-only, but is {}.", name,
                            clears_depth ? "cleared" : "discarded");
        }

        const bool clears_stencil = attachment.stencil_load_op == LoadOp::Clear;
        if (clears_stencil && !has_stencil(texture->format)) {
            violations_.add(
                "The stencil of {} is cleared, but its format ({}) has no stencil "
                "aspect.",
                name, to_text(texture->format));
        }
        if (clears_stencil && attachment.stencil_clear_value > 0xFF) {
            violations_.add("The stencil clear value ({}) of {} exceeds 255.",
                            attachment.stencil_clear_value, name);
        }
        if (attachment.stencil_read_only &&
            (clears_stencil || attachment.stencil_store_op == StoreOp::Discard)) {
            violations_.add("The stencil of {} is read-only, but is {}.", name,
                            clears_stencil ? "cleared" : "discarded");
        }
    }

    const QuerySetDesc* query_set(QuerySetId id, QueryType type) {
        const QuerySetDesc* query_set = device_.find(id);
        if (query_set == nullptr) {
            violations_.add("{}", device_.absence(id));
            return nullptr;
        }
        if (query_set->type != type) {
            violations_.add("The type of {} is {} instead of {}.", device_.name(id),
                            to_text(query_set->type), to_text(type));
            return nullptr;
        }
        return query_set;
    }

    void occlusion() {
        if (!desc_.occlusion_query_set) return;
        const QuerySetDesc* queries = query_set(desc_.occlusion_query_set, QueryType::Occlusion);
        if (queries != nullptr) targets_.occlusion_queries = queries->count;
    }

    // That the adapter has timestamps at all was seen when the query set was made.
    void timestamps(const TimestampWrites& writes) {
        const QuerySetDesc* queries = query_set(writes.query_set, QueryType::Timestamp);
        if (queries == nullptr) return;
        for (const std::uint32_t index : {writes.beginning_index, writes.end_index}) {
            if (index >= queries->count) {
                violations_.add("The timestamp index ({}) is not below the count ({}) of {}.",
                                index, queries->count, device_.name(writes.query_set));
            }
        }
        if (writes.beginning_index == writes.end_index) {
            violations_.add("Both timestamps of the pass go to index {} of {}.",
                            writes.beginning_index, device_.name(writes.query_set));
        }
    }

    const DeviceState& device_;
    const RenderPassDesc& desc_;
    Violations& violations_;
    PassTargets targets_;
};

}  // namespace

PassTargets validate_pass(const DeviceState& device, const RenderPassDesc& desc,
                          Violations& violations) {
    return PassCheck(device, desc, violations).run();
}

}  // namespace gnomon::gpu
