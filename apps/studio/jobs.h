#pragma once
#include <atomic>
#include <condition_variable>
#include <list>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "dashpot/value.h"
#include "project.h"

namespace dashpot::studio {

/// What a fit is asked for.
struct FitRequest {
  std::string name;                 ///< of its folder below fits/
  std::vector<std::string> models;  ///< names and groups, as `dashpot rank --models` takes them
  std::string leave_out;            ///< "": as the recordings allow
};

/// The fits of a project: each is a child, `dashpot rank`, with a folder of its own. What it was
/// asked for lies there in studio.json; its finished fits are kept by the command itself, so that
/// one which was stopped, or whose studio ended, goes on where it was. Safe from several threads.
class Jobs {
 public:
  explicit Jobs(const Project& project);
  /// Stops all and waits for their end.
  ~Jobs();
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  /// Starts a fit. Throws Error on a name that is taken, or a request that cannot be one.
  void start(const FitRequest& request);
  void stop(const std::string& name);
  void go_on(const std::string& name);

  /// Every fit of the folder, those of the command line too: name, state ("running", "stopped",
  /// "done", "failed"), command, progress, steps of the fits, leaderboard.
  Value list() const;

  /// A number that grows with every change; returns when it is above `seen`, or after a while.
  std::size_t wait(std::size_t seen);
  /// To be called when something else changed that pages show.
  void changed();

 private:
  struct Job {
    FitRequest request;
    std::string state, stage, message;
    double fraction = 0;
    struct Step {
      std::string what;
      double seconds, cost;
    };
    std::vector<Step> steps;  ///< how the sums of squares of its fits fell
    std::atomic<int> pid = 0;
    std::jthread thread;
    bool stop_asked = false;
  };
  Job* find(const std::string& name);
  void run(Job& job);
  void begin(Job& job);
  void take_line(Job& job, std::string_view line, double seconds);
  std::vector<std::string> arguments(const FitRequest& request) const;
  void save(const Job& job) const;

  const Project& project_;
  mutable std::mutex mutex_;
  std::condition_variable condition_;
  std::size_t version_ = 1;
  bool ending_ = false;
  int waiting_ = 0;
  std::list<Job> jobs_;
};

}  // namespace dashpot::studio
