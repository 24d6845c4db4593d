#pragma once
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace bladefit {

/// Threads that do what is put into a queue of bounded length.
class WorkerPool {
 public:
  WorkerPool(std::size_t workers, std::size_t longest_queue);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// Waits while the queue is full. After finish() nothing is taken.
  void put(std::function<void()> work);

  /// Does what is in the queue and ends.
  void finish();

 private:
  void work();

  std::mutex mutex_;
  std::condition_variable came_, left_;
  std::deque<std::function<void()>> queue_;
  std::size_t longest_;
  bool finished_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace bladefit
