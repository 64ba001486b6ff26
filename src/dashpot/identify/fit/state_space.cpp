#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/base/parallel.h"
#include "dashpot/damper/kinds/state_space/presets.h"
#include "dashpot/damper/kinds/state_space/train_state_space.h"
#include "dashpot/error.h"
#include "dashpot/identify/fit/dissipating.h"
#include "dashpot/identify/fit/fit.h"
#include "dashpot/identify/fit/free_run_records.h"
#include "dashpot/identify/fit/trials.h"

namespace dashpot {
namespace {

constexpr std::size_t kStateSpaceSamples = 6000;  // of a fit, every k-th; the states see all
constexpr std::size_t kWindow = 400;              // samples of a window
constexpr std::size_t kWindowStride = 2;          // of its samples, scored
constexpr std::size_t kWindowSteps = 12000, kTrialSteps = 5000;
constexpr int kWindowIterations = 25, kStateSpaceTrialIterations = 12, kFinishIterations = 30;
constexpr int kStateSpacePaidIterations = 20;  // of a training that pays for energy fed in
// Iterations that end a lone trial: a short one prefers small weights, so a lone one is made in
// full.
constexpr int kTrialFinish = 10;
constexpr double kStateSpaceTolerance = 1e-3;  // stopping early, too, keeps weights small
constexpr std::array kStateSpaceDecays{1e-3, 1e-4, 1e-5};
constexpr double kMostStep = 0.005;  // s, of the model

using Records = std::vector<const FreeRunRecord*>;

double mean_square_velocity(const Records& records) {
  double squares = 0, samples = 0;
  for (const FreeRunRecord* record : records) {
    for (const DamperInput& input : record->inputs) squares += input.velocity * input.velocity;
    samples += static_cast<double>(record->inputs.size());
  }
  return squares / samples;
}

/// The longest mean sample time, s: no record's steps are then divided but where it is coarse.
double longest_sample_time(const Records& records) {
  double longest = 0;
  for (const FreeRunRecord* record : records)
    longest = std::max(longest, (record->time.back() - record->time.front()) /
                                    static_cast<double>(record->time.size() - 1));
  return longest > 0 ? longest : kMostStep;
}

StateSpaceCell starting_cell(const StateSpacePreset& preset, const Records& records,
                             const DriveRange& drive) {
  // Path rates times the longest and the shortest way.
  constexpr double kSlowest = 2, kFastest = 30;
  constexpr double kLags[] = {30, 300}, kCurrentLags[] = {20, 200}, kSteady = 100;  // 1/s
  StateSpaceCell cell;

  // The rates of its states: by the way travelled, in time, and of the current.
  const double square = mean_square_velocity(records);
  cell.velocity_scale = square > 0 ? std::sqrt(square) : 1;
  const WayRange way = way_range(records);
  cell.path_rates = spaced_rates(kSlowest * cell.velocity_scale / way.longest,
                                 kFastest * cell.velocity_scale / way.shortest, preset.path_states);
  cell.lag_rates = spaced_rates(kLags[0], kLags[1], preset.lags);
  cell.current_rates = drive.varies
                           ? spaced_rates(kCurrentLags[0], kCurrentLags[1], preset.current_lags)
                           : std::vector{kSteady};

  // The scale of the current, and a step that no record exceeds without need.
  const double half = (drive.high - drive.low) / 2;
  cell.current_mean = drive.low + half;
  cell.current_scale = half > 0 ? half : 1;
  cell.model_step = std::min(kMostStep, longest_sample_time(records));
  return cell;
}

GatedNetwork standardised(const StateSpaceCell& cell, const Records& records) {
  GatedNetwork network;
  network.currents = cell.currents();
  network.signals.resize(cell.signal_count());
  network.signals.front().scale = cell.velocity_scale;
  network.output_scale = force_deviation(records);
  return network;
}

/// The preset with what the user's design says otherwise: neurons of the cell, then of what reads
/// it.
StateSpacePreset designed(StateSpacePreset preset, const NetworkDesign& design) {
  constexpr std::size_t kMost = StateSpaceCell::kMaxHidden;
  if (!design.hidden.empty() && design.hidden.front() > kMost)
    throw Error("--network hidden", std::to_string(design.hidden.front()) + " neurons of the cell",
                "at most " + std::to_string(kMost) + " for " + std::string(preset.name));
  if (!design.hidden.empty()) preset.hidden = design.hidden.front();
  if (design.hidden.size() > 1) preset.output_hidden = design.hidden[1];
  preset.members = design.members.value_or(preset.members);
  return preset;
}

/// One preset on one set of records.
class StateSpaceFit {
 public:
  StateSpaceFit(const StateSpacePreset& preset, const std::vector<Record>& training,
                DriveUnit drive_unit, const IdentifyOptions& options)
      : preset_(designed(preset, options.network)),
        options_(options),
        records_(free_run_records(training, drive_unit)) {
    for (const FreeRunRecord& record : records_) all_.push_back(&record);
    start_.cell = starting_cell(preset_, all_, drive_range(training, drive_unit));
    start_.network = standardised(start_.cell, all_);
    decay_ = options.network.l2 ? *options.network.l2 : best_decay(Trials(training, drive_unit));
  }

