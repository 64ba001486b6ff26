#include "dashpot/suspension/bound/range_damper.h"

namespace dashpot {

std::unique_ptr<DamperModel> RangeDamper::with_offset(double newton) const {
  ForceRange moved = range_;
  for (double& force : moved.soft) force += newton;
  for (double& force : moved.hard) force += newton;
  return std::make_unique<RangeDamper>(std::move(moved));
}

Value RangeDamper::to_json() const {
  return Value::object({{"velocity", Value::array(range_.velocity)},
                        {"soft", Value::array(range_.soft)},
                        {"hard", Value::array(range_.hard)}});
}

MountedDamper mounted(const ForceRange& range) {
  return {.model = std::make_shared<RangeDamper>(range),
          .driver = {.current_min = 0, .current_max = 1},
          .inverse = nullptr,
          .loop = {}};
}

}  // namespace dashpot
