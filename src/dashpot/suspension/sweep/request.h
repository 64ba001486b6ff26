#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dashpot/suspension/sweep/distribution.h"
#include "dashpot/vehicle.h"

namespace dashpot {

/// The name that stands first in the words of a part: "viscous" of "viscous,damping=1500".
std::string first_word(const std::string& words);

/// A quantity of a vehicle or its road that varies, and how it varies.
struct SweepInput {
  enum class Target { Plant, Road, RoadClass, RoadSeed, Damper, Controller, Current, LagRate };
  std::string name;  ///< as the request has it: "sprung_mass", "road.speed", "mix1.crossover"
  Target target = Target::Plant;
  std::string parameter;             ///< of the target: "speed"
  std::size_t controller = 0;        ///< whose parameter it is
  std::vector<std::string> dampers;  ///< names of those whose parameter it is
  std::string unit, meaning;
  Distribution distribution;
  std::vector<std::string> words;  ///< names of the values 0, 1 ...: "B", "C"; empty: numbers
  bool on_grid = false;  ///< every value with every sample, instead of one drawn per sample

  std::string description() const;
  /// Whether the parameter is one of the damper of these words.
  bool applies_to(const std::string& damper) const;
  /// The value as people read it.
  std::string text_of(double value) const;
};

/// A way of driving the same vehicles: dampers and what commands them.
struct SweepController {
  std::string name;
  VehicleWords words;
};

/// Vehicles on roads, as a YAML file of data/sweeps or of the user's describes them. SI.
struct SweepRequest {
  enum class Drawing { Sobol, Plain };

  std::string name, note, source;
  std::vector<SweepController> controllers;
  std::size_t baseline = 0;  ///< the controller that others are compared with
  std::string road;
  std::optional<std::uint64_t> road_seed;  ///< none: a road of its own for every sample
  std::vector<SweepInput> inputs;
  std::size_t samples = 1000;
  std::uint64_t seed = 1;
  Drawing drawing = Drawing::Sobol;
  double duration = 30;  ///< s
  double discard = 5;    ///< s, at the start of a ride, which measures leave out
  /// Share of the time outside a damper's data from which on a ride is flagged.
  double outside_limit = 0.05;
  double relative_tolerance = 1e-6;

  std::size_t grid_size() const;  ///< vehicles per sample
  std::size_t vehicles() const { return samples * grid_size(); }
};

}  // namespace dashpot
