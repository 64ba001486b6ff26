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
#include "dashpot/dissipation.h"
#include "dashpot/drive.h"
#include "dashpot/value.h"

namespace dashpot {

/// A model with all that must travel with it: a versioned JSON file.
struct ModelFile {
  std::unique_ptr<DamperModel> model;
  DriveUnit drive_unit = DriveUnit::Ampere;
  double sample_time = 0;  ///< s, of the training data; 0 when mixed
  Domain domain;
  Provenance provenance;
  Value quality;  ///< the report's figures on training and left-out data; may be null
  /// Around the force, where left-out records allow one.
  std::optional<ForceBand> interval;
  std::optional<Dissipation> dissipation;  ///< as measured when the model was made
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
