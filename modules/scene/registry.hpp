// SPDX-License-Identifier: MIT
//
// Registry: a small, fast store of entities and their components (sparse sets). An entity is an
// index and a generation; a component is any movable type; a view walks the entities that have all
// of the types asked for.
//
// It is what the apps and tests use. gnomon does not need it: modules/shadows takes plain values
// from anybody's ECS.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include <gnomon/core/expects.hpp>

#pragma GCC visibility push(default)
namespace gnomon::scene {

/// A thing of a registry: a plain value.
struct Entity {
    std::uint32_t index = std::numeric_limits<std::uint32_t>::max();  ///< its place
    std::uint32_t generation = 0;  ///< tells it from those that had the place before

    bool operator==(const Entity&) const = default;
    /// A 64-bit key for gnomon::shadows: unique while the entity lives, never used again after.
    [[nodiscard]] std::uint64_t key() const {
        return (static_cast<std::uint64_t>(generation) << 32U) | index;
    }
    /// The entity whose key() that is.
    [[nodiscard]] static Entity from_key(std::uint64_t key) {
        return {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32U)};
    }
};

namespace internal {

class PoolBase {
public:
    virtual ~PoolBase() = default;
    virtual void remove(std::uint32_t index) = 0;

    [[nodiscard]] bool contains(std::uint32_t index) const {
        return index < sparse_.size() && sparse_[index] != absent;
    }
    [[nodiscard]] const std::vector<Entity>& entities() const { return dense_; }

protected:
    static constexpr std::uint32_t absent = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> sparse_;  // entity index -> place in dense_
    std::vector<Entity> dense_;
};

template <class T>
class Pool final : public PoolBase {
public:
    template <class... Args>
    T& emplace(Entity entity, Args&&... args) {
        if (sparse_.size() <= entity.index) sparse_.resize(entity.index + 1, absent);
        sparse_[entity.index] = static_cast<std::uint32_t>(dense_.size());
        dense_.push_back(entity);
        return values_.emplace_back(T{std::forward<Args>(args)...});
    }
    [[nodiscard]] T& at(std::uint32_t index) { return values_[sparse_[index]]; }
    [[nodiscard]] const T& at(std::uint32_t index) const { return values_[sparse_[index]]; }
    void remove(std::uint32_t index) override {
        if (!contains(index)) return;
        const std::uint32_t place = sparse_[index];
        const std::uint32_t last = static_cast<std::uint32_t>(dense_.size()) - 1;
        if (place != last) {
            dense_[place] = dense_[last];
            values_[place] = std::move(values_[last]);
            sparse_[dense_[place].index] = place;
        }
        dense_.pop_back();
        values_.pop_back();
        sparse_[index] = absent;
    }

private:
    std::vector<T> values_;
};

inline std::size_t next_component_id() {
    static std::size_t next = 0;
    return next++;
}
template <class T>
std::size_t component_id() {
    static const std::size_t id = next_component_id();
    return id;
}

}  // namespace internal

/// Entities and their components. One thread at a time; reading, many.
class Registry {
public:
    Registry() = default;
    Registry(Registry&&) noexcept = default;
    Registry& operator=(Registry&&) noexcept = default;

    /// An entity without components.
    [[nodiscard]] Entity create();
    /// Destroys the entity and its components. A stale entity is a caller's bug.
    void destroy(Entity entity);
    /// Whether it is alive.
    [[nodiscard]] bool valid(Entity entity) const;
    /// How many are alive.
    [[nodiscard]] std::size_t size() const { return alive_; }

