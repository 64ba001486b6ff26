#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/base/parallel.h"
#include "dashpot/damper/kinds/hysteresis_network/presets.h"
#include "dashpot/damper/kinds/hysteresis_network/train_hysteresis_network.h"
#include "dashpot/error.h"
#include "dashpot/identify/fit/dissipating.h"
#include "dashpot/identify/fit/fit.h"
#include "dashpot/identify/fit/free_run_records.h"
#include "dashpot/identify/fit/starting_bank.h"
#include "dashpot/identify/fit/trials.h"

namespace dashpot {
namespace {

constexpr std::size_t kBankSamples = 8000;       // of a fit, every k-th; the states see all
constexpr std::size_t kBankTrialSamples = 2500;  // of a trial of a decay
constexpr int kBankIterations = 60,
              kBankTrialIterations = 25;  // stopping early, too, keeps weights small
constexpr int kBankPaidIterations = 20;   // of a training that pays for energy fed in
constexpr std::array kBankDecays{1e-3, 1e-4, 1e-5};

using Records = std::vector<const FreeRunRecord*>;

/// Mean square of each of the bank's signals over all records.
std::vector<double> mean_squares(const HysteresisBank& bank, const Records& records) {
  std::vector<double> squares(bank.signal_count()), signals(bank.signal_count()),
      state(bank.size());

  // Run the bank from rest through each record and add up the squares.
  double samples = 0;
  for (const FreeRunRecord* record : records) {
    bank.rest(record->inputs.front(), state);
    for (std::size_t k = 0; k < record->inputs.size(); ++k) {
      if (k > 0)
        bank.advance(record->inputs[k - 1], record->inputs[k],
                     record->time[k] - record->time[k - 1], state);
      bank.read(record->inputs[k], state, signals.data());
      for (std::size_t i = 0; i < signals.size(); ++i) squares[i] += signals[i] * signals[i];
    }
    samples += static_cast<double>(record->inputs.size());
  }

  for (double& square : squares) square /= samples;
  return squares;
}

GatedNetwork standardised(const HysteresisBank& bank, const Records& records,
                          const DriveRange& drive) {
  const std::vector<double> squares = mean_squares(bank, records);
  GatedNetwork network;
  network.currents = bank.current_rates.size();
  for (std::size_t k = 0; k + network.currents < squares.size(); ++k) {
    const bool is_dahl = k >= 1 && k <= bank.path_rates.size();  // -1 ... 1 as it is
    network.signals.push_back({.scale = is_dahl || squares[k] == 0 ? 1 : std::sqrt(squares[k])});
  }
  const double half = (drive.high - drive.low) / 2;
  network.signals.resize(squares.size(), {.mean = drive.low + half, .scale = half > 0 ? half : 1});
  network.output_scale = force_deviation(records);
  return network;
}

std::size_t hidden_of(const HysteresisNetworkPreset& preset, const NetworkDesign& design) {
  if (design.hidden.size() > 1)
    throw Error("--network hidden", std::string(preset.name) + " has one hidden layer",
                "give one number, as hidden=8");
  return design.hidden.empty() ? preset.hidden : design.hidden.front();
}

/// One preset on one set of records.
class HysteresisNetworkFit {
 public:
  HysteresisNetworkFit(const HysteresisNetworkPreset& preset, const std::vector<Record>& training,
                       DriveUnit drive_unit, const IdentifyOptions& options)
      : options_(options),
        hidden_(hidden_of(preset, options.network)),
        members_(options.network.members.value_or(preset.members)),
        iterations_(static_cast<int>(options.network.epochs.value_or(kBankIterations))),
        records_(free_run_records(training, drive_unit)) {
    for (const FreeRunRecord& record : records_) all_.push_back(&record);
    const DriveRange drive = drive_range(training, drive_unit);
    start_.bank = starting_bank({preset.path_states, preset.velocity_lags, preset.current_lags},
                                all_, drive.varies);
    start_.network = standardised(start_.bank, all_, drive);
    decay_ = options.network.l2 ? *options.network.l2 : best_decay(Trials(training, drive_unit));
  }

  struct Member {
    HysteresisNetwork network;
    FreeRunTrainReport report;
  };

  /// Members differ in their random start alone.
  std::vector<Member> members() const {
    std::vector<Member> members(members_);
    parallel_for(members.size(), options_.threads, [&](std::size_t k) {
      members[k] = fit(all_, kBankSamples, {decay_, iterations_, k, k == 0});
    });
    return members;
  }

  /// Trains a member on while it pays for energy that it feeds in.
  void train_on(Member& member, const ActivityPenalty& penalty) const {
    HysteresisNetworkTrainOptions options =
        train_options(all_, kBankSamples, {decay_, std::min(kBankPaidIterations, iterations_)});
    options.rate_decay = kPaidRateDecay;
    options.penalty = &penalty;
    member.report = train(member.network, all_, options);
  }

 private:
  /// The weight decay with which trials predict best what was held back from them.
  double best_decay(const Trials& trials) const {
    return trials.best_decay(
        kBankDecays, options_.threads, [this](const FreeRunTrial& trial, double decay) {
          const Effort effort{decay, std::min(kBankTrialIterations, iterations_)};
          const HysteresisNetwork found = fit(trial.training, kBankTrialSamples, effort).network;
          double squares = 0;
          for (const FreeRunRecord* record : trial.held_back)
            squares += squares_left(found, *record, options_.offset == OffsetMode::Record);
          return squares;
        });
  }

  struct Effort {
    double decay;
    int iterations;
    std::uint64_t start = 0;
    bool is_watched = false;  ///< how its error falls is reported; of several at once only one is
  };
  HysteresisNetworkTrainOptions train_options(const Records& records, std::size_t most_samples,
                                              Effort effort) const {
    return {.max_iterations = effort.iterations,
            .weight_decay = effort.decay,
            .offsets = options_.offset == OffsetMode::Record,
            .stride = (scored_samples(records) + most_samples - 1) / most_samples,
            .on_iteration = [this, effort](double cost) {
              effort.is_watched ? options_.monitor.report_cost(cost) : options_.monitor.check();
            }};
  }

  Member fit(const Records& records, std::size_t most_samples, Effort effort) const {
    Member member{start_, {}};
    member.network.network.initialise(hidden_, options_.seed + effort.start);
    member.report = train(member.network, records, train_options(records, most_samples, effort));
    return member;
  }

  const IdentifyOptions& options_;
  std::size_t hidden_, members_;
  int iterations_;
  std::vector<FreeRunRecord> records_;
  Records all_;
  HysteresisNetwork start_;
  double decay_ = 0;
};

}  // namespace

FitReport fit_hysteresis_network(const HysteresisNetworkPreset& preset,
                                 const std::vector<Record>& training, DriveUnit drive_unit,
                                 const IdentifyOptions& options) {
  using Member = HysteresisNetworkFit::Member;
  const HysteresisNetworkFit fit(preset, training, drive_unit, options);
  return report_of_dissipating(
      fit.members(), training, drive_unit, options,
      [&](const std::vector<Member>& members) {
        std::vector<HysteresisNetwork> networks;
        for (const Member& member : members) networks.push_back(member.network);
        return std::make_shared<HysteresisNetworkModel>(std::string(preset.name),
                                                        std::move(networks));
      },
      [&](Member& member, const ActivityPenalty& penalty) { fit.train_on(member, penalty); });
}

}  // namespace dashpot
