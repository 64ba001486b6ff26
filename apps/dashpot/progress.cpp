#include "progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/core.h>

#include "dashpot/value.h"
#include "layout.h"

namespace dashpot::cli {
namespace {

using namespace std::chrono_literals;
constexpr auto kRedraw = 100ms;   // fast enough to look alive
constexpr auto kLogLine = 5s;     // slow enough for a log to stay readable
constexpr auto kCostLine = 20ms;  // as fast as an eye follows
constexpr auto kSettle = 3s;      // no forecast before this
constexpr int kBarColumns = 24;
constexpr int kLeastBarColumns = 50;  // narrower terminals get no bar, only words

}  // namespace

void ProgressLine::show_cost(const std::string& stage, double cost) {
  const Clock::time_point now = Clock::now();
  if (format != "json" || !std::isfinite(cost) || now - last_cost_ < kCostLine) return;
  last_cost_ = now;
  const Value line = Value::object({{"stage", stage}, {"cost", cost}});
  fmt::print(stderr, "{}\n", format_json(line, false));
}

void ProgressLine::show(const Progress& progress) {
  const Clock::time_point now = Clock::now();
  if (format == "json") {
    const Value line = Value::object({{"stage", progress.stage}, {"fraction", progress.fraction}});
    fmt::print(stderr, "{}\n", format_json(line, false));
    return;
  }
  if (!started_) {
    started_ = true;
    start_ = now;
    start_fraction_ = progress.fraction;
    last_ = width_ > 0 ? now - kRedraw : now;
  }

  // A terminal is redrawn often, a log gets a line now and then.
  if (now - last_ < (width_ > 0 ? Clock::duration(kRedraw) : Clock::duration(kLogLine))) return;
  last_ = now;

  if (width_ > 0) {
    fmt::print(stderr, "\r\x1b[K{}", bar(progress));
    drawn_ = true;
  } else {
    const double fraction = std::clamp(progress.fraction, 0.0, 1.0);
    fmt::print(stderr, "{:3.0f} %{}  {}\n", 100 * fraction, remaining(fraction), progress.stage);
  }

  std::fflush(stderr);
}

void ProgressLine::clear() {
  if (!drawn_) return;
  fmt::print(stderr, "\r\x1b[K");
  std::fflush(stderr);
  drawn_ = false;
}

std::string ProgressLine::bar(const Progress& progress) const {
  const double fraction = std::clamp(progress.fraction, 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(std::lround(fraction * kBarColumns));
  std::string line = fmt::format("{:3.0f} %", 100 * fraction);
  if (width_ >= kLeastBarColumns)
    line += " [" + std::string(filled, '=') + std::string(kBarColumns - filled, ' ') + "]";
  line += remaining(fraction) + "  " + progress.stage;
  return first_columns(line, static_cast<std::size_t>(width_ - 1));
}

std::string ProgressLine::remaining(double fraction) const {
  // What was done before, as rides that are kept, took no time of this run.
  const double done = fraction - start_fraction_, left = 1 - fraction;
  const Clock::duration spent = last_ - start_;
  if (spent < kSettle || !(left > 0) || done < 0.02 * (done + left)) return {};
  const double seconds = std::chrono::duration<double>(spent).count() * left / done;
  if (seconds < 90) return fmt::format(" {:.0f} s left", std::ceil(seconds));
  return fmt::format(" {:.0f} min left", std::ceil(seconds / 60));
}

}  // namespace dashpot::cli
