#include "dashpot/suspension/sweep/request.h"

#include <algorithm>

#include "dashpot/base/text.h"

namespace dashpot {

std::string first_word(const std::string& words) {
  return std::string(trim(split(words, ',').front()));
}

std::string SweepInput::description() const {
  return words.empty() ? distribution.description(unit) : "one of " + join(words, ", ");
}

std::string SweepInput::text_of(double value) const {
  return words.empty() ? format_number(value) : words[static_cast<std::size_t>(value)];
}

bool SweepInput::applies_to(const std::string& damper) const {
  return std::ranges::find(dampers, first_word(damper)) != dampers.end();
}

std::size_t SweepRequest::grid_size() const {
  std::size_t size = 1;
  for (const SweepInput& input : inputs)
    if (input.on_grid) size *= input.distribution.values.size();
  return size;
}

}  // namespace dashpot
