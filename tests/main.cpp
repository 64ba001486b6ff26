#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

/// HDF5 keeps some memory of files that it refused.
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5"; }
