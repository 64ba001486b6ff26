// Layer: damper
#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dashpot/damper_model.h"
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
  Value
      quality;  ///< figures on training and left-out data, as the report printed them; may be null
  std::optional<ForceBand>
      interval;  ///< around the force, where it could be told from left-out records
};

/// Throws Error with file and key on anything unknown, missing or out of bounds.
ModelFile load_model(const std::filesystem::path& path);
void save_model(const ModelFile& file, const std::filesystem::path& path);
ModelFile parse_model(std::string_view text, const std::string& source);
std::string format_model(const ModelFile& file);

}  // namespace dashpot
