#include <algorithm>
#include <cmath>
#include <limits>

#include "dashpot/numerics/linear_algebra.h"
#include "dashpot/suspension/steps/plant_equations.h"
#include "dashpot/suspension/steps/step_control.h"

namespace dashpot {
namespace {

// RODAS, a Rosenbrock method of six stages, order 4 with an embedded solution of order 3, stiffly
// accurate: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II (1996), section IV.7.
// In the form without products of the Jacobian J, each stage solves
//
//   (I / (gamma h) - J) u_i = f(t + c_i h, y + sum a_ij u_j) + sum (c_ij / h) u_j + h d_i df/dt
//
// and y + sum a_6j u_j + u_6 is the end of the step, u_6 the difference of the two solutions.
// Below, c_i is kAt, a_ij kFrom, c_ij kSlopes, d_i kByTime.
constexpr std::size_t kImplicitStages = 6;
constexpr double kGamma = 0.25;
constexpr double kAt[kImplicitStages] = {0, 0.386, 0.21, 0.63, 1, 1};
constexpr double kByTime[kImplicitStages] = {0.25, -0.1043, 0.1035, -0.0362, 0, 0};
constexpr double kFrom[kImplicitStages][kImplicitStages - 1] = {
    {},
    {1.544},
    {0.9466785280815826, 0.2557011698983284},
    {3.314825187068521, 2.896124015972201, 0.9986419139977817},
    {1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950},
    {1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950, 1}};
constexpr double kSlopes[kImplicitStages][kImplicitStages - 1] = {
    {},
    {-5.6688},
    {-2.430093356833875, -0.2063599157091915},
    {-0.1073529058151375, -9.594562251023355, -20.47028614809616},
    {7.496443313967647, -10.24680431464352, -33.99990352819905, 11.70890893206160},
    {8.083246795921522, -7.981132988064893, -31.52159432874371, 16.31930543123136,
     -6.058818238834054}};

using Vector = std::vector<double>;

/// sum += factor * terms.
void add(Vector& sum, double factor, const Vector& terms) {
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += factor * terms[k];
}

class ImplicitSteps final : public StepMethod {
 public:
  ImplicitSteps(const PlantForces& forces, const IntegratorOptions& options,
                const PlantState& start)
      : equations_(forces, start), options_(options), size_(equations_.size()) {
    for (Vector* vector : {&y_, &f_, &trial_, &slope_, &by_time_}) vector->resize(size_);
    for (Vector& u : u_) u.resize(size_);
    jacobian_.resize(size_ * size_);
    matrix_.resize(size_ * size_);
  }

  void refresh(PlantState& state) override {
    equations_.read(state, y_.data());
    rates(0, y_, f_);
    equations_.write_forces(f_.data(), state);
  }

  bool advance(PlantState& state, double end) override {
    const double length = end - state.time;
    if (!(length > 0)) return true;

    next_ = next_ > 0 ? next_ : length;
    equations_.read(state, y_.data());
    rates(0, y_, f_);
    Allowance least(length);
    for (double done = 0; done < length;) {
      // The Jacobian holds for all tries from the same point.
      differentiate(done, length);
      for (bool taken = false; !taken;) {
        // One try, to the end of the stretch at most, and the length that its error allows.
        const bool last = done + next_ >= length * (1 - 1e-12);
        const double h = last ? length - done : next_;
        attempt(done, h);
        const double error = distance();
        const bool bad = !(error <= 1);
        const double wanted = h * step_factor(error, 0.25);
        next_ = std::max(last && !bad ? std::max(next_, wanted) : wanted, least.shortest());

        // Too great an error is accepted from the shortest step alone, and counted.
        if (bad && !least.is_shortest(h)) continue;
        if (!std::isfinite(error)) return false;
        if (bad) {
          ++counts_.missed;
          least.miss();
        }

        // The step is taken.
        ++counts_.steps;
        taken = true;
        y_ = trial_;
        done = last ? length : done + h;
        rates(done, y_, f_);
      }
    }
    equations_.write(y_.data(), f_.data(), end, state);
    return true;
  }

 private:
  void rates(double after, const Vector& y, Vector& dy) {
    ++counts_.evaluations;
    equations_.rates(after, y.data(), dy.data());
  }

  /// Derivatives of f by y and by t at the present y, by differences; t goes forwards within the
  /// stretch.
  void differentiate(double done, double length) {
    constexpr double kLeast = 1e-5;

    // By the state: one component after the other.
    for (std::size_t j = 0; j < size_; ++j) {
      const double kept = y_[j];
      const double change =
          std::sqrt(std::numeric_limits<double>::epsilon() * std::max(kLeast, std::abs(kept)));
      y_[j] = kept + change;
      rates(done, y_, slope_);
      y_[j] = kept;
      for (std::size_t i = 0; i < size_; ++i)
        jacobian_[j * size_ + i] = (slope_[i] - f_[i]) / change;
    }

    // By time.
    const double later = 1e-4 * length, sign = done + later <= length ? 1 : -1;
    rates(done + sign * later, y_, by_time_);
    for (std::size_t i = 0; i < size_; ++i) by_time_[i] = (by_time_[i] - f_[i]) * (sign / later);
  }

  /// trial_ becomes the end of a step, the last of u_ its error.
  void attempt(double done, double h) {
    for (std::size_t k = 0; k < matrix_.size(); ++k) matrix_[k] = 0 - jacobian_[k];
    for (std::size_t j = 0; j < size_; ++j)
      matrix_[j * size_ + j] = 1 / (kGamma * h) - jacobian_[j * size_ + j];
    factors_.factorise_columns(matrix_, size_);

    // One linear system per stage, all with the same matrix.
    for (std::size_t s = 0; s < kImplicitStages; ++s) {
      trial_ = y_;
      for (std::size_t j = 0; j < s; ++j) add(trial_, kFrom[s][j], u_[j]);
      if (s == 0)
        slope_ = f_;
      else
        rates(done + kAt[s] * h, trial_, slope_);
      add(slope_, h * kByTime[s], by_time_);
      for (std::size_t j = 0; j < s; ++j) add(slope_, kSlopes[s][j] / h, u_[j]);
      factors_.solve(slope_, u_[s]);
    }

    // The method is stiffly accurate: the last stage is the end, and its increment the error.
    add(trial_, 1, u_[kImplicitStages - 1]);
  }

  double distance() const {
    const StepEnds ends{equations_.coordinates(), y_, trial_};
    return error_in_tolerances(
        ends, options_, [&](std::size_t k) { return std::abs(u_[kImplicitStages - 1][k]); },
        [&](std::size_t k) { return ends.size(k); });
  }

  PlantEquations equations_;
  IntegratorOptions options_;
  std::size_t size_;
  Vector y_, f_, trial_, slope_, by_time_;
  Vector u_[kImplicitStages];
  Vector jacobian_, matrix_;  ///< column by column
  Factors factors_;
  double next_ = 0;  ///< s, the length to try next
};

}  // namespace

std::unique_ptr<StepMethod> make_implicit_steps(const PlantForces& forces,
                                                const IntegratorOptions& options,
                                                const PlantState& start) {
  return std::make_unique<ImplicitSteps>(forces, options, start);
}

}  // namespace dashpot
