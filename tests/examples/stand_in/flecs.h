// SPDX-License-Identifier: MIT
//
// A stand-in for flecs: as much of its C++ interface, under its names, as examples/03_ecs_flecs.cpp
// uses, so that the loop there is compiled and run on machines without flecs. Written for that
// test; slow, and not flecs.
#pragma once

#include <any>
#include <cstdint>
#include <map>
#include <memory>
#include <type_traits>
#include <typeindex>

namespace flecs {

using entity_t = std::uint64_t;
using Pools = std::map<std::type_index, std::map<entity_t, std::any>>;

class entity {
public:
    entity() = default;
    entity(Pools* pools, entity_t id) : pools_(pools), id_(id) {}
    entity_t id() const { return id_; }
    template <class T>
    const entity& set(const T& value) const {
        (*pools_)[typeid(T)][id_] = value;
        return *this;
    }
    void destruct() const {
        for (auto& [type, pool] : *pools_) pool.erase(id_);
    }

private:
    Pools* pools_ = nullptr;
    entity_t id_ = 0;
};

template <class First, class... Rest>
class query {
public:
    explicit query(Pools* pools) : pools_(pools) {}
    template <class Visit>
    void each(Visit&& visit) const {
        for (auto& [id, value] : (*pools_)[typeid(First)]) {
            if (((*pools_)[typeid(Rest)].contains(id) && ...))
                visit(entity(pools_, id), std::any_cast<First&>(value),
                      std::any_cast<Rest&>((*pools_)[typeid(Rest)].at(id))...);
        }
    }

private:
    Pools* pools_;
};

class world {
public:
    flecs::entity entity() { return {pools_.get(), ++last_}; }
    template <class... Ts>
    flecs::query<Ts...> query() {
        return flecs::query<Ts...>(pools_.get());
    }

private:
    std::unique_ptr<Pools> pools_ = std::make_unique<Pools>();
    entity_t last_ = 0;
};

}  // namespace flecs
