#include "dashpot/suspension/ride/domain_use.h"

#include <algorithm>

#include "dashpot/base/text.h"

namespace dashpot {
namespace {

double share_outside(const std::vector<double>& values, double ratio, double low, double high) {
  const double slack = 0.01 * (high - low);
  const auto outside = std::ranges::count_if(values, [&](double value) {
    return ratio * value < low - slack || ratio * value > high + slack;
  });
  return values.empty() ? 0 : static_cast<double>(outside) / static_cast<double>(values.size());
}

}  // namespace

double DomainUse::any() const { return std::max({displacement, velocity, current}); }

std::vector<DomainUse> domain_use(const Vehicle& vehicle, const Trace& trace) {
  std::vector<DomainUse> uses;
  for (std::size_t s = 0; s < vehicle.domains.size(); ++s) {
    if (!vehicle.domains[s]) continue;
    const Domain& d = *vehicle.domains[s];
    const std::string& name = vehicle.set.plant.struts[s].name;
    const double ratio = vehicle.dampers[s].motion_ratio;
    const auto share = [&](const char* channel, double scale, double low, double high) {
      return share_outside(trace.record.channel(name + channel).samples, scale, low, high);
    };

    // Only quantities that the damper depends on and its data vary.
    DomainUse use{.strut = name, .damper = vehicle.damper_names[s]};
    if (vehicle.dampers[s].model->needs_displacement())
      use.displacement = share("_deflection", ratio, d.displacement_min, d.displacement_max);
    use.velocity = share("_velocity", ratio, d.velocity_min, d.velocity_max);
    if (d.current_min < d.current_max)
      use.current = share("_current", 1, d.current_min, d.current_max);
    uses.push_back(use);
  }
  return uses;
}

std::vector<std::string> domain_warnings(const std::vector<DomainUse>& uses, double allowed) {
  std::vector<std::string> warnings;
  for (const DomainUse& use : uses) {
    std::vector<std::string> parts;
    const auto add = [&](const char* what, double share) {
      if (share > allowed)
        parts.push_back(std::string(what) + ' ' + format_number(100 * share, 3) + " % of the time");
    };

    add("displacement", use.displacement);
    add("velocity", use.velocity);
    add("current", use.current);
    if (!parts.empty())
      warnings.push_back(use.strut + ": " + use.damper +
                         " is asked beyond its data: " + join(parts, ", "));
  }
  return warnings;
}

}  // namespace dashpot
