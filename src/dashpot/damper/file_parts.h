#pragma once
#include <string>
#include <string_view>

#include "dashpot/base/value.h"
#include "dashpot/damper/model_file.h"

// What the files of models and of inverses have in common.
namespace dashpot {

struct FileFormat {
  std::string_view name, what;  ///< "dashpot-model", "a model file"
  int version;
};
/// Reads "format" and "version". Throws Error where they are others.
void require_format(ObjectReader& reader, const FileFormat& format);

Value to_json(const Domain& domain, const std::string& drive_unit);
/// Throws Error naming the key on anything unknown, missing, in another unit or out of order.
Domain read_domain(const Value& value, const std::string& drive_unit);

Value to_json(const Provenance& from);
Provenance read_provenance(const Value& value);

}  // namespace dashpot
