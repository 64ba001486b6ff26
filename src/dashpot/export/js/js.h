#pragma once
#include <vector>

#include "dashpot/base/escape.h"
#include "dashpot/export.h"

namespace dashpot {

/// A model as a program of JavaScript that computes what its C code computes: an expression whose
/// value is an object with
///   model     what it is: name, title, kind, origin, sample_time, state_size, inputs with unit and
///             range, output, the band around the force (null: none), parameters with unit, value,
///             bounds and their place in a state, of a family also `low` to `high`, its dampers
///   create(parameters)                                   a state of the caller's, a Float64Array
///   reset(state, displacement, velocity, current)        long at rest there: the force, N
///   step(state, displacement, velocity, current)         one sample time later
///   advance(state, displacement, velocity, current, dt)  dt seconds later
///   force(state, displacement, velocity, current)        at this input, the state as it is
///   plate_flow(state, displacement, velocity, current)   of a family by physics alone: what plate
///                                                        flow says of the damper, N
/// Throws Error where the model cannot become that, and where single precision is asked for.
JsText js_program(const ExportedModel& model, const ExportOptions& options);

/// NAME.mjs, a module that exports these names.
std::vector<ExportedFile> write_js(const ExportedModel& model, const ExportOptions& options);

}  // namespace dashpot
