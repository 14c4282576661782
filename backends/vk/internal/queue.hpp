// SPDX-License-Identifier: MIT
//
// The queue: one command buffer is always the one being recorded; uploads, clears and submitted
// commands all go into it in the order of the calls, which is the order in which they run. What is
// destroyed waits in a list until the submission that may still use it is done.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "internal/device.hpp"

namespace gnomon::vk {

/// Semaphores of a submission that draws on a window.
struct SubmitSemaphores {
    VkSemaphore wait = VK_NULL_HANDLE;  ///< before the transfer stage
    VkSemaphore signal = VK_NULL_HANDLE;
};

class Queue {
public:
    explicit Queue(Device& device) : device_(device) {}
    ~Queue();
    Queue(const Queue&) = delete;
    Queue& operator=(const Queue&) = delete;
    [[nodiscard]] Status initialise();

    /// A host's commands may use objects, too, and it submits them after our last submission and
    /// before our next: what is destroyed waits for that one.
    void share_with_host() { shared_ = true; }

    /// The command buffer being recorded; begins one when there is none.
    [[nodiscard]] Result<VkCommandBuffer> commands();

    /// Whether that is it.
    [[nodiscard]] bool is_recording_to(VkCommandBuffer commands) const {
        return recording_ && recording_->commands == commands;
    }

    /// Hands what was recorded to the device; does nothing when nothing was. A failure loses
    /// recorded work, so every later call fails as well, with ErrorCode::DeviceLost.
    [[nodiscard]] Status submit(const SubmitSemaphores& semaphores = {});
    /// Submits, then waits until the device has finished.
    [[nodiscard]] Status finish();

    /// What is destroyed from now on may be used by what the host records, and submits after our
    /// next submission: it waits for let_go().
    void hold() { holds_ = true; }
    /// The host has submitted that, or does before our next submission.
    void let_go();

    /// Runs `destroy` once nothing recorded so far can use the object any more.
    void defer(std::function<void()> destroy);
    /// For the end: waits for the device and runs all that was deferred. What is recorded but not
    /// submitted never runs.
    void drain();

    /// Submissions are numbered from 1. What is recorded now belongs to this one.
    [[nodiscard]] std::uint64_t recording_serial() const { return submitted_ + 1; }
    /// All submissions up to this one are done; as of the last submit() or finish().
    [[nodiscard]] std::uint64_t completed_serial() const { return completed_; }

private:
    struct Slot {
        VkCommandBuffer commands = VK_NULL_HANDLE;
        VkFence fence = VK_NULL_HANDLE;
    };
    struct InFlight {
        Slot slot;
        std::uint64_t serial = 0;
    };
    struct Deferred {
        std::function<void()> destroy;
        std::uint64_t serial = 0;
    };

    [[nodiscard]] Result<Slot> take_slot();
    [[nodiscard]] Status retire_oldest();
    [[nodiscard]] Status retire_finished();
    void run_deferred();
    tl::unexpected<Error> lose(VkResult result, const char* call);
    [[nodiscard]] Status check_not_lost() const;

    Device& device_;
    bool shared_ = false;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    std::vector<Slot> free_;
    std::optional<Slot> recording_;
    std::deque<InFlight> in_flight_;
    std::deque<Deferred> deferred_;  // in order of their numbers
    std::vector<std::function<void()>> held_;
    bool holds_ = false;
    std::uint64_t submitted_ = 0;
    std::uint64_t completed_ = 0;
    std::string lost_;  // the sentence of the failure after which nothing works
};

}  // namespace gnomon::vk
