#include <algorithm>
#include <cmath>
#include <numeric>

#include "dashpot/base/parallel.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/passive_hybrid/passive_hybrid_model.h"
#include "dashpot/damper/kinds/passive_hybrid/presets.h"
#include "dashpot/identify/fit/fit.h"
#include "dashpot/identify/fit/passive_network_fit.h"

namespace dashpot {
namespace {

/// The options for the law inside: what is chosen for the hybrid's parameters holds for it.
IdentifyOptions options_for_law(IdentifyOptions options, const PassiveHybridPreset& preset) {
  std::erase_if(options.choices,
                [&](const auto& choice) { return choice.law == preset.law->name; });
  for (auto& choice : options.choices)
    if (choice.law == preset.name) choice.law = preset.law->name;
  return options;
}

/// Sums of squared errors and of their products, N^2, over records that neither has seen.
struct ErrorProducts {
  double law = 0, network = 0, both = 0;
};

ErrorProducts error_products(const DamperModel& law, const DamperModel& network,
                             const std::vector<Record>& records, DriveUnit drive_unit,
                             OffsetMode offset) {
  ErrorProducts products;
  for (const Record& record : records) {
    // What each leaves of the measured force in free run, with an offset of its own.
    const std::vector<DamperInput> inputs = damper_inputs(record, drive_unit);
    const auto errors_of = [&](const DamperModel& model) {
      std::vector<double> errors = free_run(model, inputs, record.time).force;
      const std::vector<double>& measured = record.channel("force").samples;
      for (std::size_t k = 0; k < errors.size(); ++k) errors[k] -= measured[k];
      errors.erase(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(record.warm_up));
      const double mean =
          std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
      if (offset == OffsetMode::Record)
        for (double& error : errors) error -= mean;
      return errors;
    };
    const std::vector<double> of_law = errors_of(law), of_network = errors_of(network);

    const auto product = [](const std::vector<double>& a, const std::vector<double>& b) {
      return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
    };
    products.law += product(of_law, of_law);
    products.network += product(of_network, of_network);
    products.both += product(of_law, of_network);
  }
  return products;
}

/// One law and network on one set of records.
class PassiveHybridFit {
 public:
  PassiveHybridFit(const PassiveHybridPreset& preset, const std::vector<Record>& training,
                   DriveUnit drive_unit, const IdentifyOptions& options)
      : preset_(preset),
        training_(training),
        drive_unit_(drive_unit),
        options_(options),
        law_options_(options_for_law(options, preset)) {}

  FitReport law(const std::vector<Record>& records) const {
    return fit_law(*preset_.law, records, drive_unit_, law_options_);
  }
  PassiveNetworkTraining network() const {
    return train_passive_network(*preset_.network, training_, drive_unit_, options_);
  }

  /// The network's share that leaves least, over the trials, of what was held back: in each as a
  /// multiple of what the better of the two leaves alone, so that one wild extrapolation does not
  /// decide alone.
  double best_share(PassiveEffort effort) const {
    const std::vector<PassiveTrial> trials =
        passive_trials(training_, drive_range(training_, drive_unit_)).folds;
    std::vector<ErrorProducts> products(trials.size());
    parallel_for(trials.size(), options_.threads,
                 [&](std::size_t k) { products[k] = tried(trials[k].fold, effort); });

    // The error (1 - b) e_law + b e_network is least where its square has no slope by b. A trial in
    // which one of them diverges says nothing.
    double lean = 0, apart = 0;
    for (std::size_t k = 0; k < trials.size(); ++k) {
      const ErrorProducts& e = products[k];
      const double scale = trials[k].weight / std::min(e.law, e.network);
      if (!std::isfinite(scale * (e.law + e.network))) continue;
      lean += scale * (e.law - e.both);
      apart += scale * (e.law - 2 * e.both + e.network);
    }
    return apart > 0 ? std::clamp(lean / apart, 0.0, 1.0) : 0;
  }

 private:
  /// Both fitted without what a fold holds back, and judged on that.
  ErrorProducts tried(const Fold& fold, PassiveEffort effort) const {
    const FitReport of_law = law(fold.training);
    if (!of_law.model) return {};
    IdentifyOptions options = options_;
    options.network = trial_design(options_.network);
    const FitReport of_network = train_passive_network(*preset_.network, fold.training, drive_unit_,
                                                       options, trial_effort(effort))
                                     .report;
    return error_products(*of_law.model, *of_network.model, fold.left_out, drive_unit_,
                          options_.offset);
  }

  const PassiveHybridPreset& preset_;
  const std::vector<Record>& training_;
  DriveUnit drive_unit_;
  const IdentifyOptions& options_;
  const IdentifyOptions law_options_;
};

}  // namespace

FitReport fit_passive_hybrid(const PassiveHybridPreset& preset, const std::vector<Record>& training,
                             DriveUnit drive_unit, const IdentifyOptions& options) {
  // The law, whose fit the report tells of.
  const PassiveHybridFit fit(preset, training, drive_unit, options);
  FitReport report = fit.law(training);
  if (report.status == FitReport::Status::Failed) return report;

  // The network and its share.
  const PassiveNetworkTraining network = fit.network();
  const double share = fit.best_share(network.effort);
  report.model = std::make_shared<PassiveHybridModel>(
      dynamic_cast<const LawModel&>(*report.model),
      dynamic_cast<const PassiveNetworkModel&>(*network.report.model), share);
  report.iterations += network.report.iterations;
  report.training_rmse = evaluate(*report.model, training, drive_unit,
                                  {.offset = options.offset, .threads = options.threads})
                             .pooled.rmse;
  report.covariance.clear();
  report.warnings.insert(report.warnings.begin(),
                         "the network beside the law has a share of " + format_number(share, 2) +
                             " in the force: the law's parameters are those of its own fit");
  return report;
}

}  // namespace dashpot
