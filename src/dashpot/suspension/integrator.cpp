#include "dashpot/suspension/integrator.h"

#include <algorithm>
#include <cmath>

namespace dashpot {
namespace {

constexpr int kFinest = 16;  // a stretch in 65 536 steps at most
constexpr int kIterations = 12;
constexpr double kConverged = 0.02;  // tolerances that the last iteration may move the end

bool is_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

Integrator::Integrator(const PlantForces& forces, const IntegratorOptions& options, const PlantState& start)
    : forces_(forces),
      options_(options),
      middle_(start),
      whole_(start),
      half_(start),
      end_(start),
      before_(start.x) {}

void Integrator::evaluate(PlantState& state) {
  ++evaluations_;
  for (std::size_t s = 0; s < state.dampers.size(); ++s) {
    const DamperInput motion = forces_.strut_motion(s, state.time, state.x, state.dampers[s].current());
    state.strut_forces[s] = state.dampers[s].force(motion);
  }
  for (std::size_t s = 0; s < state.dampers.size(); ++s)
    state.strut_forces[s] += forces_.strut_extra(s, forces_.strut_motion(s, state.time, state.x, 0));
  forces_.add_up(state.time, state.x, state.strut_forces, state.g);
}

void Integrator::refresh(PlantState& state) { evaluate(state); }

const Propagator& Integrator::propagator(double h) {
  const long long key = std::llround(h * 1e12);
  const auto found = propagators_.find(key);
  if (found != propagators_.end()) return found->second;
  constexpr std::size_t kMost = 200;
  if (propagators_.size() >= kMost) propagators_.clear();
  return propagators_.emplace(key, Propagator(forces_.linear(), static_cast<double>(key) * 1e-12))
      .first->second;
}

double Integrator::distance(const std::vector<double>& a, const std::vector<double>& b) const {
  const std::size_t n = a.size() / 2;
  double greatest = 0;
  for (std::size_t part = 0; part < 2; ++part) {
    double size = 0, apart = 0;
    for (std::size_t k = part * n; k < (part + 1) * n; ++k) {
      size = std::max(size, std::abs(b[k]));
      apart = std::max(apart, std::abs(a[k] - b[k]));
    }
    greatest = std::max(greatest, apart / (options_.absolute_tolerance + options_.relative_tolerance * size));
  }
  return greatest;
}

double Integrator::step(const PlantState& from, double h, PlantState& middle, PlantState& to) {
  ++steps_;
  const Propagator& exact = propagator(h);
  middle.time = from.time + 0.5 * h;
  to.time = from.time + h;
  middle.g = from.g;
  to.g = from.g;
  const double* g[3] = {from.g.data(), middle.g.data(), to.g.data()};
  double moved = 0;
  for (int k = 0; k < kIterations; ++k) {
    before_ = to.x;
    exact.middle(from.x, g, middle.x);
    exact.end(from.x, g, to.x);
    for (std::size_t s = 0; s < from.dampers.size(); ++s) {
      const DamperState& start = from.dampers[s];
      const DamperInput a = forces_.strut_motion(s, from.time, from.x, start.current());
      const DamperInput b = forces_.strut_motion(s, middle.time, middle.x, start.current_after(0.5 * h));
      const DamperInput c = forces_.strut_motion(s, to.time, to.x, start.current_after(h));
      middle.dampers[s] = start;
      middle.dampers[s].advance(a, b, 0.5 * h);
      to.dampers[s] = middle.dampers[s];
      to.dampers[s].advance(b, c, 0.5 * h);
    }
    evaluate(middle);
    evaluate(to);
    moved = k == 0 ? INFINITY : distance(before_, to.x);
    if (!(moved > kConverged)) break;
  }
  return moved;
}

/// The fewest halvings that keep to the longest step.
int Integrator::coarsest_level(double length) const {
  if (options_.longest_step <= 0) return 0;
  const double ratio = length / options_.longest_step * (1 - 1e-9);
  return ratio <= 1 ? 0 : std::min(kFinest, static_cast<int>(std::ceil(std::log2(ratio))));
}

bool Integrator::advance(PlantState& state, double end) {
  const double length = end - state.time;
  if (!(length > 0)) return true;
  const int least = coarsest_level(length);
  level_ = std::max(level_, least);
  double done = 0;  // share of the stretch
  const double begin = state.time;
  while (done < 1) {
    const double share = std::exp2(-level_), h = length * share;
    double error = step(state, h, middle_, whole_);
    if (options_.controls_error) {
      const bool whole_converged = error <= 1;
      step(state, 0.5 * h, middle_, half_);
      const double halves = step(half_, 0.5 * h, middle_, end_);
      error = whole_converged && halves <= 1 ? distance(whole_.x, end_.x) / 15 : 10;
      if (!(error <= 1) && level_ < kFinest) {
        ++level_;
        continue;
      }
      missed_ = missed_ || !(error <= 1);
    }
    std::swap(state, options_.controls_error ? end_ : whole_);
    if (!is_finite(state.x)) return false;
    done += share;
    state.time = done >= 1 ? end : begin + length * done;
    const bool even = std::fmod(done, 2 * share) == 0;
    if (options_.controls_error && error < 1.0 / 64 && level_ > least && even) --level_;
  }
  return true;
}

}  // namespace dashpot
