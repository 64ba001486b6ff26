#include "dashpot/identify/fit/physics_calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/family/family_member.h"
#include "dashpot/damper/kinds/family/physics_family.h"
#include "dashpot/error.h"
#include "dashpot/evaluate.h"
#include "dashpot/identify/fit/uncertainty.h"
#include "dashpot/numerics/distributions.h"
#include "dashpot/numerics/least_squares.h"
#include "dashpot/physics/damper_physics.h"
#include "dashpot/physics/plate_flow.h"

namespace dashpot {
namespace {

/// Where each unknown stands; all are logarithms.
enum CalibrationIndex : std::size_t {
  kYieldScale,
  kViscosityScale,
  kFriction,
  kGive,
  kSeries,
  kCalibrationNumbers
};
constexpr std::array<std::pair<const char*, const char*>, kCalibrationNumbers> kNumberNames{
    {{"yield_stress", "1"},
     {"viscosity", "1"},
     {"friction", "N"},
     {"seal_give", "m"},
     {"stiffness", "N/m"}}};

/// Refuses a record whose conditions state another geometry than the drawing.
void require_drawn(const Record& record, const FamilyMember& drawn) {
  constexpr double kAlike = 0.01;
  for (const MemberField& field : member_fields()) {
    const double* stated = find_condition(record.conditions, field.name);
    const double value = drawn.*field.field;
    if (!stated || !field.required || field.field == &FamilyMember::viscosity) continue;
    if (!(std::abs(*stated - value) <= kAlike * value))
      throw Error(record.name,
                  "is of a damper whose " + std::string(field.name) + " is " +
                      format_number(*stated) + " " + std::string(field.unit) +
                      ", the drawing has " + format_number(value),
                  "recordings of the drawn damper alone");
  }
}

/// One recording: what drives the damper, and what it answered.
struct CalibrationRecord {
  std::vector<DamperInput> inputs;
  std::vector<double> time, force;
  std::size_t first = 0;
  double weight = 0;
  std::optional<double> level;
};

class CalibrationProblem {
 public:
  CalibrationProblem(const DamperDescription& drawing, const Dataset& data) {
    double largest = 0;
    const FamilyMember as_drawn = member_of(drawing, std::array{0.});
    for (const Record& record : data.records) {
      require_drawn(record, as_drawn);
      CalibrationRecord one{damper_inputs(record, data.drive_unit),
                            record.time,
                            record.channel("force").samples,
                            record.warm_up,
                            0,
                            record.drive_level};
      for (const DamperInput& input : one.inputs)
        largest = std::max(largest, std::abs(input.current));
      records_.push_back(std::move(one));
    }
    if (!(largest > 0))
      throw Error(data.name, "no recording has a current, so that none tells of the field",
                  "recordings at two currents or more");
    add_sizes(data.name);

    // The flow as drawn: forces per unit of the yield stress and of the speed.
    member_ = member_of(drawing, largest);
    const PlateGap active{member_.pole_length, member_.gap_area / member_.gap, member_.gap};
    const PlateGap passive{drawing.passive_length, active.width, active.height};
    const double area = member_.piston_area;
    per_stress_ = area * plate_yield_pressure(&active, 1);
    viscous_ = area * plate_newtonian_pressure(&active, member_.viscosity, area);
    passive_ = area * plate_newtonian_pressure(&passive, member_.viscosity, area);
  }

  std::size_t samples() const { return first_.back(); }
  const std::vector<std::size_t>& first() const { return first_; }
  const std::vector<CalibrationRecord>& records() const { return records_; }
  double force() const { return force_; }
  double stroke() const { return stroke_; }

  /// Weighted residuals in free run, without the mean of each record: its offset.
  void residuals(std::span<const double> x, std::span<double> r) const {
    for (std::size_t n = 0; n < records_.size(); ++n) {
      const CalibrationRecord& record = records_[n];
      std::array<double, kPhysicsStates> state{};
      double mean = 0;
      for (std::size_t k = 0; k < record.inputs.size(); ++k) {
        if (k > 0) {
          const PhysicsElement now = element(x, record.inputs[k].current);
          physics_advance(&now, record.inputs[k - 1].velocity, record.inputs[k].velocity,
                          record.time[k] - record.time[k - 1], state.data());
        }
        if (k < record.first) continue;
        const std::size_t at = first_[n] + k - record.first;
        r[at] = record.weight * (state[0] + state[1] - record.force[k]);
        mean += r[at];
      }
      const std::size_t count = first_[n + 1] - first_[n];
      mean /= static_cast<double>(count);
      for (double& one : r.subspan(first_[n], count)) one -= mean;
    }
  }

