#include "dashpot/record/mat_bytes.h"

#include "dashpot/base/packed_bytes.h"
#include "dashpot/record/made_file.h"

namespace dashpot {

std::string mat_bytes(const std::vector<MatVariable>& variables, const std::string& header) {
  PackedBytes request;
  request.add(header);
  request.add(variables.size());
  for (const MatVariable& variable : variables) {
    request.add(variable.name);
    request.add(std::size_t{variable.is_text});
    request.add(variable.rows);
    request.add(variable.columns);
    request.add(variable.values);
    request.add(variable.text);
  }
  return made_file("write-mat", request.bytes());
}

}  // namespace dashpot
