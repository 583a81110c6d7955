#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace farol {

/// Threads that run tasks in the order in which they are added.
class Workers {
  public:
    /// Makes as many threads as can be had, `threads` at most.
    explicit Workers(std::size_t threads);
    /// Waits for tasks that run; the others are left out, their futures broken.
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    std::size_t size() const { return threads_.size(); }

    /// Runs it in a thread, or in this one where there are none.
    template <typename Task>
    auto add(Task task) -> std::future<decltype(task())> {
        // Shared, for std::function wants what it holds to be copied.
        auto packed = std::make_shared<std::packaged_task<decltype(task())()>>(std::move(task));
        auto result = packed->get_future();
        push([packed] { (*packed)(); });
        return result;
    }

  private:
    void push(std::function<void()> task);
    void run();

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> tasks_;
    bool ends_ = false;
    std::vector<std::thread> threads_;
};

}  // namespace farol
