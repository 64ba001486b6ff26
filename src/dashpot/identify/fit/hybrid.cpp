#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "dashpot/base/parallel.h"
#include "dashpot/damper/kinds/hybrid/presets.h"
#include "dashpot/identify/fit/fit.h"
#include "dashpot/identify/fit/hybrid_residuals.h"
#include "dashpot/identify/fit/law_solution.h"
#include "dashpot/identify/fit/starting_bank.h"
#include "dashpot/record/trial_parts.h"

namespace dashpot {
namespace {

constexpr std::size_t kHybridSamples = 8000;       // of a fit, every k-th; the states see all
constexpr std::size_t kHybridTrialSamples = 2500;  // of a trial of a weight decay
constexpr int kHybridIterations = 60, kHybridTrialIterations = 30;
constexpr double kHybridTolerance = 1e-4;
constexpr std::array kHybridDecays{1e-1, 1e-2, 1e-3,
                                   1e-4};  // in the mean square of what the law leaves

constexpr std::size_t kFewestLevels = 4;  // that tell more than a line, one of them left out

double mean_square(std::span<const double> errors) {
  return std::inner_product(errors.begin(), errors.end(), errors.begin(), 0.0) /
         static_cast<double>(errors.size());
}

HybridData data_of(const LawSolution& law, const HybridPreset& preset,
                   const std::vector<Record>& training, DriveUnit drive_unit, OffsetMode offset) {
  HybridData data{law.unknowns, {}, {}, offset};
  std::vector<const FreeRunRecord*> records;
  for (const Record& record : training)
    data.records.push_back({damper_inputs(record, drive_unit), record.time,
                            record.channel("force").samples, record.warm_up});
  for (const FreeRunRecord& record : data.records) records.push_back(&record);
  // With a constant drive a campaign is a few motions that repeat, and a bank would learn these
  // apart.
  if (drive_range(training, drive_unit).varies)
    data.bank = starting_bank({preset.path_states, preset.velocity_lags, preset.current_lags},
                              records, true);
  return data;
}

/// One law with its network on one set of records.
class HybridFit {
 public:
  HybridFit(const HybridPreset& preset, const std::vector<Record>& training, DriveUnit drive_unit,
            const IdentifyOptions& options, const LawSolution& law)
      : options_(options),
        law_(law),
        data_(data_of(law, preset, training, drive_unit, options.offset)),
        all_(all_parts(training)) {
    // The mixing comes from the signals of the law as its own fit left it.
    const SignalRows rows = residuals(all_, kHybridSamples).signals(law_.solved.x);
    mixing_ = mixing_of(rows);

    // The network at its start: motions mixed to deviation 1, currents over the range of the drive.
    const DriveRange drive = drive_range(training, drive_unit);
    const double half = (drive.high - drive.low) / 2;
    network_.currents = rows.currents;
    network_.signals.resize(rows.motions());
    network_.signals.resize(rows.width, {.mean = drive.low + half, .scale = half > 0 ? half : 1});
    network_.output_scale = law_.noise.rms;
    network_.initialise(preset.hidden, options_.seed);

    // Few levels leave the current out; the weight decay is then found by trials.
    if (!drive.varies && drive.levels < kFewestLevels) fix_current();
    decay_ = best_decay(trial_parts(training));
  }

  /// The law's unknowns, from where its own fit left them, and the weights, together.
  LeastSquaresReport solve_jointly() const {
    const HybridResiduals residuals = this->residuals(all_, kHybridSamples);
    std::vector<double> start = law_.solved.x;
    const std::vector<double> weights = starting_weights();
    start.insert(start.end(), weights.begin(), weights.end());
    return solve(residuals.problem(with_decay(decay_, residuals), law_.solved.x,
                                   law_.noise.independent, options_.threads),
                 std::move(start), solver(kHybridIterations));
  }

  HybridModel model(std::span<const double> x) const {
    const std::size_t own = law_.unknowns.size();
    GatedNetwork network = with_weights(network_, x.subspan(own));
    find_ranges(network,
                residuals(all_, std::numeric_limits<std::size_t>::max()).signals(x.first(own)));
    return {{law_.unknowns.model(x.first(own)), data_.bank}, mixing_, std::move(network)};
  }

  double training_rmse(std::span<const double> x) const {
    const HybridResiduals residuals = this->residuals(all_, kHybridSamples);
    return std::sqrt(squared_error(residuals, residuals.signals(x.first(law_.unknowns.size())),
                                   x.subspan(law_.unknowns.size())));
  }

 private:
  /// Few levels of the drive leave open what lies between them: the network follows it, then,
  /// through the law's force and states alone.
  void fix_current() {
    fixed_.assign(network_.parameter_count(), false);
    const std::size_t stride = network_.neuron_stride(), count = network_.gate_count();
    for (std::size_t w = network_.motions(); w < network_.neurons.size(); w += stride) {
      fixed_[w] = true;
      network_.neurons[w] = 0;
    }
    for (std::size_t g = 0; g < network_.gates.size(); ++g)
      fixed_[network_.neurons.size() + g] = g % count != 0;
  }

  HybridResiduals residuals(const ScoredParts& parts, std::size_t most_samples) const {
    std::size_t samples = 0;
    for (const ScoredPart& part : parts) samples += part.last - part.first;
    return {data_, parts, 1 + (samples - 1) / most_samples};
  }

