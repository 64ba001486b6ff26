#pragma once
#include <string>
#include <vector>

namespace dashpot {

/// Days are taken as they come. Where the numbers in the names of their files tell another order,
/// as a shell lists day_10 before day_2, what is to be said of the first such; else empty. An empty
/// name tells nothing, and names of different series (monday_2, tuesday_1) are not compared.
std::string day_disorder(const std::vector<std::string>& names);

}  // namespace dashpot
