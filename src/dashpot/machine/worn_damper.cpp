#include "dashpot/machine/worn_damper.h"

#include <algorithm>

#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {

const std::vector<Wear>& wears() {
  static const std::vector<Wear> kWears = {
      {"force", "1", "the damper's whole force", 0.02,
       [](const DamperInput&, double force) { return force; }},
      {"rebound", "1", "the damper's force against extension", 0.02,
       [](const DamperInput&, double force) { return std::max(force, 0.0); }},
      {"compression", "1", "the damper's force against compression", 0.02,
       [](const DamperInput&, double force) { return std::min(force, 0.0); }},
      {"viscous", "N*s/m", "the part of the damper's force that goes with its speed", 20,
       [](const DamperInput& input, double) { return input.velocity; }},
      {"stiffness", "N/m", "the part of the damper's force that goes with its deflection", 200,
       [](const DamperInput& input, double) { return input.displacement; }}};
  return kWears;
}

const Wear& find_wear(const std::string& name, const std::string& where) {
  std::vector<std::string> known;
  for (const Wear& wear : wears()) {
    if (wear.name == name) return wear;
    known.push_back(wear.name);
  }
  throw Error(where, "unknown wear '" + name + "'", suggest(name, known));
}

std::unique_ptr<DamperModel> WornDamper::with_offset(double newton) const {
  return std::make_unique<WornDamper>(as_new_, amounts_, offset_ + newton);
}

Value WornDamper::to_json() const {
  throw Error(name(), "is worn: a model file holds a damper as it was identified");
}

}  // namespace dashpot
