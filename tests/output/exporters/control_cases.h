#pragma once
#include "dashpot/damper/inverse/registry.h"
#include "dashpot/output/exporters/c_controller.h"
#include "dashpot/output/exporters/c_inverse.h"
#include "output/exporters/example_models.h"

/// A controller on a vehicle, with a name in C.
struct ControlCase {
  std::string name;
  dashpot::VehicleWords words;
};

/// Every law on a quarter car, with true signals and with a car's sensors; laws of the whole plant on a full
/// car; the ways from a force to a current.
inline std::vector<ControlCase> control_cases() {
  std::vector<ControlCase> all;
  const auto add = [&](std::string name, dashpot::VehicleWords words) {
    words.sample_time = 2e-3;
    all.push_back({std::move(name), std::move(words)});
  };
  for (const dashpot::ControlLaw* law : dashpot::control_laws()) {
    add(std::string(law->name) + "_q", {.controller = std::string(law->name)});
    if (law->needs_plant_state) continue;
    add(std::string(law->name) + "_car", {.controller = std::string(law->name), .sensors = {.in_car = true}});
  }
  add("selector_q",
      {.controller = "selector(skyhook_modified/feb),crossover=3Hz", .sensors = {.in_car = true}});
  add("twice_q", {.controller = "selector(feb/feb)"});
  add("full_car", {.plant = "ikenaga2000", .dampers = {"ideal"}, .controller = "clipped_lqr,force=1e-8"});
  add("full_skyhook",
      {.plant = "ikenaga2000", .dampers = {"ideal"}, .controller = "feb", .sensors = {.in_car = true}});
  for (const char* inverse :
       {"numeric", "heaviside", "signum", "modified_clipped_optimal", "clipped_optimal"})
    add(std::string("spencer_") + inverse,
        {.dampers = {"spencer1997,motion_ratio=0.8"}, .controller = "skyhook_modified", .inverse = inverse});
  add("spencer_loop", {.dampers = {"spencer1997,motion_ratio=0.8"},
                       .controller = "skyhook_modified",
                       .inverse = "numeric",
                       .force_loop = "proportional=0.2,integral=5,derivative=1e-4"});
  return all;
}

/// An inverse of a damper, with a name in C.
struct InverseCase {
  std::string name;
  std::shared_ptr<const dashpot::LawModel> damper;
  std::shared_ptr<const dashpot::InverseModel> inverse;

  dashpot::ExportedInverse exported() const {
    return {.model = *inverse, .title = name, .domain = {-0.02, 0.02, -0.3, 0.3, 0, 2}};
  }
};

/// Every scheme on dampers that suit it, with and without a coil's lag where it leads one.
inline std::vector<InverseCase> inverse_cases() {
  std::vector<InverseCase> all;
  for (const std::string damper : {"bingham", "bouc_wen"})
    for (const dashpot::InverseScheme& scheme : dashpot::inverse_schemes()) {
      if (scheme.name == "polynomial" && damper == "bouc_wen") continue;
      for (const double lag : {0.0, 60.0}) {
        if (scheme.name.starts_with("neural") && (lag > 0 || damper == "bouc_wen")) continue;
        const auto model = std::make_shared<const dashpot::LawModel>(example_law(dashpot::find_law(damper)));
        all.push_back({damper + "_" + std::string(scheme.name) + (lag > 0 ? "_lag" : ""), model,
                       scheme.make(*model, {0, 2, 1e-3, lag})});
      }
    }
  return all;
}
