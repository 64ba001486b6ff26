#include "dashpot/identify/judge/error_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/base/random.h"
#include "dashpot/error.h"
#include "dashpot/numerics/linear_algebra.h"
#include "dashpot/value.h"

namespace dashpot {
namespace {

using Lagged = std::array<double, ErrorTerms::kLags>;

/// Brings the low-passes of the velocity dt seconds further; the velocity is linear in between.
void follow(double from, double to, double dt, std::span<double, ErrorTerms::kLags> z) {
  z[0] = to;
  if (!(dt > 0)) return;
  for (std::size_t k = 1; k < z.size(); ++k) {
    const double lag = ErrorTerms::kLag[k], slope = (to - from) / dt;
    z[k] = to - slope * lag + (z[k] - from + slope * lag) * std::exp(-dt / lag);
  }
}

/// The place of a value between knots: of the knot below it, and the share of the one above.
struct Place {
  std::size_t below = 0;
  double share = 0;
};
Place place(const std::vector<double>& knots, double value) noexcept {
  if (!(value > knots.front())) return {};
  if (value >= knots.back()) return {knots.size() - 1, 0};
  const auto above = std::ranges::upper_bound(knots, value) - knots.begin();
  const auto k = static_cast<std::size_t>(above - 1);
  return {k, (value - knots[k]) / (knots[k + 1] - knots[k])};
}

/// Calls use(index, share) for the knots about a point of a plane; the drive runs fastest.
template <class Use>
void about(Place row, Place drive, std::size_t drives, Use use) noexcept {
  for (const auto& [k, across] : {std::pair(row.below, 1 - row.share), {row.below + 1, row.share}})
    for (const auto& [d, along] :
         {std::pair(drive.below, 1 - drive.share), {drive.below + 1, drive.share}})
      if (across > 0 && along > 0) use(k * drives + d, across * along);
}

/// The same for every weight of b that has a part in the force there.
template <class Use>
void each_weight(const ErrorTerms& terms, std::span<const double, ErrorTerms::kLags> z,
                 const DamperInput& input, Use use) noexcept {
  const Place drive = place(terms.drives, input.current);
  const std::size_t drives = terms.drives.size(), one = terms.velocities.size() * drives;
  for (std::size_t k = 0; k < z.size(); ++k)
    about(place(terms.velocities, z[k]), drive, drives,
          [&](std::size_t at, double share) { use(k * one + at, share); });
  about(place(terms.displacements, input.displacement), drive, drives,
        [&](std::size_t at, double share) { use(z.size() * one + at, share); });
}

/// Likewise for every class of the noise.
template <class Use>
void each_class(const ErrorTerms& terms, const DamperInput& input, Use use) noexcept {
  about(place(terms.speeds, std::abs(input.velocity)), place(terms.drives, input.current),
        terms.drives.size(), use);
}

class ErringDamper final : public DamperModel {
 public:
  ErringDamper(std::shared_ptr<const DamperModel> model, std::shared_ptr<const ErrorDraw> error)
      : model_(std::move(model)), error_(std::move(error)), inside_(model_->state_size()) {}

  ModelKind kind() const override { return ModelKind::Other; }
  std::string name() const override { return model_->name(); }
  bool needs_displacement() const noexcept override { return true; }
  std::size_t parameter_count() const noexcept override { return model_->parameter_count(); }
  /// The model's, then the low-passes, then the time.
  std::size_t state_size() const noexcept override { return inside_ + ErrorTerms::kLags + 1; }

