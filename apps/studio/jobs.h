#pragma once
#include <atomic>
#include <condition_variable>
#include <list>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "dashpot/value.h"
#include "job_kinds.h"
#include "project.h"

namespace dashpot::studio {

/// The long work of a project: fits, rides, designs (job_kinds.h). Each is a child with a folder of
/// its own; what it was asked for lies there in studio.json. A command that keeps what is finished
/// goes on where it was stopped, or where its studio ended; another begins anew. Safe from several
/// threads.
class Jobs {
 public:
  explicit Jobs(const Project& project);
  /// Stops all and waits for their end.
  ~Jobs();
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  /// Starts one. Throws Error on a name that is taken, or where `asked` cannot be such work.
  void start(const JobKind& kind, const std::string& name, const Value& asked);
  void stop(const JobKind& kind, const std::string& name);
  void go_on(const JobKind& kind, const std::string& name);

  /// All of a kind in the folder, those of the command line too: name, state ("running", "stopped",
  /// "done", "failed"), what was asked for, command, progress, steps of fits, leaderboard.
  Value list(const JobKind& kind) const;

  /// A number that grows with every change; returns when it is above `seen`, or after a while.
  std::size_t wait(std::size_t seen);
  /// To be called when something else changed that pages show.
  void changed();

 private:
  struct Job {
    const JobKind* kind;
    std::string name;
    Value asked;                     ///< null: of the command line
    std::vector<std::string> words;  ///< of its command; empty: it cannot go on
    std::string state, stage, message;
    double fraction = 0;
    struct Step {
      std::string what;
      double seconds, cost;
    };
    std::vector<Step> steps;    ///< how the errors of its fits fell
    Value parameters;           ///< of the law that reported last, as they are then
    std::vector<Value> judged;  ///< rows of the leaderboard to come, as its models end
    std::atomic<int> pid = 0;
    std::jthread thread;
    bool stop_asked = false;
  };
  Job* find(const JobKind& kind, const std::string& name);
  std::filesystem::path folder_of(const Job& job) const;
  void run(Job& job);
  void begin(Job& job);
  void take_line(Job& job, std::string_view line, double seconds);
  std::vector<std::string> words_of(const Job& job) const;
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
