#include "dashpot/suspension/lanes/lane_pilot.h"

#include <algorithm>
#include <cmath>

namespace dashpot {

LanePilot::Driver::Driver(const BatchVehicle& v)
    : vehicle(&v),
      forces(v.setting.plant, v.setting.ground),
      sensors(v.sensors, v.setting.plant.struts.size(), v.limits.sample_time),
      state(v.setting.controller ? v.setting.controller->state_size() : 0),
      signals(v.setting.plant.struts.size()),
      demands(signals.size()),
      x(2 * v.setting.plant.size()),
      heights(v.setting.plant.tyres.size()),
      resting(v.setting.plant.size()) {
  for (const MountedDamper& damper : v.setting.dampers) paths.emplace_back(damper, v.limits, 0);
  if (v.setting.controller) v.setting.controller->reset(state);
}

LanePilot::LanePilot(std::span<const BatchVehicle* const> vehicles, std::size_t lanes)
    : lanes_(lanes) {
  drivers_.reserve(vehicles.size());
  for (const BatchVehicle* vehicle : vehicles) drivers_.emplace_back(*vehicle);
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
  const double half = 0.5 * sample_time_of(vehicle);
  for (const Tyre& tyre : vehicle.setting.plant.tyres) {
    vehicle.setting.ground.feet(half * static_cast<double>(first), half, tyre.track, tyre.behind,
                                feet_);
    for (std::size_t k = 0; k < kLaneNodes; ++k) {
      heights[k * lanes_ + lane] = feet_[k].height;
      rates[k * lanes_ + lane] = feet_[k].velocity;
    }
    heights += kLaneNodes * lanes_;
    rates += kLaneNodes * lanes_;
  }
}

void LanePilot::control(const double* signals, double* commands, const std::int64_t* which) {
  for (std::size_t lane = 0; lane < drivers_.size(); ++lane)
    if (which[lane]) command(drivers_[lane], signals + lane, commands + lane);

  // Further lanes go as the last driver's does.
  const std::size_t struts = drivers_.front().signals.size();
  for (std::size_t s = 0; s < struts; ++s, commands += lanes_)
    std::fill(commands + drivers_.size(), commands + lanes_, commands[drivers_.size() - 1]);
}

void LanePilot::command(Driver& driver, const double* signals, double* commands) const {
  const BatchVehicle& vehicle = *driver.vehicle;
  const std::size_t struts = driver.signals.size(), coordinates = driver.resting.size();
  const auto of_strut = [&](std::size_t s, LaneSignal row) {
    return signals[(s * kLaneSignals + row) * lanes_];
  };

  // The true signals of this lane's struts.
  for (std::size_t s = 0; s < struts; ++s)
    driver.signals[s] = {.body_velocity = of_strut(s, kBodyVelocity),
                         .body_acceleration = of_strut(s, kBodyAcceleration),
                         .wheel_velocity = of_strut(s, kWheelVelocity),
                         .deflection = of_strut(s, kDeflection),
                         .deflection_velocity = of_strut(s, kDeflectionVelocity),
                         .force = of_strut(s, kForce),
                         .current = of_strut(s, kCurrent)};

  // And the plant's state, heights counted from rest on the ground as it is.
  const double* behind = signals + struts * kLaneSignals * lanes_;
  for (double& value : driver.x) {
    value = *behind;
    behind += lanes_;
  }
  for (double& height : driver.heights) {
    height = *behind;
    behind += lanes_;
  }
  driver.forces.resting_place(driver.heights, driver.resting);
  for (std::size_t k = 0; k < coordinates; ++k) driver.x[k] -= driver.resting[k];

  // The controller's demands as the sensors let it see them, as currents within the drivers'
  // limits. A NaN keeps the command.
  const bool ideal = driver.sensors.ideal();
  if (!ideal) driver.sensors.measure(driver.signals);
  vehicle.setting.controller->step(
      driver.signals, ideal ? std::span<const double>(driver.x) : std::span<const double>(),
      driver.state, driver.demands);
  for (std::size_t s = 0; s < struts; ++s) {
    const StrutSignals& seen = driver.signals[s];
    const double wanted = driver.paths[s].command(
        driver.demands[s], {seen.deflection, seen.deflection_velocity, seen.current},
        of_strut(s, kForce));
    const DriverOptions& limits = vehicle.setting.dampers[s].driver;
    double& command = commands[s * lanes_];
    if (!std::isnan(wanted)) command = std::clamp(wanted, limits.current_min, limits.current_max);
  }
}

}  // namespace dashpot
