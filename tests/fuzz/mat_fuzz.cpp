#include "fuzz.h"

void fuzz(const std::string& input) { load_fuzzed(fuzz_file("run_0.5A.mat", input)); }
