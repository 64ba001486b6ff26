#include "dashpot/suspension/bound/range_damper.h"

#include <algorithm>

namespace dashpot {

double RangeDamper::force(const DamperInput& input, std::span<const double>) const noexcept {
  const double wanted = range_.at(input.displacement).force(input.velocity, input.current) +
                        range_.stiffness * input.displacement;
  if (!range_.reach) return wanted;
  const auto [least, greatest] = range_.reach(input.displacement, input.velocity);
  return std::clamp(wanted, least, greatest);
}

std::unique_ptr<DamperModel> RangeDamper::with_offset(double newton) const {
  ForceRange moved = range_;
  if (moved.reach)
    moved.reach = [reach = range_.reach, newton](double displacement, double velocity) {
      const auto [least, greatest] = reach(displacement, velocity);
      return std::pair{least + newton, greatest + newton};
    };
  const auto move = [newton](std::vector<double>& forces) {
    for (double& force : forces) force += newton;
  };
  move(moved.soft);
  move(moved.hard);
  for (auto* const sides : {&moved.sides, &moved.reached})
    for (RangeSide& side : *sides) {
      std::ranges::for_each(side.soft, move);
      std::ranges::for_each(side.hard, move);
    }
  return std::make_unique<RangeDamper>(std::move(moved));
}

Value RangeDamper::to_json() const {
  return Value::object({{"velocity", Value::array(range_.velocity)},
                        {"soft", Value::array(range_.soft)},
                        {"hard", Value::array(range_.hard)},
                        {"stiffness", range_.stiffness}});
}

MountedDamper mounted(const ForceRange& range) {
  return {.model = std::make_shared<RangeDamper>(range),
          .driver = {.current_min = 0, .current_max = 1},
          .inverse = nullptr,
          .loop = {}};
}

}  // namespace dashpot
