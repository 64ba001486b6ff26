#include "dashpot/export/c/c_observer.h"

#include "conformance/c_compile.h"
#include "export/observer_example.h"

using namespace dashpot;

TEST_CASE("exported C of an observer: the library's estimates in double and single precision" *
          doctest::test_suite("long")) {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& stem, const ExampleObserver& example) {
    for (const CPrecision precision : {CPrecision::Double, CPrecision::Single}) {
      const std::string name = stem + (precision == CPrecision::Single ? "_float" : "_double");
      const CBlock block = c_observer_block(example.observer, example.names, "",
                                            {.name = name, .precision = precision});
      CHECK(block.tolerance == (precision == CPrecision::Single ? 1e-3 : 1e-9));
      for (const ExportedFile& file : write_c_block(block, ""))
        folder.write(file.name, file.content);
    }
  };
  for (const char* damper : {"spencer1997", "kwok2006"}) {
    write(damper, example_observer(damper));
    write(std::string("half_car_") + damper, example_half_car_observer(damper));
    write(std::string("own_drives_") + damper,
          example_half_car_observer(damper, "{front: coil_front, rear: coil_rear}"));
    write(std::string("shifted_") + damper, example_half_car_observer(damper, "coil", 0.004));
    write(std::string("own_roads_") + damper,
          example_half_car_observer(damper, "coil", 0, kUnmeasuredRoads));
  }
  write("hysteresis_network", example_network_observer());
  check_that_it_runs(folder, kAsTheTests);
}
