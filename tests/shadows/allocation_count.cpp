// SPDX-License-Identifier: MIT
#include "tests/shadows/allocation_count.hpp"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <new>

namespace {

thread_local std::uint64_t allocations = 0;
std::atomic<std::uint64_t> bytes{0};

// Before each block: how large it is.
constexpr std::size_t header = alignof(std::max_align_t);

}  // namespace

void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    ++allocations;
    void* memory = std::malloc(header + size);
    if (memory == nullptr) return nullptr;
    std::memcpy(memory, &size, sizeof size);
    bytes += size;
    return static_cast<std::byte*>(memory) + header;
}
void* operator new(std::size_t size) {
    if (void* memory = operator new(size, std::nothrow)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
    if (memory == nullptr) return;
    void* block = static_cast<std::byte*>(memory) - header;
    std::size_t size = 0;
    std::memcpy(&size, block, sizeof size);
    bytes -= size;
    std::free(block);
}
void operator delete(void* memory, std::size_t) noexcept { operator delete(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { operator delete(memory); }

namespace gnomon::test {

std::uint64_t allocation_count() { return allocations; }
std::uint64_t allocated_bytes() { return bytes; }

}  // namespace gnomon::test
