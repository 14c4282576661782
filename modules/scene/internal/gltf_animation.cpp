// SPDX-License-Identifier: MIT
#include "internal/gltf_animation.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "internal/gltf_model.hpp"

namespace gnomon::scene::internal {
namespace {

class AnimationReader {
public:
    AnimationReader(const GltfModel& model, const AnimationTargets& targets)
        : model_(model), targets_(targets), limit_(std::size_t{1} << 24U) {
        for (const auto& buffer : model.buffers) limit_ += 16 * buffer.size();
    }

    Animation read(std::size_t index) {
        const AnimationSource& source = model_.animations[index];
        Animation animation;
        animation.name = source.name;
        animation.place = static_cast<std::uint32_t>(index);
        std::vector<AnimationSampler> samplers;
        // By sampler and path: what a sampler's numbers mean is up to its channel.
        std::map<std::pair<std::size_t, AnimationPath>, std::uint32_t> known;
        for (const AnimationChannelSource& channel : source.channels) {
            const std::vector<Entity> targets = targets_.of(channel.node, channel.path);
            if (targets.empty()) continue;
            const auto [place, is_new] =
                known.try_emplace({channel.sampler, channel.path}, samplers.size());
            if (is_new) {
                samplers.push_back(read_sampler(
                    source.samplers[channel.sampler], channel,
                    fmt::format("animations[{}].samplers[{}]", index, channel.sampler)));
                animation.duration_s =
                    std::max(animation.duration_s, double{samplers.back().times_s.back()});
            }
            for (const Entity target : targets) {
                animation.channels.push_back({target, channel.path, place->second});
            }
        }
        animation.samplers =
            std::make_shared<const std::vector<AnimationSampler>>(std::move(samplers));
        return animation;
    }

private:
    AnimationSampler read_sampler(const AnimationSamplerSource& source,
                                  const AnimationChannelSource& channel, const std::string& place) {
        AnimationSampler sampler;
        sampler.interpolation = source.interpolation;
        sampler.width = channel.width;
        sampler.times_s = read_times(source.input, place);
        read_values(sampler, source.output, channel.path, place);
        return sampler;
    }

    std::vector<float> read_times(int accessor, const std::string& place) {
        const AccessorView view(model_, accessor);
        spend(view.count(), place);
        std::vector<float> times(view.count());
        for (std::size_t k = 0; k < times.size(); ++k) {
            times[k] = static_cast<float>(view.get(k, 0));
            const float least = k == 0 ? 0.0F : times[k - 1];
            if (!std::isfinite(times[k]) || times[k] < least || (k > 0 && times[k] == least)) {
                refuse_input(model_.file,
                             fmt::format("{}: time {} of its input, accessors[{}], is {} s, but "
                                         "must be finite and {} {}",
                                         place, k, accessor, times[k],
                                         k == 0 ? "not less than" : "more than", least));
            }
        }
        return times;
    }

    void read_values(AnimationSampler& sampler, int accessor, AnimationPath path,
                     const std::string& place) {
        const AccessorView view(model_, accessor);
        const std::size_t components = path == AnimationPath::Weights ? 1 : sampler.width;
        spend(view.count() * components, place);
        sampler.values.resize(view.count() * components);
        for (std::size_t i = 0; i < sampler.values.size(); ++i) {
            const auto value = static_cast<float>(view.get(i / components, i % components));
            if (!std::isfinite(value)) {
                refuse_input(model_.file,
                             fmt::format("{}: element {} of its output, accessors[{}], is {}, but "
                                         "must be finite",
                                         place, i / components, accessor, value));
            }
            sampler.values[i] = value;
        }
        if (path == AnimationPath::Rotation) check_rotations(sampler, accessor, place);
    }

    void check_rotations(const AnimationSampler& sampler, int accessor, const std::string& place) {
        const bool is_spline = sampler.interpolation == Interpolation::CubicSpline;
        for (std::size_t k = 0; k < sampler.times_s.size(); ++k) {
            const std::size_t element = is_spline ? 3 * k + 1 : k;
            double length = 0.0;
            for (std::size_t c = 0; c < 4; ++c) {
                const double part = sampler.values[element * 4 + c];
                length += part * part;
            }
            if (length >= 1e-12) continue;
            refuse_input(model_.file,
                         fmt::format("{}: element {} of its output, accessors[{}], has length {}, "
                                     "but must be a quaternion of length 1",
                                     place, element, accessor, std::sqrt(length)));
        }
    }

    /// Many samplers may share one accessor, so a small file can describe any number of keys.
    void spend(std::size_t numbers, const std::string& place) {
        spent_ += numbers;
        if (spent_ > limit_) {
            refuse_input(model_.file,
                         fmt::format("{} brings the numbers of all animations to {}, but a file of "
                                     "this size may have at most {}",
                                     place, spent_, limit_));
        }
    }

    const GltfModel& model_;
    const AnimationTargets& targets_;
    std::size_t limit_ = 0;
    std::size_t spent_ = 0;
};

}  // namespace

std::vector<Animation> read_animations(const GltfModel& model, const AnimationTargets& targets) {
    AnimationReader reader(model, targets);
    std::vector<Animation> animations;
    for (std::size_t i = 0; i < model.animations.size(); ++i) {
        animations.push_back(reader.read(i));
    }
    return animations;
}

}  // namespace gnomon::scene::internal
