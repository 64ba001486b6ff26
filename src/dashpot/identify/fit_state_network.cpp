#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "dashpot/base/error.h"
#include "dashpot/base/parallel.h"
#include "dashpot/damper/neural/train_bank.h"
#include "dashpot/identify/fit.h"

namespace dashpot {
namespace {

constexpr std::size_t kSamples = 8000;                  // of a fit, every k-th; the states see all
constexpr std::size_t kTrialSamples = 2500;             // of a trial of a decay
constexpr int kIterations = 60, kTrialIterations = 25;  // stopping early, too, keeps weights small
constexpr std::array kDecays{1e-3, 1e-4, 1e-5};

using Records = std::vector<const BankRecord*>;

std::vector<double> spaced(double low, double high, std::size_t count) {
  std::vector<double> rates(count, std::sqrt(low * high));
  for (std::size_t k = 0; count > 1 && k < count; ++k)
    rates[k] = low * std::pow(high / low, static_cast<double>(k) / static_cast<double>(count - 1));
  return rates;
}

/// Mean way between two turns, m. A turn is a change of direction at a tenth of the record's top speed at
/// least, so that noise at rest is none.
double mean_way(const BankRecord& record) {
  double top = 0, way = 0;
  for (const DamperInput& input : record.inputs) top = std::max(top, std::abs(input.velocity));
  int turns = 0, direction = 0;
  for (std::size_t k = 1; k < record.inputs.size(); ++k) {
    const double v = record.inputs[k].velocity;
    way += std::abs(v) * (record.time[k] - record.time[k - 1]);
    const int now = v > 0 ? 1 : -1;
    if (std::abs(v) <= 0.1 * top || now == direction) continue;
    direction = now;
    ++turns;
  }
  return way / std::max(1, turns);
}

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
    const double way = mean_way(*record);
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

std::vector<BankRecord> bank_records(const std::vector<Record>& records, const std::string& drive_unit) {
  std::vector<BankRecord> out;
  for (const Record& record : records)
    out.push_back(
        {damper_inputs(record, drive_unit), record.time, record.channel("force").samples, record.warm_up});
  return out;
}

Records pointers_to(const std::vector<BankRecord>& records) {
  Records pointers;
  for (const BankRecord& record : records) pointers.push_back(&record);
  return pointers;
}

/// A part of the training records that a trial does without and is judged on.
struct Trial {
  std::vector<BankRecord> training, held_back;
};

std::vector<Trial> trials_of(const std::vector<Record>& training, const std::string& drive_unit) {
  std::vector<Trial> trials;
  for (const Fold& fold : trial_folds(training))
    trials.push_back({bank_records(fold.training, drive_unit), bank_records(fold.left_out, drive_unit)});
  return trials;
}

std::size_t hidden_of(const StateNetworkPreset& preset, const NetworkDesign& design) {
  if (design.hidden.size() > 1)
    throw Error("--network hidden", std::string(preset.name) + " has one hidden layer",
                "give one number, as hidden=8");
  return design.hidden.empty() ? preset.hidden : design.hidden.front();
}

/// One preset on one set of records.
class BankFit {
 public:
  BankFit(const StateNetworkPreset& preset, const std::vector<Record>& training,
          const std::string& drive_unit, const IdentifyOptions& options)
      : options_(options),
        hidden_(hidden_of(preset, options.network)),
        members_(options.network.members.value_or(preset.members)),
        iterations_(static_cast<int>(options.network.epochs.value_or(kIterations))),
        records_(bank_records(training, drive_unit)),
        all_(pointers_to(records_)) {
    const DriveRange drive = drive_range(training, drive_unit);
    start_.bank = starting_bank(preset, all_, drive.varies);
    start_.network = standardised(start_.bank, all_, drive);
    decay_ = options.network.l2 ? *options.network.l2 : best_decay(trials_of(training, drive_unit));
  }

  struct Member {
    BankNetwork network;
    BankTrainReport report;
  };

  /// Members differ in their random start alone.
  std::vector<Member> members() const {
    std::vector<Member> members(members_);
    parallel_for(members.size(), options_.threads,
                 [&](std::size_t k) { members[k] = fit(all_, kSamples, {decay_, iterations_, k}); });
    return members;
  }

 private:
  /// The price of weights with which trials foretell best what was held back from them.
  double best_decay(const std::vector<Trial>& trials) const {
    std::vector<double> squares(kDecays.size() * trials.size());
    parallel_for(squares.size(), options_.threads, [&](std::size_t k) {
      const Trial& trial = trials[k / kDecays.size()];
      const Effort effort{kDecays[k % kDecays.size()], std::min(kTrialIterations, iterations_)};
      const BankNetwork found = fit(pointers_to(trial.training), kTrialSamples, effort).network;
      for (const BankRecord& record : trial.held_back)
        squares[k] += squares_left(found, record, options_.offset == OffsetMode::Record);
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
    member.network.network.initialise(hidden_, options_.seed + effort.start);
    member.report = train(member.network, records, options);
    return member;
  }

  const IdentifyOptions& options_;
  std::size_t hidden_, members_;
  int iterations_;
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
  const std::vector<BankFit::Member> trained = search.members();
  const auto members = static_cast<double>(trained.size());
  for (const BankFit::Member& member : trained) {
    networks.push_back(member.network);
    converged = converged && member.report.converged;
    report.iterations = std::max(report.iterations, member.report.iterations);
    report.training_rmse += member.report.rmse / members;
  }
  report.status = converged ? FitReport::Status::Converged : FitReport::Status::IterationLimit;
  report.message = converged ? "converged" : "iteration limit reached";
  report.model = std::make_shared<HysteresisNetwork>(std::string(preset.name), std::move(networks));
  return report;
}

}  // namespace dashpot
