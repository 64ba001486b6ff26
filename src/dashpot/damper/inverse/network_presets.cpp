#include "dashpot/damper/inverse/network_presets.h"

#include "dashpot/base/find_row.h"

namespace dashpot {
namespace {

using enum Tap::Signal;

/// A signal at delays first ... last.
std::vector<Tap> taps(Tap::Signal signal, int first, int last) {
  std::vector<Tap> row;
  for (int delay = first; delay <= last; ++delay) row.push_back({signal, delay});
  return row;
}

std::vector<Tap> joined(std::initializer_list<std::vector<Tap>> rows) {
  std::vector<Tap> all;
  for (const std::vector<Tap>& row : rows) all.insert(all.end(), row.begin(), row.end());
  return all;
}

std::vector<InverseNetworkPreset> make_presets() {
  // All of one size, so that a comparison of them is one of their inputs.
  return {
      {.name = "chang_zhou",
       .title = "Motion, wanted force and its own past current",
       .equation = "i(k) = net(x(k), x(k-1), v(k), v(k-1), f(k), f(k-1), i(k-1)),  7-14-1, tanh",
       .source = "after Chang, Zhou 2002, J. Structural Engineering 128(2), 231-239",
       .remarks = "The kinds of inputs are those of the source as recalled, delays and size are "
                  "ours; nothing is pruned.",
       .taps = joined({taps(Displacement, 0, 1), taps(Velocity, 0, 1), taps(Force, 0, 1),
                       taps(Current, 1, 1)}),
       .hidden = {14}},
      {.name = "history",
       .title = "Motion and wanted force with their past, no feedback",
       .equation = "i(k) = net(x(k), v(k) ... v(k-2), f(k) ... f(k-2)),  7-14-1, tanh",
       .source = "Dashpot",
       .remarks = "Cannot hold on to an own mistake.",
       .taps = joined({taps(Displacement, 0, 0), taps(Velocity, 0, 2), taps(Force, 0, 2)}),
       .hidden = {14}},
      {.name = "metered",
       .title = "Without a velocity sensor",
       .equation = "i(k) = net(x(k) ... x(k-3), f(k) ... f(k-3), i(k-1), i(k-2)),  10-14-1, tanh",
       .source = "after Metered, Bonello, Oyadiji 2010, Mechanical Systems and Signal Processing "
                 "24(3), 676-694",
       .remarks = "The kinds of inputs are those of the source as recalled, delays and size are "
                  "ours. Past displacements stand for the velocity.",
       .taps = joined({taps(Displacement, 0, 3), taps(Force, 0, 3), taps(Current, 1, 2)}),
       .hidden = {14}},
      {.name = "one_sensor",
       .title = "Velocity and wanted force with their past",
       .equation = "i(k) = net(v(k) ... v(k-3), f(k) ... f(k-3)),  8-14-1, tanh",
       .source = "Dashpot, in the spirit of the one-sensor paper",
       .remarks = "One sensor, no feedback.",
       .taps = joined({taps(Velocity, 0, 3), taps(Force, 0, 3)}),
       .hidden = {14}},
      {.name = "static",
       .title = "The present alone",
       .equation = "i = net(x, v, f),  3-14-1, tanh",
       .source = "usual in the literature; no single source",
       .remarks = "Cannot know on which branch of its hysteresis the damper is.",
       .taps = joined({taps(Displacement, 0, 0), taps(Velocity, 0, 0), taps(Force, 0, 0)}),
       .hidden = {14}},
      {.name = "zapateiro",
       .title = "The present and its own past current",
       .equation = "i(k) = net(x(k), v(k), f(k), i(k-1)),  4-14-1, tanh",
       .source = "after Zapateiro et al. 2009, cited by the one-sensor paper for its recurrent "
                 "inverse network",
       .remarks =
           "The source was not at hand: this is the least network of that kind, not its figures.",
       .taps = joined({taps(Displacement, 0, 0), taps(Velocity, 0, 0), taps(Force, 0, 0),
                       taps(Current, 1, 1)}),
       .hidden = {14}},
  };
}

}  // namespace

std::span<const InverseNetworkPreset> inverse_network_presets() {
  static const std::vector<InverseNetworkPreset> presets = make_presets();
  return presets;
}

std::vector<std::string> inverse_network_names() {
  std::vector<std::string> names;
  for (const InverseNetworkPreset& preset : inverse_network_presets())
    names.emplace_back(preset.name);
  return names;
}

const InverseNetworkPreset& find_inverse_network(std::string_view name, const std::string& where) {
  return find_row(inverse_network_presets(), name, "inverse network", where);
}

}  // namespace dashpot
