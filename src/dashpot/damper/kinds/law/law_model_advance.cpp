#include <array>
#include <math.h>  // the C text says fabs, not std::fabs

#include "dashpot/damper/kinds/law/law_model.h"

namespace dashpot {
namespace {

// The functions that the C text calls, here for whatever law the model has.

using LawParameters = std::array<double, kMaxParams>;

inline double law_lag_rate(const LawModel* m) { return m->lag_rate(); }
inline int law_states(const LawModel* m) { return static_cast<int>(m->law().states.size()); }
inline int law_follows_current(const LawModel* m) { return m->follows_current(); }
inline void law_parameters(const LawModel* m, double current, LawParameters* p) {
  m->parameters_at(current, p->data());
}
inline double law_rate(const LawModel* m, const LawParameters* p, double speed) {
  return m->law().rate(p->data(), speed);
}
inline int law_has_own_step(const LawModel* m) { return static_cast<bool>(m->law().step); }
inline int law_own_step_is_exact(const LawModel* m) { return m->law().exact_step; }
inline int law_own_step(const LawModel* m, const LawParameters* p, const double* x, const double* v,
                        double h, double* z) {
  return m->law().step(p->data(), x, v, h, z);
}
inline void law_explicit_step(const LawModel* m, const LawParameters* const* p, const double* x,
                              const double* v, double h, double* z) {
  const double* const stages[] = {p[0]->data(), p[1]->data(), p[2]->data()};
  m->law().runge_kutta(stages, x, v, h, m->law().states.size(), z);
}

// clang-format off: the second builds on the first
#include "dashpot/damper/c_text/law_path.h"
#include "dashpot/damper/c_text/law_integrate.h"
// clang-format on

}  // namespace

void LawModel::advance(const DamperInput& from, const DamperInput& to, double dt,
                       std::span<double> state) const noexcept {
  law_advance(this, &from, &to, dt, state.data());
}

}  // namespace dashpot
