#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "dashpot/dataset.h"

namespace dashpot {

/// Appends the value where it is not among them.
template <class T>
void add_new(std::vector<T>& values, const T& value) {
  if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
}

/// The conditions of the dataset's records, each once, in the order of the records.
std::vector<std::string> conditions(const Dataset& dataset);

/// The constant drive levels of the dataset's records, A or V, each once, ascending.
std::vector<double> levels(const Dataset& dataset);

}  // namespace dashpot
