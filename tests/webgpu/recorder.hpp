// SPDX-License-Identifier: MIT
//
// A bridge to nothing: it keeps what it is told and answers what it was told to answer.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "internal/bridge.hpp"

namespace gnomon::webgpu {

/// Outlives the recorder, which the backend owns.
struct Recording {
    std::vector<std::string> calls;
    std::vector<std::uint32_t> words;
    std::deque<std::string> messages;
    std::string description =
        R"({"adapter": "none", "features": ["depth32float-stencil8"],
            "limits": {"maxTextureDimension2D": 64, "maxColorAttachments": 8,
                       "maxVertexBuffers": 8, "maxVertexAttributes": 16, "maxBufferSize": 1024,
                       "maxUniformBufferBindingSize": 1024,
                       "minUniformBufferOffsetAlignment": 256}})";
    Outcome outcome = Outcome::Done;
    std::string error;
};

class Recorder final : public Bridge {
public:
    explicit Recorder(Recording& to) : to_(to) {}

    std::string describe() override { return to_.description; }
    std::string error() override { return to_.error; }
    std::string take_message() override {
        if (to_.messages.empty()) return {};
        std::string message = to_.messages.front();
        to_.messages.pop_front();
        return message;
    }
    Outcome create(Kind kind, std::uint32_t index, std::string_view description) override {
        return call("create " + number(kind) + " " + std::to_string(index) + " " +
                    std::string(description));
    }
    void destroy(Kind kind, std::uint32_t index) override {
        call("destroy " + number(kind) + " " + std::to_string(index));
    }
    Outcome write_buffer(std::uint32_t index, std::uint64_t offset,
                         std::span<const std::byte> bytes) override {
        return call("write_buffer " + std::to_string(index) + " " + std::to_string(offset) + " " +
                    std::to_string(bytes.size()));
    }
    Outcome write_texture(std::uint32_t index, std::uint32_t mip_level,
                          std::span<const std::byte> bytes) override {
        return call("write_texture " + std::to_string(index) + " " + std::to_string(mip_level) +
                    " " + std::to_string(bytes.size()));
    }
    Outcome submit(std::span<const std::uint32_t> words) override {
        to_.words.assign(words.begin(), words.end());
        return call("submit");
    }
    Outcome present(std::uint32_t index) override {
        return call("present " + std::to_string(index));
    }
    Outcome wait_idle() override { return call("wait_idle"); }
    Outcome read_buffer(std::uint32_t, std::uint64_t, std::span<std::byte>) override {
        return call("read_buffer");
    }
    Outcome read_texture(std::uint32_t, gpu::Aspect, std::span<std::byte>) override {
        return call("read_texture");
    }
    Outcome read_query_set(std::uint32_t, std::span<std::uint64_t>) override {
        return call("read_query_set");
    }

private:
    static std::string number(Kind kind) {
        return std::to_string(static_cast<std::uint32_t>(kind));
    }
    Outcome call(std::string what) {
        to_.calls.push_back(std::move(what));
        return to_.outcome;
    }

    Recording& to_;
};

}  // namespace gnomon::webgpu
