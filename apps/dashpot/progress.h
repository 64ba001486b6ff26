#pragma once
#include <chrono>
#include <string>

#include "dashpot/monitor.h"

namespace dashpot::cli {

/// Shows the progress of work on stderr: one line that redraws itself on a terminal, plain lines
/// every few seconds in a log, or lines of JSON for a program that draws it. The first two say how
/// much time is left, as soon as that can be told.
class ProgressLine {
 public:
  /// width: columns of the terminal; 0: a log.
  explicit ProgressLine(int width) : width_(width) {}
  void show(const Progress& progress);
  /// A step of a fit; shown as JSON only.
  void show_cost(const std::string& stage, double cost);
  /// {"stage", "fraction"} for all progress, {"stage", "cost"} for steps of fits.
  std::string format = "text";
  /// Takes the line off the terminal, so that other text can be printed.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  std::string bar(const Progress& progress) const;
  std::string remaining(double fraction) const;

  int width_;
  bool drawn_ = false;
  bool started_ = false;
  Clock::time_point start_, last_, last_cost_;
  double start_fraction_ = 0;  ///< of the work that was done by start_
};

}  // namespace dashpot::cli
