#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>

#include "dashpot/base/parallel.h"
#include "dashpot/damper/kinds/passive_network/passive_network_model.h"
#include "dashpot/damper/kinds/passive_network/presets.h"
#include "dashpot/damper/kinds/passive_network/train_passive_network.h"
#include "dashpot/error.h"
#include "dashpot/evaluate.h"
#include "dashpot/identify/fit/fit.h"
#include "dashpot/identify/fit/free_run_records.h"
#include "dashpot/identify/fit/member_report.h"
#include "dashpot/identify/fit/passive_network_fit.h"
#include "dashpot/identify/judge/stroke.h"
#include "dashpot/record/trial_parts.h"

namespace dashpot {
namespace {

// The network's step: a share of the time between two turns, and short where the drive switches.
constexpr double kStepsPerStroke = 25, kFinerSteps = 100, kLongestStep = 0.01,
                 kLongestSwitchingStep = 0.001;        // s
constexpr double kWindowTime = 1, kRunInShare = 0.25;  // s; of a window
constexpr std::size_t kShortestWindow = 128, kLongestWindow = 400;
constexpr std::size_t kTrialShare = 2;  // one in so many of a member's updates
/// Where motions or drives are to come that the records do not show, it may help that weights
/// shrink; where more of the same is to come, that many updates of fewer windows are made, which
/// takes longer and has to be worth it.
constexpr PassiveEffort kUsual;
constexpr std::array kForOtherMotions{kUsual, PassiveEffort{.decay = 1}};
constexpr std::array kForMoreOfTheSame{kUsual,
                                       PassiveEffort{.updates = 4800, .windows = 16, .rate = 0.02}};
constexpr double kWorthLonger = 0.9;          // of what the usual effort leaves
constexpr std::size_t kLongerForMotions = 2;  // where these motions are all that is to come
constexpr std::size_t kMostMotions = 4;       // groups of them, held back in turn
/// Where the drive stands at levels, networks learn to do without reading it in this share of
/// the windows, and do so beyond the levels, all the way from this share of their range on.
constexpr double kBlindShare = 0.5, kFadeShare = 0.25;
constexpr double kDriveSpan = 2;  // of the standardised drive

using Records = std::vector<const FreeRunRecord*>;

Records places_of(const std::vector<FreeRunRecord>& records) {
  Records places;
  for (const FreeRunRecord& record : records) places.push_back(&record);
  return places;
}

/// s: fine enough for the quickest motion of these records and, where it varies, for their drive.
double network_step(const Records& records, bool drive_varies,
                    double steps_per_stroke = kStepsPerStroke) {
  double stroke = INFINITY, own = 0;
  for (const FreeRunRecord* record : records) {
    stroke = std::min(stroke, mean_stroke(record->inputs, record->time).duration);
    own = std::max(own, (record->time.back() - record->time.front()) /
                            static_cast<double>(record->time.size() - 1));
  }
  const double longest = drive_varies ? kLongestSwitchingStep : kLongestStep;
  return std::max(own, std::min(longest, stroke / steps_per_stroke));
}

/// Samples of a window at that step.
std::size_t window_samples(double step) {
  return static_cast<std::size_t>(std::clamp(kWindowTime / step,
                                             static_cast<double>(kShortestWindow),
                                             static_cast<double>(kLongestWindow)));
}

/// What these trials choose from; a design's own number of updates is held to.
std::vector<PassiveEffort> efforts_for(const PassiveTrials& trials, const NetworkDesign& design) {
  std::span<const PassiveEffort> known = kForOtherMotions;
  if (trials.later) known = kForMoreOfTheSame;
  std::vector<PassiveEffort> efforts;
  for (PassiveEffort effort : known) {
    if (design.epochs && effort.updates != kUsual.updates) continue;
    effort.updates = design.epochs.value_or(effort.updates);
    effort.rate = design.rate.value_or(effort.rate);
    efforts.push_back(effort);
  }
  return efforts;
}

/// Whether networks read the drive within its levels only.
bool reads_levels(const DriveRange& drive) { return !drive.varies && drive.levels > 1; }

/// The training records in two: those that are held back, and the others.
template <class Held>
Fold without(const std::vector<Record>& training, const Held& held) {
  Fold fold;
  for (const Record& record : training)
    (held(record) ? fold.left_out : fold.training).push_back(record);
  return fold;
}

/// Motions in turn, dealt to kMostMotions groups; a single one cannot be held back.
std::vector<Fold> motions_in_turn(const std::vector<Record>& training) {
  std::set<std::string> motions;
  for (const Record& record : training) motions.insert(record.condition);
  const std::size_t groups = std::min(motions.size(), kMostMotions);
  std::vector<Fold> folds;
  for (std::size_t group = 0; groups > 1 && group < groups; ++group)
    folds.push_back(without(training, [&](const Record& record) {
      const auto place = std::distance(motions.begin(), motions.find(record.condition));
      return static_cast<std::size_t>(place) % groups == group;
    }));
  return folds;
}

/// The least level of the drive and the greatest, where two others are left to extrapolate from.
std::vector<Fold> end_levels_in_turn(const std::vector<Record>& training, const DriveRange& drive) {
  if (!reads_levels(drive) || drive.levels < 3) return {};
  std::set<double> levels;
  for (const Record& record : training) levels.insert(record.drive_level.value_or(0));
  std::vector<Fold> folds;
  for (const double end : {*levels.begin(), *levels.rbegin()})
    folds.push_back(without(
        training, [&](const Record& record) { return record.drive_level.value_or(0) == end; }));
  return folds;
}

/// A network of the preset's size with the scales and ranges of the records.
PassiveNetwork scaled_network(const PassiveNetworkPreset& preset, const Records& records,
                              const DriveRange& drive, double steps_per_stroke) {
  PassiveNetwork n;
  n.sizes = preset.sizes;
  n.lags = drive.varies;
  n.inert = true;

  // Means and squares of the motion.
  double samples = 0, displacements = 0, displacement_squares = 0, velocity_squares = 0;
  double lowest = INFINITY, highest = -INFINITY, slowest = INFINITY, fastest = -INFINITY;
  for (const FreeRunRecord* record : records)
    for (const DamperInput& input : record->inputs) {
      samples += 1;
      displacements += input.displacement;
      displacement_squares += input.displacement * input.displacement;
      velocity_squares += input.velocity * input.velocity;
      lowest = std::min(lowest, input.displacement);
      highest = std::max(highest, input.displacement);
      slowest = std::min(slowest, input.velocity);
      fastest = std::max(fastest, input.velocity);
    }
  n.velocity_scale = std::max(std::sqrt(velocity_squares / samples), 1e-9);
  n.velocity_low = slowest / n.velocity_scale;
  n.velocity_high = fastest / n.velocity_scale;
  if (preset.displacement) {
    n.displacement_mean = displacements / samples;
    const double variance =
        displacement_squares / samples - n.displacement_mean * n.displacement_mean;
    n.displacement_scale = std::sqrt(std::max(variance, 1e-18));
    n.displacement_low = (lowest - n.displacement_mean) / n.displacement_scale;
    n.displacement_high = (highest - n.displacement_mean) / n.displacement_scale;
  }

  // The drive, from 0, and the force.
  const double most = std::max(std::abs(drive.low), std::abs(drive.high));
  n.drive_scale = most > 0 ? most / kDriveSpan : 1;
  n.drive_low = drive.low / n.drive_scale;
  n.drive_high = drive.high / n.drive_scale;
  if (reads_levels(drive)) n.drive_fade = kFadeShare * (n.drive_high - n.drive_low);
  n.force_scale = force_deviation(records);
  n.model_step = network_step(records, drive.varies, steps_per_stroke);
  return n;
}

/// The preset with what the user's design says otherwise: neurons of the gates, then of the viscous
/// term.
PassiveNetworkPreset designed(PassiveNetworkPreset preset, const NetworkDesign& design) {
  for (const std::size_t neurons : design.hidden)
    if (neurons < 1 || neurons > PassiveNetwork::kMaxNeurons)
      throw Error("--network hidden", std::to_string(neurons) + " neurons",
                  "1 to " + std::to_string(PassiveNetwork::kMaxNeurons) + " for " +
                      std::string(preset.name));
  if (!design.hidden.empty()) preset.sizes.neurons = design.hidden.front();
  if (design.hidden.size() > 1) preset.sizes.viscous_neurons = design.hidden[1];
  preset.members = design.members.value_or(preset.members);
  return preset;
}

/// One preset on one set of records.
class PassiveNetworkFit {
 public:
  PassiveNetworkFit(const PassiveNetworkPreset& preset, const std::vector<Record>& training,
                    DriveUnit drive_unit, const IdentifyOptions& options,
                    std::optional<PassiveEffort> effort, double steps_per_stroke = kStepsPerStroke)
      : preset_(designed(preset, options.network)), drive_unit_(drive_unit), options_(options) {
    const std::vector<FreeRunRecord> recorded = free_run_records(training, drive_unit);
    const Records as_recorded = places_of(recorded);
    const DriveRange drive = drive_range(training, drive_unit);
    start_ = scaled_network(preset_, as_recorded, drive, steps_per_stroke);
    records_ = at_step(as_recorded, start_.model_step);
    all_ = places_of(records_);
    effort_ = effort ? *effort : best_effort(passive_trials(training, drive));
  }