  /// % of the power that the measured forces have about their means.
  double esr(std::span<const double> x) const {
    std::vector<double> r(samples());
    residuals(x, r);
    double left = 0, all = 0;
    for (std::size_t n = 0; n < records_.size(); ++n) {
      const CalibrationRecord& record = records_[n];
      const double w = record.weight * record.weight;
      double mean = 0;
      const auto count = static_cast<double>(first_[n + 1] - first_[n]);
      for (std::size_t k = record.first; k < record.force.size(); ++k)
        mean += record.force[k] / count;
      for (std::size_t k = record.first; k < record.force.size(); ++k)
        all += (record.force[k] - mean) * (record.force[k] - mean);
      for (std::size_t k = first_[n]; k < first_[n + 1]; ++k) left += r[k] * r[k] / w;
    }
    return 100 * left / all;
  }

 private:
  PhysicsElement element(std::span<const double> x, double current) const {
    PhysicsElement e{};
    e.seal = std::exp(x[kFriction]);
    e.seal_stiffness = e.seal / std::exp(x[kGive]);
    e.yielding = std::exp(x[kYieldScale]) * per_stress_ * member_.yield.at(current);
    e.viscous = std::exp(x[kViscosityScale]) * viscous_;
    e.passive = std::exp(x[kViscosityScale]) * passive_;
    e.stiffness = std::exp(x[kSeries]);
    e.slow = slow_;
    return e;
  }

  /// Weights, the greatest force and stroke, and where each record's residuals begin.
  void add_sizes(const std::string& where) {
    double fastest = 0;
    for (const CalibrationRecord& record : records_) {
      double way = 0, low = 0, high = 0;
      for (std::size_t k = 1; k < record.inputs.size(); ++k) {
        way += (record.time[k] - record.time[k - 1]) * record.inputs[k].velocity;
        low = std::min(low, way);
        high = std::max(high, way);
        fastest = std::max(fastest, std::abs(record.inputs[k].velocity));
      }
      for (const double f : record.force) force_ = std::max(force_, std::abs(f));
      stroke_ = std::max(stroke_, 0.5 * (high - low));
    }
    if (!(stroke_ > 0 && force_ > 0)) throw Error(where, "nothing moves in these recordings");
    slow_ = 1e-3 * fastest;

    for (CalibrationRecord& record : records_) {
      const std::size_t count = record.force.size() - record.first;
      double square = 0;
      for (std::size_t k = record.first; k < record.force.size(); ++k)
        square += record.force[k] * record.force[k];
      const double size = std::max(std::sqrt(square / static_cast<double>(count)), 0.01 * force_);
      record.weight = 1 / (size * std::sqrt(static_cast<double>(count)));
      first_.push_back(first_.back() + count);
    }
  }

