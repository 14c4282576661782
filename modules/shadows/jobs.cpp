// SPDX-License-Identifier: MIT
#include <gnomon/shadows/jobs.hpp>

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace gnomon::shadows {

namespace {

class ThreadPool {
public:
    explicit ThreadPool(unsigned workers) {
        for (unsigned i = 0; i < workers; ++i) threads_.emplace_back([this] { serve(); });
    }
    ThreadPool(const ThreadPool&) = delete;
    ThreadPool& operator=(const ThreadPool&) = delete;
    ~ThreadPool() {
        {
            const std::lock_guard lock(mutex_);
            ending_ = true;
        }
        woken_.notify_all();
        for (std::thread& thread : threads_) thread.join();
    }

    void run(std::size_t count, const std::function<void(std::size_t)>& task) {
        if (threads_.empty() || count < 2) {
            for (std::size_t i = 0; i < count; ++i) task(i);
            return;
        }
        const std::lock_guard one_at_a_time(turn_);
        std::unique_lock lock(mutex_);
        task_ = &task;
        count_ = count;
        next_ = 0;
        ++call_;
        woken_.notify_all();
        take_tasks(lock);
        done_.wait(lock, [&] { return busy_ == 0; });
        task_ = nullptr;
        if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    }

private:
    void serve() {
        std::unique_lock lock(mutex_);
        for (std::uint64_t seen = 0;;) {
            woken_.wait(lock, [&] { return ending_ || call_ != seen; });
            if (ending_) return;
            seen = call_;
            if (task_ != nullptr) take_tasks(lock);
        }
    }

    // Tasks are some ten microseconds each at least; a lock for each is nothing beside them.
    void take_tasks(std::unique_lock<std::mutex>& lock) {
        ++busy_;
        while (next_ < count_) {
            const std::size_t i = next_++;
            lock.unlock();
            std::exception_ptr failure;
            try {
                (*task_)(i);
            } catch (...) {
                failure = std::current_exception();
            }
            lock.lock();
            if (failure && !failure_) failure_ = std::move(failure);
        }
        if (--busy_ == 0) done_.notify_all();
    }

    std::mutex turn_;
    std::mutex mutex_;  // of all that follows
    std::condition_variable woken_;
    std::condition_variable done_;
    const std::function<void(std::size_t)>* task_ = nullptr;
    std::size_t count_ = 0;
    std::size_t next_ = 0;
    std::size_t busy_ = 0;  // threads that may be within a task
    std::uint64_t call_ = 0;
    std::exception_ptr failure_;
    bool ending_ = false;
    std::vector<std::thread> threads_;
};

}  // namespace

Jobs thread_jobs(unsigned threads) {
    if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
    auto pool = std::make_shared<ThreadPool>(threads - 1);
    return
        [pool = std::move(pool)](std::size_t count, const std::function<void(std::size_t)>& task) {
            pool->run(count, task);
        };
}

}  // namespace gnomon::shadows