  void rest(const DamperInput& input, std::span<double> state) const noexcept override {
    model_->rest(input, state.first(inside_));
    std::ranges::fill(state.subspan(inside_), 0.0);
  }
  void advance(const DamperInput& from, const DamperInput& to, double dt,
               std::span<double> state) const noexcept override {
    model_->advance(from, to, dt, state.first(inside_));
    follow(from.velocity, to.velocity, dt,
           std::span<double, ErrorTerms::kLags>(state.subspan(inside_, ErrorTerms::kLags)));
    state.back() += dt;
  }
  double force(const DamperInput& input, std::span<const double> state) const noexcept override {
    return model_->force(input, state.first(inside_)) + error(input, state);
  }
  bool flows() const noexcept override { return model_->flows(); }
  double flow(const DamperInput& input, std::span<const double> state,
              std::span<double> rates) const noexcept override {
    for (std::size_t k = 1; k < ErrorTerms::kLags; ++k)
      rates[inside_ + k] = (input.velocity - state[inside_ + k]) / ErrorTerms::kLag[k];
    rates[inside_] = 0;  // the velocity itself is read from the input
    rates[state_size() - 1] = 1;
    return model_->flow(input, state.first(inside_), rates.first(inside_)) + error(input, state);
  }
  bool has_diverged(std::span<const double> state) const noexcept override {
    return model_->has_diverged(state.first(inside_));
  }
  double feedback_step() const noexcept override { return model_->feedback_step(); }
  std::unique_ptr<DamperModel> with_offset(double newton) const override {
    return std::make_unique<ErringDamper>(model_->with_offset(newton), error_);
  }
  Value to_json() const override { return model_->to_json(); }

 private:
  double error(const DamperInput& input, std::span<const double> state) const noexcept {
    Lagged z;
    std::copy_n(state.begin() + static_cast<std::ptrdiff_t>(inside_), z.size(), z.begin());
    z[0] = input.velocity;
    double sum = 0;
    each_weight(*error_->terms, z, input,
                [&](std::size_t k, double share) { sum += share * error_->weights[k]; });

    // The noise lasts as long as it was made for.
    const double at = std::max(0.0, state.back()) / ErrorDraw::kNoiseStep;
    const auto below = static_cast<std::size_t>(at);
    const double share = at - static_cast<double>(below);
    each_class(*error_->terms, input, [&](std::size_t k, double part) {
      const std::vector<double>& noise = error_->noise[k];
      if (below + 1 < noise.size())
        sum += part * ((1 - share) * noise[below] + share * noise[below + 1]);
    });
    return sum;
  }

