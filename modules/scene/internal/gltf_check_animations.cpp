// SPDX-License-Identifier: MIT
#include <optional>

#include <fmt/format.h>

#include "internal/gltf_animation.hpp"
#include "internal/gltf_check.hpp"

namespace gnomon::scene::internal {
namespace {

struct CheckedSampler {
    AnimationSamplerSource source;
    std::uint64_t keys = 0;
    std::uint64_t values = 0;  // elements of the output
};

CheckedSampler check_sampler(const JsonPlace& root, const JsonPlace& sampler) {
    CheckedSampler checked;
    const JsonPlace input = sampler.object().member("input");
    checked.keys = check_accessor_kind(root, input, "SCALAR", {5126});
    checked.source.input = input.value();
    const JsonPlace output = sampler.member("output");
    const std::size_t accessor = check_reference(root, output, "accessors");
    checked.values = root.member("accessors").at(accessor).member("count").whole(1, largest_file);
    checked.source.output = static_cast<int>(accessor);
    if (const auto mode = sampler.find("interpolation")) {
        const std::string& name = mode->one_of({"LINEAR", "STEP", "CUBICSPLINE"});
        checked.source.interpolation = name == "STEP"     ? Interpolation::Step
                                       : name == "LINEAR" ? Interpolation::Linear
                                                          : Interpolation::CubicSpline;
    }
    return checked;
}

/// How many numbers one value of a channel has; `output` is refused where it cannot hold them.
std::uint64_t check_width(const JsonPlace& root, const JsonPlace& channel, AnimationPath path,
                          std::size_t node, const JsonPlace& output) {
    switch (path) {
        case AnimationPath::Translation:
        case AnimationPath::Scale: check_accessor_kind(root, output, "VEC3", {5126}); return 3;
        case AnimationPath::Rotation:
            check_accessor_kind(root, output, "VEC4", {5126, 5120, 5121, 5122, 5123});
            return 4;
        case AnimationPath::Weights: break;
    }
    check_accessor_kind(root, output, "SCALAR", {5126, 5120, 5121, 5122, 5123});
    const auto mesh = root.member("nodes").at(node).find("mesh");
    const std::size_t targets =
        mesh ? morph_target_count(root.member("meshes").at(check_reference(root, *mesh, "meshes")))
             : 0;
    if (targets == 0) {
        channel.refuse(fmt::format("animates weights, but nodes[{}] has no morph targets", node));
    }
    return targets;
}

std::optional<AnimationPath> path_of(std::string_view name) {
    if (name == "translation") return AnimationPath::Translation;
    if (name == "rotation") return AnimationPath::Rotation;
    if (name == "scale") return AnimationPath::Scale;
    if (name == "weights") return AnimationPath::Weights;
    return std::nullopt;  // an extension's
}

void check_channel(const JsonPlace& root, const JsonPlace& channel, const JsonPlace& samplers,
                   const std::vector<CheckedSampler>& checked, AnimationSource& into) {
    const auto count = static_cast<std::uint64_t>(checked.size());
    const JsonPlace reference = channel.object().member("sampler");
    if (count == 0) reference.must_be("absent, since the animation has no samplers");
    const auto sampler = static_cast<std::size_t>(reference.whole(0, count - 1));
    const JsonPlace target = channel.member("target").object();
    const auto path = path_of(target.member("path").text());
    const auto node_place = target.find("node");
    if (!path || !node_place) {
        ++into.left_out;
        return;
    }
    const std::size_t node = check_reference(root, *node_place, "nodes");
    const JsonPlace output = samplers.at(sampler).member("output");
    const std::uint64_t width = check_width(root, channel, *path, node, output);
    const CheckedSampler& its = checked[sampler];
    const bool is_spline = its.source.interpolation == Interpolation::CubicSpline;
    const std::uint64_t elements =
        its.keys * (is_spline ? 3 : 1) * (*path == AnimationPath::Weights ? width : 1);
    if (its.values != elements) {
        output.refuse(fmt::format("has {} elements, but must have {} for {} keys of {}", its.values,
                                  elements, its.keys, target.member("path").text()));
    }
    const bool has_matrix =
        *path != AnimationPath::Weights && root.member("nodes").at(node).has("matrix");
    if (has_matrix) {
        ++into.left_out;
        return;
    }
    into.channels.push_back({sampler, node, *path, static_cast<std::size_t>(width)});
}

}  // namespace

std::vector<AnimationSource> check_animations(const JsonPlace& root) {
    std::vector<AnimationSource> sources;
    for (const auto& animation : elements_of(root, "animations")) {
        AnimationSource source;
        if (const auto name = animation.find("name")) source.name = name->text();
        const JsonPlace samplers = animation.member("samplers").array();
        std::vector<CheckedSampler> checked;
        for (std::size_t i = 0; i < samplers.size(); ++i) {
            checked.push_back(check_sampler(root, samplers.at(i)));
            source.samplers.push_back(checked.back().source);
        }
        const JsonPlace channels = animation.member("channels").array();
        for (std::size_t i = 0; i < channels.size(); ++i) {
            check_channel(root, channels.at(i), samplers, checked, source);
        }
        sources.push_back(std::move(source));
    }
    return sources;
}

}  // namespace gnomon::scene::internal
