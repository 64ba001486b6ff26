// Layer: suspension
#pragma once

// Vehicles and structures as linear mechanics: masses and springs with tyres on the ground and
// struts for dampers. A plant comes from a kind with its parameters, or from a set that ships with
// Dashpot. SI, z up; a row has one value per coordinate, a matrix n x n stands row by row.

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/parameter_table.h"

namespace dashpot {

constexpr double kGravity = 9.81;  ///< m/s^2

/// One degree of freedom.
struct Coordinate {
  std::string name, unit;  ///< "body", "m"; "pitch", "rad"
};

/// The product row . q, row and q with one value per coordinate.
inline double along(const std::vector<double>& row, const double* q) noexcept {
  double sum = 0;
  for (std::size_t k = 0; k < row.size(); ++k) sum += row[k] * q[k];
  return sum;
}

/// A height on the plant, row . q: where a rider sits, a floor moves.
struct PlantPoint {
  std::string name;
  std::vector<double> row;  ///< one value per coordinate
};

/// A tyre between ground and plant; it pushes by k (z_r - row . q) + c (its rate).
struct Tyre {
  std::string name;
  std::vector<double> row;  ///< of the wheel's height
  double stiffness = 0;     ///< N/m
  double damping = 0;       ///< N*s/m
  double static_load = 0;   ///< N, at rest
  std::size_t track = 0;    ///< of the road: 0 left (or the only one), 1 right
  double behind = 0;        ///< m behind the first axle: the road reaches it later
};

/// A place for a damper, with stops and friction along it. Its deflection, extension positive, is
/// row . q, less the ground's height where its lower end stands on the moving ground.
struct Strut {
  std::string name;
  std::vector<double> row;           ///< body_row - wheel_row
  std::vector<double> body_row;      ///< height of its upper end
  std::vector<double> wheel_row;     ///< height of its lower end on the plant; empty: the ground
  std::optional<std::size_t> track;  ///< of the ground that its lower end moves with
  double extension_stop = 0;         ///< m of travel; 0: none
  double compression_stop = 0;       ///< m of travel; 0: none
  double stop_stiffness = 0;         ///< N/m
  double friction = 0;               ///< N, Coulomb's, smooth over friction_speed
  double friction_speed = 1e-3;      ///< m/s
};

/// Masses on springs, with feet on a road or on ground that shakes, and places for dampers. z up:
///   M q'' + C q' + K q = sum of row F_tyre - sum of row F_strut - M e a_ground
/// Linear but for tyres that may lift, stops, friction and dampers. q = 0 at rest under its own
/// weight.
struct Plant {
  std::string name, title, source;
  std::vector<Coordinate> coordinates;
  /// n x n, row by row, SI; tyres and dampers come on top.
  std::vector<double> mass, damping, stiffness;
  std::vector<Tyre> tyres;
  std::vector<Strut> struts;
  std::vector<PlantPoint> points;
  std::vector<double> ground;   ///< e: what an acceleration of the ground moves; empty: it does not
  bool tyres_may_lift = false;  ///< a tyre only pushes: its load cannot become negative

  std::size_t size() const noexcept { return coordinates.size(); }
};

/// A kind of plant, known by name.
struct PlantModel {
  std::string_view name, title, equation, source, remarks;
  std::vector<ParameterRow> parameters;
  /// values: one per row of the table, within its bounds.
  std::function<Plant(std::span<const double> values)> make;
};
/// Every kind in alphabetical order; they live as long as the program.
std::span<const PlantModel* const> plant_models();
/// Throws Error "unknown plant 'quartercar'; did you mean ...".
const PlantModel& find_plant_model(std::string_view name, const std::string& where = {});

/// The plant with these values in place of the table's. Throws Error at an unknown name and at a
/// value outside its bounds: "sprung_mass is -5 kg; between 1 and 1e+06 kg".
Plant make_plant(const PlantModel& model, const NamedValues& values, const std::string& where = {});

/// Damping of a plant's own damper, N*s/m: as it is, and between what limits it can be set.
struct DampingRange {
  double least = 0, nominal = 0, greatest = 0;
};

/// A plant with the numbers of a source: a file of data/plants, in SI.
struct PlantSet {
  std::string name;  ///< "savaresi_spelta"
  std::string source;
  bool verified = false;  ///< false: an example, not to be called published
  std::string reason;     ///< how it was verified, or why it is not
  Plant plant;
  std::optional<DampingRange> damping;  ///< per strut
  std::string kind = {};    ///< of plant, whose parameters it states; empty: matrices of its own
  NamedValues stated = {};  ///< those parameters, in SI
};

/// Names of the sets that come with Dashpot, in alphabetical order.
std::vector<std::string> plant_set_names();

/// The text of such a file: a kind of plant and its parameters ("sprung_mass": "387 kg"), or
/// matrices of its own; or of a file of 'identify --in' (docs/in-plant.md), whose numbers are all
/// known or found. `values` replace parameters. `source` stands in messages.
PlantSet parse_plant_set(std::string_view text, const std::string& source, const std::string& name,
                         const NamedValues& values = {});

/// A set, or a kind of plant with the numbers of its table. Throws Error "unknown plant ...; did
/// you mean ...".
PlantSet load_plant_set(const std::string& name, const NamedValues& values = {});

}  // namespace dashpot
