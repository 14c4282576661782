// SPDX-License-Identifier: MIT
#include <optional>
#include <random>
#include <set>
#include <vector>

#include <gmock/gmock.h>

#include <gnomon/scene/registry.hpp>

namespace gnomon::scene {
namespace {

using testing::ElementsAre;

struct Health {
    int points = 0;
};
struct Tag {};

TEST(Registry, components_come_and_go) {
    Registry registry;
    const Entity entity = registry.create();
    EXPECT_TRUE(registry.valid(entity));
    EXPECT_FALSE(registry.has<Health>(entity));
    registry.emplace<Health>(entity, 3);
    EXPECT_EQ(registry.get<Health>(entity).points, 3);
    registry.emplace<Health>(entity, 4);  // replaces
    EXPECT_EQ(registry.get<Health>(entity).points, 4);
    EXPECT_EQ(registry.count<Health>(), 1U);
    registry.remove<Health>(entity);
    EXPECT_EQ(registry.try_get<Health>(entity), nullptr);
    registry.remove<Health>(entity);  // nothing to remove: nothing happens
    EXPECT_EQ(registry.count<Health>(), 0U);
}

TEST(Registry, a_stale_entity_reaches_nothing) {
    Registry registry;
    const Entity old = registry.create();
    registry.emplace<Health>(old, 1);
    registry.destroy(old);
    EXPECT_FALSE(registry.valid(old));
    EXPECT_EQ(registry.size(), 0U);

    const Entity reused = registry.create();
    EXPECT_EQ(reused.index, old.index);
    EXPECT_NE(reused, old);
    EXPECT_NE(reused.key(), old.key());
    EXPECT_FALSE(registry.has<Health>(reused));
    registry.emplace<Health>(reused, 2);
    EXPECT_EQ(registry.try_get<Health>(old), nullptr);
    EXPECT_FALSE(registry.valid(Entity{}));
}

TEST(Registry, a_view_walks_those_that_have_all_types) {
    Registry registry;
    std::vector<Entity> entities;
    for (int i = 0; i < 6; ++i) {
        entities.push_back(registry.create());
        registry.emplace<Health>(entities.back(), i);
        if (i % 2 == 0) registry.emplace<Tag>(entities.back());
    }
    std::vector<int> seen;
    registry.each<Health, Tag>(
        [&](Entity, Health& health, Tag&) { seen.push_back(health.points); });
    EXPECT_THAT(seen, ElementsAre(0, 2, 4));

    registry.destroy(entities[0]);  // the last one is swapped in
    seen.clear();
    const Registry& constant = registry;
    constant.each<Health>([&](Entity, const Health& health) { seen.push_back(health.points); });
    EXPECT_THAT(seen, ElementsAre(5, 1, 2, 3, 4));
    seen.clear();
    constant.each<Health, double>([&](Entity, const Health&, const double&) { seen.push_back(0); });
    EXPECT_TRUE(seen.empty());
}

TEST(Registry, a_moved_registry_keeps_its_entities) {
    Registry registry;
    const Entity entity = registry.create();
    registry.emplace<Health>(entity, 7);
    const Registry moved = std::move(registry);
    EXPECT_EQ(moved.get<Health>(entity).points, 7);
}

TEST(Registry, many_random_steps_agree_with_a_plain_map) {
    constexpr unsigned seed = 20240607;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    Registry registry;
    std::vector<std::pair<Entity, std::optional<int>>> model;
    std::set<std::uint64_t> keys;
    for (int step = 0; step < 50'000; ++step) {
        const unsigned action = random() % 4;
        if (action == 0 || model.empty()) {
            model.emplace_back(registry.create(), std::nullopt);
            EXPECT_TRUE(keys.insert(model.back().first.key()).second);
            continue;
        }
        const std::size_t chosen = random() % model.size();
        auto& [entity, value] = model[chosen];
        if (action == 1) {
            value = step;
            registry.emplace<Health>(entity, step);
        } else if (action == 2) {
            value.reset();
            registry.remove<Health>(entity);
        } else {
            registry.destroy(entity);
            std::swap(model[chosen], model.back());
            model.pop_back();
        }
    }
    EXPECT_EQ(registry.size(), model.size());
    std::size_t with_health = 0;
    for (const auto& [entity, value] : model) {
        const Health* health = registry.try_get<Health>(entity);
        ASSERT_EQ(health != nullptr, value.has_value());
        if (value) {
            ++with_health;
            EXPECT_EQ(health->points, *value);
        }
    }
    EXPECT_EQ(registry.count<Health>(), with_health);
}

}  // namespace
}  // namespace gnomon::scene
