// SPDX-License-Identifier: MIT
#include <gnomon/render/light_choice.hpp>

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

namespace gnomon::render {

namespace {

// What of the view's axis lies within the bounds.
struct Segment {
    glm::dvec3 begin{0.0};
    glm::dvec3 end{0.0};
};

Segment axis_within(const scene::Bounds& bounds, const shadows::View& view) {
    if (bounds.empty()) return {};
    const glm::dmat4 world_from_view = glm::inverse(view.view_from_world);
    const glm::dvec3 eye(world_from_view[3]);
    const glm::dvec3 ahead = -glm::dvec3(world_from_view[2]);
    double first = view.projection == shadows::ProjectionKind::Orthographic
                       ? -std::numeric_limits<double>::infinity()
                       : 0.0;
    double last = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        if (ahead[axis] == 0.0) {
            if (eye[axis] < bounds.min[axis] || eye[axis] > bounds.max[axis]) last = first - 1.0;
            continue;
        }
        const double a = (bounds.min[axis] - eye[axis]) / ahead[axis];
        const double b = (bounds.max[axis] - eye[axis]) / ahead[axis];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    if (!(first <= last)) return {bounds.center(), bounds.center()};
    return {eye + first * ahead, eye + last * ahead};
}

double luminance(const glm::vec3& color) {
    return glm::dot(glm::dvec3(color), glm::dvec3(0.2126, 0.7152, 0.0722));
}

double point_illuminance(const Segment& where, double size, const glm::dvec3& position,
                         double intensity, std::optional<double> range) {
    const glm::dvec3 along = where.end - where.begin;
    const double length2 = glm::dot(along, along);
    const double t = length2 > 0.0 ? glm::dot(position - where.begin, along) / length2 : 0.0;
    const glm::dvec3 nearest = where.begin + std::clamp(t, 0.0, 1.0) * along;
    const double distance = std::max(glm::length(position - nearest), 1e-3 * size);
    double falloff = 1.0 / std::max(distance * distance, 1e-30);
    if (range) {
        const double x = distance * distance / (*range * *range);
        falloff *= std::max(1.0 - x * x, 0.0);
    }
    return intensity * falloff;
}

}  // namespace

LightChoice choose_shadowed_lights(const scene::Scene& scene, const scene::Bounds& bounds,
                                   const shadows::View& view, std::size_t most,
                                   std::span<const scene::Entity> off) {
    const Segment where = axis_within(bounds, view);
    const double size = bounds.empty() ? 1.0 : bounds.diagonal();
    std::vector<scene::Entity> lights;
    std::vector<double> illuminance;
    const scene::Registry& registry = scene.registry;
    const auto add = [&](scene::Entity entity, double lux) {
        if (std::ranges::find(off, entity) != off.end()) return;
        lights.push_back(entity);
        illuminance.push_back(lux);
    };
    const auto add_lamp = [&](scene::Entity entity, const auto& lamp) {
        const auto* pose = registry.try_get<scene::WorldTransform>(entity);
        if (pose == nullptr) return;
        add(entity, point_illuminance(where, size, glm::dvec3(pose->world_from_local[3]),
                                      luminance(lamp.color) * static_cast<double>(lamp.intensity),
                                      lamp.range_m));
    };
    registry.each<scene::PointLight>(add_lamp);
    registry.each<scene::SpotLight>(add_lamp);
    registry.each<scene::DirectionalLight>(
        [&](scene::Entity entity, const scene::DirectionalLight& sun) {
            if (registry.try_get<scene::WorldTransform>(entity) == nullptr) return;
            add(entity, luminance(sun.color) * static_cast<double>(sun.intensity));
        });

    std::vector<std::size_t> order(lights.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return illuminance[a] > illuminance[b]; });
    std::vector<bool> chosen(lights.size(), false);
    for (std::size_t i = 0; i < std::min(most, order.size()); ++i) chosen[order[i]] = true;
    LightChoice choice;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        (chosen[i] ? choice.shadowed : choice.unshadowed).push_back(lights[i]);
    }
    return choice;
}

}  // namespace gnomon::render
