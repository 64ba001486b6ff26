#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/damper/kinds/family/physics_information.h"
#include "dashpot/damper/kinds/family/presets.h"
#include "dashpot/damper/nets/standardise.h"
#include "dashpot/identify/fit/family_gates_fit.h"
#include "dashpot/identify/fit/family_line_fit.h"
#include "dashpot/identify/fit/family_physics_fit.h"
#include "dashpot/identify/fit/fit.h"
#include "dashpot/identify/fit/network_trainer.h"
#include "dashpot/numerics/linear_algebra.h"

namespace dashpot {
namespace {

// The settings of the paper's network and its training that the user leaves open. Without weight
// decay networks learn the builds of their training by heart, which a new damper does not share.
constexpr double kRate = 5e-3, kL2 = 5e-3;
constexpr std::size_t kBatch = 100, kEpochs = 200;

std::vector<FamilyRecord> family_records(const std::vector<Record>& training,
                                         DriveUnit drive_unit) {
  std::vector<FamilyRecord> records;
  for (const Record& record : training) {
    require_member(record.conditions, record.name);
    const double* specimen = find_condition(record.conditions, kSpecimen);
    records.push_back({with_conditions({}, record.conditions, record.name),
                       damper_inputs(record, drive_unit), record.time,
                       record.channel("force").samples, record.warm_up, specimen ? *specimen : 0});
  }
  return records;
}

/// The yield stress of a fluid at the currents of its records, ascending, each current once.
YieldCurve yield_of(const std::vector<FamilyRecord>& records, double viscosity) {
  std::vector<std::pair<double, double>> points;
  for (const FamilyRecord& record : records)
    if (record.member.viscosity == viscosity)
      points.emplace_back(std::abs(record.inputs.front().current),
                          record.member.yield.stresses.front());
  std::ranges::sort(points);
  YieldCurve curve;
  for (const auto& [current, stress] : points) {
    if (!curve.currents.empty() && curve.currents.back() == current) continue;
    curve.currents.push_back(current);
    curve.stresses.push_back(stress);
  }
  return curve;
}

std::vector<Family::Range> domain_of(const std::vector<FamilyRecord>& records) {
  std::vector<Family::Range> domain;
  for (const MemberField& field : member_fields()) {
    if (!field.required) continue;
    Family::Range range{field.field, INFINITY, -INFINITY};
    for (const FamilyRecord& record : records) {
      range.min = std::min(range.min, record.member.*field.field);
      range.max = std::max(range.max, record.member.*field.field);
    }
    domain.push_back(range);
  }
  return domain;
}

/// Of records, each at one current.
Family::Range yield_range_of(const std::vector<FamilyRecord>& records) {
  Family::Range range{nullptr, INFINITY, -INFINITY};
  for (const FamilyRecord& record : records) {
    range.min = std::min(range.min, record.member.yield.greatest());
    range.max = std::max(range.max, record.member.yield.greatest());
  }
  return range;
}

/// The share of the plate flow that leaves the least of the forces.
FamilyBaseline fitted_baseline(FamilyTarget target, const std::vector<FamilyRecord>& records) {
  constexpr double kOnset = 0.1;  // of the top speed

  // The onset of the plate flow follows the top speed of all records.
  double top = 0, across = 0, square = 0;
  for (const FamilyRecord& record : records)
    for (const DamperInput& input : record.inputs) top = std::max(top, std::abs(input.velocity));
  FamilyBaseline baseline{target, 1, top > 0 ? kOnset * top : 1};

  // Where the network learns what the flow leaves, the share is the least-squares one.
  if (target != FamilyTarget::Residual) return baseline;
  for (const FamilyRecord& record : records)
    for (std::size_t k = record.first; k < record.force.size(); ++k) {
      const double flow = baseline.force(record.member, record.inputs[k]);
      across += flow * record.force[k];
      square += flow * flow;
    }
  if (square > 0) baseline.share = across / square;
  return baseline;
}

TrainingSamples samples_of(const FamilyPreset& preset, const FamilyBaseline& baseline,
                           const std::vector<FamilyRecord>& records) {
  std::vector<FamilyInput> reads;
  for (const std::string& input : preset.inputs)
    reads.push_back(family_input_named(input, std::string(preset.name)));
  TrainingSamples samples;
  for (const FamilyRecord& record : records)
    for (std::size_t k = record.first; k < record.force.size(); ++k) {
      const DamperInput& input = record.inputs[k];
      for (const FamilyInput read : reads) samples.inputs.push_back(read(record.member, input));
      samples.targets.push_back(record.force[k] - baseline.force(record.member, input));
    }
  return samples;
}

struct LearnedForce {
  std::shared_ptr<const FamilyForce> force;  ///< none where the training failed
  double build_spread = 0;
  double offset = 0;  ///< N, of every damper
  double drawing_spread = 0;
};

/// The design with what it leaves open as the family's networks learn.
NetworkDesign completed(NetworkDesign design) {
  if (design.trainer.value_or(Trainer::Adam) != Trainer::Adam) return design;
  design.trainer = Trainer::Adam;
  design.rate = design.rate.value_or(kRate);
  design.batch = design.batch.value_or(kBatch);
  design.epochs = design.epochs.value_or(kEpochs);
  design.l2 = design.l2.value_or(kL2);
  return design;
}

LearnedForce fit_networks(const FamilyPreset& preset, const FamilyBaseline& baseline,
                          const std::vector<Record>& training, DriveUnit drive_unit,
                          const IdentifyOptions& asked, FitReport& report) {
  IdentifyOptions options = asked;
  options.network = completed(asked.network);
  // The start that fits best is not the one that predicts best, so there is one only.
  if (options.network.patience.value_or(0) == 0) options.starts = 1;
  const SamplesOf samples_of_records = [&](const std::vector<Record>& records) {
    return samples_of(preset, baseline, family_records(records, drive_unit));
  };
  const NetworkDesign& design = options.network;
  const Mlp start =
      untrained(preset.inputs.size(), design.hidden.empty() ? preset.hidden : design.hidden,
                design.activation.value_or(Activation::Relu), samples_of_records(training));
  TrainedEnsemble trained = train_networks(start, training, samples_of_records, options);
  report.status = trained.status;
  report.message = trained.message;
  report.iterations = trained.iterations;
  if (trained.status == FitReport::Status::Failed) return {};
  return {std::make_shared<FamilyNetwork>(preset.inputs, std::move(trained.members))};
}

LearnedForce fit_gates(const FamilyPreset& preset, const std::vector<FamilyRecord>& records,
                       const IdentifyOptions& options, FitReport& report) {
  FamilyGatesFit fit = fit_family_gates(preset, records, options.monitor);
  report.parameters.push_back(
      {"build_spread", "1",
       "standard deviation of a new damper's force from its design's, as a share", fit.build_spread,
       fit.spread_low, fit.spread_high});
  report.status = FitReport::Status::Converged;
  report.message = "solved";
  report.iterations = 1;
  return {std::make_shared<GatedFamily>(std::move(fit.gates)), fit.build_spread};
}

LearnedForce fit_line(const std::vector<FamilyRecord>& records, FitReport& report) {
  report.status = FitReport::Status::Converged;
  report.message = "solved";
  report.iterations = 1;
  return {std::make_shared<LineFamily>(fit_family_line(records))};
}

LearnedForce fit_physics(const std::vector<FamilyRecord>& records, const IdentifyOptions& options,
                         FitReport& report) {
  const FamilyPhysicsFit fit = fit_family_physics(records, options.threads, options.monitor);

  // The numbers, each with what it means, and their intervals as builds and errors of drawings
  // leave them; with one design, these are not known.
  constexpr double kAbout95 = 1.96;
  const std::vector<double>& information = fit.physics.information;
  const std::vector<double> covariance =
      information.empty() ? std::vector<double>() : inverse(information, kPhysicsUnknowns);
  for (std::size_t k = 0; k < kPhysicsNumbers; ++k) {
    const PhysicsNumber& number = FamilyPhysics::table()[k];
    const double value = fit.physics.numbers[k];
    const double half =
        covariance.empty() ? 0 : kAbout95 * std::sqrt(covariance[k * (kPhysicsUnknowns + 1)]);
    report.parameters.push_back({std::string(number.name), "1", std::string(number.meaning), value,
                                 std::max(number.low, value - half),
                                 std::min(number.high, value + half)});
  }

  // Where no build repeats, builds and the family's error are one, and named so.
  const bool told_apart = fit.builds_repeat;
  report.parameters.push_back(
      {"build_spread", "1",
       told_apart ? "standard deviation of the force of builds of one drawing, as a share"
                  : "standard deviation of a new damper's force from its design's, as a share: of "
                    "builds and of the family's error, which no repeated build tells apart",
       fit.build_spread, fit.spread_low, fit.spread_high});
  if (told_apart)
    report.parameters.push_back(
        {"drawing_spread", "1",
         "standard deviation of what the family gets wrong of a drawing's force, as a share",
         fit.drawing_spread, fit.drawing_spread, fit.drawing_spread});
  report.status = fit.converged ? FitReport::Status::Converged : FitReport::Status::IterationLimit;
  report.message = "geometry's ridges " + format_number(fit.ridges.all) + ", " +
                   format_number(fit.ridges.yield) + " and " + format_number(fit.ridges.spring) +
                   ", chosen by leaving designs out";
  report.iterations = fit.iterations;
  return {std::make_shared<PhysicsFamily>(fit.physics), fit.build_spread, fit.offset,
          fit.drawing_spread};
}

LearnedForce fit_force(const FamilyPreset& preset, const FamilyBaseline& baseline,
                       const std::vector<FamilyRecord>& records,
                       const std::vector<Record>& training, DriveUnit drive_unit,
                       const IdentifyOptions& options, FitReport& report) {
  switch (preset.form) {
    case FamilyForm::Gates:
      return fit_gates(preset, records, options, report);
    case FamilyForm::Line:
      return fit_line(records, report);
    case FamilyForm::Physics:
      return fit_physics(records, options, report);
    case FamilyForm::Network:
      break;
  }
  return fit_networks(preset, baseline, training, drive_unit, options, report);
}

double rmse_of(const FamilyModel& model, const std::vector<Record>& training, DriveUnit drive_unit,
               const IdentifyOptions& options) {
  return evaluate(model, training, drive_unit,
                  {.offset = options.offset, .threads = options.threads})
      .pooled.rmse;
}

}  // namespace

FitReport fit_family(const FamilyPreset& preset, const std::vector<Record>& training,
                     DriveUnit drive_unit, const IdentifyOptions& options) {
  options.monitor.check();
  const std::vector<FamilyRecord> records = family_records(training, drive_unit);

  // The family without its force: its domain and its baseline.
  FitReport report;
  Family family;
  family.name = preset.name;
  family.domain = domain_of(records);
  family.yield = yield_range_of(records);
  family.baseline = fitted_baseline(preset.target, records);

  const LearnedForce learned =
      fit_force(preset, family.baseline, records, training, drive_unit, options, report);
  if (!learned.force) return report;
  family.force = learned.force;
  family.build_spread = learned.build_spread;
  family.drawing_spread = learned.drawing_spread;

  // The model stands at the first record's damper, with the yield curve of its fluid.
  FamilyMember member = records.front().member;
  member.yield = yield_of(records, member.viscosity);
  const auto model = std::make_shared<FamilyModel>(std::make_shared<Family>(std::move(family)),
                                                   member, learned.offset);
  report.training_rmse = rmse_of(*model, training, drive_unit, options);
  report.model = model;
  return report;
}

}  // namespace dashpot
