#pragma once
#include <array>
#include <cmath>
#include <fstream>
#include <memory>
#include <numbers>

#include "dashpot/damper/kinds/network/network_model.h"
#include "dashpot/damper/laws/modified_bouc_wen.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/drive.h"
#include "dashpot/ground_motion.h"
#include "dashpot/mounted_damper.h"
#include "dashpot/plant.h"
#include "dashpot/suspension/ground/road_profile.h"
#include "peer.h"

// The rides that all integrators take: the one-sensor paper's quarter car, or a half car, 10 s of a
// class C road at 20 m/s, Mix-1 at 1 kHz, rtol 1e-6, atol 1e-9. A full car is Dashpot's own.
namespace peer {

constexpr double kRideSeconds = 10, kSample = 1e-3, kRelative = 1e-6, kAbsolute = 1e-9;
constexpr double kSpeed = 20, kCrossover = 1.9;
constexpr std::size_t kSamples10s = 10000;

enum class Ride { Network, BoucWen, HalfNetwork, HalfBoucWen, FullNetwork, FullBoucWen };
struct RideRow {
  Ride ride;
  const char *task, *plant;
  std::size_t struts;
  bool network;      ///< else the modified Bouc-Wen damper
  double drive_max;  ///< A, or V
};
constexpr RideRow kRides[] = {
    {Ride::Network, "ride_network", "tudon_martinez2012", 1, true, 1},
    {Ride::BoucWen, "ride_bouc_wen", "tudon_martinez2012", 1, false, 2.25},
    {Ride::HalfNetwork, "ride_half_network", "half_car_a", 2, true, 1},
    {Ride::HalfBoucWen, "ride_half_bouc_wen", "half_car_a", 2, false, 2.25},
    {Ride::FullNetwork, "ride_full_network", "ikenaga2000", 4, true, 1},
    {Ride::FullBoucWen, "ride_full_bouc_wen", "ikenaga2000", 4, false, 2.25}};
constexpr const RideRow& row_of(Ride ride) { return kRides[static_cast<int>(ride)]; }

/// 2-10-1 tanh of velocity and current, fitted to a curve that looks like a small damper's.
inline dashpot::Mlp ride_network() {
  dashpot::TrainingSamples samples;
  dashpot::Random random(3);
  for (int s = 0; s < 2000; ++s) {
    const double v = 1.5 * std::pow(random.uniform(-1, 1), 3), i = random.uniform();
    samples.inputs.insert(samples.inputs.end(), {v, i});
    samples.targets.push_back((150 + 900 * i) * std::tanh(v / 0.08) + (700 + 900 * i) * v);
  }
  dashpot::Mlp mlp;
  mlp.layers = kTanh;
  mlp.input_mean = {0, 0.5};
  mlp.input_scale = {0.5, 0.3};
  mlp.output_scale = 800;
  initialise(mlp, 1);
  train(mlp, samples, {.max_iterations = 100});
  return mlp;
}

/// A vehicle of its own road for each number.
inline dashpot::RoadProfile ride_road(int vehicle) {
  return dashpot::cosine_road({.length = kSpeed * (kRideSeconds + 0.1),
                               .spacing = kSpeed * kSample,  // so that a sample lies on each point
                               .seed = static_cast<std::uint64_t>(vehicle) + 1});
}
inline dashpot::Plant ride_plant(Ride ride) {
  return dashpot::load_plant_set(row_of(ride).plant).plant;
}

inline dashpot::MountedDamper ride_damper(Ride ride) {
  dashpot::MountedDamper damper;
  damper.driver.current_max = row_of(ride).drive_max;
  if (row_of(ride).network) {
    damper.model = std::make_shared<dashpot::NetworkModel>(
        "network", std::vector<std::string>{"velocity", "current"}, std::vector{ride_network()});
    return damper;
  }
  const dashpot::LawModel published = dashpot::load_parameters("spencer1997");
  dashpot::Dependence parameters = published.parameters();
  parameters.coefficients[published.law().index_of("x0")] = {0};
  damper.model = std::make_shared<dashpot::LawModel>(
      published.law(), parameters, dashpot::DriveUnit::Volt, published.lag_rate());
  return damper;
}

/// The plant's numbers: kg, N/m.
constexpr double kBody = 387, kWheel = 139.5, kSpring = 37300, kTyre = 295200;  // table 7

/// A sample of Mix-1: hard where the body moves slower than at the crossover.
inline bool is_hard(double body_velocity, double body_acceleration) {
  const double rate = 2 * std::numbers::pi * kCrossover * body_velocity;
  return body_acceleration * body_acceleration - rate * rate <= 0;
}

/// The road as Dashpot has it: a cubic between its points, one per sample. Height: double, or one
/// per vehicle.
template <class Height>
Height road_at(const std::vector<Height>& heights, double t) {
  const double place = t / kSample;
  const auto k = std::min(static_cast<std::size_t>(place), heights.size() - 3);
  const double u = place - static_cast<double>(k), w = 1 - u;
  const Height rise = heights[k + 1] - heights[k];
  const Height before = k > 0 ? 0.5 * (heights[k + 1] - heights[k - 1]) : Height{};
  const Height after = 0.5 * (heights[k + 2] - heights[k]);
  return heights[k] + u * (rise * u * (3 - 2 * u) + w * (w * before - u * after));
}

/// The same as equations for a general integrator: y = heights, with the half car's pitch behind
/// that of its body, and wheels; their rates; then strut by strut the law's two states and its
/// coil's voltage.
class RideEquations {
 public:
  RideEquations(Ride ride, int vehicle)
      : row_(row_of(ride)), heights_(ride_road(vehicle).tracks[0]) {
    const dashpot::MountedDamper damper = ride_damper(ride);
    if (row_.network) {
      const auto& network = dynamic_cast<const dashpot::NetworkModel&>(*damper.model);
      mlp_ = network.members().front();
      for (int n = 0; n < 10; ++n) {  // on raw inputs
        const double* w = &mlp_.parameters[2 * n];
        neurons_[n] = {w[0] / mlp_.input_scale[0], w[1] / mlp_.input_scale[1],
                       mlp_.parameters[20 + n], mlp_.parameters[30 + n] * mlp_.output_scale};
        neurons_[n][2] -= neurons_[n][0] * mlp_.input_mean[0] + neurons_[n][1] * mlp_.input_mean[1];
      }
      bias_ = mlp_.output_mean + mlp_.output_scale * mlp_.parameters[40];
    } else {
      const auto& law = dynamic_cast<const dashpot::LawModel&>(*damper.model);
      lag_rate_ = law.lag_rate();
      law.parameters_at(0, &off_.alpha);
      ModifiedBoucWen on;
      law.parameters_at(1, &on.alpha);
      alpha_slope_ = on.alpha - off_.alpha;
      c0_slope_ = on.c0 - off_.c0;
      c1_slope_ = on.c1 - off_.c1;
    }
  }

