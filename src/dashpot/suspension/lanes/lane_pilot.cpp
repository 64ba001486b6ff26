#include "dashpot/suspension/lanes/lane_pilot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/suspension/lanes/lane_vehicle.h"
#include "dashpot/suspension/plants/plant_forces.h"

namespace dashpot {
namespace {

struct RaisedGround final : GroundMotion {
  std::string description() const override { return "1 m higher"; }
  FootMotion foot(double, std::size_t, double) const noexcept override { return {1, 0}; }
};

}  // namespace

LanePilot::LanePilot(std::span<const BatchVehicle* const> vehicles, std::size_t lanes)
    : lanes_(lanes) {
  for (const BatchVehicle* vehicle : vehicles) {
    const Setting& setting = vehicle->setting;
    drivers_.push_back(
        {vehicle,
         Sensors(vehicle->sensors, 1, vehicle->limits.sample_time),
         CommandPath(setting.dampers[0], vehicle->limits, 0),
         std::vector<double>(setting.controller ? setting.controller->state_size() : 0),
         {}});
    if (!setting.controller) continue;
    setting.controller->reset(drivers_.back().state);
    PlantForces(setting.plant, RaisedGround()).resting_place(0, drivers_.back().resting);
  }
}

void LanePilot::take(LaneRide& ride) {
  ride.pilot = this;
  ride.ground = [](void* self, std::size_t lane, std::size_t first, double* heights,
                   double* rates) {
    static_cast<LanePilot*>(self)->ground(lane, first, heights, rates);
  };
  if (drivers_.front().vehicle->setting.controller)
    ride.control = [](void* self, const double* signals, double* commands,
                      const std::int64_t* which) {
      static_cast<LanePilot*>(self)->control(signals, commands, which);
    };
}

void LanePilot::ground(std::size_t lane, std::size_t first, double* heights,
                       double* rates) noexcept {
  const BatchVehicle& vehicle = *drivers_[std::min(lane, drivers_.size() - 1)].vehicle;
  const Tyre& tyre = vehicle.setting.plant.tyres[0];
  const double half = 0.5 * sample_time_of(vehicle);
  vehicle.setting.ground.feet(half * static_cast<double>(first), half, tyre.track, tyre.behind,
                              feet_);
  for (std::size_t k = 0; k < kLaneNodes; ++k) {
    heights[k * lanes_ + lane] = feet_[k].height;
    rates[k * lanes_ + lane] = feet_[k].velocity;
  }
}

void LanePilot::control(const double* signals, double* commands, const std::int64_t* which) {
  for (std::size_t lane = 0; lane < drivers_.size(); ++lane)
    if (which[lane]) commands[lane] = command(drivers_[lane], signals + lane, commands[lane]);
  std::fill(commands + drivers_.size(), commands + lanes_, commands[drivers_.size() - 1]);
}

double LanePilot::command(Driver& driver, const double* signals, double before) const {
  const auto signal = [&](LaneSignal row) { return signals[row * lanes_]; };
  const BatchVehicle& vehicle = *driver.vehicle;

  // The true signals of this lane; heights counted from rest on the ground as it is.
  StrutSignals strut{.body_velocity = signal(kBodyVelocity),
                     .body_acceleration = signal(kBodyAcceleration),
                     .wheel_velocity = signal(kWheelVelocity),
                     .deflection = signal(kDeflection),
                     .deflection_velocity = signal(kDeflectionVelocity),
                     .force = signal(kForce),
                     .current = signal(kCurrent)};
  DamperInput seen{signal(kDeflection), signal(kDeflectionVelocity), signal(kCurrent)};
  const std::array<double, 4> x{signal(kBody) - driver.resting[0] * signal(kGround),
                                signal(kWheel) - driver.resting[1] * signal(kGround),
                                signal(kBodyVelocity), signal(kWheelVelocity)};

  // As the sensors see them.
  const bool ideal = driver.sensors.ideal();
  if (!ideal) {
    driver.sensors.measure({&strut, 1});
    seen = {strut.deflection, strut.deflection_velocity, strut.current};
  }

  // The controller's demand as a current within the driver's limits. A NaN keeps the command.
  DamperDemand demand;
  vehicle.setting.controller->step({&strut, 1},
                                   ideal ? std::span<const double>(x) : std::span<const double>(),
                                   driver.state, {&demand, 1});
  const double wanted = driver.path.command(demand, seen, signal(kForce));
  const DriverOptions& limits = vehicle.setting.dampers[0].driver;
  return std::isnan(wanted) ? before : std::clamp(wanted, limits.current_min, limits.current_max);
}

}  // namespace dashpot