  std::shared_ptr<const DamperModel> model_;
  std::shared_ptr<const ErrorDraw> error_;
  std::size_t inside_;
};

/// What the error model learns from: a record, or a stretch of one.
struct Stretch {
  const RecordResult* record;
  std::size_t begin, end;
};

/// Few records are divided in time.
std::vector<Stretch> stretches_of(const std::vector<RecordResult>& records) {
  std::vector<const RecordResult*> whole;
  for (const RecordResult& record : records)
    if (!record.diverged_at && record.measured.size() > record.warm_up) whole.push_back(&record);
  if (whole.empty())
    throw Error("error of the model", "it has no finite error on a left-out record",
                "records that its fits have not seen, on which it does not diverge");

  std::vector<Stretch> stretches;
  const std::size_t each = (RidgeRegression::kParts + whole.size() - 1) / whole.size();
  for (const RecordResult* record : whole)
    for (std::size_t part = 0; part < each; ++part) {
      const std::size_t n = record->measured.size() - record->warm_up;
      stretches.push_back(
          {record, record->warm_up + part * n / each, record->warm_up + (part + 1) * n / each});
    }
  std::erase_if(stretches, [](const Stretch& s) { return s.begin == s.end; });
  return stretches;
}

DamperInput input_at(const RecordResult& r, std::size_t k) {
  return {r.displacement.empty() ? 0 : r.displacement[k], r.velocity[k], r.drive[k]};
}

/// Calls use(sample, input, low-passes) for each sample of a stretch.
template <class Use>
void run_over(const Stretch& stretch, Use use) {
  const RecordResult& r = *stretch.record;
  Lagged z{};
  z.fill(r.velocity.front());
  for (std::size_t k = 0; k < stretch.end; ++k) {
    if (k > 0) follow(r.velocity[k - 1], r.velocity[k], r.time[k] - r.time[k - 1], z);
    if (k >= stretch.begin) use(k, input_at(r, k), z);
  }
}

std::vector<double> evenly(double low, double high, int steps) {
  if (!(low < high)) return {low};
  std::vector<double> knots;
  for (int k = 0; k <= steps; ++k) knots.push_back(low + (high - low) * k / steps);
  return knots;
}

ErrorTerms terms_of(const std::vector<Stretch>& stretches) {
  double fastest = 0, least = INFINITY, greatest = -INFINITY, low = INFINITY, high = -INFINITY;
  for (const Stretch& stretch : stretches)
    for (std::size_t k = stretch.begin; k < stretch.end; ++k) {
      const DamperInput input = input_at(*stretch.record, k);
      fastest = std::max(fastest, std::abs(input.velocity));
      least = std::min(least, input.displacement);
      greatest = std::max(greatest, input.displacement);
      low = std::min(low, input.current);
      high = std::max(high, input.current);
    }

  // Knots lie closest where valves open.
  ErrorTerms terms{.velocities = {0},
                   .displacements = evenly(least, greatest, 4),
                   .drives = evenly(low, high, 2),
                   .speeds = {0, 0.1 * fastest, 0.4 * fastest, fastest}};
  for (const double share : {0.02, 0.05, 0.12, 0.25, 0.5, 1.0}) {
    terms.velocities.push_back(share * fastest);
    terms.velocities.insert(terms.velocities.begin(), -share * fastest);
  }
  return terms;
}

RidgeRegression::Unit sums_over(const Stretch& stretch, const ErrorTerms& terms) {
  const std::size_t n = terms.weights();
  RidgeRegression::Unit unit{std::vector<double>(n * n), std::vector<double>(n)};
  const double weight = 1 / static_cast<double>(stretch.end - stretch.begin);
  run_over(stretch, [&](std::size_t k, const DamperInput& input, const Lagged& z) {
    std::array<std::pair<std::size_t, double>, 4 * (ErrorTerms::kLags + 1)> row;
    std::size_t size = 0;
    each_weight(terms, z, input, [&](std::size_t at, double share) { row[size++] = {at, share}; });
    const double error = stretch.record->measured[k] - stretch.record->modelled[k];
    for (const auto& [a, share] : std::span(row).first(size)) {
      unit.right[a] += weight * share * error;
      for (const auto& [b, other] : std::span(row).first(size))
        unit.matrix[a * n + b] += weight * share * other;
    }
    unit.power += weight * error * error;
  });
  return unit;
}

/// The error that b leaves on a stretch, N, sample by sample.
std::vector<double> left_on(const Stretch& stretch, const ErrorTerms& terms,
                            std::span<const double> weights) {
  std::vector<double> left;
  run_over(stretch, [&](std::size_t k, const DamperInput& input, const Lagged& z) {
    left.push_back(stretch.record->measured[k] - stretch.record->modelled[k]);
    each_weight(terms, z, input,
                [&](std::size_t at, double share) { left.back() -= share * weights[at]; });
  });
  return left;
}

constexpr double kColourLag = 4e-3;  // s

/// Of a class of the noise: its power, and how it lives on after one and after two lags.
struct ColourSums {
  double weight = 0, power = 0, once = 0, twice = 0;
};

void add_colour(const Stretch& stretch, const ErrorTerms& terms, const std::vector<double>& left,
                std::vector<ColourSums>& sums) {
  const RecordResult& r = *stretch.record;
  const double dt = (r.time.back() - r.time.front()) / static_cast<double>(r.time.size() - 1);
  const auto lag = static_cast<std::size_t>(std::max(1.0, std::round(kColourLag / dt)));
  for (std::size_t k = 0; k + 2 * lag < left.size(); ++k)
    each_class(terms, input_at(r, stretch.begin + k), [&](std::size_t at, double share) {
      const double weight = share / static_cast<double>(left.size());
      sums[at].weight += weight;
      sums[at].power += weight * left[k] * left[k];
      sums[at].once += weight * left[k] * left[k + lag];
      sums[at].twice += weight * left[k] * left[k + 2 * lag];
    });
}

}  // namespace

std::vector<double> RidgeRegression::weights(std::span<const double> counts, double penalty) const {
  const std::size_t n = units.front().right.size();
  std::vector<double> matrix(n * n), right(n), w(n);
  double total = 0;
  for (std::size_t u = 0; u < units.size(); ++u) {
    if (counts[u] == 0) continue;
    total += counts[u];
    for (std::size_t k = 0; k < n * n; ++k) matrix[k] += counts[u] * units[u].matrix[k];
    for (std::size_t k = 0; k < n; ++k) right[k] += counts[u] * units[u].right[k];
  }
  for (std::size_t k = 0; k < n; ++k) matrix[k * n + k] += penalty * total / static_cast<double>(n);
  solve_positive_definite(matrix, right, w);
  return w;
}

std::vector<double> RidgeRegression::weights_without(std::size_t part, double penalty) const {
  std::vector<double> counts(units.size(), 1);
  for (std::size_t u = part; u < counts.size(); u += kParts) counts[u] = 0;
  return weights(counts, penalty);
}

double RidgeRegression::power_left(std::size_t part, std::span<const double> w) const {
  double power = 0;
  for (std::size_t u = part; u < units.size(); u += kParts) {
    power += units[u].power;
    for (std::size_t a = 0; a < w.size(); ++a) {
      double sum = -2 * units[u].right[a];
      for (std::size_t b = 0; b < w.size(); ++b) sum += units[u].matrix[a * w.size() + b] * w[b];
      power += w[a] * sum;
    }
  }
  return power;
}

ErrorModel::ErrorModel(const std::vector<RecordResult>& left_out) {
  const std::vector<Stretch> stretches = stretches_of(left_out);
  const auto terms = std::make_shared<ErrorTerms>(terms_of(stretches));
  for (const Stretch& stretch : stretches) regression_.units.push_back(sums_over(stretch, *terms));

  // The penalty that predicts best what was left out; the greatest leaves no b at all.
  constexpr std::size_t kParts = RidgeRegression::kParts;
  double least = INFINITY;
  for (const double penalty : {1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0, 1e9}) {
    double left = 0;
    for (std::size_t part = 0; part < kParts; ++part)
      left += regression_.power_left(part, regression_.weights_without(part, penalty));
    if (left < least) least = left, penalty_ = penalty;
  }
  unexplained_ = std::sqrt(least / static_cast<double>(stretches.size()));

  // Size and colour of what is left there.
  std::vector<ColourSums> sums(terms->classes());
  for (std::size_t part = 0; part < kParts; ++part) {
    const std::vector<double> w = regression_.weights_without(part, penalty_);
    for (std::size_t u = part; u < stretches.size(); u += kParts)
      add_colour(stretches[u], *terms, left_on(stretches[u], *terms, w), sums);
  }

  // An autoregression beside white noise: the ratio of the two lags is its decay, and what it would
  // have been at no lag its power.
  for (const ColourSums& s : sums) {
    NoiseClass noise{0, 1 / kColourLag};
    if (s.once > 0) {
      const double decay = std::clamp(s.twice / s.once, 0.5, 0.999);
      noise.rate = -std::log(decay) / kColourLag;
      noise.size = std::sqrt(std::min(s.power, s.once / decay) / s.weight);
    }
    classes_.push_back(noise);
  }
  terms_ = terms;
}

ErrorDraw ErrorModel::draw(double duration, std::uint64_t seed) const {
  Random random(seed);

  // Each unit counts at random, one on average.
  std::vector<double> counts;
  for (std::size_t u = 0; u < regression_.units.size(); ++u)
    counts.push_back(-std::log(1 - random.uniform()));
  ErrorDraw draw{terms_, regression_.weights(counts, penalty_), {}};

  // How much of the noise is the damper's and not the sensors' no recording says. All classes are
  // moved by the same chance, so that the noise is whole between them.
  const double ours = random.uniform();
  const auto samples = static_cast<std::size_t>(duration / ErrorDraw::kNoiseStep) + 2;
  std::vector<double> chance(samples);
  for (double& value : chance) value = random.normal();
  for (const NoiseClass& noise : classes_) {
    const double keeps = std::exp(-noise.rate * ErrorDraw::kNoiseStep);
    const double size = ours * noise.size, fresh = size * std::sqrt(1 - keeps * keeps);
    std::vector<double> values{size * chance.front()};
    for (std::size_t k = 1; k < samples; ++k)
      values.push_back(keeps * values.back() + fresh * chance[k]);
    draw.noise.push_back(std::move(values));
  }
  return draw;
}

std::shared_ptr<const DamperModel> erring(std::shared_ptr<const DamperModel> model,
                                          ErrorDraw error) {
  return std::make_shared<ErringDamper>(std::move(model),
                                        std::make_shared<const ErrorDraw>(std::move(error)));
}

}  // namespace dashpot
