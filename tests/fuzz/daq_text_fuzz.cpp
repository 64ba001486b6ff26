#include "fuzz.h"

void fuzz(const std::string& input) {
  const std::string columns =
      "name: fuzz\nfiles:\n  - match: '*'\n    level: 1\n    channels:\n"
      "      displacement: {column: 2, unit: mm}\n      force: {column: 3, unit: kN, centre: mean}\n";
  load_fuzzed(fuzz_file("run.txt", "Header Size: " + input), fuzz_file("daq.yaml", columns).string());
}
