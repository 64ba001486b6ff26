#pragma once
#include <string>
#include <vector>

#include "dashpot/vehicle.h"

namespace dashpot {

/// How long a damper was used outside the range of its data.
struct DomainUse {
  std::string strut, damper;
  double displacement = 0, velocity = 0, current = 0;  ///< shares of the time outside, 0 ... 1
  double any() const;                                  ///< the greatest of them
};
/// One per strut whose damper has a domain. A hair beyond its ends, 1 % of the range, counts as
/// inside.
std::vector<DomainUse> domain_use(const Vehicle& vehicle, const Trace& trace);

/// In words, where some share is above `allowed`: "suspension: mr.json is asked beyond its data:
/// velocity 12 % of the time"; nothing where none is.
std::vector<std::string> domain_warnings(const std::vector<DomainUse>& uses, double allowed);

}  // namespace dashpot
