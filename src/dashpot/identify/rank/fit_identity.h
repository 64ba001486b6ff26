#pragma once
#include <string>
#include <vector>

#include "dashpot/base/store.h"
#include "dashpot/identify.h"

// Everything that a fit depends on, as text: a kept fit is found again by it.
namespace dashpot {

/// Changes with every sample, channel, name and warm-up of the records.
std::string fingerprint(const std::vector<Record>& records);

/// Every option that changes a fit.
NamedTexts describe_options(const IdentifyOptions& identify_options);

}  // namespace dashpot
