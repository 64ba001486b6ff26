#include "dashpot/suspension/dampers/passive_curve.h"

#include "dashpot/base/file.h"
#include "support.h"

using namespace dashpot;

TEST_CASE("a passive curve meets its points, is monotone between and goes straight on beyond") {
  const PassiveCurve front = load_passive_curve("suv_front");
  const auto force = [&](double v) { return front.force({.velocity = v}, {}); };
  // Points of TC-8.1b.
  CHECK_CLOSE(force(-1.056), -971, 1e-12, 0);
  CHECK_CLOSE(force(0.132), 902, 1e-12, 0);
  CHECK_CLOSE(force(1.056), 4054, 1e-12, 0);
  double before = force(-2);
  for (double v = -2; v < 2; v += 0.001) {
    CHECK(force(v) >= before);
    before = force(v);
  }
  CHECK_CLOSE(force(1.056 + 0.5), 4054 + 0.5 * (4054 - 2178) / 0.528, 1e-12, 0);
  CHECK_CLOSE(force(-1.056 - 0.5), -971 - 0.5 * (971 - 744) / 0.528, 1e-12, 0);
  CHECK(load_passive_curve("suv_rear").velocity_max() == 0.832);
  CHECK(front.with_offset(100)->force({.velocity = 0.132}, {}) == doctest::Approx(1002));
}

TEST_CASE("a curve of straight lines is a straight line") {
  const PassiveCurve line("line", {-1, -0.2, 0, 0.7, 1}, {-1500, -300, 0, 1050, 1500});
  for (double v = -1.5; v < 1.5; v += 0.01)
    CHECK_CLOSE(line.force({.velocity = v}, {}), 1500 * v, 1e-12, 1e-9);
}

TEST_CASE("a curve's file may have other units, and what is wrong in it is said") {
  const TemporaryFolder folder;
  const auto path =
      folder.write("own.csv", "velocity [mm/s],force [kN]\n-100,-0.3\n0,0\n100,0.5\n");
  CHECK_CLOSE(load_passive_curve(path.string()).force({.velocity = 0.1}, {}), 500, 1e-12, 0);
  const auto back = folder.write("back.csv", "velocity [m/s],force [N]\n0,0\n-1,-300\n1,500\n");
  CHECK(message_of([&] { load_passive_curve(back.string()); }) ==
        "back: the velocity does not rise at point 2; one force per velocity, the least velocity "
        "first");
  const auto leap =
      folder.write("leap.csv", "velocity [m/s],force [N]\n-1,-300\n0,0\n1e-320,500\n");
  CHECK(message_of([&] { load_passive_curve(leap.string()); }) ==
        "leap: the force leaps at point 3; points further apart, or one of the two");
  const auto other = folder.write("other.csv", "force [N],current [A]\n0,0\n-1,-300\n1,500\n");
  CHECK(message_of([&] { load_passive_curve(other.string()); }).find("has no column 'velocity'") !=
        std::string::npos);
}
