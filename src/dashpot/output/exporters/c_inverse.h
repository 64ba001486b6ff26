#pragma once
#include "dashpot/damper/inverse/inverse_file.h"
#include "dashpot/output/exporters/exporter.h"

namespace dashpot {

/// An inverse network as C99: <prefix>_init, _reset and _step give the current for a wanted force; a header,
/// a source and a main that checks them, as of c_source(). The coil's lag is the driver's affair. Throws
/// Error where the sample time cannot serve its delays.
std::vector<ExportedFile> write_c_inverse(const InverseFile& inverse, const ExportOptions& options);

}  // namespace dashpot
