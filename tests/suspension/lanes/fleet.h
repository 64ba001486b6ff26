#pragma once
#include "dashpot/damper/kinds/network/network_model.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/registry.h"
#include "dashpot/plant.h"
#include "dashpot/suspension/ground/ground_sequences.h"
#include "dashpot/suspension/lanes/batch.h"
#include "support.h"

// Fleets of vehicles with dampers made for the tests of lanes, and how far their rides lie apart.
namespace fleets {

using namespace dashpot;

inline MountedDamper mounted(std::shared_ptr<const DamperModel> model, double current_max,
                             double lag_rate = 0) {
  return {.model = std::move(model),
          .driver = {.current_min = 0, .current_max = current_max, .lag_rate = lag_rate}};
}

inline MountedDamper network_damper(std::vector<std::size_t> layers,
                                    std::vector<std::string> inputs, double lag_rate = 0) {
  Mlp mlp;
  mlp.layers = std::move(layers);
  mlp.input_mean.assign(inputs.size(), 0.1);
  mlp.input_scale.assign(inputs.size(), 0.3);
  mlp.output_scale = 700;
  initialise(mlp, 3);
  for (double& weight : mlp.parameters) weight = std::abs(weight);  // so that it takes energy
  return mounted(std::make_shared<NetworkModel>("network", std::move(inputs), std::vector{mlp}, 5),
                 1, lag_rate);
}

inline MountedDamper law_damper(const char* name, std::vector<double> values, double lag_rate = 0) {
  return mounted(std::make_shared<LawModel>(LawModel::constant(find_law(name), values)), 1,
                 lag_rate);
}

inline MountedDamper spencer_damper() {
  return mounted(std::make_shared<LawModel>(load_parameters("spencer1997")), 2.25);
}

/// A network of two members that are the same, which lanes do not have.
inline std::shared_ptr<const DamperModel> twins_of(const MountedDamper& damper) {
  const auto& network = dynamic_cast<const NetworkModel&>(*damper.model);
  return std::make_shared<NetworkModel>("twins", network.inputs(),
                                        std::vector(2, network.members()[0]), network.offset());
}

/// A plant set, and the parameter that its vehicles differ by: its least value, in steps of 10.
struct Make {
  const char* set;
  const char* mass;
  double least;
};
constexpr Make kQuarter{"tudon_martinez2012", "sprung_mass", 350}, kHalf{"half_car_a", "mass", 640},
    kFull{"ikenaga2000", "mass", 1450};

/// Vehicles of their own masses and roads with one damper in every strut and one controller.
struct Fleet {
  Fleet(const Make& make, MountedDamper damper, const char* law, std::size_t count,
        const NamedValues& values = {}) {
    limits.current_max = damper.driver.current_max;
    for (std::size_t k = 0; k < count; ++k) {
      NamedValues own = values;
      own.emplace_back(make.mass, make.least + 10 * static_cast<double>(k));
      plants.push_back(load_plant_set(make.set, own).plant);
      roads.push_back(make_ground(
          "iso8608,class=C,length=100,wave_number_max=1,waves=100,track_width=1.5", k + 1));
    }
    dampers.assign(plants[0].struts.size(), damper);
    if (law) controller = make_controller(law, {limits, plants[0]});
    for (std::size_t k = 0; k < count; ++k)
      vehicles.push_back({{plants[k], dampers, *roads[k], controller.get()}, limits, {}});
  }
  /// Of quarter cars.
  Fleet(MountedDamper damper, const char* law, std::size_t count, const NamedValues& values = {})
      : Fleet(kQuarter, std::move(damper), law, count, values) {}

  ControlLimits limits;
  std::vector<MountedDamper> dampers;
  std::vector<Plant> plants;
  std::vector<GroundPointer> roads;
  ControllerPointer controller;
  std::vector<BatchVehicle> vehicles;
};

/// Greatest distance of a channel from another one, of the other one's greatest magnitude.
inline double apart(const Record& a, const std::string& channel, const Record& b,
                    const std::string& other) {
  const std::vector<double>&x = a.channel(channel).samples, &y = b.channel(other).samples;
  REQUIRE(x.size() == y.size());
  double top = 0, off = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    top = std::max(top, std::abs(y[k]));
    off = std::max(off, std::abs(x[k] - y[k]));
  }
  return top > 0 ? off / top : off;
}
inline double apart(const Record& a, const Record& b, const std::string& channel) {
  return apart(a, channel, b, channel);
}

inline void check_same(const BatchResult& a, const BatchResult& b) {
  CHECK(a.measures.body_acceleration == b.measures.body_acceleration);
  CHECK(a.measures.weighted_acceleration == b.measures.weighted_acceleration);
  CHECK(a.measures.tyre_load == b.measures.tyre_load);
  CHECK(a.measures.energy == b.measures.energy);
  CHECK(a.measures.greatest_deflection == b.measures.greatest_deflection);
  CHECK(a.evaluations == b.evaluations);
}

}  // namespace fleets
