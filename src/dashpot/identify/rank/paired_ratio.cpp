#include "dashpot/identify/rank/paired_ratio.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "dashpot/identify/judge/left_out_parts.h"
#include "dashpot/numerics/distributions.h"

namespace dashpot {
namespace {

/// %: what is less than that of the force's variation is rounding, and as good as none.
constexpr double kRounding = 1e-12;

std::vector<ErrorSums> by_unit(std::span<const Evaluation> folds) {
  std::vector<ErrorSums> sums;
  if (folds.size() >= kFewestDivisions) {
    for (const Evaluation& fold : folds) {
      sums.emplace_back();
      for (const RecordResult& record : fold.records) sums.back().add(record.sums);
    }
    return sums;
  }

  for (const Evaluation& fold : folds)
    for (const LeftOutPart& part : left_out_parts(fold.records)) {
      sums.emplace_back();
      for (std::size_t k = part.first; k < part.last; ++k)
        sums.back().add(part.record->measured[k], part.record->modelled[k]);
    }
  return sums;
}

}  // namespace

std::vector<double> esr_parts(std::span<const Evaluation> folds) {
  for (const Evaluation& fold : folds)
    if (fold.diverged > 0) return {};

  const std::vector<ErrorSums> units = by_unit(folds);
  ErrorSums all;
  for (const ErrorSums& unit : units) all.add(unit);
  std::vector<double> parts;
  for (const ErrorSums& unit : units) parts.push_back(100 * unit.squared / all.force_variation());
  return parts;
}

std::optional<PairedRatio> paired_ratio(std::span<const double> esr_parts,
                                        std::span<const double> leader_parts) {
  assert(esr_parts.size() == leader_parts.size());
  const std::size_t units = esr_parts.size();
  if (units < 2) return std::nullopt;
  const auto n = static_cast<double>(units);

  // The logarithm of each unit's ratio, and their mean.
  std::vector<double> logs;
  for (std::size_t k = 0; k < units; ++k)
    logs.push_back(
        std::log(std::max(esr_parts[k], kRounding) / std::max(leader_parts[k], kRounding)));
  const double mean = std::reduce(logs.begin(), logs.end()) / n;

  // The interval of that mean.
  double squares = 0;
  for (const double value : logs) squares += std::pow(value - mean, 2);
  const double quantile = students_t_quantile(n - 1, (1 + kPairedLevel) / 2);
  const double half = quantile * std::sqrt(squares / (n - 1) / n);
  return PairedRatio{.times = std::exp(mean),
                     .low = std::exp(mean - half),
                     .high = std::exp(mean + half),
                     .units = units};
}

}  // namespace dashpot
