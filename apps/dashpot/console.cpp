#include "console.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <unistd.h>

#include <fmt/core.h>
#include <sys/ioctl.h>

#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "layout.h"

namespace dashpot::cli {
namespace {

constexpr int kDefaultColumns = 80;
constexpr int kLeastColumns = 40;
constexpr int kMostColumns = 160;  // longer lines are hard to read

int terminal_columns(int stream) {
  if (const char* stated = std::getenv("COLUMNS"))
    if (const auto columns = parse_number(stated); columns && *columns >= 1)
      return static_cast<int>(std::min(*columns, 1000.0));
  winsize size{};
  if (ioctl(stream, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return kDefaultColumns;
}

bool has_colour(int stream) {
  const char* none = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  return isatty(stream) && !(none && *none) && !(terminal && std::string_view(terminal) == "dumb");
}

std::string coloured(std::string_view text, std::string_view colour, int stream) {
  return has_colour(stream) ? fmt::format("\x1b[{}m{}\x1b[0m", colour, text) : std::string(text);
}

void put(std::string_view text, std::FILE* stream) {
  const std::string safe = terminal_text(text);
  std::fwrite(safe.data(), 1, safe.size(), stream);
}

}  // namespace

Console::Console(std::string command_line, const std::atomic<bool>& stop)
    : command_line_(std::move(command_line)),
      stop_(stop),
      width_(std::clamp(terminal_columns(STDOUT_FILENO), kLeastColumns, kMostColumns)),
      live_width_(isatty(STDERR_FILENO) ? terminal_columns(STDERR_FILENO) : 0),
      progress_(live_width_) {}

void Console::print(std::string_view text) {
  progress_.clear();
  if (json && quiet) return;
  errno = 0;
  put(text, json ? stderr : stdout);
  note_reader();
}

void Console::print_json(const Value& value) {
  progress_.clear();
  const std::string text = format_json(presentable(value));  // what is not finite becomes null
  errno = 0;
  std::fwrite(text.data(), 1, text.size(), stdout);
  if (!text.ends_with('\n')) std::fputc('\n', stdout);
  note_reader();
}

void Console::talk(std::string_view text) {
  if (quiet) return;
  progress_.clear();
  flush();
  put(text, stderr);
}

void Console::talk_over(std::size_t lines, std::string_view text) {
  if (quiet) return;
  progress_.clear();
  flush();
  if (lines > 0) fmt::print(stderr, "\x1b[{}A\x1b[J", lines);
  put(text, stderr);
}

void Console::note(std::string_view text) {
  remarks_.emplace_back(text);
  if (!quiet) message("note", "1", text);
}

void Console::warn(std::string_view text) {
  remarks_.emplace_back(text);
  message("warning", "1;33", text);
}

void Console::error(std::string_view text) { message("error", "1;31", text); }

void Console::message(std::string_view label, std::string_view colour, std::string_view text) {
  progress_.clear();
  flush();  // keeps the order where both streams go to one terminal
  put(fmt::format("{}: {}\n", coloured(label, colour, STDERR_FILENO), text), stderr);
}

Monitor Console::monitor() {
  Monitor monitor;
  monitor.stop = &stop_;
  if (quiet) return monitor;
  progress_.format = progress;
  monitor.on_progress = [this](const Progress& now) { progress_.show(now); };
  if (progress == "json")
    monitor.on_cost = [this](const std::string& stage, double cost) {
      progress_.show_cost(stage, cost);
    };
  return monitor;
}

void Console::check_stop() const {
  if (stop_) throw Interrupted();
}

void Console::finish() {
  progress_.clear();
  flush();
  if (reader_has_left_) throw ReaderGone();
  if (!std::ferror(stdout)) return;
  throw Error("standard output", "cannot be written", "is the disk full?");
}

void Console::flush() {
  errno = 0;
  std::fflush(stdout);
  note_reader();
}

void Console::note_reader() {
  if (errno == EPIPE && std::ferror(stdout)) reader_has_left_ = true;
}

std::string Console::bold(std::string_view text) const {
  return coloured(text, "1", STDOUT_FILENO);
}

std::string shell_quoted(std::string_view word) {
  constexpr std::string_view kSafe =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+,./:%@";
  if (!word.empty() && word.find_first_not_of(kSafe) == std::string_view::npos)
    return std::string(word);
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace dashpot::cli
