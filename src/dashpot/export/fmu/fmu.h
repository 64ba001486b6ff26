#pragma once
#include <cmath>
#include <ctime>
#include <span>

#include "dashpot/export/c/c_block.h"

namespace dashpot {

/// A variable of an FMU. Its value reference is its place in Fmu::variables, which is the order in
/// which texts/fmu.h numbers them.
struct FmuVariable {
  enum class Role { Time, Input, Output, State, Derivative, Parameter };
  Role role = Role::Input;
  std::string name, unit, meaning;  ///< `unit`: empty where none is known
  double start = 0;                 ///< for inputs and parameters
  double lower = -HUGE_VAL, upper = HUGE_VAL;
  double nominal = 0;             ///< 0: the largest along the run; rounded when the FMU is made
  std::size_t derivative_of = 0;  ///< value reference of the state
};

using FmuRole = FmuVariable::Role;

/// All that is known of an FMU, whichever version of FMI it speaks.
struct Fmu {
  int version = 3;   ///< of FMI: 2 or 3
  std::string name;  ///< of the archive and the library
  std::vector<ExportedFile>
      code;  ///< damper.h, damper.c: names begin with "damper", whatever the FMU's name
  std::string interface;    ///< name of the text between its code and texts/fmu.h
  std::string definitions;  ///< what that text needs, C
  std::vector<FmuVariable> variables{
      {.role = FmuVariable::Role::Time, .name = "time", .unit = "s", .meaning = "simulation time"}};
  std::size_t first_parameter = 0;  ///< where in the state
  bool sampled = false;             ///< outputs change at samples only
  bool exchanges = false;           ///< model exchange is possible: all continuous states are known
  double sample_time = 0;           ///< s, of its own steps
  double grid = 0;                  ///< s: it remembers at such steps; 0: at any
  std::vector<std::vector<double>> run;  ///< inputs and outputs, sample_time apart
  std::string title, origin, command, tool;
  std::string equation;              ///< empty: none
  std::vector<std::string> remarks;  ///< paragraphs
  std::vector<std::string> steps;    ///< paragraphs on what happens between communication points
  std::string
      token;  ///< FMI 2's GUID, FMI 3's instantiation token: a hash of all the rest but the date
  std::string date;      ///< xs:dateTime; that of SOURCE_DATE_EPOCH where it is set
  std::time_t made = 0;  ///< the same, s since 1970

  std::size_t count(FmuVariable::Role role) const;
  double stop_time() const { return sample_time * static_cast<double>(run.size() - 1); }
};

/// The FMU of a model, or of a controller or an inverse in double precision; version, token and
/// date are still open.
Fmu model_fmu(const ExportedModel& model, const ExportOptions& options);
Fmu block_fmu(const CBlock& block, const ExportOptions& options);

/// modelDescription.xml.
std::string fmi2_description(const Fmu& fmu);
std::string fmi3_description(const Fmu& fmu);
/// C files of the folder sources/, and which of them are compiled.
std::vector<ExportedFile> fmu_sources(const Fmu& fmu);
std::vector<std::string> fmu_translation_units(const Fmu& fmu);
/// FMI 3's sources/buildDescription.xml.
std::string fmu_build_description(const Fmu& fmu);
/// documentation/index.html.
std::string fmu_page(const Fmu& fmu);
/// A run as CSV: time, inputs and the outputs there.
std::string fmu_reference_run(const Fmu& fmu);
/// The manifest by which FMI-LS-REF announces that run.
std::string fmu_reference_manifest(const Fmu& fmu);

/// A platform that an FMU can hold a binary for.
struct FmuPlatform {
  std::string_view name;        ///< in ExportOptions::platforms
  std::string_view fmi2, fmi3;  ///< its folder in binaries/
  std::string_view ending;      ///< of a library there
  std::string_view compiler;    ///< of Debian, on machines of another kind
  std::string_view package;     ///< that holds it
};
std::span<const FmuPlatform> fmu_platforms();
/// That of this machine.
const FmuPlatform& own_platform();
/// Throws Error that names those that are known.
const FmuPlatform& find_platform(std::string_view name);

/// A shared library of C files, as the bytes of the file. `compiler`: for this machine, a program
/// and more of its arguments. Throws Error when there is none or it complains.
std::string compile_shared_library(const std::vector<ExportedFile>& files,
                                   const std::vector<std::string>& translation_units,
                                   const FmuPlatform& platform, const std::string& compiler);
/// A zip archive, all files bearing one time.
std::string zip_archive(const std::vector<ExportedFile>& files, std::time_t time);

/// NAME_fmi2.fmu, NAME_fmi3.fmu
std::vector<ExportedFile> write_fmu2(const ExportedModel& model, const ExportOptions& options);
std::vector<ExportedFile> write_fmu3(const ExportedModel& model, const ExportOptions& options);
std::vector<ExportedFile> write_fmu2_block(const CBlockMaker& block, const ExportOptions& options);
std::vector<ExportedFile> write_fmu3_block(const CBlockMaker& block, const ExportOptions& options);

}  // namespace dashpot
