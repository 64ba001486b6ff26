#include "dashpot/identify/law_residuals.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dashpot {

LawResiduals::LawResiduals(const LawUnknowns& unknowns, const std::vector<Record>& records,
                           std::string_view drive_unit, OffsetMode offset, double share)
    : unknowns_(&unknowns), offset_(offset) {
  constexpr std::size_t kFewest = 200;
  for (const Record& record : records) {
    Run run{damper_inputs(record, drive_unit), record.time, record.channel("force").samples, record.warm_up};
    const auto wanted = static_cast<std::size_t>(share * static_cast<double>(run.time.size()));
    const std::size_t length = std::min(run.time.size(), std::max(wanted, run.warm_up + kFewest));
    run.inputs.resize(length);
    run.time.resize(length);
    run.force.resize(length);
    segments_.emplace_back(size_, length - run.warm_up);
    size_ += length - run.warm_up;
    runs_.push_back(std::move(run));
  }
}

bool LawResiduals::evaluate(std::span<const double> unknowns, std::span<double> residuals) const {
  const LawModel model = unknowns_->model(unknowns);
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const Run& run = runs_[r];
    const FreeRun simulated = free_run(model, run.inputs, run.time);
    if (simulated.diverged_at) return false;
    const auto [first, length] = segments_[r];
    const std::span<double> out = residuals.subspan(first, length);
    for (std::size_t k = 0; k < length; ++k)
      out[k] = run.force[run.warm_up + k] - simulated.force[run.warm_up + k];
    if (offset_ == OffsetMode::Record) {
      const double mean = std::accumulate(out.begin(), out.end(), 0.0) / static_cast<double>(length);
      for (double& value : out) value -= mean;
    }
  }
  return true;
}

LeastSquaresProblem LawResiduals::problem() const {
  LeastSquaresProblem problem;
  problem.residuals = size_;
  problem.lower = unknowns_->lower();
  problem.upper = unknowns_->upper();
  problem.residual = [this](std::span<const double> x, std::span<double> r) { return evaluate(x, r); };
  return problem;
}

}  // namespace dashpot
