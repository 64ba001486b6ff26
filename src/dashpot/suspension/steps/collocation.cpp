#include <algorithm>
#include <cmath>
#include <map>

#include "dashpot/suspension/dampers/damper_state.h"
#include "dashpot/suspension/steps/propagator.h"
#include "dashpot/suspension/steps/step_method.h"

namespace dashpot {
namespace {

constexpr int kFinest = 16;  // a stretch in 65 536 steps at most
constexpr int kIterations = 12;
constexpr double kConverged = 0.02;  // tolerances by which the last iteration may move the end
/// Halving a step quarters the error of a damper's own steps, the least that a method here gains.
constexpr double kGain = 3;

bool is_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](double value) { return std::isfinite(value); });
}

/// An instant of a step.
struct Node {
  PlantState state;
  std::vector<double> g;  ///< PlantForces::add_up
};

class Collocation final : public StepMethod {
 public:
  Collocation(const PlantForces& forces, const IntegratorOptions& options, const PlantState& start)
      : forces_(forces),
        options_(options),
        now_{start, std::vector<double>(start.acceleration.size())},
        middle_(now_),
        whole_(now_),
        half_(now_),
        three_quarters_(now_),
        end_(now_),
        before_(start.x) {}

  void refresh(PlantState& state) override {
    evaluate(state);
    forces_.accelerate(state.time, state.x, state.strut_forces, state.acceleration);
  }

  bool advance(PlantState& state, double end) override {
    now_.state = state;
    forces_.add_up(state.time, state.x, state.strut_forces, now_.g);
    const bool finite = go(end);
    state = now_.state;
    forces_.accelerate(state.time, state.x, state.strut_forces, state.acceleration);
    return finite;
  }

 private:
  /// Brings now_ to `end`. A stretch is cut into 2^level steps, so that halved and doubled steps
  /// meet.
  bool go(double end) {
    const double start = now_.state.time, length = end - start;
    if (!(length > 0)) return true;

    // As fine as the step before was, and no coarser than was asked for.
    const int least = options_.longest_step > 0 ? halvings(length, options_.longest_step) : 0;
    level_ =
        options_.controls_error && usual_ > 0 ? std::max(halvings(length, usual_), least) : least;

    // A step at the present level; where its error is too great, the level rises.
    double done = 0;  // share of the stretch
    while (done < 1) {
      const double share = std::exp2(-level_), h = length * share;
      const double error = options_.controls_error ? in_halves(h) : step_anew(h, end_);
      if (options_.controls_error && !(error <= 1) && level_ < kFinest) {
        ++level_;
        continue;
      }

      // The step is taken.
      counts_.missed += options_.controls_error && !(error <= 1);
      std::swap(now_, end_);
      if (!is_finite(now_.state.x)) return false;
      done += share;
      now_.state.time = done >= 1 ? end : start + length * done;

      // The level falls where the error is small and the place suits a step of twice the length.
      const bool even = std::fmod(done, 2 * share) == 0;
      if (options_.controls_error && error < 1.0 / 64 && level_ > least && even) --level_;
      usual_ = level_ > 0 ? length * std::exp2(-level_) : std::max(usual_, length);
    }
    return true;
  }

  /// end_ becomes the state h later, in two steps; its error in tolerances.
  double in_halves(double h) {
    constexpr double kNotConverged = 10;
    const double whole = step_anew(h, whole_);

    // Each half begins with its part of the parabola of forces that the whole step has found.
    half_.g = middle_.g;
    end_.g = whole_.g;
    for (std::size_t k = 0; k < half_.g.size(); ++k) {
      const double start = now_.g[k], middle = half_.g[k], end = end_.g[k];
      middle_.g[k] = 0.375 * start + 0.75 * middle - 0.125 * end;
      three_quarters_.g[k] = 0.375 * end + 0.75 * middle - 0.125 * start;
    }
    step(now_, 0.5 * h, middle_, half_);
    const double halves = step(half_, 0.5 * h, three_quarters_, end_);
    return whole <= 1 && halves <= 1 ? distance(whole_.state.x, end_.state.x) / kGain
                                     : kNotConverged;
  }

  /// A step from now_; the first guess is that forces stay as they are at the start.
  double step_anew(double h, Node& to) {
    middle_.g = to.g = now_.g;
    return step(now_, h, middle_, to);
  }

