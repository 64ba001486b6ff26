#include "dashpot/identify/fit/family_gates_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "dashpot/damper/nets/standardise.h"
#include "dashpot/error.h"
#include "dashpot/identify/fit/free_run_records.h"
#include "dashpot/identify/judge/stroke.h"
#include "dashpot/numerics/linear_algebra.h"

namespace dashpot {
namespace {

constexpr std::size_t kGates = FamilyGates::kGates, kQuantities = FamilyGates::kQuantities;
// Rates of the bank: Dahl's times the mean way between two turns, lags times its duration.
constexpr double kSlowestWay = 1, kFastestWay = 30, kSlowestLag = 1, kFastestLag = 60;
constexpr std::array<double, FamilyGates::kSoftSpeeds> kSoftShares{0.1, 0.3};  // of the top speed
// B_sat / k of the saturating circuit behind the published yield stresses: 1.40056 T / (2.15216
// T/A).
constexpr double kHalfCurrent = 0.65077;
// The ridge of the other gates, per sample, terms and gates standardised.
constexpr std::array kRidges{0.003, 0.01, 0.03};
// The ridge of gates with geometry in them is greater by one of these factors.
constexpr std::array kGeometryFactors{3.0, 10.0, 30.0};
constexpr std::size_t kLateStarts = 6;
constexpr double kLateShare = 1;     // of runs that begin while the piston moves, beside 1
constexpr double kBaseRidge = 1e-4;  // the ridge of every weight

/// Sums over one record's samples: F'F, t'F and t't, terms standardised.
struct RecordSums {
  std::array<double, kGates> open;
  std::vector<double> across, square;
  double energy = 0, samples = 0;
  std::size_t design = 0, damper = 0;
};

struct Ridge {
  double field = 0, geometry = 0;
};

HysteresisBank bank_of(const FamilyPreset& preset, const std::vector<FamilyRecord>& records) {
  // The shortest and the longest of the records' strokes, in way and in duration.
  Stroke shortest{INFINITY, INFINITY}, longest;
  for (const FamilyRecord& record : records) {
    const Stroke stroke = mean_stroke(record.inputs, record.time);
    if (!(stroke.way > 0)) continue;
    shortest = {std::min(shortest.way, stroke.way), std::min(shortest.duration, stroke.duration)};
    longest = {std::max(longest.way, stroke.way), std::max(longest.duration, stroke.duration)};
  }
  if (!(longest.way > 0)) throw Error(std::string(preset.name), "nothing moves in these records");

  // Dahl rates cover the ways, lag rates the durations.
  HysteresisBank bank;
  bank.path_rates =
      spaced_rates(kSlowestWay / longest.way, kFastestWay / shortest.way, preset.path_states);
  bank.velocity_rates = spaced_rates(kSlowestLag / longest.duration,
                                     kFastestLag / shortest.duration, preset.velocity_lags);
  return bank;
}

/// Gates whose quantities are standardised; a quantity that is the same in all records leaves its
/// gates shut.
FamilyGates starting_gates(const FamilyPreset& preset, const std::vector<FamilyRecord>& records) {
  FamilyGates gates;
  gates.bank = bank_of(preset, records);
  gates.half_current = kHalfCurrent;

  // The quantities of every record, and the top speed of all.
  double top = 0;
  std::vector<double> quantities;
  for (const FamilyRecord& record : records) {
    const auto q = gates.quantities(record.member, record.inputs.front().current);
    quantities.insert(quantities.end(), q.begin(), q.end());
    for (const DamperInput& input : record.inputs) top = std::max(top, std::abs(input.velocity));
  }

  // Standardise the quantities; the terms have scale 1 until their sums are known.
  for (std::size_t n = 0; n < kQuantities; ++n)
    std::tie(gates.mean[n], gates.scale[n]) = mean_and_scale(quantities, n, kQuantities);
  for (const double share : kSoftShares) gates.soft_speeds.push_back(share * top);
  gates.term_scale.assign(gates.term_count(), 1);
  return gates;
}

/// Adds the scored samples of a free run from rest at `start`, each counting so much.
void add_run(const FamilyGates& gates, const FamilyRecord& record, std::size_t start, double weight,
             RecordSums& sums) {
  const std::size_t terms = gates.term_count();
  std::vector<double> state(gates.bank.size()), t(terms);

  // Run the bank through the record; samples before the first scored one only move it.
  gates.bank.rest(record.inputs[start], state);
  for (std::size_t k = start; k < record.inputs.size(); ++k) {
    if (k > start)
      gates.bank.advance(record.inputs[k - 1], record.inputs[k],
                         record.time[k] - record.time[k - 1], state);
    if (k < record.first) continue;

    // Add the sample's products; `square` is symmetric, and its lower triangle is enough.
    gates.read_terms(record.inputs[k], state, t.data());
    for (std::size_t i = 0; i < terms; ++i) {
      sums.across[i] += weight * t[i] * record.force[k];
      for (std::size_t j = 0; j <= i; ++j) sums.square[i * terms + j] += weight * t[i] * t[j];
    }
    sums.energy += weight * record.force[k] * record.force[k];
    sums.samples += weight;
  }
}

/// A run from the record's start, and some that begin while the piston moves, over two strokes
/// from the first scored sample on: what moved before is not always known.
void add_runs(const FamilyGates& gates, const FamilyRecord& record, RecordSums& sums) {
  add_run(gates, record, 0, 1, sums);
  const double until =
      record.time[record.first] + 2 * mean_stroke(record.inputs, record.time).duration;
  const auto end =
      static_cast<std::size_t>(std::ranges::lower_bound(record.time, until) - record.time.begin());
  for (std::size_t k = 0; k < kLateStarts; ++k)
    add_run(gates, record, record.first + (end - record.first) * k / kLateStarts,
            kLateShare / kLateStarts, sums);
}

/// The records' sums, and the ridge over them.
class GateSums {
 public:
  GateSums(FamilyGates& gates, const std::vector<FamilyRecord>& records)
      : terms_(gates.term_count()) {
    for (const FamilyRecord& record : records) {
      RecordSums sums{
          FamilyGates::gates(gates.quantities(record.member, record.inputs.front().current)),
          std::vector<double>(terms_), std::vector<double>(terms_ * terms_)};
      add_runs(gates, record, sums);
      sums_.push_back(std::move(sums));
    }
    standardise(gates);
    number_designs(records);
  }

