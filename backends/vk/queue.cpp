// SPDX-License-Identifier: MIT
//
// Submissions, their fences, and what waits for them.
#include "internal/queue.hpp"

#include <limits>

#include <fmt/format.h>

#include "internal/error.hpp"

namespace gnomon::vk {

namespace {

/// Enough that the host records while the device works, few enough that a frame is never seen late.
constexpr std::size_t max_in_flight = 3;

}  // namespace

Status Queue::initialise() {
    VkCommandPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    info.queueFamilyIndex = device_.adapter.queue_family;
    if (const VkResult result =
            device_.fn.CreateCommandPool(device_.handle, &info, nullptr, &pool_);
        result != VK_SUCCESS) {
        return failure(result, "vkCreateCommandPool", "the queue");
    }
    return {};
}

Queue::~Queue() {
    drain();
    const auto destroy_fence = [&](const Slot& slot) {
        device_.fn.DestroyFence(device_.handle, slot.fence, nullptr);
    };
    for (const InFlight& submission : in_flight_) {
        destroy_fence(submission.slot);
    }
    for (const Slot& slot : free_) {
        destroy_fence(slot);
    }
    if (recording_) {
        destroy_fence(*recording_);
    }
    if (pool_ != VK_NULL_HANDLE) {
        device_.fn.DestroyCommandPool(device_.handle, pool_, nullptr);
    }
}

tl::unexpected<Error> Queue::lose(VkResult result, const char* call) {
    const tl::unexpected<Error> error = failure(result, call, "the queue");
    lost_ = error.value().message;
    return error;
}

Status Queue::check_not_lost() const {
    if (lost_.empty()) {
        return {};
    }
    return fail(ErrorCode::DeviceLost,
                fmt::format("The device cannot be used after an earlier failure: {}", lost_));
}

Result<Queue::Slot> Queue::take_slot() {
    if (!free_.empty()) {
        const Slot slot = free_.back();
        free_.pop_back();
        return slot;
    }
    Slot slot;
    VkFenceCreateInfo fence{};
    fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    if (const VkResult result =
            device_.fn.CreateFence(device_.handle, &fence, nullptr, &slot.fence);
        result != VK_SUCCESS) {
        return failure(result, "vkCreateFence", "the queue");
    }
    VkCommandBufferAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    info.commandPool = pool_;
    info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    info.commandBufferCount = 1;
    if (const VkResult result =
            device_.fn.AllocateCommandBuffers(device_.handle, &info, &slot.commands);
        result != VK_SUCCESS) {
        device_.fn.DestroyFence(device_.handle, slot.fence, nullptr);
        return failure(result, "vkAllocateCommandBuffers", "the queue");
    }
    return slot;
}

Result<VkCommandBuffer> Queue::commands() {
    if (const Status usable = check_not_lost(); !usable) {
        return forward_error(usable);
    }
    if (recording_) {
        return recording_->commands;
    }
    const Result<Slot> slot = take_slot();
    if (!slot) {
        return forward_error(slot);
    }
    VkCommandBufferBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    if (const VkResult result = device_.fn.BeginCommandBuffer(slot->commands, &info);
        result != VK_SUCCESS) {
        free_.push_back(*slot);
        return failure(result, "vkBeginCommandBuffer", "the queue");
    }
    recording_ = *slot;
    return slot->commands;
}

Status Queue::submit(const SubmitSemaphores& semaphores) {
    if (const Status usable = check_not_lost(); !usable) {
        return usable;
    }
    if (!recording_ && !deferred_.empty() && deferred_.back().serial > submitted_) {
        // An empty submission, whose fence tells that the host's before it are done.
        if (const Result<VkCommandBuffer> begun = commands(); !begun) {
            return forward_error(begun);
        }
    }
    if (!recording_) {
        return retire_finished();
    }
    if (const VkResult result = device_.fn.EndCommandBuffer(recording_->commands);
        result != VK_SUCCESS) {
        return lose(result, "vkEndCommandBuffer");
    }
    const VkPipelineStageFlags wait_stage = VK_PIPELINE_STAGE_TRANSFER_BIT;
    VkSubmitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    info.waitSemaphoreCount = semaphores.wait != VK_NULL_HANDLE ? 1 : 0;
    info.pWaitSemaphores = &semaphores.wait;
    info.pWaitDstStageMask = &wait_stage;
    info.commandBufferCount = 1;
    info.pCommandBuffers = &recording_->commands;
    info.signalSemaphoreCount = semaphores.signal != VK_NULL_HANDLE ? 1 : 0;
    info.pSignalSemaphores = &semaphores.signal;
    if (const VkResult result = device_.fn.QueueSubmit(device_.queue, 1, &info, recording_->fence);
        result != VK_SUCCESS) {
        return lose(result, "vkQueueSubmit");
    }
    in_flight_.push_back({*recording_, ++submitted_});
    recording_.reset();
    if (in_flight_.size() > max_in_flight) {
        if (const Status retired = retire_oldest(); !retired) {
            return retired;
        }
    }
    return retire_finished();
}

Status Queue::finish() {
    if (const Status submitted = submit(); !submitted) {
        return submitted;
    }
    while (!in_flight_.empty()) {
        if (const Status retired = retire_oldest(); !retired) {
            return retired;
        }
    }
    run_deferred();
    return {};
}

Status Queue::retire_oldest() {
    const InFlight oldest = in_flight_.front();
    if (const VkResult result =
            device_.fn.WaitForFences(device_.handle, 1, &oldest.slot.fence, VK_TRUE,
                                     std::numeric_limits<std::uint64_t>::max());
        result != VK_SUCCESS) {
        return lose(result, "vkWaitForFences");
    }
    if (const VkResult result = device_.fn.ResetFences(device_.handle, 1, &oldest.slot.fence);
        result != VK_SUCCESS) {
        return lose(result, "vkResetFences");
    }
    completed_ = oldest.serial;
    free_.push_back(oldest.slot);
    in_flight_.pop_front();
    return {};
}

Status Queue::retire_finished() {
    while (!in_flight_.empty()) {
        const VkResult result =
            device_.fn.GetFenceStatus(device_.handle, in_flight_.front().slot.fence);
        if (result == VK_NOT_READY) {
            break;
        }
        if (result != VK_SUCCESS) {
            return lose(result, "vkGetFenceStatus");
        }
        if (const Status retired = retire_oldest(); !retired) {
            return retired;
        }
    }
    run_deferred();
    return {};
}

void Queue::defer(std::function<void()> destroy) {
    if (holds_) {
        held_.push_back(std::move(destroy));
        return;
    }
    const std::uint64_t serial = recording_ || shared_ ? recording_serial() : submitted_;
    if (serial <= completed_) {
        destroy();
    } else {
        deferred_.push_back({std::move(destroy), serial});
    }
}

void Queue::let_go() {
    holds_ = false;
    for (std::function<void()>& destroy : held_) {
        defer(std::move(destroy));
    }
    held_.clear();
}

void Queue::drain() {
    let_go();
    // A lost device is idle too. A host's other queues need not be, nor may we touch them.
    if (device_.is_adopted()) {
        device_.fn.QueueWaitIdle(device_.queue);
    } else {
        device_.fn.DeviceWaitIdle(device_.handle);
    }
    for (const Deferred& deferred : deferred_) {
        deferred.destroy();
    }
    deferred_.clear();
}

void Queue::run_deferred() {
    while (!deferred_.empty() && deferred_.front().serial <= completed_) {
        // Taken off the list first: destroying one object may defer another.
        const std::function<void()> destroy = std::move(deferred_.front().destroy);
        deferred_.pop_front();
        destroy();
    }
}

}  // namespace gnomon::vk
