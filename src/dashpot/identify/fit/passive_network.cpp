#include <algorithm>
#include <array>
#include <cmath>

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

namespace dashpot {
namespace {

// The network's step: a share of the time between two turns, and short where the drive switches.
constexpr double kStepsPerStroke = 25, kFinerSteps = 100, kLongestStep = 0.01,
                 kLongestSwitchingStep = 0.001;        // s
constexpr double kWindowTime = 1, kRunInShare = 0.25;  // s; of a window
constexpr std::size_t kShortestWindow = 128, kLongestWindow = 400;
constexpr std::size_t kUpdates = 1600,
                      kTrialShare = 2;  // of a member; a trial makes one in so many
/// How much the networks' weights shrink: not at all, or as strange motions ask for.
constexpr std::array kWeightDecays{0.0, 1.0};
constexpr std::size_t kMostMotions = 4;  // groups of them, held back in turn
/// Where the drive stands at levels, networks learn to do without reading it in this share of
/// the windows, and do so beyond the levels, all the way from this share of their range on.
constexpr double kBlindShare = 0.5, kFadeShare = 0.25;
constexpr double kDriveSpan = 2;  // of the standardised drive

using Records = std::vector<const FreeRunRecord*>;

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

/// Updates of a member, and of a trial, which is as much shorter as the design asks for.
std::size_t member_updates(const NetworkDesign& design) { return design.epochs.value_or(kUpdates); }
std::size_t trial_updates(const NetworkDesign& design) {
  return std::max<std::size_t>(member_updates(design) / kTrialShare, 1);
}

/// Whether networks read the drive within its levels only.
bool reads_levels(const DriveRange& drive) { return !drive.varies && drive.levels > 1; }

/// Motions in turn, dealt to kMostMotions groups; a single one cannot be held back.
std::vector<HeldBack> motions_in_turn(const std::vector<Record>& records) {
  std::set<std::string> motions;
  for (const Record& record : records) motions.insert(record.condition);
  if (motions.size() < 2) return {};
  std::vector<HeldBack> parts(std::min(motions.size(), kMostMotions));
  for (std::size_t r = 0; r < records.size(); ++r) {
    const auto place = std::distance(motions.begin(), motions.find(records[r].condition));
    parts[static_cast<std::size_t>(place) % parts.size()].insert(r);
  }
  return parts;
}

/// The least level of the drive and the greatest, where two others are left to extrapolate from.
std::vector<HeldBack> end_levels_in_turn(const std::vector<Record>& records,
                                         const DriveRange& drive) {
  if (!reads_levels(drive) || drive.levels < 3) return {};
  std::set<double> levels;
  for (const Record& record : records) levels.insert(record.drive_level.value_or(0));
  std::vector<HeldBack> parts(2);
  for (std::size_t r = 0; r < records.size(); ++r) {
    const double level = records[r].drive_level.value_or(0);
    if (level == *levels.begin()) parts[0].insert(r);
    if (level == *levels.rbegin()) parts[1].insert(r);
  }
  return parts;
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
                    std::optional<double> decay, double steps_per_stroke = kStepsPerStroke)
      : preset_(designed(preset, options.network)), options_(options) {
    const std::vector<FreeRunRecord> recorded = free_run_records(training, drive_unit);
    Records as_recorded;
    for (const FreeRunRecord& record : recorded) as_recorded.push_back(&record);
    const DriveRange drive = drive_range(training, drive_unit);
    start_ = scaled_network(preset_, as_recorded, drive, steps_per_stroke);
    records_ = at_step(as_recorded, start_.model_step);
    for (const FreeRunRecord& record : records_) all_.push_back(&record);
    decay_ = decay ? *decay : best_weight_decay(held_back_parts(training, drive));
  }

  double decay() const { return decay_; }

  struct Member {
    PassiveNetwork network;
    FreeRunTrainReport report;
  };

  /// Members differ in their random start and in the windows that they see.
  std::vector<Member> members() const {
    std::vector<Member> members(preset_.members);
    parallel_for(members.size(), options_.threads, [&](std::size_t k) {
      members[k] = trained(all_, {decay_, member_updates(options_.network), options_.seed + k});
    });
    return members;
  }

 private:
  struct Effort {
    double decay;
    std::size_t updates;
    std::uint64_t seed;
  };

  Member trained(const Records& records, Effort effort) const {
    PassiveTrainOptions options;
    options.updates = effort.updates;
    options.window = window_samples(start_.model_step);
    options.run_in = static_cast<std::size_t>(static_cast<double>(options.window) * kRunInShare);
    options.rate = options_.network.rate.value_or(options.rate);
    options.weight_decay = effort.decay;
    options.blind_share = start_.drive_fade > 0 ? kBlindShare : 0;
    options.offsets = options_.offset == OffsetMode::Record;
    options.seed = effort.seed;
    options.on_update = [this] { options_.monitor.check(); };

    Member member{start_, {}};
    initialise(member.network, effort.seed);
    member.report = train(member.network, records, options);
    return member;
  }

