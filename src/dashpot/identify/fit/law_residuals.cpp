#include "dashpot/identify/fit/law_residuals.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "dashpot/base/parallel.h"

namespace dashpot {
namespace {

/// Keeps every `stride`-th sample from `first` on, and what comes before.
template <class T>
void thin(std::vector<T>& samples, std::size_t first, std::size_t stride) {
  std::size_t kept = first;
  for (std::size_t k = first; k < samples.size(); k += stride) samples[kept++] = samples[k];
  samples.resize(kept);
}

}  // namespace

LawResiduals::LawResiduals(const LawUnknowns& unknowns, const std::vector<Record>& records,
                           DriveUnit drive_unit, OffsetMode offset, const Thinning& thinning)
    : unknowns_(&unknowns),
      offset_(offset),
      constant_drive_(!unknowns.fits_lag() && !unknowns.slows_filter()) {
  constexpr std::size_t kFewest = 200;
  for (const Record& record : records) {
    Run run{damper_inputs(record, drive_unit), record.time, record.channel("force").samples,
            record.warm_up};

    // Cut the run to the share that is wanted, then thin what is scored of it.
    const auto wanted =
        static_cast<std::size_t>(thinning.share * static_cast<double>(run.time.size()));
    const std::size_t length = std::min(run.time.size(), std::max(wanted, run.warm_up + kFewest));
    run.inputs.resize(length);
    run.time.resize(length);
    run.force.resize(length);
    thin(run.inputs, run.warm_up, thinning.stride);
    thin(run.time, run.warm_up, thinning.stride);
    thin(run.force, run.warm_up, thinning.stride);

    // Constant drives in all runs allow one difference per parameter.
    constant_drive_ &= std::ranges::all_of(run.inputs, [&](const DamperInput& input) {
      return input.current == run.inputs.front().current;
    });

    // Its residuals follow those of the runs before.
    segments_.emplace_back(size_, run.force.size() - run.warm_up);
    size_ += segments_.back().second;
    runs_.push_back(std::move(run));
  }
}

bool LawResiduals::simulate(const LawModel& model, std::span<double> residuals) const {
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const Run& run = runs_[r];
    const auto [first, length] = segments_[r];
    const std::span<double> out = residuals.subspan(first, length);
    const FreeRun simulated = free_run(model, run.inputs, run.time);
    if (simulated.diverged_at) return false;
    for (std::size_t k = 0; k < length; ++k)
      out[k] = run.force[run.warm_up + k] - simulated.force[run.warm_up + k];
    if (offset_ == OffsetMode::None) continue;
    const double mean = std::accumulate(out.begin(), out.end(), 0.0) / static_cast<double>(length);
    for (double& value : out) value -= mean;
  }
  return true;
}

bool LawResiduals::evaluate(std::span<const double> unknowns, std::span<double> residuals) const {
  return simulate(unknowns_->model(unknowns), residuals);
}

/// Where the current is constant in each record, a parameter is one number there, however many
/// unknowns describe how it follows the current: one run per parameter gives all their columns.
bool LawResiduals::jacobian(std::span<const double> unknowns, std::span<double> residuals,
                            std::span<double* const> columns, int threads) const {
  if (!evaluate(unknowns, residuals)) return false;
  std::vector<LawUnknowns::Group> groups = unknowns_->groups();
  std::erase_if(groups, [&](const LawUnknowns::Group& group) {
    return std::all_of(&columns[group.first], &columns[group.first] + group.count,
                       [](const double* column) { return column == nullptr; });
  });
  std::atomic<bool> complete = true;
  parallel_for(groups.size(), threads, [&](std::size_t g) {
    if (!differences(unknowns, groups[g], residuals, columns)) complete = false;
  });
  return complete;
}

/// The columns of one parameter's unknowns.
bool LawResiduals::differences(std::span<const double> unknowns, const LawUnknowns::Group& group,
                               std::span<const double> residuals,
                               std::span<double* const> columns) const {
  std::vector<double> slope(size_);

  // One run with the parameter moved; where it diverges, a step to the other side.
  double step = unknowns_->step(unknowns, group);
  if (!simulate(unknowns_->moved(unknowns, group, step), slope)) {
    step = -step;
    if (!simulate(unknowns_->moved(unknowns, group, step), slope)) return false;
  }
  for (std::size_t k = 0; k < size_; ++k) slope[k] = (slope[k] - residuals[k]) / step;

  // By the chain rule: each unknown moves the parameter by its share at the record's current.
  for (std::size_t u = 0; u < group.count; ++u) {
    double* const column = columns[group.first + u];
    if (!column) continue;
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      const double share = unknowns_->slope(unknowns, group, u, runs_[r].inputs.front().current);
      const auto [first, length] = segments_[r];
      for (std::size_t k = first; k < first + length; ++k) column[k] = share * slope[k];
    }
  }
  return true;
}

LeastSquaresProblem LawResiduals::problem(double noise, int threads) const {
  const std::vector<LawUnknowns::PriorTerm> priors =
      noise > 0 ? unknowns_->priors() : std::vector<LawUnknowns::PriorTerm>{};

  // A part of residuals per record, and one for the priors, so that each has its own variance.
  LeastSquaresProblem problem;
  problem.residuals = size_ + priors.size();
  problem.parts.clear();
  for (const auto& [first, length] : segments_) problem.parts.push_back(first);
  if (!priors.empty()) problem.parts.push_back(size_);
  problem.lower = unknowns_->lower();
  problem.upper = unknowns_->upper();

  // The residuals at given unknowns, each prior with one of its own.
  const auto add_priors = [this, noise, priors](std::span<const double> x, std::span<double> r) {
    for (std::size_t k = 0; k < priors.size(); ++k)
      r[size_ + k] = priors[k].residual(x[priors[k].unknown], noise);
  };
  problem.residual = [this, add_priors](std::span<const double> x, std::span<double> r) {
    add_priors(x, r);
    return evaluate(x, r.first(size_));
  };

  // Without constant drives the solver takes its own differences, an unknown at a time.
  if (!constant_drive_) return problem;
  problem.jacobian = [this, add_priors, noise, priors, threads](std::span<const double> x,
                                                                std::span<double> r,
                                                                std::span<double* const> columns) {
    add_priors(x, r);
    for (std::size_t k = 0; k < priors.size(); ++k)
      for (std::size_t u = 0; u < x.size(); ++u)
        if (columns[u]) columns[u][size_ + k] = u == priors[k].unknown ? priors[k].slope(noise) : 0;
    return jacobian(x, r.first(size_), columns, threads);
  };
  return problem;
}

}  // namespace dashpot
