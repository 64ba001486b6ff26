#pragma once
#include "dashpot/output/exporters/exporter.h"

namespace dashpot {

/// NAME.onnx, one step of the sample time, and, where the model has a state, NAME_rest.onnx, which begins a
/// run. Both are made of the C code that write_c_source would write.
std::vector<ExportedFile> write_onnx(const ExportedModel& model, const ExportOptions& options);

}  // namespace dashpot