  struct Member {
    StateSpaceNetwork network;
    FreeRunTrainReport report;
  };

  /// Members differ in their random start alone: each learns from windows, then from whole records.
  std::vector<Member> members() const {
    std::vector<Member> members(preset_.members);
    parallel_for(members.size(), options_.threads, [&](std::size_t k) {
      members[k].network = from_windows(all_, {decay_, kWindowIterations, kWindowSteps, k});
      members[k].report =
          train(members[k].network, all_, finish(decay_, kFinishIterations, k == 0));
    });
    return members;
  }

  /// Trains a member on while it pays for energy that it feeds in.
  void train_on(Member& member, const ActivityPenalty& penalty) const {
    StateSpaceTrainOptions options = finish(decay_, kStateSpacePaidIterations);
    options.rate_decay = kPaidRateDecay;
    options.penalty = &penalty;
    member.report = train(member.network, all_, options);
  }

 private:
  struct Effort {
    double decay;
    int iterations;
    std::size_t steps;
    std::uint64_t start = 0;
  };

  double best_decay(const Trials& trials) const {
    const bool lone = trials.all().size() == 1;
    return trials.best_decay(
        kStateSpaceDecays, options_.threads, [this, lone](const FreeRunTrial& trial, double decay) {
          StateSpaceNetwork found = from_windows(
              trial.training, lone ? Effort{decay, kWindowIterations, kWindowSteps}
                                   : Effort{decay, kStateSpaceTrialIterations, kTrialSteps});
          if (lone) train(found, trial.training, finish(decay, kTrialFinish));
          double squares = 0;
          for (const FreeRunRecord* record : trial.held_back)
            squares += squares_left(found, *record, options_.offset == OffsetMode::Record);
          return squares;
        });
  }

  /// is_watched: how its error falls is reported; of several at once only one is.
  StateSpaceTrainOptions finish(double decay, int iterations, bool is_watched = false) const {
    return {.max_iterations = static_cast<int>(options_.network.epochs.value_or(iterations)),
            .tolerance = kStateSpaceTolerance,
            .weight_decay = decay,
            .offsets = options_.offset == OffsetMode::Record,
            .stride = (scored_samples(all_) + kStateSpaceSamples - 1) / kStateSpaceSamples,
            .on_iteration = [this, is_watched](double cost) {
              is_watched ? options_.monitor.report_cost(cost) : options_.monitor.check();
            }};
  }

  StateSpaceNetwork from_windows(const Records& records, Effort effort) const {
    StateSpaceTrainOptions options = finish(effort.decay, effort.iterations);
    options.max_iterations = effort.iterations;
    options.stride = kWindowStride;
    options.window = kWindow;
    options.most_steps = effort.steps;
    StateSpaceNetwork network = start_;
    network.cell.initialise(preset_.hidden, options_.seed + effort.start);
    network.network.initialise(preset_.output_hidden, options_.seed + effort.start);
    train(network, records, options);
    return network;
  }

  const StateSpacePreset preset_;
  const IdentifyOptions& options_;
  std::vector<FreeRunRecord> records_;
  Records all_;
  StateSpaceNetwork start_;
  double decay_ = 0;
};

}  // namespace

FitReport fit_state_space(const StateSpacePreset& preset, const std::vector<Record>& training,
                          DriveUnit drive_unit, const IdentifyOptions& options) {
  using Member = StateSpaceFit::Member;
  const StateSpaceFit fit(preset, training, drive_unit, options);
  return report_of_dissipating(
      fit.members(), training, drive_unit, options,
      [&](const std::vector<Member>& members) {
        std::vector<StateSpaceNetwork> networks;
        for (const Member& member : members) networks.push_back(member.network);
        return std::make_shared<StateSpaceModel>(std::string(preset.name), std::move(networks));
      },
      [&](Member& member, const ActivityPenalty& penalty) { fit.train_on(member, penalty); });
}

}  // namespace dashpot
