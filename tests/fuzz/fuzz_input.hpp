// SPDX-License-Identifier: MIT
//
// What the fuzz targets share: the bytes of one input as values, and the words for a broken
// promise. Input that has run out reads as zero, so every sequence of bytes is an input.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include <gnomon/core/result.hpp>

/// libFuzzer's entry point, which replay.cpp calls too.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace gnomon::test {

class FuzzInput {
public:
    FuzzInput(const std::uint8_t* data, std::size_t size) : rest_(data, size) {}

    [[nodiscard]] bool empty() const { return rest_.empty(); }

    template <class T>
    [[nodiscard]] T value() {
        static_assert(std::is_arithmetic_v<T>);
        T result{};
        const auto taken = rest_.first(std::min(sizeof(T), rest_.size()));
        if (!taken.empty()) std::memcpy(&result, taken.data(), taken.size());
        rest_ = rest_.subspan(taken.size());
        return result;
    }
    [[nodiscard]] bool flag() { return (value<std::uint8_t>() & 1U) != 0; }
    /// 0 to limit - 1, from one byte; limit <= 256.
    [[nodiscard]] std::uint32_t below(std::size_t limit) {
        return value<std::uint8_t>() % static_cast<std::uint32_t>(limit);
    }
    /// An enumerator from the first to `last`.
    template <class Enum>
    [[nodiscard]] Enum up_to(Enum last) {
        return static_cast<Enum>(below(static_cast<std::size_t>(last) + 1));
    }
    template <class T>
    [[nodiscard]] T one_of(std::initializer_list<T> choices) {
        return choices.begin()[below(choices.size())];
    }

private:
    std::span<const std::uint8_t> rest_;
};

/// Stops with `claim` when it does not hold: what a fuzzer calls a crash.
inline void require(bool holds, std::string_view claim) {
    if (holds) return;
    std::fprintf(stderr, "fuzz: this does not hold: %.*s\n", static_cast<int>(claim.size()),
                 claim.data());
    std::abort();
}

/// Errors are sentences, and the code says whose fault it is.
inline void require_sentence(const Error& error, ErrorCode code) {
    const std::string what = "\"" + error.message + "\" is one sentence, about bad input";
    require(error.code == code && error.message.ends_with('.'), what);
}

}  // namespace gnomon::test
