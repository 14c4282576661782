// SPDX-License-Identifier: MIT
//
// A wrapper round any backend that makes the n-th fallible call fail, so that error paths are
// tested: run a piece of code with n = 1, 2, 3, … until it succeeds, and look that every failure
// came back as a Result and nothing leaked.
#pragma once

#include <cstdint>
#include <memory>

#include <gnomon/gpu/backend.hpp>

#pragma GCC visibility push(default)
namespace gnomon::gpu {

/// What fails, and how.
struct FaultPlan {
    std::uint64_t fail_at = 0;                ///< 1: the first fallible call; 0: none
    ErrorCode code = ErrorCode::OutOfMemory;  ///< of the failures
    std::uint64_t calls = 0;                  ///< counts fallible calls made so far
};

/// The plan may be changed between calls; it must outlive the backend.
[[nodiscard]] std::unique_ptr<Backend> create_fault_backend(std::unique_ptr<Backend> inner,
                                                            FaultPlan& plan);

}  // namespace gnomon::gpu
#pragma GCC visibility pop
