#include "command.h"

namespace dashpot::cli {

std::string Option::long_name() const { return names.substr(names.find(',') + 1); }

void append(std::vector<Option>& options, const std::vector<Option>& more) {
  options.insert(options.end(), more.begin(), more.end());
}

}  // namespace dashpot::cli
