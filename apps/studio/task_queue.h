#pragma once
#include <condition_variable>
#include <deque>
#include <functional>
#include <httplib.h>
#include <mutex>
#include <thread>
#include <vector>

namespace dashpot::studio {

/// The connections of the server on a fixed number of threads. Where as many wait as may, the
/// server accepts no more until one is served: neither threads nor memory grow with requests.
class TaskQueue : public httplib::TaskQueue {
 public:
  TaskQueue(std::size_t threads, std::size_t most_waiting);
  void enqueue(std::function<void()> task) override;
  void shutdown() override;

 private:
  void work();

  const std::size_t most_waiting_;
  std::mutex mutex_;
  std::condition_variable has_task_, has_room_;
  std::deque<std::function<void()>> tasks_;
  bool ending_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace dashpot::studio
