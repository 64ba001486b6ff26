#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "dashpot/drive.h"
#include "dashpot/driver.h"
#include "dashpot/model_file.h"

namespace dashpot::cli {

/// The damper that a command works with, as a model file or by the publication of its parameters.
struct DamperChoice {
  std::string model, parameters;
  double current_max = 0, lag_rate = -1;  ///< A, 1/s: 0 and below 0: the damper's own
  bool is_made() const { return !model.empty() || !parameters.empty(); }
};

/// MODEL and --parameters.
std::vector<Option> damper_options(DamperChoice& choice);

/// --current-max and --lag-rate, of the coil in front of a damper.
Option current_max_option(double& current_max);
Option lag_rate_option(double& lag_rate);
std::vector<Option> coil_options(DamperChoice& choice);

/// A published damper has a name, and no file: throws UsageError where MODEL is one, with what
/// would be right.
void refuse_published(const std::string& model, const std::string& command,
                      const std::string& right);

/// Warns where the damper feeds energy into some motions. Throws UsageError where not exactly one
/// was chosen.
ModelFile load_damper_file(const DamperChoice& choice, const std::string& command,
                           Console& console);

/// A damper and the range of its current.
struct Damper {
  std::string name;
  DriveUnit drive_unit = DriveUnit::Ampere;
  std::unique_ptr<DamperModel> model;
  double drive_min = 0, drive_max = 0;
  std::optional<Domain> domain;  ///< of a model file
};

/// That of a file, which was chosen so.
Damper damper_of(ModelFile file, const DamperChoice& choice);
/// As load_damper_file().
Damper load_damper(const DamperChoice& choice, const std::string& command, Console& console);

/// The driver in front of it. Throws Error where there is no range of currents.
DriverOptions driver_of(const Damper& damper, const DamperChoice& choice,
                        DriverOptions options = {});

}  // namespace dashpot::cli
