// Layer: base
#pragma once

// How the caller of long work follows it and stops it.

#include <atomic>
#include <functional>
#include <string>

namespace dashpot {

/// How far long work has come.
struct Progress {
  std::string stage;    ///< "fit modified_bouc_wen, fold 2 of 4"
  double fraction = 0;  ///< of the whole job, 0...1
};

/// Long work reports through a monitor and is stopped by it. Safe from several threads.
struct Monitor {
  /// May be empty; called from one thread at a time.
  std::function<void(const Progress&)> on_progress;
  const std::atomic<bool>* stop = nullptr;  ///< set by a signal handler, say
  /// May be empty. How the error of one fit falls: `stage`, and its sum of squares at this step, in
  /// a unit of its own; called from one thread at a time.
  std::function<void(const std::string& stage, double cost)> on_cost = {};
  std::string stage = {};  ///< what on_cost is told

  /// Reports, and throws Interrupted when `stop` is set.
  void report(const std::string& now, double fraction) const;
  /// The same for a step of a fit.
  void report_cost(double cost) const;
  /// Throws Interrupted when `stop` is set.
  void check() const;
};

}  // namespace dashpot