  const PassiveEffort& effort() const { return effort_; }

  struct Member {
    PassiveNetwork network;
    FreeRunTrainReport report;
  };

  /// Members differ in their random start and in the windows that they see.
  std::vector<Member> members() const {
    std::vector<Member> members(preset_.members);
    parallel_for(members.size(), options_.threads,
                 [&](std::size_t k) { members[k] = trained(all_, effort_, options_.seed + k); });
    return members;
  }

  /// At the network's step.
  const Records& records() const { return all_; }

 private:
  Member trained(const Records& records, const PassiveEffort& effort, std::uint64_t seed) const {
    PassiveTrainOptions options;
    options.updates = effort.updates;
    options.window = window_samples(start_.model_step);
    options.run_in = static_cast<std::size_t>(static_cast<double>(options.window) * kRunInShare);
    options.windows = effort.windows;
    options.rate = effort.rate;
    options.weight_decay = effort.decay;
    options.blind_share = start_.drive_fade > 0 ? kBlindShare : 0;
    options.offsets = options_.offset == OffsetMode::Record;
    options.seed = seed;
    options.on_update = [this] { options_.monitor.check(); };

    Member member{start_, {}};
    initialise(member.network, seed);
    member.report = train(member.network, records, options);
    return member;
  }

  /// The effort that leaves least of what trials hold back, on the mean of logarithms, so that one
  /// wild extrapolation does not decide alone.
  PassiveEffort best_effort(const PassiveTrials& trials) const {
    const std::vector<PassiveEffort> efforts = efforts_for(trials, options_.network);
    if (efforts.size() == 1) return efforts.front();
    std::vector<double> left(efforts.size() * trials.folds.size());
    parallel_for(left.size(), options_.threads, [&](std::size_t k) {
      const PassiveTrial& trial = trials.folds[k / efforts.size()];
      left[k] =
          trial.weight * std::log(left_of(trial.fold, trial_effort(efforts[k % efforts.size()])));
    });

    std::vector<double> sums;
    for (const PassiveEffort& effort : efforts)
      sums.push_back(effort.updates > kUsual.updates ? -std::log(kWorthLonger) : 0);
    for (std::size_t k = 0; k < left.size(); ++k) sums[k % efforts.size()] += left[k];
    return efforts[static_cast<std::size_t>(std::ranges::min_element(sums) - sums.begin())];
  }

