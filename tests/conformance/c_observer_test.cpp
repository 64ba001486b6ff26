#include "dashpot/export/c/c_observer.h"

#include "conformance/c_compile.h"
#include "export/observer_example.h"

using namespace dashpot;

TEST_CASE("exported C of an observer: the library's estimates in double and single precision") {
  const TemporaryFolder folder;
  for (const char* damper : {"spencer1997", "kwok2006"}) {
    const ExampleObserver example = example_observer(damper);
    for (const CPrecision precision : {CPrecision::Double, CPrecision::Single}) {
      const std::string name =
          std::string(damper) + (precision == CPrecision::Single ? "_float" : "_double");
      const CBlock block =
          c_observer_block(example.observer, example.names, {.name = name, .precision = precision});
      CHECK(block.tolerance == (precision == CPrecision::Single ? 1e-3 : 1e-9));
      for (const ExportedFile& file : write_c_block(block, ""))
        folder.write(file.name, file.content);
    }
  }
  check_that_it_runs(folder, "-O1 " + kAsTheTests);
}
