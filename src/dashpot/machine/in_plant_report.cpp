#include "dashpot/machine/in_plant_report.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/damper/law.h"
#include "dashpot/error.h"
#include "dashpot/machine/damper_drive.h"
#include "dashpot/numerics/distributions.h"
#include "dashpot/numerics/linear_algebra.h"

namespace dashpot {
namespace {

/// Names of plant, law and sensor unknowns among these, each once. States at the beginning are
/// nuisances that nobody asked for: they are named beside others only.
std::vector<std::string> names_of(const InPlantUnknowns& unknowns,
                                  const std::vector<std::size_t>& which) {
  std::vector<std::string> names;
  bool is_asked_for = false;
  for (const std::size_t u : which) {
    const std::string name = unknowns.name(u);
    is_asked_for |= u < unknowns.plant_unknowns() || unknowns.is_of_law(u) || unknowns.of_sensor(u);
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return is_asked_for ? names : std::vector<std::string>{};
}

/// The same of each group that has one.
std::vector<std::vector<std::string>> named_groups(const InPlantUnknowns& unknowns,
                                                   const Covariance& spread) {
  std::vector<std::vector<std::string>> groups;
  for (const auto& group : spread.confounded)
    if (std::vector<std::string> names = names_of(unknowns, group); !names.empty())
      groups.push_back(std::move(names));
  return groups;
}

/// Which unknowns are without effect or can be traded, by index.
std::vector<bool> weak_ones(const Covariance& spread, std::size_t n) {
  std::vector<bool> weak(n);
  for (const std::size_t k : spread.without_effect) weak[k] = true;
  for (const auto& group : spread.confounded)
    for (const std::size_t k : group) weak[k] = true;
  return weak;
}

/// Cut-offs that may as well be none, and those as low as was looked.
void add_cutoff_warnings(const InPlantUnknowns& unknowns, std::size_t count,
                         InPlantReport& report) {
  for (std::size_t k = 0; k < count; ++k) {
    const SensorUnknown* one = unknowns.of_sensor(k);
    if (!one || one->of != SensorUnknown::Of::Cutoff) continue;
    const FittedParameter& cutoff =
        *std::ranges::find(report.nuisances, unknowns.name(k), &FittedParameter::name);
    if (std::isinf(cutoff.high))
      report.warnings.push_back(cutoff.name + ": nothing tells it from no filter at all; above " +
                                format_number(cutoff.low, 3) + " Hz, if there is one");
    else if (cutoff.at_bound)
      report.warnings.push_back(cutoff.name + " = " + format_number(cutoff.value) +
                                " Hz stands at a bound of its range");
  }
}

}  // namespace

bool has_interval(const FittedParameter& parameter) { return !std::isnan(parameter.low); }

std::string name_in_law(const InPlantUnknowns& unknowns, std::size_t first, std::size_t k,
                        std::size_t size) {
  const std::size_t own = k - first;
  for (const auto& c : unknowns.law_coefficients(std::vector<double>(size, 1.0)))
    if (!c.weights.empty() && own >= c.first && own < c.first + c.weights.size()) {
      const std::size_t end = c.weights.size() > 1 ? c.name.rfind('_') : std::string::npos;
      return c.name.substr(0, end);
    }
  return "law";
}

Knowable knowable_of(const InPlantUnknowns& unknowns,
                     const std::vector<std::vector<double>>& part_matrices, std::size_t n) {
  Knowable known;
  if (part_matrices.empty()) return known;
  const std::vector<double> ones(part_matrices.size(), 1.0);
  const Covariance spread = covariance(part_matrices, ones, n);
  known.without_effect = names_of(unknowns, spread.without_effect);
  known.confounded = named_groups(unknowns, spread);

  // Singular values of the sensitivities, each column scaled to length 1.
  std::vector<double> normal(n * n);
  for (const std::vector<double>& one : part_matrices)
    for (std::size_t i = 0; i < n * n; ++i) normal[i] += one[i];
  std::vector<std::size_t> active;
  for (std::size_t k = 0; k < n; ++k)
    if (normal[k * n + k] > 0) active.push_back(k);
  const std::size_t m = active.size();
  std::vector<double> scaled(m * m), one(m * m);
  for (std::size_t i = 0; i < m; ++i) {
    known.unknowns.push_back(unknowns.name(active[i]));
    one[i * m + i] = 1;
    for (std::size_t k = 0; k < m; ++k)
      scaled[i * m + k] =
          normal[active[i] * n + active[k]] /
          std::sqrt(normal[active[i] * n + active[i]] * normal[active[k] * n + active[k]]);
  }
  if (m == 0) return known;
  for (const double square : eigenvalues(scaled, one, m))
    known.singular_values.push_back(std::sqrt(std::max(square, 0.0)));
  std::ranges::reverse(known.singular_values);
  return known;
}

void add_parameters(const InPlantUnknowns& unknowns, std::span<const double> x,
                    const Covariance& spread, InPlantReport& report, const Reach& reach) {
  const std::vector<bool> weak = weak_ones(spread, x.size());
  const auto interval = [&](FittedParameter& p, std::size_t of, std::span<const double> weights) {
    const double half = kNormal95 * std::sqrt(spread.variance(of, weights));
    const auto [below, above] = reach ? reach(of, weights) : std::pair(half, half);
    p.low = p.value - below;
    p.high = p.value + above;
  };

  // The plant's numbers, then the nuisances: both are single unknowns in a size of their own.
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (unknowns.is_of_law(k)) continue;
    FittedParameter p = unknowns.described(k, x);
    const double size[] = {unknowns.size_at(k, x)};
    interval(p, k, size);
    p.weak = weak[k];
    if (const SensorUnknown* one = unknowns.of_sensor(k)) tell(*one, p);
    (k < unknowns.plant_unknowns() ? report.plant : report.nuisances).push_back(std::move(p));
  }

