#pragma once
#include <string>
#include <vector>

#include "dashpot/base/result_file.h"
#include "dashpot/identify.h"

// What kept results are found again by: all that a fit depends on, as text.
namespace dashpot {

/// Changes with every sample, channel, name and warm-up of the records.
std::string fingerprint(const std::vector<Record>& records);

/// Every option that changes a fit.
NamedTexts describe_options(const IdentifyOptions& identify_options);

}  // namespace dashpot