  std::size_t designs() const { return designs_; }

  /// The weights W that fit all records but those of this design; with designs() all records.
  std::vector<double> solve(Ridge ridge, std::size_t without) const {
    // The normal equations over all other designs.
    const std::size_t n = terms_ * kGates;
    std::vector<double> matrix(n * n), right(n), weights(n);
    double samples = 0;
    for (const RecordSums& r : sums_) {
      if (r.design == without) continue;
      add(r, matrix, right);
      samples += r.samples;
    }

    // The ridge: every weight has a little, those of all gates but the constant one more, those of
    // gates with geometry in them most.
    const auto exponents = FamilyGates::exponents();
    for (std::size_t u = 0; u < n; ++u) {
      const auto& powers = exponents[u % kGates];
      const bool constant = u % kGates == 0, geometric = powers[2] + powers[3] > 0;
      const double strength = constant ? 0 : ridge.field * (geometric ? ridge.geometry : 1);
      matrix[u * n + u] += samples * (kBaseRidge + strength);
    }

    if (!solve_positive_definite(matrix, right, weights))
      throw Error("family", "the records do not tell one weight from another");
    return weights;
  }

  /// The squared error, N^2, that these weights leave on the records of a design.
  double squares_left(const std::vector<double>& weights, std::size_t design) const {
    double left = 0;
    for (const RecordSums& r : sums_)
      if (r.design == design) {
        const auto [across, square] = predicted(weights, r);
        left += r.energy - 2 * across + square;
      }
    return left;
  }

  /// For each damper of a design: the factor that would bring its predicted force nearest to the
  /// measured one.
  std::vector<double> strengths(const std::vector<double>& weights, std::size_t design) const {
    std::map<std::size_t, std::pair<double, double>> dampers;
    for (const RecordSums& r : sums_)
      if (r.design == design) {
        const auto [across, square] = predicted(weights, r);
        dampers[r.damper].first += across;
        dampers[r.damper].second += square;
      }
    std::vector<double> factors;
    for (const auto& [damper, sums] : dampers) factors.push_back(sums.first / sums.second);
    return factors;
  }

 private:
  void standardise(FamilyGates& gates) {
    // A term's scale is the root of its mean square over all records.
    double samples = 0;
    std::vector<double> squares(terms_);
    for (const RecordSums& r : sums_) {
      samples += r.samples;
      for (std::size_t i = 0; i < terms_; ++i) squares[i] += r.square[i * terms_ + i];
    }
    for (std::size_t i = 0; i < terms_; ++i)
      if (squares[i] > 0) gates.term_scale[i] = std::sqrt(squares[i] / samples);

    // Bring the sums to these scales, and fill the upper triangle.
    for (RecordSums& r : sums_)
      for (std::size_t i = 0; i < terms_; ++i) {
        r.across[i] /= gates.term_scale[i];
        for (std::size_t j = 0; j <= i; ++j) {
          r.square[i * terms_ + j] /= gates.term_scale[i] * gates.term_scale[j];
          r.square[j * terms_ + i] = r.square[i * terms_ + j];
        }
      }
  }

