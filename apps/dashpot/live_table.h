#pragma once
#include <chrono>
#include <mutex>
#include <string>
#include <vector>

#include "console.h"
#include "dashpot/identify/search/search.h"

namespace dashpot::cli {

/// The trials of a running search: on a terminal the best so far as a table that redraws itself, in
/// a log a line per trial. add() and draw() may be called from several threads.
class LiveTable {
 public:
  explicit LiveTable(Console& console) : console_(console) {}
  /// Takes a trial that has ended.
  void add(const Trial& trial, const SearchReport& search);
  /// Shows what came since, not too often; from one thread at a time.
  void draw();
  /// Shows the last of it in a log, takes the table off a terminal: the results follow.
  void finish();

 private:
  void take();
  std::string table() const;
  std::string line(const Trial& trial) const;

  Console& console_;
  std::mutex guard_;
  SearchReport search_;        ///< how the search was asked for
  std::vector<Trial> trials_;  ///< of the present rung, best first
  std::vector<Trial> fresh_;   ///< not yet drawn
  std::size_t rung_ = 0, ended_ = 0;
  std::size_t drawn_lines_ = 0;
  std::chrono::steady_clock::time_point drawn_at_;
};

}  // namespace dashpot::cli
