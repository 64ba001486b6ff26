#pragma once
#include <string>
#include <vector>

/// The figures of docs/in-plant-measured.md of roads that nothing measures: "unmeasured", "cover",
/// "sensors", "building", "half", "full" and what follows them. False: not one of these.
bool run_without_road(const std::vector<std::string>& words);
