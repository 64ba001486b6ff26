#include "dashpot/damper/inverse/registry.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/base/find_row.h"
#include "dashpot/damper/inverse/numeric.h"
#include "dashpot/damper/inverse/observer.h"
#include "dashpot/damper/inverse/polynomial.h"
#include "dashpot/damper/inverse/switching.h"
#include "dashpot/damper/inverse/train_inverse.h"

namespace dashpot {
namespace {

using Inverse = std::unique_ptr<InverseModel>;

template <SwitchingInverse::Rule rule>
Inverse make_switching(const DamperModel& forward, const InverseLimits& limits) {
  const double force_max = Observer(forward, limits).force_max();
  return std::make_unique<SwitchingInverse>(rule, limits, force_max);
}

template <class Model>
Inverse make_model(const DamperModel& forward, const InverseLimits& limits) {
  return std::make_unique<Model>(forward, limits);
}

/// Teaches a preset's network on the model, in about a second: the caller waits for it.
Inverse make_network(std::string_view preset, std::string_view name, const DamperModel& forward,
                     const InverseLimits& limits) {
  InverseTraining training;
  training.samples = 2000;  // it is waited for
  training.rounds = 2;
  training.iterations = 60;
  training.spacing =
      limits.sample_time * std::max(1.0, std::round(training.spacing / limits.sample_time));
  training.current_min = limits.current_min;
  training.current_max = limits.current_max;

  // Two sets of runs, the second from other random numbers, to judge by.
  std::vector<InverseRun> runs[2];
  for (const std::size_t part : {0, 1})
    for (const BenchTest& test : teaching_tests({}, limits, training.seed + part))
      runs[part].push_back(run_on_model(forward, test, limits));

  TaughtInverse taught = train_inverse(find_inverse_network(preset), runs[0], runs[1], training);
  taught.network.name = name;
  return std::make_unique<HistoryNetwork>(std::move(taught.network), limits);
}

Inverse make_neural(const DamperModel& forward, const InverseLimits& limits) {
  return make_network("chang_zhou", "neural", forward, limits);
}

Inverse make_neural_displacement(const DamperModel& forward, const InverseLimits& limits) {
  return make_network("metered", "neural_displacement", forward, limits);
}

constexpr std::array kSchemes{
    InverseScheme{
        .name = "clipped_optimal",
        .title = "Clipped-optimal",
        .equation = "i = i_max H((f_c - f) f),  H(0) = 0",
        .source = "Dyke, Spencer, Sain, Carlson 1996, Smart Materials and Structures 5, 565-575",
        .remarks = "Needs the measured force. Where it is exactly 0, the current stays off.",
        .needs_force = true,
        .make = make_switching<SwitchingInverse::Rule::ClippedOptimal>},
    InverseScheme{
        .name = "heaviside",
        .title = "Heaviside step on the wanted dissipation",
        .equation = "i = i_max H(f_c v),  H(0) = 0",
        .source = "common in semi-active control; no single source",
        .remarks = "Neither model nor force sensor: full current whenever the damper can help.",
        .needs_force = false,
        .make = make_switching<SwitchingInverse::Rule::Heaviside>},
    InverseScheme{
        .name = "modified_clipped_optimal",
        .title = "Modified clipped-optimal",
        .equation = "i = min(i_max, i_max |f_c| / f_max) H((f_c - f) f),  H(0) = 0",
        .source = "Yoshida, Dyke 2004, J. Engineering Mechanics 130(4), 386-397",
        .remarks = "f_max is the largest force of the forward model on a sine of 20 mm at 1 Hz.",
        .needs_force = true,
        .make = make_switching<SwitchingInverse::Rule::ModifiedClippedOptimal>},
    InverseScheme{.name = "neural",
                  .title = "Network from motion, wanted force and past current",
                  .equation = "the network chang_zhou of 'dashpot invert'",
                  .source = "after Chang, Zhou 2002, J. Structural Engineering 128(2), 231-239",
                  .remarks = "Taught on the forward model when it is made: motions to 3 Hz, +-2 "
                             "cm, random currents. Steps of 5 ms. 'dashpot invert' teaches it over "
                             "a range of yours and keeps it.",
                  .needs_force = false,
                  .make = make_neural},
    InverseScheme{.name = "neural_displacement",
                  .title = "Network without a velocity sensor",
                  .equation = "the network metered of 'dashpot invert'",
                  .source = "after Metered, Bonello, Oyadiji 2010, Mechanical Systems and Signal "
                            "Processing 24(3), 676-694",
                  .remarks = "As neural, but the past displacements stand for the velocity.",
                  .needs_force = false,
                  .make = make_neural_displacement},
    InverseScheme{
        .name = "numeric",
        .title = "Search on the forward model",
        .equation =
            "least i in [i_min, i_max] with F(x, v, i, z) = f_c;  z from a free run of the model",
        .source = "Dashpot",
        .remarks = "For every model. Bracketed and warm-started.",
        .needs_force = false,
        .make = make_model<NumericInverse>},
    InverseScheme{
        .name = "polynomial",
        .title = "Closed form where the force is a polynomial of the current",
        .equation =
            "least i in [i_min, i_max] with  c0 + c1 i + c2 i^2 + c3 i^3 = f_c,  c(x, v, z)",
        .source = "Choi, Lee, Park 2001, J. Sound and Vibration 245(2), 375-383, for one law; here "
                  "for all",
        .remarks =
            "For laws that are linear in parameters which are polynomials of the current: Bingham, "
            "hyperbolic tangent, semi-phenomenological, polynomial, LuGre.",
        .needs_force = false,
        .make = make_model<PolynomialInverse>},
    InverseScheme{
        .name = "signum",
        .title = "Signum, continuous state",
        .equation = "i = sat(G (f_c - f) sgn f),  G = 10 i_max / f_max",
        .source = "Sims, Stanway, Johnson, Peel, Bullough 1999, as recalled",
        .remarks =
            "Needs the measured force; with G without limit it is clipped-optimal. f_max as in "
            "modified_clipped_optimal.",
        .needs_force = true,
        .make = make_switching<SwitchingInverse::Rule::Signum>},
};

}  // namespace

std::span<const InverseScheme> inverse_schemes() { return kSchemes; }

std::vector<std::string> inverse_names() {
  std::vector<std::string> names;
  for (const InverseScheme& scheme : kSchemes) names.emplace_back(scheme.name);
  return names;
}

const InverseScheme& find_inverse(std::string_view name, const std::string& where) {
  return find_row(kSchemes, name, "inverse", where);
}

}  // namespace dashpot