  std::vector<double> starting_weights() const {
    std::vector<double> weights = network_.neurons;
    weights.insert(weights.end(), network_.gates.begin(), network_.gates.end());
    return weights;
  }

  HybridResiduals::Network with_decay(double decay, const HybridResiduals& residuals) const {
    const double scale = network_.output_scale;
    return {mixing_, network_, decay * static_cast<double>(residuals.size()) * scale * scale,
            fixed_};
  }

  LeastSquaresOptions solver(int iterations) const {
    LeastSquaresOptions solver = solver_options(options_, iterations, kHybridTolerance);
    solver.normal_equations = true;
    return solver;
  }

  double squared_error(const HybridResiduals& residuals, const SignalRows& rows,
                       std::span<const double> weights) const {
    std::vector<double> errors(residuals.size());
    residuals.evaluate(with_decay(0, residuals), rows, weights, errors);
    return mean_square(errors);
  }

  /// The weight decay with which trials predict best what was held back from them. The law stays
  /// where its fit on all records left it, for the decay concerns the network alone.
  double best_decay(const std::vector<TrialParts>& trials) const {
    std::vector<double> errors(kHybridDecays.size() * trials.size());
    parallel_for(errors.size(), options_.threads, [&](std::size_t k) {
      // Train the weights with this decay on the trial's training part.
      const TrialParts& trial = trials[k / kHybridDecays.size()];
      const HybridResiduals seen = residuals(trial.training, kHybridTrialSamples);
      const SignalRows rows = seen.signals(law_.solved.x);
      const LeastSquaresProblem problem =
          seen.problem(with_decay(kHybridDecays[k % kHybridDecays.size()], seen), rows);
      const std::vector<double> weights =
          solve(problem, starting_weights(), solver(kHybridTrialIterations)).x;

      // Its error on the part held back, as a share of the untrained network's.
      const HybridResiduals unseen = residuals(trial.held_back, kHybridTrialSamples);
      const SignalRows held_back = unseen.signals(law_.solved.x);
      errors[k] = squared_error(unseen, held_back, weights) /
                  squared_error(unseen, held_back, starting_weights());
    });

    // The decay with the least errors over all trials.
    std::array<double, kHybridDecays.size()> sums{};
    for (std::size_t k = 0; k < errors.size(); ++k) sums[k % kHybridDecays.size()] += errors[k];
    return kHybridDecays[static_cast<std::size_t>(std::min_element(sums.begin(), sums.end()) -
                                                  sums.begin())];
  }

  void find_ranges(GatedNetwork& network, const SignalRows& rows) const {
    for (GatedNetwork::Signal& s : network.signals) {
      s.low = std::numeric_limits<double>::infinity();
      s.high = -s.low;
    }
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const SignalPoint point = standardised(mixing_, network, rows.row(k));
      for (std::size_t i = 0; i < rows.width; ++i) {
        network.signals[i].low = std::min(network.signals[i].low, point[i]);
        network.signals[i].high = std::max(network.signals[i].high, point[i]);
      }
    }
  }

  const IdentifyOptions& options_;
  const LawSolution& law_;
  HybridData data_;
  ScoredParts all_;
  SignalMixing mixing_;
  GatedNetwork network_;  ///< at its start
  std::vector<bool> fixed_;
  double decay_ = 0;
};

/// The law's parameters without intervals: the network can make up for any of them.
std::vector<FittedParameter> parameters_of(const LawUnknowns& unknowns, std::span<const double> x) {
  std::vector<FittedParameter> parameters;
  for (const LawUnknowns::Coefficient& c : unknowns.coefficients(x)) {
    FittedParameter p{.name = c.name, .unit = c.unit, .meaning = c.meaning, .value = c.value};
    p.fixed = c.weights.empty();
    p.low = p.high = p.fixed ? p.value : std::numeric_limits<double>::quiet_NaN();
    p.at_bound = c.at_bound;
    parameters.push_back(std::move(p));
  }
  return parameters;
}

}  // namespace

FitReport fit_hybrid(const HybridPreset& preset, const std::vector<Record>& training,
                     DriveUnit drive_unit, const IdentifyOptions& options) {
  const LawSolution law = solve_law(*preset.law, training, drive_unit, options, preset.name);
  FitReport report;
  report.status = status_of(law.solved);
  report.message = law.solved.message;
  if (report.status == FitReport::Status::Failed) return report;

  const HybridFit fit(preset, training, drive_unit, options, law);
  const LeastSquaresReport solved = fit.solve_jointly();
  report.status = status_of(solved);
  report.message = solved.message;
  report.iterations = law.solved.iterations + solved.iterations;
  if (report.status == FitReport::Status::Failed) return report;
  const std::span<const double> x(solved.x);
  report.model = std::make_shared<HybridModel>(fit.model(x));
  report.training_rmse = fit.training_rmse(x);
  report.parameters = parameters_of(law.unknowns, x.first(law.unknowns.size()));
  report.warnings = law.unknowns.warnings();
  report.warnings.insert(
      report.warnings.begin(),
      "the parameters of the law share their work with the network: they have no intervals, and "
      "are not properties of the damper");
  return report;
}

}  // namespace dashpot