  std::size_t size() const { return 4 * row_.struts + (row_.network ? 0 : 3 * row_.struts); }
  const std::vector<double>& heights() const { return heights_; }

  /// Of the network: its neurons (by velocity, by current, bias, out), bias; of the law: its
  /// parameters without current, the slopes of alpha, c0 and c1 by it, the lag's rate.
  std::vector<double> numbers() const {
    std::vector<double> all;
    if (row_.network) {
      for (const auto& neuron : neurons_) all.insert(all.end(), neuron.begin(), neuron.end());
      all.push_back(bias_);
    } else {
      all.assign(&off_.alpha, &off_.alpha + sizeof off_ / sizeof(double));
      all.insert(all.end(), {alpha_slope_, c0_slope_, c1_slope_, lag_rate_});
    }
    return all;
  }

  /// dy/dt; the commands are constant between samples.
  void derivative(double t, const double* y, double* dy) const {
    ++evaluations;
    if (row_.struts > 1) return half_car(t, y, dy);
    const double x = y[0] - y[1], v = y[2] - y[3];
    const double spring = kSpring * x + damper(0, x, v, y + 4, dy + 4);
    dy[0] = y[2];
    dy[1] = y[3];
    dy[2] = -spring / kBody;
    dy[3] = (spring - kTyre * (y[1] - road_at(heights_, t))) / kWheel;
  }

  /// A sample of Mix-1 at each strut: hard where the body moves slower than at the crossover.
  /// Whether a command has changed.
  bool control(const double* y, const double* dy) {
    if (row_.struts == 1) return control(0, y[2], dy[2]);
    const bool front = control(0, y[4] - kFront * y[5], dy[4] - kFront * dy[5]),
               rear = control(1, y[4] + kRear * y[5], dy[4] + kRear * dy[5]);
    return front || rear;
  }
  /// Body, (front) wheel and their speeds.
  std::array<double, 4> sample(const double* y) const {
    if (row_.struts == 1) return {y[0], y[1], y[2], y[3]};
    return {y[0], y[2], y[4], y[6]};
  }

  mutable std::size_t evaluations = 0;

