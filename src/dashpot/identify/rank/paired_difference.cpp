#include "dashpot/identify/rank/paired_difference.h"

#include <cassert>
#include <cmath>

#include "dashpot/identify/judge/left_out_parts.h"
#include "dashpot/numerics/distributions.h"

namespace dashpot {
namespace {

std::vector<ErrorSums> by_unit(std::span<const Evaluation> folds) {
  std::vector<ErrorSums> sums;
  if (folds.size() > 1) {
    for (const Evaluation& fold : folds) {
      sums.emplace_back();
      for (const RecordResult& record : fold.records) sums.back().add(record.sums);
    }
    return sums;
  }

  for (const LeftOutPart& part : left_out_parts(folds.front().records)) {
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

std::optional<PairedDifference> paired_difference(std::span<const double> esr_parts,
                                                  std::span<const double> leader_parts) {
  assert(esr_parts.size() == leader_parts.size());
  const std::size_t units = esr_parts.size();
  if (units < 2) return std::nullopt;
  const auto n = static_cast<double>(units);

  // The sum of the differences, and their spread.
  PairedDifference difference{.units = units};
  for (std::size_t k = 0; k < units; ++k) difference.esr += esr_parts[k] - leader_parts[k];
  double squares = 0;
  for (std::size_t k = 0; k < units; ++k)
    squares += std::pow(esr_parts[k] - leader_parts[k] - difference.esr / n, 2);

  // The interval of a sum of n such differences.
  const double quantile = students_t_quantile(n - 1, (1 + kPairedLevel) / 2);
  const double half = quantile * std::sqrt(n * squares / (n - 1));
  difference.low = difference.esr - half;
  difference.high = difference.esr + half;
  return difference;
}

}  // namespace dashpot
