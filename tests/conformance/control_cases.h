#pragma once
#include <memory>
#include <string>
#include <vector>

#include "dashpot/damper/inverse/registry.h"
#include "dashpot/export/c/c_controller.h"
#include "dashpot/export/c/c_inverse.h"
#include "export/example_models.h"

/// A controller or an inverse, with a name in C.
struct BlockCase {
  std::string name;
  dashpot::CBlockMaker block;
};

/// Every law on a quarter car, with true signals and with a car's sensors; laws of the whole plant
/// on a full car; the ways from a force to a current.
inline std::vector<BlockCase> controller_cases() {
  using namespace dashpot;
  std::vector<BlockCase> all;
  const auto add = [&](const std::string& name, VehicleWords words) {
    words.sample_time = 2e-3;
    all.push_back({name, [name, words](ExportOptions options) {
                     options.name = name;
                     return c_controller_block(make_vehicle(words), options);
                   }});
  };
  for (const ControlLaw* law : control_laws()) {
    const std::string name(law->name);
    add(name + "_q", {.controller = name});
    if (!law->needs_plant_state)
      add(name + "_car", {.controller = name, .sensors = {.in_car = true}});
  }
  add("selector_q",
      {.controller = "selector(skyhook_modified/feb),crossover=3Hz", .sensors = {.in_car = true}});
  add("twice_q", {.controller = "selector(feb/feb)"});
  add("full_car",
      {.plant = "ikenaga2000", .dampers = {"ideal"}, .controller = "clipped_lqr,force=1e-8"});
  add("full_skyhook", {.plant = "ikenaga2000",
                       .dampers = {"ideal"},
                       .controller = "feb",
                       .sensors = {.in_car = true}});
  for (const char* inverse :
       {"numeric", "heaviside", "signum", "modified_clipped_optimal", "clipped_optimal"})
    add(std::string("spencer_") + inverse, {.dampers = {"spencer1997,motion_ratio=0.8"},
                                            .controller = "skyhook_modified",
                                            .inverse = inverse});
  add("spencer_loop", {.dampers = {"spencer1997,motion_ratio=0.8"},
                       .controller = "skyhook_modified",
                       .inverse = "numeric",
                       .force_loop = "proportional=0.2,integral=5,derivative=1e-4"});
  return all;
}

/// Every scheme on dampers that suit it, with and without a lag of the coil.
inline std::vector<BlockCase> inverse_cases() {
  using namespace dashpot;
  std::vector<BlockCase> all;
  for (const std::string damper : {"bingham", "bouc_wen"})
    for (const InverseScheme& scheme : inverse_schemes())
      for (const double lag : {0.0, 60.0}) {
        const bool network = scheme.name.starts_with("neural");
        if (damper == "bouc_wen" && (scheme.name == "polynomial" || network)) continue;
        if (network && lag > 0) continue;
        const std::string name = damper + '_' + std::string(scheme.name) + (lag > 0 ? "_lag" : "");
        const auto model = std::make_shared<const LawModel>(example_law(find_law(damper)));
        const std::shared_ptr<const InverseModel> inverse = scheme.make(*model, {0, 2, 1e-3, lag});
        all.push_back({name, [name, model, inverse](ExportOptions options) {
                         options.name = name;
                         return c_inverse_block({.model = *inverse,
                                                 .title = "the inverse " + name,
                                                 .domain = {-0.02, 0.02, -0.3, 0.3, 0, 2}},
                                                options);
                       }});
      }
  return all;
}

inline std::vector<BlockCase> block_cases() {
  std::vector<BlockCase> all = controller_cases(), inverses = inverse_cases();
  all.insert(all.end(), inverses.begin(), inverses.end());
  return all;
}
