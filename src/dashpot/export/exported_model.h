#pragma once
#include <optional>
#include <string>
#include <vector>

#include "dashpot/damper/model_file.h"
#include "dashpot/export/c_subset/c_rewrite.h"

namespace dashpot {

// The model, the options and the files of every exporter; exporter.h lists the exporters.

/// A model with what an export says of it.
struct ExportedModel {
  const DamperModel& model;
  std::string drive_unit = "A";
  Domain domain;           ///< where it was identified, or where its parameters hold
  double sample_time = 0;  ///< s, of the training data; 0: mixed or unknown
  std::string origin;      ///< where it comes from, in words
};

/// The motions of a car's damper, for models whose data do not say theirs.
Domain usual_domain(double current_min, double current_max);
/// The model of a file, which must outlive the result.
ExportedModel exported_model(const ModelFile& file);

struct ExportOptions {
  std::string name;                     ///< of files and functions: a name in C
  std::optional<CPrecision> precision;  ///< nothing: double in C, single in ONNX
  CPrecision c_precision() const { return precision.value_or(CPrecision::Double); }
  double sample_time = 0;            ///< s; 0: the model's own
  bool settable_parameters = false;  ///< a law's parameters stand behind its state, not in its code
  std::string compiler = "cc";       ///< for an FMU: a C compiler, and arguments for it
  bool sources_only = false;         ///< for an FMU: without a binary
  std::string command, version;      ///< of Dashpot, as the files name them
};

struct ExportedFile {
  std::string name, content;
};

/// The compiler that make would take: $CC, or cc.
std::string usual_compiler();

/// The time between two steps in s: as asked for, the model's own where it has one, that of its
/// data, or 1 ms. Throws Error where it is not a positive number.
double export_sample_time(const ExportedModel& model, const ExportOptions& options);
/// The name asked for, or one made of the model's. Throws Error where it is no name in C.
std::string export_name(const ExportedModel& model, const ExportOptions& options);

/// `name` itself. Throws Error where it is no name in C.
std::string c_name(const std::string& name);

}  // namespace dashpot
