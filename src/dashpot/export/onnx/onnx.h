#pragma once
#include <string>
#include <vector>

#include "dashpot/export/c/c_block.h"

namespace dashpot {

/// NAME.onnx, one step of the sample time, and, where the model has a state, NAME_rest.onnx, which
/// begins a run. Both are made of the C code that write_c_source would write.
std::vector<ExportedFile> write_onnx(const ExportedModel& model, const ExportOptions& options);
/// The same for an inverse or a controller, from its inputs to its commands.
std::vector<ExportedFile> write_onnx_block(const CBlockMaker& block, const ExportOptions& options);

}  // namespace dashpot
