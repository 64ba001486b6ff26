#include "dashpot/machine/plant_step.h"

#include <algorithm>
#include <cmath>

#include "dashpot/damper/law_side.h"
#include "dashpot/numerics/linear_algebra.h"

namespace dashpot {
namespace {

constexpr std::size_t kCubic = 4;  // coefficients

/// exp of the plant's rates over a step, count x count at the top left of a matrix that has, beside
/// it, what a push of t^k / (k! length^k) along `push` (n, an acceleration) does, k = 0 ... 3.
std::vector<double> response_of(const PlantNumbers& plant, const std::vector<double>& push,
                                double length) {
  const std::size_t n = plant.size, size = 2 * n + kCubic;
  std::vector<double> rates(size * size);
  for (std::size_t i = 0; i < n; ++i) {
    rates[i * size + n + i] = length;
    for (std::size_t k = 0; k < n; ++k) {
      rates[(n + i) * size + k] = -length * plant.stiffness[i * n + k];
      rates[(n + i) * size + n + k] = -length * plant.damping[i * n + k];
    }
    rates[(n + i) * size + 2 * n] = length * push[i];
  }
  for (std::size_t k = 0; k + 1 < kCubic; ++k) rates[(2 * n + k) * size + 2 * n + k + 1] = 1;
  return exponential(rates, size);
}

/// Columns of a response, one after the other: the plant's own, count of them, and the four beside
/// them.
std::vector<double> columns_of(const std::vector<double>& response, std::size_t count,
                               std::size_t first, std::size_t columns) {
  std::vector<double> out;
  for (std::size_t k = first; k < first + columns; ++k)
    for (std::size_t i = 0; i < count; ++i) out.push_back(response[i * (count + kCubic) + k]);
  return out;
}
std::vector<double> beside(const std::vector<double>& response, std::size_t count) {
  return columns_of(response, count, count, kCubic);
}

}  // namespace

PlantStep::PlantStep(const PlantNumbers& plant, double length)
    : count_(2 * plant.size), length_(length) {
  // A damper's force, which resists: its value at the start, and its change until the end.
  for (std::vector<double> push : plant.by_force) {
    for (double& value : push) value = -value;
    const std::vector<double> response = response_of(plant, push, length);
    const std::vector<double> forced = beside(response, count_);
    free_ = columns_of(response, count_, 0, count_);
    by_force_.emplace_back();
    by_end_force_.emplace_back();
    for (std::size_t i = 0; i < count_; ++i) {
      by_end_force_.back().push_back(forced[count_ + i]);
      by_force_.back().push_back(forced[i] - forced[count_ + i]);
    }
  }

  // An input pushes by its value, and by its rate, whose coefficients are those of one power more.
  for (std::size_t u = 0; u < plant.by_value.size(); ++u) {
    std::vector<double> by_input = beside(response_of(plant, plant.by_value[u], length), count_);
    const std::vector<double> by_rate =
        beside(response_of(plant, plant.by_rate[u], length), count_);
    for (std::size_t k = count_; k < by_input.size(); ++k)
      by_input[k] += by_rate[k - count_] / length;
    by_input_.push_back(std::move(by_input));
  }
}

/// With the number of states known where it is compiled, for loops without a count; 0: any.
template <std::size_t kCount>
void PlantStep::end_of(const PlantInputSamples& inputs, std::size_t point, const double* state,
                       const double* forces, double* end) const {
  const std::size_t count = kCount > 0 ? kCount : count_;
  std::array<double, kCount> own;
  double* const sum = kCount > 0 ? own.data() : end;
  const auto add = [&](const std::vector<double>& columns, std::size_t column, double factor) {
    for (std::size_t i = 0; i < count; ++i) sum[i] += columns[column * count + i] * factor;
  };

  // By the forces at the start, and by the state there.
  for (std::size_t i = 0; i < count; ++i) sum[i] = by_force_[0][i] * forces[0];
  for (std::size_t d = 1; d < by_force_.size(); ++d) add(by_force_[d], 0, forces[d]);
  for (std::size_t k = 0; k < count; ++k) add(free_, k, state[k]);

  // By each input: Hermite's cubic; each coefficient times the factorial of its power.
  for (std::size_t u = 0; u < by_input_.size(); ++u) {
    const double first = inputs.value[u][point];
    const double change = inputs.value[u][point + 1] - first;
    const double rate = length_ * inputs.rate[u][point];
    const double end_rate = length_ * inputs.rate[u][point + 1];
    const double cubic[kCubic] = {first, rate, 2 * (3 * change - 2 * rate - end_rate),
                                  6 * (rate + end_rate - 2 * change)};
    for (std::size_t k = 0; k < kCubic; ++k) add(by_input_[u], k, cubic[k]);
  }
  if (kCount > 0) std::copy_n(sum, count, end);
}

void PlantStep::end_without_force(const PlantInputSamples& inputs, std::size_t point,
                                  const double* state, const double* forces, double* end) const {
  switch (count_) {
    case 2:  // an oscillator
      return end_of<2>(inputs, point, state, forces, end);
    case 4:  // a quarter car
      return end_of<4>(inputs, point, state, forces, end);
    case 8:  // half a car
      return end_of<8>(inputs, point, state, forces, end);
    default:
      return end_of<0>(inputs, point, state, forces, end);
  }
}

void RunTangent::add(const StepTangent& step) {
  first_.push_back(numbers_.size());
  numbers_.push_back(step.force);
  numbers_.push_back(step.answer);
  numbers_.insert(numbers_.end(), step.states.begin(), step.states.end());
}

StepTangent RunTangent::at(std::size_t step) const {
  const std::size_t end = step + 1 < size() ? first_[step + 1] : numbers_.size();
  const std::span<const double> own = std::span(numbers_).subspan(first_[step], end - first_[step]);
  return {.force = own[0], .answer = own[1], .states = own.subspan(2)};
}

DamperStep::DamperStep(const DamperModel& damper, double length)
    : damper_(damper), law_(model_as<LawModel>(damper)), length_(length), half_(1) {
  if (law_ && !law_->law().step) law_ = nullptr;
  if (law_ && law_->lag_rate() > 0) half_ = LagWeights(0.5 * length * law_->lag_rate());
  is_constant_ = law_ && !law_->follows_current();
  if (is_constant_) law_->parameters_at(0, parameters_.data());
}

/// One step of a law's own, however long, which is smooth in its parameters; else whatever the
/// model does.
void DamperStep::advance(const DamperInput& from, const DamperInput& to,
                         std::span<double> state) const {
  if (!law_) return damper_.advance(from, to, length_, state);
  const Law& law = law_->law();
  const std::size_t count = law.states.size();

  // The current in the coil half way, whose parameters serve for the step, and at the end.
  double middle = 0.5 * (from.current + to.current), end = to.current;
  if (law_->lag_rate() > 0) {
    const double command = middle;
    middle = half_.of(state[count], from.current, command);
    end = half_.of(middle, command, to.current);
  }
  std::array<double, kMaxParams> at_middle;
  if (!is_constant_) law_->parameters_at(middle, at_middle.data());
  const double* const parameters = is_constant_ ? parameters_.data() : at_middle.data();

  const double x[] = {from.displacement, to.displacement}, v[] = {from.velocity, to.velocity};
  if (law.step(parameters, x, v, length_, state.data()) == 0)
    return damper_.advance(from, to, length_, state);
  if (law_->lag_rate() > 0) state[count] = end;
}

double DamperStep::force_at(const DamperInput& input, std::span<const double> state) const {
  if (!is_constant_) return damper_.force(input, state);
  const Law& law = law_->law();
  const double force =
      law.force(parameters_.data(), input.displacement, input.velocity, state.data());
  return law.side_row > 0 ? force + side_force(law, parameters_.data(), input.velocity) : force;
}

/// The force at the end where `force` was presumed, and the damper's state there.
double DamperStep::answer(const DamperMotion& motion, double force, std::span<const double> state,
                          States& end) const {
  DamperInput to = motion.to;
  to.displacement += motion.moves * force;
  to.velocity += motion.hastens * force;
  std::ranges::copy(state, end.begin());
  const std::span<double> own(end.data(), state.size());
  advance(motion.from, to, own);
  return force_at(to, own);
}

double DamperStep::end_force(const DamperMotion& motion, std::span<double> state) {
  if (followed_) {
    const StepTangent beside = followed_->at(step_);
    step_ += every_;
    return solve_beside(motion, beside, state);
  }
  if (!kept_) return solve(motion, state);
  States before;
  std::ranges::copy(state, before.begin());
  const double force = solve(motion, state);
  return keep_tangent(motion, force, {before.data(), state.size()}, state);
}

/// One step of Newton's method from where the step that is followed has led; where that is too far
/// off, a search of its own.
double DamperStep::solve_beside(const DamperMotion& motion, const StepTangent& tangent,
                                std::span<double> state) {
  constexpr double kNear = 1e-4;  // of the force
  const double presumed = tangent.force + beyond_;
  States end;
  const double excess = answer(motion, presumed, state, end) - presumed;
  largest_ = std::max(largest_, std::abs(presumed));
  double force = presumed + excess / (1 - tangent.answer);
  if (std::abs(force - presumed) <= kNear * largest_)
    for (std::size_t i = 0; i < state.size(); ++i)
      state[i] = end[i] + (force - presumed) * tangent.states[i];
  else
    force = solve(motion, state);
  beyond_ = force - tangent.force;
  before_ = motion.force;
  is_first_ = false;
  return force;
}

/// The step once more at the force that was found and a little above it, and a step of Newton's
/// method from there.
double DamperStep::keep_tangent(const DamperMotion& motion, double force,
                                std::span<const double> before, std::span<double> state) {
  constexpr double kLittle = 1e-5;  // of the force
  const double above = kLittle * std::max(largest_, 1e-300);
  States ends[2], slopes;
  const double answers[] = {answer(motion, force, before, ends[0]),
                            answer(motion, force + above, before, ends[1])};
  StepTangent tangent{.force = force,
                      .answer = (answers[1] - answers[0]) / above,
                      .states = {slopes.data(), state.size()}};
  if (!(tangent.answer < 0.9)) tangent.answer = 0;
  tangent.force += (answers[0] - force) / (1 - tangent.answer);
  for (std::size_t i = 0; i < state.size(); ++i) {
    slopes[i] = (ends[1][i] - ends[0][i]) / above;
    state[i] = ends[0][i] + (tangent.force - force) * slopes[i];
  }
  kept_->add(tangent);
  return tangent.force;
}

double DamperStep::solve(const DamperMotion& motion, std::span<double> state) {
  constexpr int kMost = 20;
  constexpr double kClose = 1e-6;  // of the largest force, before the last correction
  States ends[2];

  // The answer falls with the presumed force where the damper resists, so that the force lies
  // between any presumed one and its answer. The slope is at first that of the step before.
  double low = -INFINITY, high = INFINITY;
  double presumed = is_first_ ? motion.force : 2 * motion.force - before_;
  double last = 0, last_excess = 0, next = presumed;
  for (int k = 0; k < kMost; ++k) {
    const double answered = answer(motion, presumed, state, ends[k % 2]);
    const double excess = answered - presumed;
    largest_ = std::max(largest_, std::abs(answered));
    if (k > 0 && presumed != last) slope_ = 1 + (excess - last_excess) / (presumed - last);
    if (!(slope_ < 0.9)) slope_ = 0;

    // The next one, between the bounds if the slope says that there are any.
    next = presumed + excess / (1 - slope_);
    if (slope_ <= 0) {
      low = std::max(low, std::min(presumed, answered));
      high = std::min(high, std::max(presumed, answered));
      if (low <= high && !(next >= low && next <= high)) next = 0.5 * (low + high);
    }
    const bool is_close = std::abs(excess) <= kClose * largest_;
    if (k > 0 && (is_close || presumed == last || k + 1 == kMost)) {
      // The last correction moves the state along as well.
      const double share = presumed != last ? (next - presumed) / (presumed - last) : 0;
      for (std::size_t i = 0; i < state.size(); ++i)
        state[i] = ends[k % 2][i] + share * (ends[k % 2][i] - ends[(k + 1) % 2][i]);
      break;
    }
    last = presumed;
    last_excess = excess;
    presumed = next;
  }
  before_ = motion.force;
  is_first_ = false;
  return next;
}

}  // namespace dashpot