  /// `to` becomes the state h later, by way of `middle`, whose forces and those of `to` are a first
  /// guess; how far the last iteration moved it, in tolerances.
  double step(const Node& from, double h, Node& middle, Node& to) {
    ++counts_.steps;
    const Propagator& exact = propagator(h);
    middle.state.time = from.state.time + 0.5 * h;
    to.state.time = from.state.time + h;
    const double* g[3] = {from.g.data(), middle.g.data(), to.g.data()};

    // Motion under the parabola of forces, then forces of that motion, until the end stays.
    double moved = 0;
    for (int k = 0; k < kIterations; ++k) {
      before_ = to.state.x;
      exact.middle(from.state.x, g, middle.state.x);
      exact.end(from.state.x, g, to.state.x);
      move_dampers(from.state, h, middle.state, to.state);
      for (Node* node : {&middle, &to}) {
        evaluate(node->state);
        forces_.add_up(node->state.time, node->state.x, node->state.strut_forces, node->g);
      }
      moved = k == 0 ? INFINITY : distance(before_, to.state.x);
      if (!(moved > kConverged)) break;
    }
    return moved;
  }

  /// The dampers' own steps over both halves of the step, along the motion at its three instants.
  void move_dampers(const PlantState& from, double h, PlantState& middle, PlantState& to) const {
    for (std::size_t s = 0; s < from.dampers.size(); ++s) {
      const DamperState& start = from.dampers[s];
      const DamperInput a = forces_.strut_motion(s, from.time, from.x, start.current());
      const DamperInput b =
          forces_.strut_motion(s, middle.time, middle.x, start.current_after(0.5 * h));
      const DamperInput c = forces_.strut_motion(s, to.time, to.x, start.current_after(h));
      middle.dampers[s] = start;
      middle.dampers[s].advance(a, b, 0.5 * h);
      to.dampers[s] = middle.dampers[s];
      to.dampers[s].advance(b, c, 0.5 * h);
    }
  }

  /// Forces of dampers and struts at the state's instant.
  void evaluate(PlantState& state) {
    ++counts_.evaluations;
    for (std::size_t s = 0; s < state.dampers.size(); ++s) {
      const DamperInput motion =
          forces_.strut_motion(s, state.time, state.x, state.dampers[s].current());
      state.damper_forces[s] = state.dampers[s].force(motion);
      state.strut_forces[s] = state.damper_forces[s] + forces_.strut_extra(s, motion);
    }
  }

  /// How far two motions are apart, in tolerances; displacements and speeds each against their
  /// greatest.
  double distance(const std::vector<double>& a, const std::vector<double>& b) const {
    const std::size_t n = a.size() / 2;
    double greatest = 0;
    for (std::size_t part = 0; part < 2; ++part) {
      double size = 0, apart = 0;
      for (std::size_t k = part * n; k < (part + 1) * n; ++k) {
        size = std::max(size, std::abs(b[k]));
        apart = std::max(apart, std::abs(a[k] - b[k]));
      }
      greatest = std::max(
          greatest, apart / (options_.absolute_tolerance + options_.relative_tolerance * size));
    }
    return greatest;
  }

  /// Kept for each length of step that has occurred, to the picosecond.
  const Propagator& propagator(double h) {
    const long long key = std::llround(h * 1e12);
    const auto found = propagators_.find(key);
    if (found != propagators_.end()) return found->second;
    constexpr std::size_t kMost = 200;
    if (propagators_.size() >= kMost) propagators_.clear();
    return propagators_.emplace(key, Propagator(forces_.linear(), static_cast<double>(key) * 1e-12))
        .first->second;
  }

  /// The fewest that make steps of a stretch as short as that.
  static int halvings(double length, double step) {
    const double ratio = length / step * (1 - 1e-9);
    return ratio <= 1 ? 0 : std::min(kFinest, static_cast<int>(std::ceil(std::log2(ratio))));
  }

  const PlantForces& forces_;
  IntegratorOptions options_;
  std::map<long long, Propagator> propagators_;
  Node now_, middle_, whole_, half_, three_quarters_, end_;
  std::vector<double> before_;
  int level_ = 0;     ///< a stretch is cut into 2^level steps
  double usual_ = 0;  ///< s, the length of the step before
};

}  // namespace

std::unique_ptr<StepMethod> make_collocation(const PlantForces& forces,
                                             const IntegratorOptions& options,
                                             const PlantState& start) {
  return std::make_unique<Collocation>(forces, options, start);
}

}  // namespace dashpot
