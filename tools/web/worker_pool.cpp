#include "tools/web/worker_pool.hpp"

#include <utility>

namespace bladefit {

WorkerPool::WorkerPool(std::size_t workers, std::size_t longest_queue) : longest_(longest_queue) {
  threads_.reserve(workers);
  for (std::size_t k = 0; k < workers; ++k) threads_.emplace_back([this] { work(); });
}

WorkerPool::~WorkerPool() { finish(); }

void WorkerPool::put(std::function<void()> work) {
  std::unique_lock lock(mutex_);
  left_.wait(lock, [this] { return queue_.size() < longest_ || finished_; });
  if (finished_) return;
  queue_.push_back(std::move(work));
  came_.notify_one();
}

void WorkerPool::finish() {
  {
    const std::lock_guard lock(mutex_);
    finished_ = true;
  }
  came_.notify_all();
  left_.notify_all();
  for (std::thread& thread : threads_) {
    if (thread.joinable()) thread.join();
  }
}

void WorkerPool::work() {
  while (true) {
    std::function<void()> next;
    {
      std::unique_lock lock(mutex_);
      came_.wait(lock, [this] { return !queue_.empty() || finished_; });
      if (queue_.empty()) return;
      next = std::move(queue_.front());
      queue_.pop_front();
    }
    left_.notify_one();
    next();
  }
}

}  // namespace bladefit