    /// Adds a component, replacing one that is there. References stay good until the next emplace
    /// or remove of T.
    template <class T, class... Args>
    T& emplace(Entity entity, Args&&... args) {
        GNOMON_EXPECTS(valid(entity));
        auto& p = pool<T>();
        if (p.contains(entity.index)) return p.at(entity.index) = T{std::forward<Args>(args)...};
        return p.emplace(entity, std::forward<Args>(args)...);
    }
    /// Removes a component, where there is one.
    template <class T>
    void remove(Entity entity) {
        GNOMON_EXPECTS(valid(entity));
        pool<T>().remove(entity.index);
    }
    /// The component, or null where there is none or the entity is gone.
    template <class T>
    [[nodiscard]] T* try_get(Entity entity) {
        if (!valid(entity)) return nullptr;
        auto& p = pool<T>();
        return p.contains(entity.index) ? &p.at(entity.index) : nullptr;
    }
    /// Likewise.
    template <class T>
    [[nodiscard]] const T* try_get(Entity entity) const {
        if (!valid(entity)) return nullptr;
        const auto* p = find_pool<T>();
        return p != nullptr && p->contains(entity.index) ? &p->at(entity.index) : nullptr;
    }
    /// The component; that there is none is a caller's bug.
    template <class T>
    [[nodiscard]] T& get(Entity entity) {
        T* found = try_get<T>(entity);
        GNOMON_EXPECTS(found != nullptr);
        return *found;
    }
    /// Likewise.
    template <class T>
    [[nodiscard]] const T& get(Entity entity) const {
        const T* found = try_get<T>(entity);
        GNOMON_EXPECTS(found != nullptr);
        return *found;
    }
    /// Whether there is one.
    template <class T>
    [[nodiscard]] bool has(Entity entity) const {
        return try_get<T>(entity) != nullptr;
    }

    /// Calls visit(Entity, First&, Rest&...) for every entity that has all the types, in the order
    /// in which the First components were added (removals swap the last one in). Adding or removing
    /// these types meanwhile is a caller's bug. Cost: linear in the number of First components:
    /// name the rarest type first.
    template <class First, class... Rest, class Visit>
    void each(Visit&& visit) {
        auto& first = pool<First>();
        for (const Entity entity : first.entities()) {
            if ((pool<Rest>().contains(entity.index) && ...)) {
                visit(entity, first.at(entity.index), pool<Rest>().at(entity.index)...);
            }
        }
    }
    /// Likewise, for reading.
    template <class First, class... Rest, class Visit>
    void each(Visit&& visit) const {
        const auto* first = find_pool<First>();
        const std::tuple<const internal::Pool<Rest>*...> rest{find_pool<Rest>()...};
        const bool all =
            first != nullptr && ((std::get<const internal::Pool<Rest>*>(rest) != nullptr) && ...);
        if (!all) return;
        for (const Entity entity : first->entities()) {
            if ((std::get<const internal::Pool<Rest>*>(rest)->contains(entity.index) && ...)) {
                visit(entity, first->at(entity.index),
                      std::get<const internal::Pool<Rest>*>(rest)->at(entity.index)...);
            }
        }
    }
    /// How many entities have one.
    template <class T>
    [[nodiscard]] std::size_t count() const {
        const auto* p = find_pool<T>();
        return p == nullptr ? 0 : p->entities().size();
    }

private:
    template <class T>
    internal::Pool<T>& pool() {
        const std::size_t id = internal::component_id<T>();
        if (pools_.size() <= id) pools_.resize(id + 1);
        if (!pools_[id]) pools_[id] = std::make_unique<internal::Pool<T>>();
        return static_cast<internal::Pool<T>&>(*pools_[id]);
    }
    template <class T>
    const internal::Pool<T>* find_pool() const {
        const std::size_t id = internal::component_id<T>();
        return id < pools_.size() ? static_cast<const internal::Pool<T>*>(pools_[id].get())
                                  : nullptr;
    }

    std::vector<std::unique_ptr<internal::PoolBase>> pools_;
    std::vector<std::uint32_t> generations_;
    std::vector<std::uint32_t> free_;
    std::size_t alive_ = 0;
};

}  // namespace gnomon::scene
#pragma GCC visibility pop