  std::vector<CalibrationRecord> records_;
  FamilyMember member_;
  double per_stress_ = 0, viscous_ = 0, passive_ = 0;
  double force_ = 0, stroke_ = 0, slow_ = 0;
  std::vector<std::size_t> first_{0};
};

/// The start from which the residuals are least, of some compliances.
std::vector<double> calibration_start(const CalibrationProblem& problem, double friction) {
  std::vector<double> best, r(problem.samples());
  double least = INFINITY;
  for (const double compliance : {0.3, 0.03, 0.003})
    for (const double give : {0.1, 0.003}) {
      std::vector<double> x(kCalibrationNumbers);
      x[kFriction] = std::log(std::max(friction, 0.02 * problem.force()));
      x[kGive] = std::log(give * problem.stroke());
      x[kSeries] = std::log(problem.force() / (compliance * problem.stroke()));
      problem.residuals(x, r);
      double cost = 0;
      for (const double one : r) cost += one * one;
      if (cost < least) best = x, least = cost;
    }
  return best;
}

/// The numbers with their intervals, and what the recordings cannot tell apart.
void add_numbers(const CalibrationProblem& problem, const LeastSquaresReport& solved,
                 PhysicsCalibration& out) {
  std::vector<double> r(problem.samples());
  problem.residuals(solved.x, r);
  std::vector<std::pair<std::size_t, std::size_t>> segments;
  for (std::size_t n = 0; n + 1 < problem.first().size(); ++n)
    segments.emplace_back(problem.first()[n], problem.first()[n + 1] - problem.first()[n]);
  const std::vector<double> variances = independent_variances(r, segments, kCalibrationNumbers);
  const Covariance known = covariance(solved.part_matrices, variances, kCalibrationNumbers);

  const double wide = normal_quantile(0.975);
  constexpr double kUnknown = 1;  // an interval of e times and more tells nothing
  for (std::size_t k = 0; k < kCalibrationNumbers; ++k) {
    const double sd = std::sqrt(known.matrix[k * kCalibrationNumbers + k]);
    const bool idle = std::ranges::find(known.without_effect, k) != known.without_effect.end();
    out.numbers.push_back({kNumberNames[k].first, kNumberNames[k].second, std::exp(solved.x[k]),
                           std::exp(solved.x[k] - wide * sd), std::exp(solved.x[k] + wide * sd),
                           !idle && wide * sd < kUnknown});
  }
  for (const std::vector<std::size_t>& group : known.confounded) {
    std::vector<std::string> names;
    for (const std::size_t k : group) {
      names.emplace_back(kNumberNames[k].first);
      out.numbers[k].is_known = false;
    }
    out.doubts.push_back("these recordings cannot tell apart " + join(names, " and "));
  }
}

/// By how much the yield stress of each level alone would have to move, to first order.
void add_levels(const CalibrationProblem& problem, const DamperDescription& drawing,
                std::span<const double> x, PhysicsCalibration& out) {
  // The residuals where the fit ended, and a small step of all yield stresses on.
  constexpr double kStep = 1e-4;
  std::vector<double> r(problem.samples()), moved(problem.samples()), at(x.begin(), x.end());
  problem.residuals(at, r);
  at[kYieldScale] += kStep;
  problem.residuals(at, moved);

  // Each level's own least-squares step from there.
  std::map<double, std::pair<double, double>> sums;  // of slope x residual, slope squared
  for (std::size_t n = 0; n < problem.records().size(); ++n) {
    const auto& level = problem.records()[n].level;
    if (!level || *level == 0) continue;
    auto& [product, square] = sums[std::abs(*level)];
    for (std::size_t k = problem.first()[n]; k < problem.first()[n + 1]; ++k) {
      const double slope = (moved[k] - r[k]) / kStep;
      product += slope * r[k];
      square += slope * slope;
    }
  }

  for (const auto& [level, sum] : sums) {
    if (!(sum.second > 0)) continue;
    const FluidState state = fluid_state(drawing, level);
    const double ratio = std::exp(x[kYieldScale] - sum.first / sum.second);
    out.levels.push_back({level, state.field, ratio * state.yield_stress, ratio});
  }
}

/// What is found beyond what the drawing may be off: its recordings may be another damper's.
void add_doubts_of_drawing(const DamperDescription& drawing, PhysicsCalibration& out) {
  // What is taken as usual where a file states no uncertainty. A stated one counts twice, and is
  // never taken for better than temperatures are known.
  constexpr double kViscosity = 2, kTrend = 1.3, kBestKnown = 0.1;
  const std::string right =
      ": is the drawing that of the damper which was recorded, with its fluid";

  // The viscosity, where all of its interval is too far.
  const PhysicsCalibration::Number& viscosity = out.numbers[kViscosityScale];
  const double stated = drawing.fluid->viscosity_uncertainty;
  const double allowed = stated > 0 ? 1 + 2 * std::max(stated, kBestKnown) : kViscosity;
  if (viscosity.is_known && (viscosity.low > allowed || viscosity.high < 1 / allowed))
    out.doubts.push_back("the viscosity is " + format_number(viscosity.value, 3) +
                         " times the file's, which is off by a factor of " +
                         format_number(allowed, 3) + " at most" + right +
                         " and at its temperature?");

  // The shape of tau(H) times that of the steel, which one factor for all currents leaves.
  if (out.levels.empty()) return;
  const auto [least, greatest] =
      std::ranges::minmax(out.levels, {}, &PhysicsCalibration::Level::ratio);
  if (greatest.ratio > kTrend * least.ratio)
    out.doubts.push_back("the yield stress is " + format_number(least.ratio, 3) +
                         " times the file's at " + format_number(least.current) + " A and " +
                         format_number(greatest.ratio, 3) + " times at " +
                         format_number(greatest.current) + " A" + right + " and magnetic circuit?");
}

}  // namespace

PhysicsCalibration calibrate_physics(const DamperDescription& drawing, const Dataset& recordings,
                                     const Monitor& monitor) {
  require_field(drawing, drawing.name);
  if (drawing.fluid->index != 1)
    throw Error(drawing.fluid->name,
                "is a Herschel-Bulkley fluid; the calibration takes a Bingham fluid",
                "a fluid file without herschel_bulkley");
  if (recordings.drive_unit != DriveUnit::Ampere)
    throw Error(recordings.name, "is driven by " + to_string(recordings.drive_unit),
                "recordings whose coil current is known, in A");
  const CalibrationProblem problem(drawing, recordings);

  // Every number is found by its logarithm, within what a damper can have.
  LeastSquaresProblem squares;
  squares.residuals = problem.samples();
  squares.parts.assign(problem.first().begin(), problem.first().end() - 1);
  const std::vector<double> start = calibration_start(problem, drawing.friction);
  for (std::size_t k = 0; k < kCalibrationNumbers; ++k) {
    const double far = k == kFriction ? 7 : 5;
    squares.lower.push_back(start[k] - far);
    squares.upper.push_back(start[k] + far);
  }
  squares.residual = [&](std::span<const double> x, std::span<double> r) {
    problem.residuals(x, r);
    return true;
  };
  LeastSquaresOptions options;
  options.difference_step = 1e-5;
  options.on_iteration = [&](int iteration, double, std::span<const double>) {
    monitor.report("calibrate", static_cast<double>(iteration) / options.max_iterations);
  };
  const LeastSquaresReport solved = solve(squares, start, options);

  PhysicsCalibration out;
  out.converged = solved.converged;
  add_numbers(problem, solved, out);
  add_levels(problem, drawing, solved.x, out);
  add_doubts_of_drawing(drawing, out);

  // The drawing by itself: stiff, with its own friction.
  std::vector<double> stiff = start;
  stiff[kFriction] = std::log(std::max(drawing.friction, 1e-6 * problem.force()));
  stiff[kGive] = std::log(1e-4 * problem.stroke());
  stiff[kSeries] = std::log(1e4 * problem.force() / problem.stroke());
  out.esr_before = problem.esr(stiff);
  out.esr_after = problem.esr(solved.x);

  // The calibrated fluid: its law times what was found, known as well as that is.
  Fluid fluid = *drawing.fluid;
  FluidLaw law = drawing.law();
  const auto spread = [&](CalibrationIndex k) {
    const PhysicsCalibration::Number& number = out.numbers[k];
    return std::min(1., std::log(number.high / number.low) / (2 * normal_quantile(0.975)));
  };
  law.scale *= out.numbers[kYieldScale].value;
  law.faults.clear();
  fluid.name += "_calibrated";
  fluid.note = "calibrated on " + recordings.name;
  fluid.laws = {law};
  for (auto& [temperature, viscosity] : fluid.viscosities)
    viscosity *= out.numbers[kViscosityScale].value;
  fluid.yield_uncertainty = spread(kYieldScale);
  fluid.viscosity_uncertainty = spread(kViscosityScale);
  out.damper = drawing;
  if (out.damper.viscosity > 0) out.damper.viscosity *= out.numbers[kViscosityScale].value;
  out.damper.fluid = std::make_shared<const Fluid>(std::move(fluid));
  out.damper.yield_law = law.name;
  out.damper.friction = out.numbers[kFriction].value;
  if (!out.converged) out.doubts.emplace_back("the fit did not converge");
  return out;
}

}  // namespace dashpot
