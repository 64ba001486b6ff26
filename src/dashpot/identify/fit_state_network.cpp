#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include "dashpot/base/parallel.h"
#include "dashpot/damper/neural/train_bank.h"
#include "dashpot/identify/fit.h"
#include "dashpot/identify/stroke.h"

namespace dashpot {
namespace {

constexpr std::size_t kSamples = 8000;                  // of a fit, every k-th; the states see all
constexpr std::size_t kTrialSamples = 2500;             // of a trial of a decay
constexpr int kIterations = 60, kTrialIterations = 25;  // stopping early, too, keeps weights small
constexpr std::array kDecays{1e-3, 1e-4, 1e-5};
constexpr std::size_t kConditionTrials = 4;  // conditions are dealt to so many trials
constexpr double kHeldBackEnd = 0.3;         // of records that have neither conditions nor levels

using Records = std::vector<const BankRecord*>;

/// A part of the training records that a trial does without and is judged on.
struct Trial {
  Records training, held_back;
};

/// Mean square of each of the bank's signals over all records.
std::vector<double> mean_squares(const HysteresisBank& bank, const Records& records) {
  std::vector<double> squares(bank.signal_count()), signals(bank.signal_count()), state(bank.size());
  double samples = 0;
  for (const BankRecord* record : records) {
    bank.rest(record->inputs.front(), state);
    for (std::size_t k = 0; k < record->inputs.size(); ++k) {
      if (k > 0)
        bank.advance(record->inputs[k - 1], record->inputs[k], record->time[k] - record->time[k - 1], state);
      bank.read(record->inputs[k], state, signals.data());
      for (std::size_t i = 0; i < signals.size(); ++i) squares[i] += signals[i] * signals[i];
    }
    samples += static_cast<double>(record->inputs.size());
  }
  for (double& square : squares) square /= samples;
  return squares;
}

/// Of the scored force, each record's mean taken out.
double force_deviation(const Records& records) {
  double squares = 0, samples = 0;
  for (const BankRecord* record : records) {
    const auto first = record->force.begin() + static_cast<std::ptrdiff_t>(record->first);
    const double n = static_cast<double>(record->force.end() - first);
    const double sum = std::accumulate(first, record->force.end(), 0.0);
    squares += std::inner_product(first, record->force.end(), first, 0.0) - sum * sum / n;
    samples += n;
  }
  const double deviation = std::sqrt(std::max(0.0, squares) / samples);
  return deviation > 0 ? deviation : 1;
}

HysteresisBank starting_bank(const StateNetworkPreset& preset, const Records& records, bool drive_varies) {
  constexpr double kSlowest = 2, kFastest = 30;  // Dahl rates times the longest and the shortest way
  constexpr double kLags[] = {30, 300}, kCurrentLags[] = {20, 200}, kSteady = 100;  // 1/s
  double shortest = INFINITY, longest = 0;
  for (const BankRecord* record : records) {
    const double way = mean_stroke(record->inputs, record->time).way;
    shortest = std::min(shortest, way);
    longest = std::max(longest, way);
  }
  HysteresisBank bank;
  bank.path_rates = spaced(kSlowest / longest, kFastest / shortest, preset.path_states);
  bank.velocity_rates = spaced(kLags[0], kLags[1], preset.velocity_lags);
  bank.current_rates =
      drive_varies ? spaced(kCurrentLags[0], kCurrentLags[1], preset.current_lags) : std::vector{kSteady};
  return bank;
}

GatedNetwork standardised(const HysteresisBank& bank, const Records& records, const DriveRange& drive) {
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

/// Parts that are held back: conditions, dealt out in turn, and each inner level of the drive; records that
/// have neither are cut, and their ends are held back.
class Trials {
 public:
  Trials(const std::vector<Record>& training, const std::vector<BankRecord>& records) {
    std::vector<std::string> conditions;
    std::set<double> levels;
    std::vector<std::size_t> condition_of;
    for (const Record& record : training) {
      const auto at = std::find(conditions.begin(), conditions.end(), record.condition);
      condition_of.push_back(static_cast<std::size_t>(at - conditions.begin()));
      if (at == conditions.end()) conditions.push_back(record.condition);
      if (record.drive_level) levels.insert(*record.drive_level);
    }
    const std::size_t hands = std::min(conditions.size(), kConditionTrials);
    for (std::size_t hand = 0; hands > 1 && hand < hands; ++hand)
      hold_back(records, [&](std::size_t r) { return condition_of[r] % hands == hand; });
    for (const double level : levels)
      if (level != *levels.begin() && level != *levels.rbegin())
        hold_back(records, [&](std::size_t r) { return training[r].drive_level == level; });
    if (trials_.empty()) cut(records);
  }

  const std::vector<Trial>& all() const { return trials_; }

 private:
  template <class Chosen>
  void hold_back(const std::vector<BankRecord>& records, Chosen chosen) {
    Trial trial;
    for (std::size_t r = 0; r < records.size(); ++r)
      (chosen(r) ? trial.held_back : trial.training).push_back(&records[r]);
    if (!trial.training.empty()) trials_.push_back(std::move(trial));
  }

  void cut(const std::vector<BankRecord>& records) {
    cuts_.reserve(2 * records.size());
    trials_.emplace_back();
    for (const BankRecord& record : records) {
      const auto scored = static_cast<double>(record.inputs.size() - record.first);
      const std::size_t at = record.inputs.size() - static_cast<std::size_t>(kHeldBackEnd * scored);
      BankRecord& early = cuts_.emplace_back(record);
      early.inputs.resize(at);
      BankRecord& late = cuts_.emplace_back(record);
      late.first = std::min(at, record.inputs.size() - 1);
      trials_.back().training.push_back(&early);
      trials_.back().held_back.push_back(&late);
    }
  }

  std::vector<Trial> trials_;
  std::vector<BankRecord> cuts_;
};

/// One preset on one set of records.
class BankFit {
 public:
  BankFit(const StateNetworkPreset& preset, const std::vector<Record>& training,
          const std::string& drive_unit, const IdentifyOptions& options)
      : preset_(preset), options_(options) {
    for (const Record& record : training)
      records_.push_back(
          {damper_inputs(record, drive_unit), record.time, record.channel("force").samples, record.warm_up});
    for (const BankRecord& record : records_) all_.push_back(&record);
    const DriveRange drive = drive_range(training, drive_unit);
    start_.bank = starting_bank(preset, all_, drive.varies);
    start_.network = standardised(start_.bank, all_, drive);
    const Trials trials(training, records_);
    decay_ = best_decay(trials.all());
  }

  struct Member {
    BankNetwork network;
    BankTrainReport report;
  };

  /// Members differ in their random start alone.
  std::vector<Member> members() const {
    std::vector<Member> members(preset_.members);
    parallel_for(members.size(), options_.threads,
                 [&](std::size_t k) { members[k] = fit(all_, kSamples, {decay_, kIterations, k}); });
    return members;
  }

 private:
  /// The price of weights with which trials foretell best what was held back from them.
  double best_decay(const std::vector<Trial>& trials) const {
    std::vector<double> squares(kDecays.size() * trials.size());
    parallel_for(squares.size(), options_.threads, [&](std::size_t k) {
      const Trial& trial = trials[k / kDecays.size()];
      const Effort effort{kDecays[k % kDecays.size()], kTrialIterations};
      const BankNetwork found = fit(trial.training, kTrialSamples, effort).network;
      for (const BankRecord* record : trial.held_back)
        squares[k] += squares_left(found, *record, options_.offset == OffsetMode::Record);
    });
    std::array<double, kDecays.size()> sums{};
    for (std::size_t k = 0; k < squares.size(); ++k) sums[k % kDecays.size()] += squares[k];
    return kDecays[static_cast<std::size_t>(std::min_element(sums.begin(), sums.end()) - sums.begin())];
  }

  struct Effort {
    double decay;
    int iterations;
    std::uint64_t start = 0;
  };
  Member fit(const Records& records, std::size_t most_samples, Effort effort) const {
    std::size_t samples = 0;
    for (const BankRecord* record : records) samples += record->inputs.size() - record->first;
    const BankTrainOptions options{.max_iterations = effort.iterations,
                                   .weight_decay = effort.decay,
                                   .offsets = options_.offset == OffsetMode::Record,
                                   .stride = (samples + most_samples - 1) / most_samples,
                                   .on_iteration = [this] { options_.monitor.check(); }};
    Member member{start_, {}};
    member.network.network.initialise(preset_.hidden, options_.seed + effort.start);
    member.report = train(member.network, records, options);
    return member;
  }

  const StateNetworkPreset& preset_;
  const IdentifyOptions& options_;
  std::vector<BankRecord> records_;
  Records all_;
  BankNetwork start_;
  double decay_ = 0;
};

}  // namespace

FitReport fit_state_network(const StateNetworkPreset& preset, const std::vector<Record>& training,
                            const std::string& drive_unit, const IdentifyOptions& options) {
  const BankFit search(preset, training, drive_unit, options);
  FitReport report;
  std::vector<BankNetwork> networks;
  bool converged = true;
  for (const BankFit::Member& member : search.members()) {
    networks.push_back(member.network);
    converged = converged && member.report.converged;
    report.iterations = std::max(report.iterations, member.report.iterations);
    report.training_rmse += member.report.rmse / static_cast<double>(preset.members);
  }
  report.status = converged ? FitReport::Status::Converged : FitReport::Status::IterationLimit;
  report.message = converged ? "converged" : "iteration limit reached";
  report.model = std::make_shared<HysteresisNetwork>(std::string(preset.name), std::move(networks));
  return report;
}

}  // namespace dashpot
