#include "fuzz.h"

void fuzz(const std::string& input) { load_fuzzed(fuzz_file("run_10mm_1Hz_0.5A.csv", input)); }
