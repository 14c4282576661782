// SPDX-License-Identifier: MIT
//
// Violations: all that is wrong with a command buffer, each with the command it was found at. Text
// is built when something is wrong, never before.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <gnomon/gpu/command.hpp>

#include "internal/wording.hpp"

namespace gnomon::gpu {

class Violations {
public:
    explicit Violations(const CommandBuffer& commands) : commands_(commands) {}

    /// Where the violations that follow belong. `pass` is null outside of passes. Before the first
    /// command and after the last, `function` is null.
    void at(std::size_t command, const char* function, const RenderPassDesc* pass) {
        command_ = command;
        function_ = function;
        pass_ = pass;
    }

    /// From now on the violations of this command belong to `pass`, which it begins.
    void enter(const RenderPassDesc* pass) { pass_ = pass; }

    template <class... Args>
    void add(fmt::format_string<Args...> format, Args&&... args) {
        if (++count_ > listed_violations) return;
        std::string line = fmt::format(format, std::forward<Args>(args)...);
        const std::string buffer = object_name("CommandBuffer", commands_.label);
        if (function_ == nullptr) {
            line += fmt::format(" While finishing {}.", buffer);
        } else if (pass_ == nullptr) {
            line +=
                fmt::format(" While encoding {} (command {}) of {}.", function_, command_, buffer);
        } else {
            line += fmt::format(" While encoding {} (command {}) in {} of {}.", function_, command_,
                                object_name("RenderPass", pass_->label), buffer);
        }
        lines_.push_back(std::move(line));
    }

    [[nodiscard]] Status status() const {
        if (count_ == 0) return {};
        std::string message = fmt::format("{}", fmt::join(lines_, "\n"));
        if (count_ > lines_.size()) {
            message += fmt::format("\nThis is followed by {} more.", count_ - lines_.size());
        }
        return fail(ErrorCode::Validation, std::move(message));
    }

private:
    static constexpr std::size_t listed_violations = 20;
    const CommandBuffer& commands_;
    const RenderPassDesc* pass_ = nullptr;
    const char* function_ = nullptr;
    std::size_t command_ = 0;
    std::size_t count_ = 0;
    std::vector<std::string> lines_;
};

}  // namespace gnomon::gpu
