#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "dashpot/design/design_request.h"

namespace dashpot {

/// What the models tell of one damper as it is, SI.
struct DamperFigures {
  std::vector<double> values;  ///< of every goal, then of every constraint; NaN where refused
  Refusal refusal = Refusal::None;
};

/// How well a damper meets a request. Figures in SI.
struct Assessment {
  bool possible = true;  ///< false: no such damper can be drawn; there are no figures then
  Refusal refusal = Refusal::None;  ///< by a fitted model, asked or not
  bool known = true;                ///< false: a model refuses its force, or a goal is not finite
  std::vector<double> goals;        ///< the quantities, as the share of dampers made reaches them
  std::vector<double> constraints;  ///< likewise
  std::vector<double> slack;  ///< of each constraint, in shares of its bound; negative: it fails
  double violation = 0;       ///< sum of what is negative

  bool holds() const { return possible && known && violation == 0; }
};

/// Which dampers a robust request rides for a goal.
enum class Ridden { Made, Drawn };

/// Whether a damper can be drawn so: lengths above 0, a gap within its bore.
bool is_possible(const DamperDescription& damper);

/// A request turned into a search: places in the unit cube are dampers, which are assessed.
/// Immutable.
class DesignProblem {
 public:
  /// Request and models must outlive it. The seed draws the dampers that stand for those made.
  /// Throws Error when the request asks for figures of a second model and there is none.
  DesignProblem(const DesignRequest& request, const DesignModel& model, std::uint64_t seed,
                const DesignModel* second = nullptr, int threads = 1);

  /// The same with the drawing alone ridden for a goal, where the made ones are asked for all else.
  DesignProblem riding(Ridden ridden) const {
    DesignProblem other = *this;
    other.ridden_ = ridden;
    return other;
  }

  const DesignRequest& request() const { return request_; }
  const DesignModel& model() const { return model_; }
  const DesignModel* second() const { return second_; }
  std::size_t size() const { return request_.variables.size(); }

  /// The damper at a place of the unit cube. `relaxed`: ranges with steps are taken without them.
  DamperDescription damper_at(std::span<const double> place, bool relaxed = false) const;
  /// The place of the damper that is nearest to this one in each variable by itself.
  std::vector<double> place_of(const DamperDescription& damper) const;
  /// The place at which variable k takes its level (for a variable with levels), and the level at a
  /// place.
  double place_of_level(std::size_t k, std::size_t level) const;
  std::size_t level_at(std::size_t k, double place) const;

  Assessment assess(const DamperDescription& drawn) const;
  /// The same with one goal alone, or null for none. The others, of which some take long to
  /// compute, are left out: they may be anything.
  Assessment assess_for(const DamperDescription& drawn, const std::size_t* goal) const;
  /// The damper with its fields off by these shares of their tolerances.
  DamperDescription made(const DamperDescription& drawn, std::span<const double> shares) const;
  /// Each figure by the model that is asked for it, at the pessimistic end of its band; refused
  /// where a fitted model, asked or not, refuses the force at an operating point of any of them.
  DamperFigures figures(const DamperDescription& damper) const;
  /// The same without a ride: NaN for what needs one.
  DamperFigures figures_unridden(const DamperDescription& damper) const;
  /// Whether the figure of a goal or constraint, goals first, needs a ride.
  bool needs_ride(std::size_t k) const { return is_of_ride(quantity_of(k)); }
  /// The same by one model, in the middle of its band.
  std::vector<double> middle_figures(const DamperDescription& damper,
                                     const DesignModel& model) const;

 private:
  std::size_t ask(const DamperOperation& at, ToldBy by);
  void ask_fitted();
  const DesignQuantity& quantity_of(std::size_t k) const;
  bool is_wanted_large(std::size_t k) const;
  std::size_t asked_before(std::size_t k) const;
  void follow(DamperDescription& damper) const;
  using Wanted = std::vector<char>;  // of every goal, then of every constraint
  Assessment assess_wanted(const DamperDescription& drawn, const Wanted& wanted) const;
  DamperFigures figures(const DamperDescription& damper, const Wanted& wanted) const;
  double figure_of_share(std::vector<double>& figures, bool at_least) const;

  struct Question {
    DamperOperation at;
    ToldBy by;
  };

  const DesignRequest& request_;
  const DesignModel& model_;
  const DesignModel* second_;
  int threads_;  // among which the dampers made are shared; figures do not depend on it
  Ridden ridden_ = Ridden::Made;
  std::vector<Question> questions_;       // each once; of fitted models all that any model is asked
  std::vector<std::size_t> question_of_;  // of every goal, then of every constraint
  std::vector<std::vector<double>> made_with_;  // shares of the tolerances of each damper made
};

}  // namespace dashpot
