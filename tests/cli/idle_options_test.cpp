#include "program.h"

TEST_CASE("options that serve another one are refused without it" * doctest::test_suite("long")) {
  const std::string data = small_campaign().string();
  const std::pair<std::string, std::string> cases[] = {
      {"simulate --mat", "--mat: has no effect without --output; give both, or leave it out"},
      {"simulate --figures", "--figures: has no effect without --output"},
      {"evaluate m.json " + data + " -o traces", "--output: has no effect without --traces"},
      {"bench --faults 0.5", "--faults: has no effect without --dampers"},
      {"bench --trend 0.5", "--trend: has no effect without --dampers"},
      {"design passenger_car --motions 5x1", "--motions: has no effect without --next"},
      {"design passenger_car --levels 1", "--levels: has no effect without --next"},
      {"design passenger_car --next 2 --points 9", "--points: has no effect with --next"},
      {"design passenger_car --next 2 --second physics", "--second: has no effect with --next"},
      {"design passenger_car --next 2 --insist", "--insist: has no effect with --next"},
      {"design passenger_car --next 2 --points 200",
       "--points: has no effect with --next, which searches for no designs; leave one of them out"},
      {"physics passenger_car --recordings " + data + " --velocity 2",
       "--velocity: has no effect with --recordings, which have currents and motions of their own"},
      {"bench --duration 10", "--duration: has no effect without --in"},
      {"bench --in car.yaml --cycles 4", "--cycles: has no effect with --in: a plant is moved by"},
      {"bench --in car.yaml --motion AM", "--motion: has no effect with --in: a plant is moved by"},
      {"bench --in car.yaml --zero-drift 3", "--zero-drift: has no effect with --in, whose sens"},
      {"bench --in car.yaml --velocity-sensor", "--velocity-sensor: has no effect with --in"},
      {"bench --in car.yaml --dampers 3", "--dampers: has no effect with --in, which drives one"},
      {"bench --in car.yaml --family drawings", "--family: has no effect with --in"},
      {"bench --in car.yaml --units kN,m/s", "--units: has no effect with --in, whose plant's"},
      {"identify " + data + " --in car.yaml --budget 10",
       "--budget: has no effect with --in; --st"},
      {"identify " + data + " --in car.yaml --units kN,m/s", "--units: has no effect with --in"},
      {"identify " + data + " --in car.yaml --force-offset record",
       "--force-offset: has no effect with --in; leave it out: no force is measured"},
      {"identify " + data + " --in car.yaml --controller skyhook",
       "--controller: has no effect with --in; dashpot rank or ride, with the models found"},
      {"evaluate m.json " + data + " --in car.yaml --force-offset none",
       "--force-offset: has no effect with --in; leave it out: no force is measured"},
      {"evaluate m.json " + data + " --in car.yaml --dataset d.yaml",
       "--dataset: has no effect with --in; the plant says which channel is which"},
      {"identify " + data + " --profile mass", "--profile: has no effect without --in"},
      {"identify " + data + " --grade car", "--grade: has no effect without --in"},
      {"invert --parameters mr1 --dataset d.yaml", "--dataset: has no effect without --recordings"},
      {"invert --recordings " + data + " --figure f",
       "--figure: is of a damper, and recordings alone are given; name a MODEL beside them"},
      {"track --parameters mr1 --force 800", "--force: is the amplitude of a sine"},
      {"track --parameters mr1 --recording " + data + " --duration 5",
       "--duration: has no effect with --recording, which is followed as it is"},
      {"track --parameters mr1 --recording " + data + " --band 2",
       "--band: has no effect with --recording, which is followed as it is"},
      {"export --parameters mr1 --to c --sources-only", "--sources-only: is of the binaries"},
      {"export --parameters mr1 --to c --compiler cc", "--compiler: is of the binaries in an FMU"},
      {"export --parameters mr1 --to c --force-loop integral=1", "--force-loop: goes with --cont"},
      {"export --parameters mr1 --to c --plant baig", "--plant: goes with --controller"},
      {"export --parameters mr1 --to c --in car.yaml --plant baig",
       "--plant: has no effect with --in, which exports an observer"},
      {"export --parameters mr1 --to c --in car.yaml --controller sh_add",
       "--controller: has no effect with --in, which exports an observer"},
      {"export --parameters mr1 --to c --in car.yaml --lag-rate 5",
       "--lag-rate: has no effect with --in, which exports an observer"},
      {"export --parameters mr1 --to fmu3,tables --precision float",
       "--precision: has no effect on fmu3, tables"},
      {"export --parameters mr1 --to fmu3 --sources-only --compiler cc",
       "--compiler: is of binaries, and --sources-only wants none"},
      {"export --parameters mr1 --to c --lag-rate 5",
       "--lag-rate: goes with --controller or --inv"},
      {"export --parameters mr1 --to c --current-max 2",
       "--current-max: goes with --controller or --inverse"}};
  for (const auto& [arguments, said] : cases) {
    const ProgramResult result = run_dashpot(arguments);
    CAPTURE(arguments);
    CAPTURE(result.output);
    CHECK(result.exit_code == 2);
    CHECK(contains(result.output, said));
  }
}