  /// Squared errors that a network leaves of what a fold holds back, N^2, at its own sampling:
  /// noise that a step averages away counts there.
  double left_of(const Fold& fold, const PassiveEffort& effort) const {
    const std::vector<FreeRunRecord> recorded = free_run_records(fold.training, drive_unit_);
    const std::vector<FreeRunRecord> training = at_step(places_of(recorded), start_.model_step);
    const Member found = trained(places_of(training), effort, options_.seed);
    double squares = 0;
    for (const FreeRunRecord& record : free_run_records(fold.left_out, drive_unit_))
      squares += squares_left(found.network, record, options_.offset == OffsetMode::Record);
    return squares;
  }

  const PassiveNetworkPreset preset_;
  const DriveUnit drive_unit_;
  const IdentifyOptions& options_;
  std::vector<FreeRunRecord> records_;  ///< at the network's step
  Records all_;
  PassiveNetwork start_;
  PassiveEffort effort_;
};

}  // namespace

PassiveTrials passive_trials(const std::vector<Record>& training, const DriveRange& drive) {
  PassiveTrials trials;
  const auto add = [&](std::vector<Fold> folds) {
    const double weight = 1 / static_cast<double>(folds.size());
    for (Fold& fold : folds) trials.folds.push_back({std::move(fold), weight});
  };
  add(motions_in_turn(training));
  add(end_levels_in_turn(training, drive));
  trials.later = trials.folds.empty();
  if (trials.later) add(trial_folds(training));
  return trials;
}

NetworkDesign trial_design(NetworkDesign design) {
  design.members = 1;
  return design;
}

PassiveEffort trial_effort(PassiveEffort effort) {
  effort.updates = std::max<std::size_t>(effort.updates / kTrialShare, 1);
  return effort;
}

double passive_training_steps(const PassiveNetworkPreset& preset,
                              const std::vector<Record>& training, DriveUnit drive_unit,
                              const NetworkDesign& design) {
  const std::vector<FreeRunRecord> recorded = free_run_records(training, drive_unit);
  const DriveRange drive = drive_range(training, drive_unit);

  // Windows of the trials of every effort, and of the members with the greatest.
  const PassiveTrials trials = passive_trials(training, drive);
  const std::vector<PassiveEffort> efforts = efforts_for(trials, design);
  std::size_t of_trial = 0, of_member = 0;
  for (const PassiveEffort& effort : efforts) {
    if (efforts.size() > 1) of_trial += trial_effort(effort).updates * effort.windows;
    of_member = std::max(of_member, effort.updates * effort.windows);
  }
  const std::size_t windows =
      designed(preset, design).members * of_member + trials.folds.size() * of_trial;
  return static_cast<double>(windows *
                             window_samples(network_step(places_of(recorded), drive.varies)));
}

namespace {

FitReport report_of(const PassiveNetworkPreset& preset, const PassiveNetworkFit& fit) {
  const std::vector<PassiveNetworkFit::Member> members = fit.members();
  FitReport report = report_of_members(members);
  std::vector<PassiveNetwork> networks;
  for (const PassiveNetworkFit::Member& member : members) networks.push_back(member.network);

  // What one member alone does between the motions, no record has told it.
  const std::vector<std::size_t> strays = stray_members(networks, fit.records());
  for (std::size_t k = strays.size(); k-- > 0;)
    networks.erase(networks.begin() + static_cast<std::ptrdiff_t>(strays[k]));
  if (!strays.empty())
    report.warnings.push_back(
        std::to_string(strays.size()) + " of its " + std::to_string(members.size()) +
        " networks left out: unlike the others at half and at twice the speed of its motions");
  report.model =
      std::make_shared<PassiveNetworkModel>(std::string(preset.name), std::move(networks));
  return report;
}

}  // namespace

PassiveNetworkTraining train_passive_network(const PassiveNetworkPreset& preset,
                                             const std::vector<Record>& training,
                                             DriveUnit drive_unit, const IdentifyOptions& options,
                                             std::optional<PassiveEffort> effort) {
  const PassiveNetworkFit fit(preset, training, drive_unit, options, effort);
  return {report_of(preset, fit), fit.effort()};
}

FitReport fit_to_these_motions(const PassiveNetworkPreset& preset,
                               const std::vector<Record>& training, DriveUnit drive_unit,
                               IdentifyOptions options) {
  PassiveEffort effort = kUsual;
  effort.updates = options.network.epochs.value_or(kLongerForMotions * kUsual.updates);
  effort.rate = options.network.rate.value_or(effort.rate);
  return report_of(preset,
                   PassiveNetworkFit(preset, training, drive_unit, options, effort, kFinerSteps));
}

FitReport fit_passive_network(const PassiveNetworkPreset& preset,
                              const std::vector<Record>& training, DriveUnit drive_unit,
                              const IdentifyOptions& options) {
  return train_passive_network(preset, training, drive_unit, options).report;
}

}  // namespace dashpot
