#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "dashpot/suspension/plants/plant_equations.h"
#include "dashpot/suspension/steps/dormand_prince.h"
#include "dashpot/suspension/steps/step_control.h"

namespace dashpot {
namespace {

using Method = DormandPrince;
constexpr std::size_t kStages = Method::kStages;

class ExplicitSteps final : public StepMethod {
 public:
  ExplicitSteps(const PlantForces& forces, const IntegratorOptions& options,
                const PlantState& start)
      : equations_(forces, start),
        options_(options),
        size_(equations_.size()),
        y_(size_),
        trial_(size_),
        end_(size_),
        k_(kStages * size_) {}

  void refresh(PlantState& state) override {
    equations_.read(state, y_.data());
    slope(0, 0, y_);
    equations_.write_forces(k_.data(), state);
  }

  bool advance(PlantState& state, double end) override {
    const double length = end - state.time;
    if (!(length > 0)) return true;
    if (next_ == 0) next_ = length;
    equations_.read(state, y_.data());
    Allowance least(length);
    for (double done = 0; done < length;) {
      const bool last = done + next_ >= length * (1 - 1e-12);
      const double h = last ? length - done : next_;
      attempt(done, h);
      const double error = distance(h), wanted = h * step_factor(error, Method::kPower);
      const bool bad = !(error <= 1);
      next_ = std::max(last && !bad ? std::max(next_, wanted) : wanted, least.shortest());
      if (bad && h > least.shortest()) continue;
      if (!std::isfinite(error)) return false;
      if (bad) {
        ++counts_.missed;
        least.miss();
      }
      ++counts_.steps;
      std::swap(y_, end_);
      std::copy_n(&k_[(kStages - 1) * size_], size_, k_.begin());
      done = last ? length : done + h;
    }
    equations_.write(y_.data(), k_.data(), end, state);
    return true;
  }

 private:
  void slope(std::size_t stage, double after, const std::vector<double>& y) {
    ++counts_.evaluations;
    equations_.rates(after, y.data(), &k_[stage * size_]);
  }
  template <std::size_t... kBefore>
  void sum(std::vector<double>& out, double h, const double* weights,
           std::index_sequence<kBefore...>) const {
    const double* k = k_.data();
    const std::size_t n = size_;
    for (std::size_t i = 0; i < n; ++i)
      out[i] = y_[i] + h * ((weights[kBefore] * k[kBefore * n + i]) + ...);
  }
  template <std::size_t kStage>
  void stage(double done, double h, std::vector<double>& at) {
    sum(at, h, Method::kFrom[kStage], std::make_index_sequence<kStage>());
    slope(kStage, done + Method::kAt[kStage] * h, at);
  }
  void attempt(double done, double h) {
    stage<1>(done, h, trial_);
    stage<2>(done, h, trial_);
    stage<3>(done, h, trial_);
    stage<4>(done, h, trial_);
    stage<5>(done, h, trial_);
    stage<6>(done, h, end_);
  }
  double off(std::size_t i) const {
    double sum = 0;
    for (std::size_t s = 0; s < kStages; ++s) sum += Method::kError[s] * k_[s * size_ + i];
    return std::abs(sum);
  }
  double distance(double h) const {
    return error_in_tolerances(
        {equations_.coordinates(), y_, end_}, options_, [&](std::size_t k) { return h * off(k); },
        [&](std::size_t k) { return std::abs(h * k_[k]); });
  }

  PlantEquations equations_;
  IntegratorOptions options_;
  std::size_t size_;
  std::vector<double> y_, trial_, end_;
  std::vector<double> k_;  ///< slopes, stage by stage
  double next_ = 0;        ///< s
};

}  // namespace

std::unique_ptr<StepMethod> make_explicit_steps(const PlantForces& forces,
                                                const IntegratorOptions& options,
                                                const PlantState& start) {
  return std::make_unique<ExplicitSteps>(forces, options, start);
}

}  // namespace dashpot
