#pragma once
#include <string>
#include <string_view>

#include "dashpot/damper_model.h"
#include "dashpot/drive.h"
#include "dashpot/model_file.h"
#include "dashpot/value.h"

// The parts that the files of models and of inverses have in common.
namespace dashpot {

struct FileFormat {
  std::string_view name, what;  ///< "dashpot-model", "a model file"
  int version;
};
/// Reads "format" and "version". Throws Error where they are others.
void require_format(ObjectReader& reader, const FileFormat& format);

/// The key "drive_unit" of a model file or of a part of it. Throws Error where it is neither A nor
/// V.
DriveUnit read_drive_unit(ObjectReader& reader);

Value to_json(const Domain& domain, DriveUnit drive_unit);
/// Throws Error naming the key on anything unknown, missing, in another unit or out of order.
Domain read_domain(const Value& value, DriveUnit drive_unit);

/// In SI units, with "dissipates" for whoever reads the file; it is not read back.
Value to_json(const Dissipation& result);
Dissipation read_dissipation(const Value& value);

Value to_json(const Provenance& from);
Provenance read_provenance(const Value& value);

}  // namespace dashpot
