// Layer: damper
#pragma once

// Model files: a model in versioned JSON, with its units, the domain of its data and where it comes
// from. Files of earlier versions are read too.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dashpot/damper_model.h"
#include "dashpot/drive.h"
#include "dashpot/value.h"

namespace dashpot {

// Whether a damper model takes energy out of the motions that it meets. A model that is fitted to a
// bench has seen the motions of the bench; in a vehicle it meets small and quick ones too, and one
// that feeds energy into these shakes a car that stands.

/// The outcome of moving a model by sines at constant drive, from 1 to 200 Hz and from 0.1 um
/// to the strokes and speeds of its data, and to 20 times these where nothing but data has formed
/// it, each until its cycles repeat themselves.
struct Dissipation {
  bool is_tested = false;

  /// The cycle that takes out the smallest share of the energy that passes through the damper.
  double frequency = 0;  ///< Hz
  double amplitude = 0;  ///< m
  double position = 0;   ///< m, about which it moves
  double drive = 0;      ///< A or V
  double damping = 0;  ///< N*s/m: of the dashpot that takes out as much; below 0: energy is fed in
  /// What it takes out, over what passes through in both directions: 1 for a dashpot, 0 for a
  /// spring, below 0 where energy is fed in. Minus infinity where the model diverges.
  double share = 0;

  /// Hz, the band in which some cycle feeds in energy; 0 to 0 where none does.
  double active_from = 0, active_to = 0;

  bool dissipates() const;  ///< not tested, or no cycle feeds in more than 0.1 %
};

/// Runs the model with the strokes, speeds and drives of the domain; without speeds, with those of
/// usual_domain().
Dissipation dissipation(const DamperModel& model, const Domain& domain, int threads = 0);

/// What is wrong, in words that follow the model's name and a colon; empty where it dissipates.
std::string activity(const Dissipation& result, DriveUnit drive_unit);

/// The noise of a sensor, or of the sensor of an input, that nobody had stated, as an
/// identification inside a plant found it beside the damper.
struct FoundNoise {
  std::string channel, unit;
  double deviation = 0;  ///< of white noise, in that unit, SI; 0: could not be told
  double zero = 0;       ///< how far the sensor's zero may be off, likewise; 0: as far as its noise
};

/// A model with all that must travel with it: a versioned JSON file.
struct ModelFile {
  std::unique_ptr<DamperModel> model;
  DriveUnit drive_unit = DriveUnit::Ampere;
  double sample_time = 0;  ///< s, of the training data; 0 when mixed
  double moving_mass = 0;  ///< kg, whose inertia was taken off the forces of the training data
  Domain domain;
  Provenance provenance;
  Value quality;  ///< the report's figures on training and left-out data; may be null
  /// Around the force, where left-out records allow one.
  std::optional<ForceBand> interval;
  std::optional<Dissipation> dissipation;  ///< as measured when the model was made
  /// Of the plant in which the model was identified; observers take it where their plant says
  /// nothing of a sensor of that name and unit.
  std::vector<FoundNoise> noise_found = {};
};

/// As the file has it, or measured now.
Dissipation dissipation_of(const ModelFile& file);

/// Reads a model file. Throws Error with file and key on anything unknown, missing or out of
/// bounds.
ModelFile load_model(const std::filesystem::path& path);
/// Writes a model file in place of any that stands there. Throws Error where it cannot.
void save_model(const ModelFile& file, const std::filesystem::path& path);
/// The same from and to a text; `source` stands in messages.
ModelFile parse_model(std::string_view text, const std::string& source);
std::string format_model(const ModelFile& file);

}  // namespace dashpot
