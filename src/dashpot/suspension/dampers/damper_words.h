#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dashpot/damper_model.h"
#include "dashpot/drive.h"
#include "dashpot/model_file.h"
#include "dashpot/parameter_table.h"
#include "dashpot/plant.h"

namespace dashpot {

/// A damper by itself that is known by a word, as "viscous".
struct SimpleDamper {
  std::string_view name, title;
  std::vector<ParameterRow> parameters;
};
std::span<const SimpleDamper> simple_dampers();

/// Settings that any damper takes: motion_ratio i, where it moves i times as far as the strut and
/// pushes there with i times its force; force_factor, where this piece is built stronger or weaker
/// than its model, which no controller knows.
std::span<const ParameterRow> mounting_settings();

/// A damper that was named for a strut.
struct ChosenDamper {
  std::string name;                          ///< "viscous, 1500 N*s/m", "spencer1997"
  std::shared_ptr<const DamperModel> model;  ///< without the lag of its coil
  /// None where nothing drives it, or a number from 0 to 1.
  DriveUnit drive_unit = DriveUnit::Ampere;
  double drive_min = 0, drive_max = 0;  ///< of its data; equal: passive, nothing drives it
  double lag_rate = 0;                  ///< 1/s, of its coil; 0: none
  double motion_ratio = 1;              ///< how far it moves as the strut moves by one
  double force_factor = 1;              ///< its force over its model's, as built
  std::optional<Domain> domain;         ///< where its data were
  std::optional<DampingRange> damping;  ///< at the strut, where it is stated
  std::vector<std::string> notes;
  std::vector<std::string> warnings;  ///< what it is known to do wrong

  bool is_passive() const { return !(drive_min < drive_max); }
};

/// From a text: a model file or a parameter set's name, with parameters of its law replaced
/// ("spencer1997,x0=0"); "viscous,damping=1500"; "ideal,damping_min=300,damping_max=3900": any
/// damping in between, the drive from 0 to 1 being the place; a passive curve by name or as a file
/// with velocity and force. Each takes mounting_settings(). Throws Error(where, ...).
ChosenDamper choose_damper(const std::string& text, const std::string& where = "damper");

/// The damper of a model that is at hand.
ChosenDamper choose_damper(const ModelFile& file);

/// N, in the middle of its stroke at that drive, A or V: gas and offset, which a vehicle's springs
/// bear.
double force_at_rest(const DamperModel& model, double drive);

/// The linear damping that takes the same energy from a sine: energy per cycle / (pi w A^2), N*s/m,
/// of the damper's third cycle. amplitude A, m; speed: the sine's greatest, w A, m/s.
double equivalent_damping(const DamperModel& model, double current, double amplitude, double speed);

/// The motion along which a damper's least and greatest damping are measured: a sine of 20 mm at
/// 0.2 m/s, or of half the reach of the damper's data where that is less.
struct ReferenceStroke {
  double amplitude = 0.02, speed = 0.2;  ///< m, m/s
};
ReferenceStroke reference_stroke(const ChosenDamper& damper);

/// At the strut, between the ends of a range of currents, N*s/m; nominal: at the least current.
/// The range that is stated, else equivalent damping along the reference stroke.
DampingRange damping_between(const ChosenDamper& damper, double current_min, double current_max);

}  // namespace dashpot
