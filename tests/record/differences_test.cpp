#include "dashpot/record/differences.h"

#include "support.h"

using namespace dashpot;

namespace {

/// Two levels, 0 and 1 A, with two speeds each: damping force `force` at 0.1 m/s and twice that at
/// 0.2 m/s, scattering by `percent`.
Characterisation sheet(double force, double percent, double highest = 1) {
  Characterisation all;
  for (const double drive : {0.0, highest}) {
    LevelFigures level;
    level.drive = drive;
    level.friction = {force / 10, 1};
    level.static_force = {force / 10, 1};
    for (const double speed : {0.1, 0.2}) {
      SpeedFigures figures;
      figures.speed = speed;
      figures.damping_force = force * speed / 0.1;
      figures.rebound.mid_force = figures.damping_force;
      figures.compression.mid_force = -figures.damping_force;
      figures.repeatability = percent;
      level.speeds.push_back(figures);
    }
    all.levels.push_back(level);
  }
  return all;
}

}  // namespace

TEST_CASE("a difference is clear where it is more than twice the scatter of both") {
  // 5 % more, with a scatter of 1 % each: 50 N against 2 hypot(10, 10.5) = 29 N.
  const auto clear = differences(sheet(1000, 1), sheet(1050, 1));
  REQUIRE(clear.size() == 2);
  REQUIRE(clear[0].speeds.size() == 2);
  const Difference& d = clear[0].speeds[0].damping_force;
  CHECK_CLOSE(d.value(), 50, 1e-12, 0);
  CHECK_CLOSE(d.percent(), 5, 1e-12, 0);
  CHECK_CLOSE(d.noise, std::hypot(10, 10.5), 1e-12, 0);
  CHECK(d.is_clear() == true);
  CHECK(differences(sheet(1000, 3), sheet(1050, 3))[0].speeds[0].damping_force.is_clear() == false);
  CHECK(!differences(sheet(1000, kNaN), sheet(1050, 3))[0].speeds[0].damping_force.is_clear());

  // Friction by the errors of both fits: 5 N against 2 sqrt(2) N.
  CHECK(clear[0].friction.is_clear() == true);
  CHECK(!clear[0].yield.is_clear());

  // What holds the zero of a load cell is told without noise, however far it goes.
  CHECK_CLOSE(clear[0].speeds[0].rebound.value(), 50, 1e-12, 0);
  CHECK(!clear[0].speeds[0].rebound.is_clear());
  CHECK(!clear[0].speeds[0].compression.is_clear());
  CHECK(!clear[0].static_force.is_clear());
}

TEST_CASE("figures from speeds and from a loop are not told apart by their scatter") {
  Characterisation first = sheet(1000, 1), second = sheet(1050, 1);
  first.levels[0].basis = "speeds";
  second.levels[0].basis = "loop";
  const auto levels = differences(first, second);
  CHECK(levels[0].friction.value() == 5);
  CHECK(!levels[0].friction.is_clear());
  CHECK(levels[0].speeds[0].damping_force.is_clear() == true);
  CHECK(levels[1].friction.is_clear() == true);
}

TEST_CASE("levels and speeds that only one has are left out") {
  const auto levels = differences(sheet(1000, 1), sheet(1000, 1, 2));
  REQUIRE(levels.size() == 1);
  CHECK(levels[0].drive == 0.0);
  const auto stated = differences(sheet(1000, 1), sheet(1100, 1), {0.05, 0.15, 0.3});
  REQUIRE(stated[0].speeds.size() == 1);
  CHECK_CLOSE(stated[0].speeds[0].damping_force.first, 1500, 1e-12, 0);
  CHECK_CLOSE(stated[0].speeds[0].damping_force.second, 1650, 1e-12, 0);
}
