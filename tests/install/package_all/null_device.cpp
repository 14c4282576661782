// SPDX-License-Identifier: MIT
//
// A program outside gnomon that links all that was built: the null device draws nothing, but it
// keeps what it is given, and counts.
#include <array>
#include <cstdio>

#include <gnomon/gpu/device.hpp>
#include <gnomon/gpu/null_backend.hpp>

int main() {
    namespace gpu = gnomon::gpu;
    gpu::Device device(gpu::create_null_backend());
    auto buffer =
        device.create_buffer({.label = "four bytes",
                              .size = 4,
                              .usage = gpu::BufferUsage::CopyDst | gpu::BufferUsage::CopySrc |
                                       gpu::BufferUsage::Vertex});
    if (!buffer) {
        std::fprintf(stderr, "%s\n", buffer.error().message.c_str());
        return 1;
    }
    const std::array bytes{std::byte{1}, std::byte{2}, std::byte{3}, std::byte{4}};
    if (const auto written = device.write_buffer(*buffer, 0, bytes); !written) {
        std::fprintf(stderr, "%s\n", written.error().message.c_str());
        return 1;
    }
    const auto counters = device.counters();
    std::printf("%s: %llu bytes uploaded, %llu objects\n", device.caps().backend.c_str(),
                static_cast<unsigned long long>(counters.uploaded_bytes),
                static_cast<unsigned long long>(counters.objects_alive));
    return device.caps().backend == "null" && counters.uploaded_bytes == 4 &&
                   counters.objects_alive == 1
               ? 0
               : 1;
}
