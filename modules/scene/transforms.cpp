// SPDX-License-Identifier: MIT
#include <gnomon/scene/transforms.hpp>

#include <glm/gtc/matrix_transform.hpp>

namespace gnomon::scene {

glm::dmat4 LocalTransform::parent_from_local() const {
    if (matrix) return *matrix;
    glm::dmat4 result = glm::mat4_cast(rotation);
    result[0] *= scale.x;
    result[1] *= scale.y;
    result[2] *= scale.z;
    result[3] = glm::dvec4(translation, 1.0);
    return result;
}

namespace {

enum class Visit : std::uint8_t { Not, Open, Done };

/// The entity whose space `entity` lives in; none for a root. A parent that is gone or has no
/// LocalTransform of its own counts as the world.
std::optional<Entity> parent_of(const Registry& registry, Entity entity) {
    const auto* parent = registry.try_get<Parent>(entity);
    if (parent == nullptr || !registry.has<LocalTransform>(parent->value)) return std::nullopt;
    return parent->value;
}

}  // namespace

void update_world_transforms(Registry& registry) {
    std::vector<Visit> visited;
    const auto visit_of = [&visited](Entity entity) -> Visit& {
        if (visited.size() <= entity.index) visited.resize(entity.index + 1, Visit::Not);
        return visited[entity.index];
    };

    std::vector<Entity> chain;  // from a node up to the nearest ancestor that is done
    registry.each<LocalTransform>([&](Entity entity, const LocalTransform&) {
        chain.clear();
        std::optional<Entity> next = entity;
        while (next && visit_of(*next) == Visit::Not) {
            visit_of(*next) = Visit::Open;
            chain.push_back(*next);
            next = parent_of(registry, *next);
        }
        GNOMON_EXPECTS(!next || visit_of(*next) == Visit::Done);  // Open here: a cycle of parents

        glm::dmat4 world{1.0};
        if (next && visit_of(*next) == Visit::Done) {
            world = registry.get<WorldTransform>(*next).world_from_local;
        }
        for (auto node = chain.rbegin(); node != chain.rend(); ++node) {
            world = world * registry.get<LocalTransform>(*node).parent_from_local();
            registry.emplace<WorldTransform>(*node, world);
            visit_of(*node) = Visit::Done;
        }
    });
}

}  // namespace gnomon::scene
