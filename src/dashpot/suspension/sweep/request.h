#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/suspension/sweep/distribution.h"
#include "dashpot/vehicle.h"

namespace dashpot {

/// What varies, and what of a vehicle or its road it is.
struct SweepInput {
  enum class Target { Plant, Road, RoadClass, RoadSeed, Damper, Controller, Current, LagRate };
  std::string name;  ///< as the request has it: "sprung_mass", "road.speed", "mix1.crossover"
  Target target = Target::Plant;
  std::string parameter;             ///< of the target: "speed"
  std::size_t controller = 0;        ///< whose parameter it is
  std::vector<std::string> dampers;  ///< names of those whose parameter it is
  std::string unit, meaning;
  Distribution distribution;
  std::vector<std::string> words;  ///< what the values 0, 1 ... stand for: "B", "C"; empty: numbers
  bool on_grid = false;  ///< every value with every sample, instead of one drawn per sample

  std::string description() const;
  bool is_told_to(const std::string& damper) const;
  /// The value as people read it.
  std::string text_of(double value) const;
};

/// A way of driving the same vehicles: dampers and what commands them.
struct SweepController {
  std::string name;
  VehicleWords words;
};

/// Vehicles on roads: a YAML file of data/sweeps or of the user's.
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
  double discard = 5;    ///< s at the begin, which measures leave out
  double outside_limit =
      0.05;  ///< share of the time outside a damper's data from which on a run is flagged
  double relative_tolerance = 1e-6;

  std::size_t grid_size() const;  ///< vehicles per sample
  std::size_t vehicles() const { return samples * grid_size(); }
};

/// YAML as docs/sweep.md describes; `folder`: where files that it names are looked for. Throws
/// Error that names file and line.
SweepRequest parse_sweep(std::string_view text, const std::string& source,
                         const std::filesystem::path& folder = {});
SweepRequest load_sweep(const std::filesystem::path& path);
/// One that comes with Dashpot, of data/sweeps.
SweepRequest named_sweep(const std::string& name);
std::vector<std::string> sweep_names();

}  // namespace dashpot
