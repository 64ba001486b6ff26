#pragma once
#include <string>
#include <utility>
#include <vector>

#include "dashpot/identify/identify.h"

// What kept results are found again by: all that a fit depends on, as text.
namespace dashpot {

/// Changes with every sample, channel, name and warm-up of the records.
std::string fingerprint(const std::vector<Record>& records);

/// A name for people, and a text that changes with what is named.
using NamedTexts = std::vector<std::pair<std::string, std::string>>;
/// Every option that changes a fit.
NamedTexts describe_options(const IdentifyOptions& identify_options);

}  // namespace dashpot