  /// The mean logarithm of what trials leave of the records held back, for each decay: of the
  /// logarithm, so that one wild extrapolation does not decide alone.
  std::array<double, kWeightDecays.size()> left_of(const std::vector<HeldBack>& parts) const {
    const std::size_t choices = kWeightDecays.size();
    std::vector<double> left(choices * parts.size());
    parallel_for(left.size(), options_.threads, [&](std::size_t k) {
      const HeldBack& part = parts[k / choices];
      Records training, held_back;
      for (std::size_t r = 0; r < records_.size(); ++r)
        (part.contains(r) ? held_back : training).push_back(&records_[r]);

      const Member found = trained(
          training, {kWeightDecays[k % choices], trial_updates(options_.network), options_.seed});
      double squares = 0;
      for (const FreeRunRecord* record : held_back)
        squares += squares_left(found.network, *record, options_.offset == OffsetMode::Record);
      left[k] = std::log(squares) / static_cast<double>(parts.size());
    });
    std::array<double, kWeightDecays.size()> means{};
    for (std::size_t k = 0; k < left.size(); ++k) means[k % choices] += left[k];
    return means;
  }

  /// The decay that does best where motions and where the drive's ends are held back in turn; both
  /// count alike.
  double best_weight_decay(const HeldBackParts& parts) const {
    const auto by_motion = left_of(parts.motions), by_end = left_of(parts.ends);
    std::array<double, kWeightDecays.size()> both{};
    for (std::size_t k = 0; k < both.size(); ++k) both[k] = by_motion[k] + by_end[k];
    return kWeightDecays[static_cast<std::size_t>(std::ranges::min_element(both) - both.begin())];
  }

  const PassiveNetworkPreset preset_;
  const IdentifyOptions& options_;
  std::vector<FreeRunRecord> records_;  ///< at the network's step
  Records all_;
  PassiveNetwork start_;
  double decay_ = 0;
};

}  // namespace

HeldBackParts held_back_parts(const std::vector<Record>& training, const DriveRange& drive) {
  return {motions_in_turn(training), end_levels_in_turn(training, drive)};
}

NetworkDesign trial_design(NetworkDesign design) {
  design.epochs = trial_updates(design);
  design.members = 1;
  return design;
}

double passive_training_steps(const PassiveNetworkPreset& preset,
                              const std::vector<Record>& training, DriveUnit drive_unit,
                              const NetworkDesign& design) {
  const std::vector<FreeRunRecord> recorded = free_run_records(training, drive_unit);
  Records records;
  for (const FreeRunRecord& record : recorded) records.push_back(&record);
  const DriveRange drive = drive_range(training, drive_unit);

  // The members, and the trials of each decay on each part held back.
  const HeldBackParts parts = held_back_parts(training, drive);
  const std::size_t trials = parts.motions.size() + parts.ends.size();
  const std::size_t updates = designed(preset, design).members * member_updates(design) +
                              trials * kWeightDecays.size() * trial_updates(design);
  return static_cast<double>(updates * window_samples(network_step(records, drive.varies)));
}

namespace {

FitReport report_of(const PassiveNetworkPreset& preset, const PassiveNetworkFit& fit) {
  const std::vector<PassiveNetworkFit::Member> members = fit.members();
  FitReport report = report_of_members(members);
  std::vector<PassiveNetwork> networks;
  for (const PassiveNetworkFit::Member& member : members) networks.push_back(member.network);
  report.model =
      std::make_shared<PassiveNetworkModel>(std::string(preset.name), std::move(networks));
  return report;
}

}  // namespace

PassiveNetworkTraining train_passive_network(const PassiveNetworkPreset& preset,
                                             const std::vector<Record>& training,
                                             DriveUnit drive_unit, const IdentifyOptions& options,
                                             std::optional<double> decay) {
  const PassiveNetworkFit fit(preset, training, drive_unit, options, decay);
  return {report_of(preset, fit), fit.decay()};
}

FitReport fit_to_these_motions(const PassiveNetworkPreset& preset,
                               const std::vector<Record>& training, DriveUnit drive_unit,
                               IdentifyOptions options) {
  if (!options.network.epochs) options.network.epochs = 2 * kUpdates;
  return report_of(preset,
                   PassiveNetworkFit(preset, training, drive_unit, options, 0.0, kFinerSteps));
}

FitReport fit_passive_network(const PassiveNetworkPreset& preset,
                              const std::vector<Record>& training, DriveUnit drive_unit,
                              const IdentifyOptions& options) {
  return train_passive_network(preset, training, drive_unit, options).report;
}

}  // namespace dashpot
