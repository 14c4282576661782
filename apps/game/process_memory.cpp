// SPDX-License-Identifier: MIT
#include "process_memory.hpp"

#include <fstream>

#include <unistd.h>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace gnomon::game {

ProcessMemory process_memory() {
    ProcessMemory memory;
#if defined(__GLIBC__) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 33)
    const struct mallinfo2 heap = ::mallinfo2();
    memory.held_bytes = heap.uordblks + heap.hblkhd;
#endif
    std::ifstream pages("/proc/self/statm");
    std::uint64_t size = 0;
    std::uint64_t resident = 0;
    const long page_bytes = ::sysconf(_SC_PAGESIZE);
    if (pages >> size >> resident && page_bytes > 0) {
        memory.resident_bytes = resident * static_cast<std::uint64_t>(page_bytes);
    }
    return memory;
}

}  // namespace gnomon::game
