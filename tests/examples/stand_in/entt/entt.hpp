// SPDX-License-Identifier: MIT
//
// A stand-in for EnTT: as much of its registry, under its names, as examples/03_ecs_entt.cpp uses,
// so that the loop there is compiled and run on machines without EnTT. Written for that test; slow,
// and not EnTT.
#pragma once

#include <any>
#include <cstdint>
#include <map>
#include <tuple>
#include <typeindex>
#include <utility>
#include <vector>

namespace entt {

enum class entity : std::uint32_t {};

constexpr std::uint32_t to_integral(entity value) { return static_cast<std::uint32_t>(value); }

class registry {
public:
    entity create() { return entity{next_++}; }
    void destroy(entity value) {
        for (auto& [type, pool] : pools_) pool.erase(value);
    }
    template <class T, class... Args>
    T& emplace(entity value, Args&&... args) {
        return std::any_cast<T&>(pools_[typeid(T)][value] = T{std::forward<Args>(args)...});
    }
    template <class T>
    T& get(entity value) {
        return std::any_cast<T&>(pools_.at(typeid(T)).at(value));
    }

    template <class... Ts>
    class basic_view {
    public:
        explicit basic_view(const registry& from) : from_(&from) {}
        std::vector<std::tuple<entity, Ts&...>> each() const {
            std::vector<std::tuple<entity, Ts&...>> rows;
            for (std::uint32_t i = 0; i < from_->next_; ++i) {
                if ((from_->find<Ts>(entity{i}) && ...))
                    rows.emplace_back(entity{i}, *from_->find<Ts>(entity{i})...);
            }
            return rows;
        }

    private:
        const registry* from_;
    };
    template <class... Ts>
    basic_view<Ts...> view() const {
        return basic_view<Ts...>(*this);
    }

private:
    template <class T>
    T* find(entity value) const {
        const auto pool = pools_.find(typeid(T));
        if (pool == pools_.end() || !pool->second.contains(value)) return nullptr;
        return std::any_cast<T>(&pool->second.at(value));
    }

    std::map<std::type_index, std::map<entity, std::any>> pools_;
    std::uint32_t next_ = 0;
};

}  // namespace entt
