#pragma once
#include <ctime>

#include "dashpot/output/exporters/c_source.h"

namespace dashpot {

/// A variable of an FMU. Its value reference is its place in Fmu::variables, which is the order in which
/// c/fmu.h numbers them.
struct FmuVariable {
  enum class Role { Time, Input, Output, State, Derivative, Parameter };
  Role role = Role::Input;
  std::string name, unit, meaning;
  double start = 0;  ///< of inputs and parameters
  double lower = -HUGE_VAL, upper = HUGE_VAL;
  double nominal = 1;
  std::size_t derivative_of = 0;  ///< value reference of the state
};

/// What an FMU says of itself, whichever version of FMI it speaks.
struct Fmu {
  int version = 3;   ///< of FMI: 2 or 3
  std::string name;  ///< of the archive and the library
  CSource source;    ///< whose names begin with "damper", whatever the FMU's name: it may be that of a law
  std::vector<FmuVariable> variables;
  std::string token;     ///< FMI 2's GUID, FMI 3's instantiation token: a hash of all the rest but the date
  std::string date;      ///< xs:dateTime; that of SOURCE_DATE_EPOCH where it is set
  std::time_t made = 0;  ///< the same
  std::string title, equation, remarks, literature, origin, command, tool;
  Domain domain;
  std::vector<double> force;     ///< along its reference run
  std::vector<DamperInput> run;  ///< of sample_time steps

  /// Its continuous states are known, so that an integrator can bring them on. A model without a state has
  /// none.
  bool exchanges() const {
    return source.state_size == 0 || !source.states.empty() || !source.parameters.empty();
  }
  double stop_time() const { return source.sample_time * static_cast<double>(run.size() - 1); }
};

Fmu make_fmu(const ExportedModel& model, const ExportOptions& options, int version);

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
/// A run as CSV: time, inputs and the force there.
std::string fmu_reference_run(const Fmu& fmu);
/// How FMI-LS-REF announces it.
std::string fmu_reference_manifest(const Fmu& fmu);

/// A shared library of C files, as the bytes of the file. `compiler`: a program and more of its arguments.
/// Throws Error when there is none or it complains.
std::string compile_shared_library(const std::vector<ExportedFile>& files,
                                   const std::vector<std::string>& translation_units,
                                   const std::string& compiler);
/// A zip archive, all files bearing one time.
std::string zip_archive(const std::vector<ExportedFile>& files, std::time_t time);

/// NAME_fmi2.fmu, NAME_fmi3.fmu
std::vector<ExportedFile> write_fmu2(const ExportedModel& model, const ExportOptions& options);
std::vector<ExportedFile> write_fmu3(const ExportedModel& model, const ExportOptions& options);

}  // namespace dashpot
