// SPDX-License-Identifier: MIT
#include "tests/truth/traced.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

#include <gnomon/core/expects.hpp>
#include <gnomon/scene/shadow_adapter.hpp>

#include "tests/support/devices.hpp"

namespace gnomon::test {

namespace {

constexpr std::array<glm::dvec2, 4> places_of_four{
    {{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}}};

std::map<std::uint64_t, shadows::Light> lights_of(const scene::Registry& registry) {
    std::map<std::uint64_t, shadows::Light> lights;
    const auto add = [&](scene::Entity entity, const auto&) {
        if (const auto light = scene::shadow_light(registry, entity)) {
            lights.emplace(light->key, *light);
        }
    };
    registry.each<scene::PointLight>(add);
    registry.each<scene::SpotLight>(add);
    registry.each<scene::DirectionalLight>(add);
    return lights;
}

}  // namespace

Traced trace_lights(const Setting& setting, const truth::Options& options, std::uint32_t samples,
                    truth::TreeBuilder builder) {
    GNOMON_EXPECTS(samples == 1 || samples == 4);
    const glm::dvec3 eye(glm::inverse(setting.view.view_from_world)[3]);
    const auto instances = truth::instances_of(setting.scene);
    const truth::Tracer tracer = must(truth::Tracer::build(instances, eye, builder));
    Traced traced;
    for (const auto& [key, light] : lights_of(setting.scene.registry)) {
        traced.emplace_back();
        for (std::uint32_t sample = 0; sample < samples; ++sample) {
            truth::Options of_sample = options;
            if (samples == 4) of_sample.sample_position = places_of_four[sample];
            traced.back().push_back(tracer.trace(setting.view, light, of_sample));
        }
    }
    return traced;
}

truth::Judgement judge_lights(const Traced& traced,
                              std::span<const std::vector<std::vector<std::uint8_t>>> masks) {
    GNOMON_EXPECTS(traced.size() == masks.size());
    truth::Judgement total;
    for (std::size_t light = 0; light < masks.size(); ++light) {
        GNOMON_EXPECTS(traced[light].size() == masks[light].size());
        for (std::size_t sample = 0; sample < masks[light].size(); ++sample) {
            total += truth::judge(traced[light][sample], masks[light][sample]);
        }
    }
    return total;
}

truth::Judgement judge_lights(const Traced& traced,
                              std::span<const std::vector<std::uint8_t>> masks) {
    GNOMON_EXPECTS(traced.size() == masks.size());
    truth::Judgement total;
    for (std::size_t light = 0; light < masks.size(); ++light) {
        total += truth::judge(traced[light].at(0), masks[light]);
    }
    return total;
}

std::string wrong_places(const truth::Judgement& judgement, std::uint32_t width) {
    std::string text;
    for (std::size_t i = 0; i < std::min<std::size_t>(judgement.wrong_pixels.size(), 8); ++i) {
        const std::uint32_t at = judgement.wrong_pixels[i];
        text += fmt::format(" ({}, {})", at % width, at / width);
    }
    return text;
}

}  // namespace gnomon::test
