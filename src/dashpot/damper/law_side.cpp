#include "dashpot/damper/law_side.h"

#include <array>
#include <map>
#include <math.h>  // the C text says fmax, not std::fmax
#include <mutex>

namespace dashpot {
namespace {

#include "dashpot/damper/c_text/law_side.h"

constexpr double kMost = 1e6;
constexpr std::array kSideRows{
    ParamInfo{kSideFriction, "N", 200, -kMost, kMost, 0, Form::Linear, Fit::Free,
              "more friction in rebound; where negative, in compression"},
    ParamInfo{kSideViscous, "N*s/m", -300, -kMost, kMost, 0, Form::Constant, Fit::Free,
              "more viscous damping in rebound; where negative, in compression"},
    ParamInfo{kSideSpeed, "m/s", 0.02, 1e-5, 10, 0.05, Form::Constant, Fit::Free,
              "speed over which f_side sets in"},
};

}  // namespace

Law extended_by_side(const Law& law) {
  Law sided = law;
  sided.side_row = law.params.size();
  sided.params.insert(sided.params.end(), kSideRows.begin(), kSideRows.end());
  return sided;
}

const Law& with_side(const Law& law) {
  static std::mutex guard;
  static std::map<std::string_view, Law> made;  // its nodes stay where they are

  if (law.side_row > 0) return law;
  if (law.sided) return *law.sided;
  const std::lock_guard lock(guard);
  const auto found = made.find(law.name);
  return found != made.end() ? found->second
                             : made.emplace(law.name, extended_by_side(law)).first->second;
}

std::span<const ParamInfo> side_rows() { return kSideRows; }

double side_force(const Law& law, const double* p, double v) noexcept {
  const double* own = p + law.side_row;
  return law_side(own[0], own[1], own[2], v);
}

}  // namespace dashpot
