#include "dashpot/record/readers/family_json.h"
#include "fuzz.h"

/// The recordings, a line of one '#', the dampers.
void fuzz(const std::string& input) {
  const std::size_t at = input.find("\n#\n");
  fuzz_file("inp_data.json", at == std::string::npos ? "{}" : input.substr(at + 3));
  load_fuzzed(fuzz_file("data.json", input.substr(0, at)));
}
