#include "dashpot/record/stretches.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/record/columns.h"
#include "dashpot/record/time_base.h"

namespace dashpot {
namespace {

constexpr double kGap = 5;  // median steps
constexpr std::size_t kFewestSamples = 20;

/// A run of rows, first ... last-1.
using Rows = std::pair<std::size_t, std::size_t>;

/// Line of the file that a row stands on; 0 where the table has no lines.
std::size_t line_of(const RawTable& table, std::size_t row) {
  if (table.lines.empty()) return 0;
  auto jump = std::upper_bound(table.lines.begin(), table.lines.end(), row,
                               [](std::size_t r, const auto& line) { return r < line.first; });
  if (jump != table.lines.begin()) --jump;
  return jump->second + row - jump->first;
}

/// The table of those rows alone.
RawTable rows_of(const RawTable& table, const std::vector<Rows>& kept) {
  RawTable out = table;
  out.lines.clear();
  for (RawColumn& column : out.columns) column.values.clear(), column.bad.reset();

  for (const auto& [first, last] : kept) {
    // The lines: where the run begins, and where the numbering jumps within it.
    const std::size_t begin = out.rows();
    if (!table.lines.empty()) out.lines.emplace_back(begin, line_of(table, first));
    for (const auto& [row, line] : table.lines)
      if (row > first && row < last) out.lines.emplace_back(begin + row - first, line);

    for (std::size_t k = 0; k < table.columns.size(); ++k) {
      const RawColumn& from = table.columns[k];
      RawColumn& to = out.columns[k];
      to.values.insert(to.values.end(), from.values.begin() + static_cast<std::ptrdiff_t>(first),
                       from.values.begin() + static_cast<std::ptrdiff_t>(last));
      if (!to.bad && from.bad && from.bad->row >= first && from.bad->row < last)
        to.bad = BadCell{begin + from.bad->row - first, from.bad->text};
    }
  }
  return out;
}

/// Leaves out rows at the end in which no measured channel has a number, and, as stated, all rows
/// in which a used column has none.
RawTable without_bad_rows(RawTable table, const ColumnUses& uses, bool drop) {
  const auto is_bad = [&](const ColumnUse& use, std::size_t row) {
    return std::isnan(table.columns[use.column].values[row]);
  };
  if (std::none_of(uses.used.begin(), uses.used.end(),
                   [&](const ColumnUse& use) { return table.columns[use.column].bad.has_value(); }))
    return table;

  // The empty tail.
  std::size_t end = table.rows();
  while (end > 0 && std::all_of(uses.used.begin(), uses.used.end(), [&](const ColumnUse& use) {
           return use.channel == "time" || is_bad(use, end - 1);
         }))
    --end;
  if (const std::size_t tail = table.rows() - end; tail > 0)
    table.notes.push_back(counted(tail, "row") + " at the end without samples left out");

  // Bad rows before it.
  std::vector<Rows> kept{{0, end}};
  if (drop) {
    kept.clear();
    std::size_t good = 0, first = 0, first_bad = end;
    for (std::size_t row = 0; row <= end; ++row) {
      const bool bad = row == end || std::any_of(uses.used.begin(), uses.used.end(),
                                                 [&](const auto& use) { return is_bad(use, row); });
      if (!bad) continue;
      first_bad = std::min(first_bad, row);
      if (row > first) kept.emplace_back(first, row), good += row - first;
      first = row + 1;
    }
    if (good < end)
      table.notes.push_back(std::to_string(end - good) + " of " + std::to_string(table.rows()) +
                            " rows dropped: a used cell holds no number ('on_bad_row: drop'), " +
                            (end - good == 1 ? "" : "first ") + "at " + table.where(first_bad));
  }
  return end == table.rows() && !drop ? table : rows_of(table, kept);
}

/// Rows that repeat the one before in every column, as loggers write them, and single stamps that
/// are repeated with other samples: the first counts. Many such stamps are no slip: they stay, to
/// be refused.
RawTable without_repeated_stamps(RawTable table, std::size_t time) {
  constexpr double kFew = 0.01;
  const std::vector<double>& t = table.columns[time].values;

  // The rows between repeated stamps; a repetition that tells something else is counted.
  std::size_t repeated = 0, different = 0;
  std::vector<Rows> kept;
  std::size_t first = 0;
  for (std::size_t row = 1; row < t.size(); ++row) {
    if (t[row] != t[row - 1]) continue;
    ++repeated;
    different += !std::all_of(table.columns.begin(), table.columns.end(), [&](const RawColumn& c) {
      return c.values[row] == c.values[row - 1] ||
             (std::isnan(c.values[row]) && std::isnan(c.values[row - 1]));
    });
    if (row > first) kept.emplace_back(first, row);
    first = row + 1;
  }

  if (repeated == 0 || t.size() < kFewestSamples ||
      static_cast<double>(different) > kFew * static_cast<double>(t.size()))
    return table;

  kept.emplace_back(first, t.size());
  std::erase_if(kept, [](const Rows& rows) { return rows.first >= rows.second; });
  table.notes.push_back(counted(repeated, "row") +
                        " with the time stamp of the row before left out: the first counts (" +
                        std::to_string(different) + " of them with other samples)");
  return rows_of(table, kept);
}

/// A counter that starts again (after 2^16 counts, a minute, a day): goes on counting. The period
/// is the one that makes the step over the jump the usual one.
void unwrap(RawTable& table, std::size_t time) {
  std::vector<double>& t = table.columns[time].values;
  const bool back = std::adjacent_find(t.begin(), t.end(), std::greater<>()) != t.end();
  if (!back || t.size() < kFewestSamples) return;

  constexpr double kPeriods[] = {
      100,   256,     1000,     1024,  4096,   10000,        32768,       60,          3600,  65536,
      86400, 1000000, 16777216, 3.6e6, 8.64e7, 4294967296.0, 4294967.296, 4294.967296, 65.536};
  const double usual = usual_step(t);
  const auto [low, high] = std::minmax_element(t.begin(), t.end());
  for (const double period : kPeriods) {
    // It must fill its period, and every jump back must be one usual step over it.
    bool fits = usual > 0 && *low >= 0 && *high < period && *high - *low > 0.9 * period;
    for (std::size_t k = 1; fits && k < t.size(); ++k)
      if (t[k] < t[k - 1]) fits = std::abs(t[k] + period - t[k - 1] - usual) <= 0.5 * usual;
    if (!fits) continue;

    double turns = 0, before = t[0];
    for (double& stamp : t) {
      const double raw = stamp;
      if (raw < before) turns += period;
      before = raw;
      stamp += turns;
    }
    table.notes.push_back("the time counter starts again after " + format_number(period, 12) +
                          ": it is counted on");
    return;
  }
}

/// The runs between gaps.
std::vector<Rows> runs_of(const std::vector<double>& t) {
  // Where no step is far above another there is no gap to look for.
  double least = t[1] - t[0], most = least;
  for (std::size_t k = 1; k + 1 < t.size(); ++k) {
    least = std::min(least, t[k + 1] - t[k]);
    most = std::max(most, t[k + 1] - t[k]);
  }
  if (!(least > 0) || most <= kGap * least) return {{0, t.size()}};

  const double gap = kGap * usual_step(t);
  std::vector<Rows> runs;
  std::size_t first = 0;
  for (std::size_t k = 1; k < t.size(); ++k)
    if (t[k] - t[k - 1] > gap) runs.emplace_back(first, k), first = k;
  runs.emplace_back(first, t.size());
  return runs;
}

}  // namespace

std::vector<RawTable> usable_stretches(RawTable table, const FileStatement& statement,
                                       const std::string& stated_in) {
  std::vector<RawTable> out;

  // What is no recording of a damper is left to whoever refuses it.
  const ColumnUses uses = understand_columns(table, statement, stated_in);
  const auto used = [&](std::string_view channel) {
    return std::find_if(uses.used.begin(), uses.used.end(),
                        [&](const ColumnUse& use) { return use.channel == channel; });
  };
  const auto none = uses.used.end();
  if (used("force") != none && (used("displacement") != none || used("velocity") != none))
    table = without_bad_rows(std::move(table), uses, statement.drop_bad_rows);

  // Without stamps there are no gaps to see; stamps that are no numbers are refused later.
  const auto time = used("time");
  const bool stamped = time != none && !statement.sample_time && table.rows() > kFewestSamples &&
                       !table.columns[time->column].bad;
  if (stamped) {
    unwrap(table, time->column);
    table = without_repeated_stamps(std::move(table), time->column);
  }
  const std::vector<Rows> runs =
      stamped ? runs_of(table.columns[time->column].values) : std::vector<Rows>{{0, table.rows()}};
  if (runs.size() == 1) {
    out.push_back(std::move(table));
    return out;
  }

  // Each run by itself, as far as the stated cut leaves enough of it.
  const std::vector<double>& t = table.columns[time->column].values;
  const auto seconds = [&](std::size_t row) { return time->factor * (t[row] - time->raw_offset); };
  std::size_t short_rows = 0;
  double widest = 0;
  for (std::size_t k = 1; k < runs.size(); ++k)
    widest = std::max(widest, seconds(runs[k].first) - seconds(runs[k].first - 1));
  for (const auto& [first, last] : runs) {
    std::size_t inside = 0;
    for (std::size_t row = first; row < last; ++row)
      inside += seconds(row) >= statement.cut_from.value_or(seconds(row)) &&
                seconds(row) <= statement.cut_to.value_or(seconds(row));
    if (inside == 0) continue;
    if (inside < kFewestSamples) {
      short_rows += last - first;
      continue;
    }
    out.push_back(rows_of(table, {{first, last}}));
  }

  if (out.empty())
    throw Error(table.file,
                "its time stamps have gaps of more than 5 median steps, and no stretch "
                "between them has 20 samples",
                "state the 'sample_rate' in a dataset file where the stamps are wrong");
  const std::string note =
      "time has " + std::to_string(runs.size() - 1) + (runs.size() == 2 ? " gap" : " gaps") +
      " of more than 5 median steps, up to " + format_number(widest, 3) +
      " s: split there, nothing is bridged" +
      (short_rows > 0
           ? "; " + std::to_string(short_rows) + " samples in stretches of fewer than 20 left out"
           : "");
  for (RawTable& stretch : out) stretch.notes.push_back(note);
  return out;
}

}  // namespace dashpot
