#pragma once
#include "dashpot/base/escape.h"
#include "dashpot/export.h"
#include "dashpot/export/c/c_model.h"

namespace dashpot {

/// A model as C99 without heap, files or globals that change. Names begin with `prefix`:
///   <prefix>_input {displacement, velocity, current}
///   <prefix>_model {input, state[<PREFIX>_STATE_SIZE]}
///   <prefix>_init, _reset, _step, _advance      on a <prefix>_model
///   <prefix>_rest, _move, _force                on inputs and an array of the state
///   <prefix>_derivatives(input, state, derivatives)   where `states` is not empty
/// Everything is declared, with comments, in the header.
struct CSource {
  struct Variable {
    std::string name, unit, meaning;
  };
  std::string prefix;
  std::string header, source;  ///< <prefix>.h, <prefix>.c
  std::string test;  ///< <prefix>_test.c: a main that steps through a run and checks the force
  std::string real;  ///< "double" or "float"
  std::size_t state_size = 0;     ///< numbers in the state
  std::vector<Variable> inputs;   ///< the fields of <prefix>_input, in their order
  std::vector<Variable> outputs;  ///< the force
  /// The continuous states of a law, the first numbers of the state; else empty.
  std::vector<Variable> states;
  /// With ExportOptions::settable_parameters: they stand behind the states;
  /// <prefix>_defaults(state) writes them.
  std::vector<CParameter> parameters;
  std::size_t first_parameter = 0;  ///< where in the state
  double sample_time = 0;           ///< s, between two calls of <prefix>_step
  double grid = 0;  ///< s, between the instants at which the model remembers; 0: at any
};

/// Pairs of a place's name and what stands there, for filled().
using Facts = std::vector<std::pair<std::string, CText>>;
/// The facts that every text made of a model holds: x_min, x_max, v_min, v_max, i_min, i_max (the
/// domain), sample_time (s) and version.
Facts common_facts(const ExportedModel& model, const ExportOptions& options, const CSource& source);

/// "Known for displacements -0.02 ... 0.02 m, velocities ...; beyond, it extrapolates."
std::string known_text(const Domain& domain, DriveUnit drive_unit);
/// The same of the damper behind an inverse or an observer, with where it comes from and what is
/// known against it: "Of its damper: ... Known for ...".
std::string damper_origin(const ExportedModel& damper);

/// The title of a model in the registry; the name of one that is not there.
std::string title_of(const DamperModel& model);

/// Throws Error where the model cannot become C.
CSource c_source(const ExportedModel& model, const ExportOptions& options);

/// The three files.
std::vector<ExportedFile> write_c_source(const ExportedModel& model, const ExportOptions& options);

}  // namespace dashpot
