#include "dashpot/machine/in_plant.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "dashpot/damper/law_list.h"
#include "dashpot/machine/duhem_law.h"
using namespace dashpot;
int main(int argc, char** argv) {
  const std::string way = argv[1];
  PlantRecording rec = read_plant_recording(argv[2], {"excitation", "displacement"});
  InPlantSetup setup;
  setup.model = &find_machine("oscillator", "");
  setup.unknown = {{"mass", 1e-6, 1e9, {}}, {"damping", 0, 1e9, {}}, {"stiffness", 0, 1e12, {}}};
  setup.inputs = {{"excitation", {PlantInput::Force, 0}}};
  setup.sensors = {{"displacement", {PlantQuantity::Displacement, 0}}};
  setup.held_back = 0.2;
  setup.skip = 0.05;
  InPlantOptions options;
  if (argc > 3) options.starts = std::atoi(argv[3]);
  if (argc > 4) options.steps = std::atoi(argv[4]);
  if (argc > 5) setup.sensors[0].finds_delay = true;
  if (way == "grey")
    options.choices = {{.law = {}, .parameter = "c0", .fixed = 0.0},
                       {.law = {}, .parameter = "k0", .fixed = 0.0},
                       {.law = {}, .parameter = "beta", .bounds = ParameterBounds{-1e13, 1e13}},
                       {.law = {}, .parameter = "n", .free = true}};
  else
    options.choices = {{.law = {}, .parameter = "c", .fixed = 0.0}};
  options.monitor.on_progress = [](const Progress& p) {
    std::fprintf(stderr, "%s %.2f\n", p.stage.c_str(), p.fraction);
  };
  InPlantReport r =
      identify_in_plant(way == "grey" ? find_law("bouc_wen") : duhem_law(), setup, {rec}, options);
  std::printf("%d %s steps %zu step error %g, %d iterations %.1f s CPU\n", (int)r.status,
              r.message.c_str(), r.steps, r.step_error, r.iterations, r.seconds);
  for (auto* l : {&r.plant, &r.damper, &r.nuisances})
    for (auto& p : *l)
      std::printf("%-12s %14.8g  [%g %g] %s%s%s\n", p.name.c_str(), p.value, p.low, p.high,
                  p.unit.c_str(), p.at_bound ? " bound" : "", p.weak ? " weak" : "");
  for (auto& w : r.warnings) std::printf("warning: %s\n", w.c_str());
  for (auto& s : r.sensors)
    std::printf("%s rms %g training %g held %g\n", s.channel.c_str(), s.rms, s.training,
                s.held_back);
  for (double v : r.knowable.singular_values) std::printf("%.3g ", v);
  // without noise: product of residuals of two periods
  const InPlantTrace& t = r.traces[0];
  double sum = 0;
  size_t N = 8192;
  for (size_t k = 0; k < N; ++k) {
    double e5 = t.measured[0][4 * N + k] - t.modelled[0][4 * N + k], e = 0;
    for (size_t p = 1; p < 4; ++p) e += (t.measured[0][p * N + k] - t.modelled[0][p * N + k]) / 3;
    sum += e5 * e;
  }
  std::printf("\nwithout noise: mean square %g, rms %g\n", sum / N, std::sqrt(std::abs(sum / N)));
}
