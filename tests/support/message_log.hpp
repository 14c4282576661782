// SPDX-License-Identifier: MIT
//
// MessageLog: records what a device says. A warning or an error that the test did not announce
// fails the test that is running: a driver or a validation layer never complains for nothing.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include <gnomon/gpu/message_sink.hpp>

namespace gnomon::test {

struct Message {
    gpu::Severity severity = gpu::Severity::Info;
    std::string text;
};

class MessageLog {
public:
    explicit MessageLog(std::string device_name) : device_name_(std::move(device_name)) {}

    void record(gpu::Severity severity, std::string_view text);

    /// From now on messages that contain `part` are expected.
    void expect(std::string part);
    /// Forgets messages and expectations: called between tests that share a device.
    void reset();
    [[nodiscard]] std::vector<Message> messages() const;

private:
    std::string device_name_;
    mutable std::mutex mutex_;
    std::vector<Message> messages_;
    std::vector<std::string> expected_;
};

/// A sink that keeps the log alive as long as the device has it.
[[nodiscard]] gpu::MessageSink make_sink(std::shared_ptr<MessageLog> log);

}  // namespace gnomon::test
