// Layer: export
#pragma once

// Models, inverses and controllers as files for other programs: C, FMU, ONNX, tables and more. An
// exporter gives names and contents of its files and writes none itself; the caller saves them.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/drive.h"
#include "dashpot/model_file.h"
#include "dashpot/vehicle.h"

namespace dashpot {

/// The numbers in which exported code computes.
enum class CPrecision { Double, Single };

/// A model, which must outlive this, with the facts that its export states.
struct ExportedModel {
  const DamperModel& model;
  DriveUnit drive_unit = DriveUnit::Ampere;
  Domain domain;           ///< where it was identified, or where its parameters hold
  double sample_time = 0;  ///< s, of the training data; 0: mixed or unknown
  std::string origin;      ///< where it comes from, in words
  std::optional<ForceBand> interval = {};  ///< around its force, where left-out records allow one
};

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
  /// For an FMU: linux64, win64, aarch64-linux; empty: this machine's. Others than that need
  /// Debian's cross compilers.
  std::vector<std::string> platforms = {};
  /// The grid of tables, m/s and A or V, ascending; empty: over the model's domain.
  std::vector<double> velocities = {}, currents = {};
  std::string units = {};        ///< of the CSV files of `tables`, as "lbf,in/s"; empty: SI
  std::string command, version;  ///< of Dashpot, as the files name them
};

struct ExportedFile {
  std::string name, content;
};

/// Throws Error(where, ...) at a sample time, s, that no controller has: 1 was meant to be 1 ms.
void require_export_sample_time(double seconds, const std::string& where);

/// Adds files but those whose names are there: several formats have the same C code.
void add_files(std::vector<ExportedFile> more, std::vector<ExportedFile>& files);

struct CBlock;
/// An inverse or a controller, for options of an exporter's own.
using CBlockMaker = std::function<CBlock(const ExportOptions&)>;
/// The controller of a vehicle. The block throws Error where there is none, or one without C text.
CBlockMaker controller_block(std::shared_ptr<const Vehicle> vehicle);

/// One form that a model can be exported to.
struct Exporter {
  std::string_view name, title;
  std::string_view takes;  ///< which models, in words
  std::string_view files;  ///< what it writes, in words
  /// Throws Error that says why where the model cannot become that.
  std::vector<ExportedFile> (*write)(const ExportedModel& model, const ExportOptions& options);
  /// Null: inverses and controllers cannot.
  std::vector<ExportedFile> (*write_block)(const CBlockMaker& block,
                                           const ExportOptions& options) = nullptr;
};

/// All exporters in alphabetical order; they live as long as the program.
std::span<const Exporter> exporters();
/// Throws Error "unknown format 'x'; did you mean ...".
const Exporter& find_exporter(std::string_view name, const std::string& where = {});

/// The C compiler as make has it: $CC, or cc.
std::string usual_compiler();

/// The time between two steps, s: as asked for, else the model's own, else that of its data, else
/// 1 ms.
/// Throws Error where it is not a positive number.
double export_sample_time(const ExportedModel& model, const ExportOptions& options);
/// The name of the options, or one made from the model's. Throws Error where it is no name in C.
std::string export_name(const ExportedModel& model, const ExportOptions& options);

/// The name unchanged. Throws Error where it is no name in C.
std::string c_name(const std::string& name);

}  // namespace dashpot
