// SPDX-License-Identifier: MIT
//
// The bridge of a program in the browser: imports that library.js forwards to bridge.js.
#include <utility>

#include "internal/webgpu_backend.hpp"

extern "C" {
std::uint32_t gnomon_webgpu_text(std::uint32_t which, char* out);
std::uint32_t gnomon_webgpu_create(std::uint32_t kind, std::uint32_t index, const char* text,
                                   std::uint32_t length);
void gnomon_webgpu_destroy(std::uint32_t kind, std::uint32_t index);
std::uint32_t gnomon_webgpu_write_buffer(std::uint32_t index, double offset, const void* data,
                                         std::uint32_t size);
std::uint32_t gnomon_webgpu_write_texture(std::uint32_t index, std::uint32_t mip_level,
                                          const void* data, std::uint32_t size);
std::uint32_t gnomon_webgpu_submit(const std::uint32_t* words, std::uint32_t count);
std::uint32_t gnomon_webgpu_present(std::uint32_t index);
std::uint32_t gnomon_webgpu_wait_idle();
std::uint32_t gnomon_webgpu_read_buffer(std::uint32_t index, double offset, void* out,
                                        std::uint32_t size);
std::uint32_t gnomon_webgpu_read_texture(std::uint32_t index, std::uint32_t aspect, void* out,
                                         std::uint32_t size);
std::uint32_t gnomon_webgpu_read_query_set(std::uint32_t index, void* out);
}

namespace gnomon::webgpu {

namespace {

std::string text(std::uint32_t which) {
    std::string out(gnomon_webgpu_text(which, nullptr), '\0');
    if (!out.empty()) gnomon_webgpu_text(which, out.data());
    return out;
}

class EmscriptenBridge final : public Bridge {
public:
    std::string describe() override { return text(0); }
    std::string error() override { return text(1); }
    std::string take_message() override { return text(2); }

    Outcome create(Kind kind, std::uint32_t index, std::string_view description) override {
        return Outcome{gnomon_webgpu_create(static_cast<std::uint32_t>(kind), index,
                                            description.data(), description.size())};
    }
    void destroy(Kind kind, std::uint32_t index) override {
        gnomon_webgpu_destroy(static_cast<std::uint32_t>(kind), index);
    }
    Outcome write_buffer(std::uint32_t index, std::uint64_t offset,
                         std::span<const std::byte> bytes) override {
        return Outcome{gnomon_webgpu_write_buffer(index, static_cast<double>(offset), bytes.data(),
                                                  bytes.size())};
    }
    Outcome write_texture(std::uint32_t index, std::uint32_t mip_level,
                          std::span<const std::byte> bytes) override {
        return Outcome{gnomon_webgpu_write_texture(index, mip_level, bytes.data(), bytes.size())};
    }
    Outcome submit(std::span<const std::uint32_t> words) override {
        return Outcome{gnomon_webgpu_submit(words.data(), words.size())};
    }
    Outcome present(std::uint32_t index) override { return Outcome{gnomon_webgpu_present(index)}; }
    Outcome wait_idle() override { return Outcome{gnomon_webgpu_wait_idle()}; }
    Outcome read_buffer(std::uint32_t index, std::uint64_t offset,
                        std::span<std::byte> bytes) override {
        return Outcome{gnomon_webgpu_read_buffer(index, static_cast<double>(offset), bytes.data(),
                                                 bytes.size())};
    }
    Outcome read_texture(std::uint32_t index, gpu::Aspect aspect,
                         std::span<std::byte> bytes) override {
        return Outcome{gnomon_webgpu_read_texture(index, static_cast<std::uint32_t>(aspect),
                                                  bytes.data(), bytes.size())};
    }
    Outcome read_query_set(std::uint32_t index, std::span<std::uint64_t> values) override {
        return Outcome{gnomon_webgpu_read_query_set(index, values.data())};
    }
};

}  // namespace

Result<std::unique_ptr<gpu::Backend>> create_backend(const BackendOptions& options) {
    return create_backend_on(std::make_unique<EmscriptenBridge>(), options);
}

}  // namespace gnomon::webgpu