 private:
  /// Body, pitch (positive lowers the front), front wheel, rear wheel. Out of line, so that the
  /// compiler sees the quarter car alone where it integrates.
  [[gnu::noinline]] void half_car(double t, const double* y, double* dy) const {
    const double *v = y + 4, front = y[0] - kFront * y[1] - y[2], rear = y[0] + kRear * y[1] - y[3];
    const double at_front = kFrontSpring * front +
                            damper(0, front, v[0] - kFront * v[1] - v[2], y + 8, dy + 8),
                 at_rear = kRearSpring * rear +
                           damper(1, rear, v[0] + kRear * v[1] - v[3], y + 11, dy + 11);
    for (int k = 0; k < 4; ++k) dy[k] = v[k];
    dy[4] = -(at_front + at_rear) / kHalfBody;
    dy[5] = (kFront * at_front - kRear * at_rear) / kInertia;
    dy[6] = (at_front - kHalfTyre * (y[2] - road_at(heights_, t))) / kFrontWheel;
    dy[7] = (at_rear -
             kHalfTyre * (y[3] - road_at(heights_, std::max(t - (kFront + kRear) / kSpeed, 0.0)))) /
            kRearWheel;
  }
  /// Force of a strut's damper, N, and the rates of its states.
  [[gnu::always_inline]] inline double damper(int strut, double x, double v, const double* z,
                                              double* dz) const {
    if (row_.network) return network(v, commands_[strut]);
    law_at(z[2], law_);
    const double force = modified_bouc_wen_force(&law_, x, v, z);
    modified_bouc_wen_derivative(&law_, x, v, z, dz);
    dz[2] = lag_rate_ * (commands_[strut] - z[2]);
    return force;
  }
  bool control(int strut, double body_velocity, double body_acceleration) {
    const double before = commands_[strut];
    commands_[strut] = is_hard(body_velocity, body_acceleration) ? row_.drive_max : 0;
    return commands_[strut] != before;
  }
  void law_at(double u, ModifiedBoucWen& p) const {
    p = off_;
    p.alpha += alpha_slope_ * u;
    p.c0 += c0_slope_ * u;
    p.c1 += c1_slope_ * u;
  }
  double network(double v, double i) const {
    double force = bias_;
    for (const auto& [by_v, by_i, bias, out] : neurons_)
      force += out * std::tanh(by_v * v + by_i * i + bias);
    return force;
  }

  static constexpr double kHalfBody = 690, kInertia = 1222, kFrontWheel = 40, kRearWheel = 45,
                          kFrontSpring = 17000, kRearSpring = 22000, kHalfTyre = 200000,
                          kFront = 1.3,
                          kRear = 1.5;  // data/plants/half_car_a.json
  const RideRow& row_;
  std::array<double, 2> commands_{};
  std::vector<double> heights_;
  dashpot::Mlp mlp_;
  std::array<std::array<double, 4>, 10> neurons_{};
  double bias_ = 0, lag_rate_ = 0, alpha_slope_ = 0, c0_slope_ = 0, c1_slope_ = 0;
  ModifiedBoucWen off_{};
  mutable ModifiedBoucWen law_{};
};

/// Body, (first) wheel and their speeds at each sample.
using RideTrace = std::vector<std::array<double, 4>>;

/// Where the trace lies that all others are compared with, written by the peer that makes it:
/// SUNDIALS at rtol 1e-10.
inline std::string reference_file(Ride ride) {
  return std::string("/tmp/dashpot_bench_") + row_of(ride).task + ".reference";
}
inline void write_reference(Ride ride, const RideTrace& trace) {
  std::ofstream file(reference_file(ride), std::ios::binary);
  file.write(reinterpret_cast<const char*>(trace.data()),
             static_cast<std::streamsize>(trace.size() * sizeof trace[0]));
}
/// Greatest distance of a channel from the reference, of its greatest magnitude. NaN where a trace
/// is not whole.
inline double distance(const RideTrace& reference, const RideTrace& trace) {
  if (trace.size() != reference.size()) return NAN;
  double worst = 0;
  for (std::size_t c = 0; c < 4; ++c) {
    double top = 0, apart = 0;
    for (std::size_t k = 0; k < trace.size(); ++k) {
      top = std::max(top, std::abs(reference[k][c]));
      apart = std::max(apart, std::abs(reference[k][c] - trace[k][c]));
    }
    worst = std::max(worst, apart / top);
  }
  return worst;
}
/// The same from the reference that was written; NaN without one.
inline double error_of(Ride ride, const RideTrace& trace) {
  RideTrace reference(kSamples10s + 1);
  std::ifstream file(reference_file(ride), std::ios::binary);
  file.read(reinterpret_cast<char*>(reference.data()),
            static_cast<std::streamsize>(reference.size() * sizeof reference[0]));
  return file ? distance(reference, trace) : NAN;
}

/// Tasks of a general integrator: run(ride, trace or null) rides the first vehicle and returns CPU
/// seconds. One vehicle and a batch are the same to it.
template <class Run>
void add_ride_tasks(std::map<std::string, Task>& tasks, Run run) {
  for (const Ride ride : {Ride::Network, Ride::BoucWen, Ride::HalfNetwork, Ride::HalfBoucWen}) {
    const std::string name = row_of(ride).task;
    tasks[name] = tasks[name + "_batch"] = [run, ride](int) { return run(ride, nullptr); };
    tasks[name + ".error"] = tasks[name + "_batch.error"] = [run, ride](int) {
      RideTrace trace;
      run(ride, &trace);
      return error_of(ride, trace);
    };
  }
}

}  // namespace peer
