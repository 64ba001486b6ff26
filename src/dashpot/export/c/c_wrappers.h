#pragma once
#include "dashpot/export.h"

namespace dashpot {

// A model's C code with a file that calls it in another program.

/// A gateway for MATLAB and Octave.
std::vector<ExportedFile> write_mex(const ExportedModel& model, const ExportOptions& options);
/// A level-2 S-function for Simulink.
std::vector<ExportedFile> write_sfunction(const ExportedModel& model, const ExportOptions& options);
/// A Modelica package, in its folder: a block and a force element that call the C code.
std::vector<ExportedFile> write_modelica(const ExportedModel& model, const ExportOptions& options);

}  // namespace dashpot