  void number_designs(const std::vector<FamilyRecord>& records) {
    // Number geometries, fluids and builds as they come; a damper is one of each.
    std::map<std::array<double, 4>, std::size_t> geometries;
    std::map<double, std::size_t> fluids, builds;
    std::vector<std::size_t> of_fluid;
    for (std::size_t k = 0; k < records.size(); ++k) {
      const FamilyMember& m = records[k].member;
      const std::size_t geometry =
          geometries
              .try_emplace({m.piston_area, m.gap_area, m.gap, m.pole_length}, geometries.size())
              .first->second;
      const std::size_t fluid = fluids.try_emplace(m.viscosity, fluids.size()).first->second;
      const std::size_t build =
          builds.try_emplace(records[k].specimen, builds.size()).first->second;
      sums_[k].damper = (geometry * records.size() + fluid) * records.size() + build;
      sums_[k].design = geometry;
      of_fluid.push_back(fluid);
    }

    // With one geometry only, each fluid is a design.
    designs_ = geometries.size();
    if (designs_ > 1) return;
    for (std::size_t k = 0; k < sums_.size(); ++k) sums_[k].design = of_fluid[k];
    designs_ = fluids.size();
  }

  /// Adds a record to the normal equations, the lower triangle of the matrix only.
  void add(const RecordSums& r, std::vector<double>& matrix, std::vector<double>& right) const {
    const std::size_t n = terms_ * kGates;
    for (std::size_t i = 0; i < terms_; ++i)
      for (std::size_t k = 0; k < kGates; ++k) {
        right[i * kGates + k] += r.across[i] * r.open[k];
        double* row = &matrix[(i * kGates + k) * n];
        for (std::size_t j = 0; j <= i; ++j) {
          const double product = r.square[i * terms_ + j] * r.open[k];
          for (std::size_t l = 0; l < kGates; ++l) row[j * kGates + l] += product * r.open[l];
        }
      }
  }

  /// The predicted force times the measured one, and times itself, summed over a record.
  std::pair<double, double> predicted(const std::vector<double>& weights,
                                      const RecordSums& r) const {
    std::vector<double> a(terms_);
    for (std::size_t i = 0; i < terms_; ++i)
      for (std::size_t k = 0; k < kGates; ++k) a[i] += weights[i * kGates + k] * r.open[k];
    double across = 0, square = 0;
    for (std::size_t i = 0; i < terms_; ++i) {
      across += a[i] * r.across[i];
      for (std::size_t j = 0; j < terms_; ++j) square += a[i] * r.square[i * terms_ + j] * a[j];
    }
    return {across, square};
  }

  std::size_t terms_, designs_ = 0;
  std::vector<RecordSums> sums_;
};

/// The ridges with which each design is predicted best from the others.
Ridge best_ridge(const GateSums& sums, const Monitor& monitor) {
  Ridge best{kRidges[1], kGeometryFactors[1]};
  if (sums.designs() < 2) return best;

  // Try each pair of ridges: each design is predicted from all others.
  double least = INFINITY;
  for (const double field : kRidges)
    for (const double geometry : kGeometryFactors) {
      monitor.check();
      double left = 0;
      for (std::size_t d = 0; d < sums.designs(); ++d)
        left += sums.squares_left(sums.solve({field, geometry}, d), d);
      if (left >= least) continue;
      least = left;
      best = {field, geometry};
    }
  return best;
}

/// The root of the mean square of builds' strengths beyond 1, with its interval by Wilson and
/// Hilferty's approximation of chi squared.
void add_spread(const GateSums& sums, Ridge ridge, FamilyGatesFit& fit) {
  // The strengths of the dampers of each design, predicted from all others.
  double square = 0, n = 0;
  for (std::size_t d = 0; sums.designs() > 1 && d < sums.designs(); ++d)
    for (const double factor : sums.strengths(sums.solve(ridge, d), d)) {
      square += (factor - 1) * (factor - 1);
      ++n;
    }
  if (n == 0) return;

  // Their spread and its 95 % interval; with two dampers or fewer it is open upwards.
  fit.build_spread = std::sqrt(square / n);
  const auto end = [&](double z) {
    const double c = 2 / (9 * n), root = 1 - c + z * std::sqrt(c);
    return fit.build_spread / std::sqrt(root * root * root);
  };
  fit.spread_low = end(1.96);
  fit.spread_high = n > 2 ? end(-1.96) : INFINITY;
}

}  // namespace

FamilyGatesFit fit_family_gates(const FamilyPreset& preset,
                                const std::vector<FamilyRecord>& records, const Monitor& monitor) {
  FamilyGatesFit fit;
  fit.gates = starting_gates(preset, records);
  const GateSums sums(fit.gates, records);
  const Ridge ridge = best_ridge(sums, monitor);
  fit.gates.weights = sums.solve(ridge, sums.designs());
  add_spread(sums, ridge, fit);
  return fit;
}

}  // namespace dashpot
