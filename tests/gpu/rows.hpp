// SPDX-License-Identifier: MIT
//
// Tables of validation tests: each row changes something valid a little and says which sentence
// must come of it, or that it stays valid.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/result.hpp>

namespace gnomon::gpu::test {

inline constexpr const char* valid = "";

/// `message` is the whole sentence; `valid` where the call has to succeed.
template <class T>
void expect_outcome(const Result<T>& result, const std::string& message) {
    if (message == valid) {
        EXPECT_TRUE(result.has_value()) << result.error().message;
    } else if (result.has_value()) {
        ADD_FAILURE() << "This succeeded instead of saying: " << message;
    } else {
        EXPECT_EQ(result.error().code, ErrorCode::Validation);
        EXPECT_EQ(result.error().message, message);
    }
}

template <class Desc>
struct Row {
    std::function<void(Desc&)> change;
    std::string message;
};

/// Runs `make(desc)` for each row, with `base` changed as the row says, and last for `base` itself.
/// `frame` ends every message.
template <class Desc, class Make>
void expect_rows(const Desc& base, const std::vector<Row<Desc>>& rows, const std::string& frame,
                 Make make) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        SCOPED_TRACE("row " + std::to_string(i));
        Desc desc = base;
        rows[i].change(desc);
        expect_outcome(make(desc),
                       rows[i].message == valid ? valid : rows[i].message + " " + frame);
    }
    expect_outcome(make(base), valid);
}

/// The value of a result that a test cannot go on without.
template <class T>
T take(Result<T> result) {
    if (!result.has_value()) {
        ADD_FAILURE() << result.error().message;
        return T{};
    }
    return std::move(*result);
}

}  // namespace gnomon::gpu::test
