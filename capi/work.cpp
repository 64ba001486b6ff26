#include "work.h"

#include <chrono>
#include <future>
#include <mutex>
#include <optional>
#include <utility>

namespace dashpot::capi {
namespace {

constexpr std::chrono::milliseconds kBetweenQuestions{50};

/// Passes on what the work says and what the caller asks.
class Watch {
 public:
  explicit Watch(const dashpot_monitor& caller) : caller_(caller) {
    monitor_.stop = &stop_;
    if (caller.on_progress)
      monitor_.on_progress = [this](const Progress& progress) { keep(progress); };
  }

  const Monitor& monitor() const { return monitor_; }
  void stop() { stop_ = true; }

  /// On the caller's thread.
  void ask() {
    if (const std::optional<Progress> progress = take())
      caller_.on_progress(progress->stage.c_str(), progress->fraction, caller_.context);
    if (caller_.is_cancelled && caller_.is_cancelled(caller_.context) != 0) stop();
  }

 private:
  void keep(const Progress& progress) {
    const std::lock_guard lock(guard_);
    latest_ = progress;
  }
  std::optional<Progress> take() {
    const std::lock_guard lock(guard_);
    return std::exchange(latest_, std::nullopt);
  }

  const dashpot_monitor& caller_;
  std::atomic<bool> stop_ = false;
  Monitor monitor_;
  std::mutex guard_;
  std::optional<Progress> latest_;
};

}  // namespace

void run_watched(const dashpot_monitor* caller, const std::function<void(const Monitor&)>& work) {
  if (!caller || (!caller->is_cancelled && !caller->on_progress)) return work({});

  // The work runs on a thread of its own; this one keeps asking the caller.
  Watch watch(*caller);
  std::future<void> result = std::async(std::launch::async, [&] { work(watch.monitor()); });
  try {
    do watch.ask();
    while (result.wait_for(kBetweenQuestions) != std::future_status::ready);
  } catch (...) {
    watch.stop();  // a callback that throws must not leave the work running
    throw;
  }

  // Progress of the last moment still goes out before the result or its error.
  watch.ask();
  result.get();
}

}  // namespace dashpot::capi
