// SPDX-License-Identifier: MIT
#include "tests/support/message_log.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace gnomon::test {

void MessageLog::record(gpu::Severity severity, std::string_view text) {
    bool is_expected = severity == gpu::Severity::Info;
    {
        const std::lock_guard lock(mutex_);
        messages_.push_back({severity, std::string(text)});
        is_expected = is_expected || std::any_of(expected_.begin(), expected_.end(),
                                                 [text](const std::string& part) {
                                                     return text.find(part) != text.npos;
                                                 });
    }
    if (!is_expected) {
        ADD_FAILURE() << "The device \"" << device_name_ << "\" says: " << text;
    }
}

void MessageLog::expect(std::string part) {
    const std::lock_guard lock(mutex_);
    expected_.push_back(std::move(part));
}

void MessageLog::reset() {
    const std::lock_guard lock(mutex_);
    messages_.clear();
    expected_.clear();
}

std::vector<Message> MessageLog::messages() const {
    const std::lock_guard lock(mutex_);
    return messages_;
}

gpu::MessageSink make_sink(std::shared_ptr<MessageLog> log) {
    return [log = std::move(log)](gpu::Severity severity, std::string_view text) {
        log->record(severity, text);
    };
}

}  // namespace gnomon::test
