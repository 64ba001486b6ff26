#include "fuzz.h"

/// HDF5 keeps some memory of files that it refused.
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5"; }

void fuzz(const std::string& input) { load_fuzzed(fuzz_file("run_0.5A.mat", input)); }