  // The law's coefficients are weighted sums of its unknowns.
  const std::size_t first = unknowns.plant_unknowns();
  for (const auto& c : unknowns.law_coefficients(x)) {
    FittedParameter p{.name = c.name, .unit = c.unit, .meaning = c.meaning, .value = c.value};
    p.fixed = c.weights.empty();
    p.at_bound = c.at_bound;
    interval(p, first + c.first, c.weights);
    for (std::size_t k = 0; k < c.weights.size(); ++k) p.weak = p.weak || weak[first + c.first + k];
    report.damper.push_back(std::move(p));
  }
}

void add_warnings(const InPlantUnknowns& unknowns, const Covariance& spread,
                  InPlantReport& report) {
  for (const auto* list : {&report.plant, &report.damper})
    for (const FittedParameter& p : *list)
      if (p.at_bound)
        report.warnings.push_back(p.name + " = " + format_number(p.value) + " " + p.unit +
                                  " stands at a bound of its range");
  add_cutoff_warnings(unknowns, spread.n, report);
  if (const auto names = names_of(unknowns, spread.without_effect); !names.empty())
    report.warnings.push_back(join(names, ", ") + ": no sensor shows an effect");
  for (const auto& names : named_groups(unknowns, spread))
    report.warnings.push_back(join(names, " and ") +
                              " cannot be told apart by these sensors; --fix one of them");
}

namespace {

/// Each delay that `beside` asks for and `stated` does not.
std::vector<std::string> found_delays(const InPlantSetup& stated, const InPlantSetup& beside,
                                      const InPlantReport& report) {
  std::vector<std::string> found;
  for (std::size_t s = 0; s < stated.sensors.size(); ++s) {
    if (stated.sensors[s].finds_delay || !beside.sensors[s].finds_delay) continue;
    const FittedParameter& p = *lags_found(report.nuisances, stated.sensors[s].channel).delay;
    found.push_back(p.name + ' ' + format_number(1000 * p.value, 3) + " ms");
  }
  return found;
}

}  // namespace

std::string delays_found(const InPlantSetup& stated, const InPlantSetup& beside,
                         const InPlantReport& report) {
  const std::vector<std::string> found = found_delays(stated, beside, report);
  return "sensors and inputs are not at one time: " + join(found, ", ") +
         ", which the plant does not state, were found beside all else; where a filter makes them, "
         "state it ('filter: 50 Hz' at the sensor)";
}

std::string filters_found(const InPlantSetup& stated, const InPlantSetup& beside,
                          const InPlantReport& report) {
  std::vector<std::string> found;
  for (std::size_t s = 0; s < stated.sensors.size(); ++s) {
    if (stated.sensors[s].finds_cutoff || !beside.sensors[s].finds_cutoff) continue;
    const std::string& channel = stated.sensors[s].channel;
    const FittedParameter& p = *lags_found(report.nuisances, channel).cutoff;
    found.push_back("the sensor " + channel + " is as if behind a low-pass of " +
                    format_number(p.value, 3) + " Hz");
  }
  const std::vector<std::string> delays = found_delays(stated, beside, report);
  return join(found, ", ") + (delays.empty() ? "" : ", beside the " + join(delays, ", ")) +
         ", which the plant does not state and which was found beside all else: state it ('filter: "
         "unknown' at the sensor, with its order where that is not the second)";
}

std::string unlike_found(const InPlantSetup& unlike) {
  return "the dampers are not alike: those of " + join(unlike.kinds.names, ", ") +
         " were found each with numbers of their own; 'damper_kinds: alike' in the plant's file "
         "keeps "
         "them together";
}

void require_drive(const Law& law, const InPlantSetup& setup, const InPlantOptions& options,
                   std::vector<std::string>& warnings) {
  const bool follows =
      std::ranges::any_of(law.params, [](const ParamInfo& p) { return p.form != Form::Constant; });
  const auto asked = std::ranges::find_if(options.choices, [](const ParameterChoice& choice) {
    return choice.form && *choice.form != Form::Constant;
  });
  const std::vector<std::optional<double>> levels = held_levels(setup);
  for (std::size_t kind = 0; kind < levels.size(); ++kind) {
    if (!levels[kind]) continue;
    const std::string& name = setup.kinds.names[kind];
    const std::string drive = "the drive" + (name.empty() ? "" : " of the damper " + name) +
                              " is " + format_number(*levels[kind]) + " " +
                              to_string(setup.drive_unit) + " all along";
    if (asked != options.choices.end())
      throw Error("form of " + asked->parameter, "cannot be told: " + drive,
                  "record at several levels, or leave the form out");
    if (follows && setup.drive_unit != DriveUnit::None)
      warnings.push_back(drive + ": " + (name.empty() ? "the damper" : "it") +
                         " is identified there and nowhere else");
  }
}

}  // namespace dashpot
