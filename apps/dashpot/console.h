#pragma once
#include <atomic>
#include <cstdio>
#include <string>
#include <string_view>

#include "dashpot/monitor.h"
#include "dashpot/value.h"
#include "progress.h"

namespace dashpot::cli {

/// Who read stdout through a pipe wants no more: `| head`.
struct ReaderGone {};

/// The only place that prints. Results go to stdout, all talk about the work to stderr; with
/// --json, stdout holds the JSON text alone.
class Console {
 public:
  /// `stop` is set when the user interrupts.
  Console(std::string command_line, const std::atomic<bool>& stop);

  bool quiet = false;             ///< neither progress nor notes
  bool json = false;              ///< results for programs
  std::string progress = "text";  ///< or "json": lines for a program that draws it
  /// Recordings of a folder could not be read: the work was done on the others, and the exit code
  /// says so.
  bool files_unread = false;

  /// A result for people: stdout, or stderr beside JSON (nothing then when quiet).
  void print(std::string_view text);
  /// A result for programs, on stdout.
  void print_json(const Value& value);
  /// Talk about the work, on stderr; nothing when quiet.
  void talk(std::string_view text);
  /// The same in place of the last `lines` lines of it; where live_width() says so only.
  void talk_over(std::size_t lines, std::string_view text);
  /// Columns of the terminal that talk goes to and where it can be drawn anew; 0: a log.
  int live_width() const { return live_width_; }
  /// Remarks on the work, on stderr. Warnings and errors come even when quiet.
  void note(std::string_view text);
  void warn(std::string_view text);
  void error(std::string_view text);
  /// Notes and warnings up to now, for a result that tells them too.
  const std::vector<std::string>& remarks() const { return remarks_; }

  /// For long work: draws progress and passes the interruption on.
  Monitor monitor();
  /// Throws Interrupted when the user asked to stop.
  void check_stop() const;
  /// Throws Error when stdout could not take what was printed, ReaderGone when its reader has left.
  void finish();

  int width() const { return width_; }  ///< columns for results
  std::string bold(std::string_view text) const;
  /// The command line as it can be typed again.
  const std::string& command_line() const { return command_line_; }

 private:
  void message(std::string_view label, std::string_view colour, std::string_view text);
  /// What is left goes to stdout.
  void flush();
  /// Remembers that the reader of stdout has left, which only the write that failed tells.
  void note_reader();

  std::string command_line_;
  const std::atomic<bool>& stop_;
  int width_;
  int live_width_;
  ProgressLine progress_;
  bool reader_has_left_ = false;
  std::vector<std::string> remarks_;
};

/// One word of a command line, quoted for a shell where it must be.
std::string shell_quoted(std::string_view word);

}  // namespace dashpot::cli
