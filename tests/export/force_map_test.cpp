#include "dashpot/export/tables/force_map.h"

#include <algorithm>

#include "conformance/laws.h"
#include "dashpot/base/text.h"
#include "dashpot/record/readers/mat_guard.h"
#include "export/example_models.h"
#include "support.h"

using namespace dashpot;

namespace {

/// F = (1000 + 500 i) v + 20
LawModel viscous() {
  Dependence d;
  for (const ParamInfo& info : find_law("bingham").params) {
    d.forms.push_back(info.name == "c0" ? Form::Linear : Form::Constant);
    d.coefficients.push_back(info.name == "c0" ? std::vector{1000.0, 500.0}
                             : info.name == "f0"
                                 ? std::vector{20.0}
                                 : std::vector{info.fit == Fit::Fixed ? info.value : 0.0});
  }
  return LawModel(find_law("bingham"), d, DriveUnit::Ampere, 100);
}

}  // namespace

TEST_CASE("force map: the settled force, by the law in closed form, and its inverse") {
  const LawModel model = viscous();
  const ForceMap map = force_map(exported(model), 1e-3);
  CHECK(map.velocity.front() == -0.3);
  CHECK(map.velocity.back() == 0.3);
  CHECK(map.current.back() == 2);
  for (std::size_t v = 0; v < map.velocity.size(); ++v)
    for (std::size_t i = 0; i < map.current.size(); ++i)
      CHECK_CLOSE(map.at(v, i), (1000 + 500 * map.current[i]) * map.velocity[v] + 20, 1e-12, 1e-12);
  const CurrentMap inverse = inverse_of(map);
  for (std::size_t f = 0; f < inverse.force.size(); ++f) {
    const double wanted = inverse.force[f], v = inverse.velocity.back();  // 0.3 m/s: 320 to 620 N
    const double current = std::clamp(((wanted - 20) / v - 1000) / 500, 0.0, 2.0);
    CHECK_CLOSE(inverse.current[inverse.current.size() - inverse.force.size() + f], current, 0,
                1e-9);
  }
}

TEST_CASE("force map: a hysteresis settles to its plateau") {
  // Dahl: F = kappa_w + f0 beyond some 1 / rho
  const Law& law = find_law("dahl");
  std::vector<double> values = defaults(law);
  values[law.index_of("rho")] = 5000;
  const LawModel model = LawModel::constant(law, values);
  const ForceMap map = force_map(exported(model), 1e-3);
  CHECK_CLOSE(map.at(map.velocity.size() - 1, 0),
              values[law.index_of("kappa_w")] + values[law.index_of("f0")], 1e-9, 0);
}

TEST_CASE("force map: a stroke is as long whatever the sample time is") {
  // Dahl: at 2 mm/s it takes all of the two seconds to slip.
  const Law& law = find_law("dahl");
  std::vector<double> values = defaults(law);
  values[law.index_of("rho")] = 500;
  const LawModel model = LawModel::constant(law, values);
  const double slow = force_map(exported(model), 1e-3, {0.002}, {1}).at(0, 0);
  CHECK(slow > 0.8 * values[law.index_of("kappa_w")]);
  for (const double fast : {2e-4, 2e-5, 1e-6})
    CHECK_CLOSE(force_map(exported(model), fast, {0.002}, {1}).at(0, 0), slow, 1e-6, 0);
}

TEST_CASE("tables on a grid of the user's: what lies beyond the data says so") {
  const LawModel model = viscous();
  const ExportOptions options{.name = "m", .velocities = {-0.2, 0, 0.5}, .currents = {0, 0.84, 3}};
  const ForceMap map = force_map(exported(model), 1e-3, options.velocities, options.currents);
  CHECK(map.extrapolated == std::vector<double>{0, 0, 1, 0, 0, 1, 1, 1, 1});
  CHECK_CLOSE(map.at(2, 2), (1000 + 500 * 3) * 0.5 + 20, 1e-12, 0);

  // In the heads of every layout, in the units and the sign of its numbers; not where the grid
  // stays within.
  ExportedModel uneven = exported(model);
  uneven.domain.velocity_min = -0.2;
  const std::string drive = " and 0 ... 2 A";
  const auto files = write_tables(uneven, options);
  CHECK(
      files[0].content.starts_with("force[N]: velocity[m/s] \\ current[A]; extrapolated beyond "
                                   "-0.2 ... 0.3 m/s" +
                                   drive + ",0,0.84,3\n-0.2,"));
  CHECK(files[2].content.find("extrapolated") != std::string::npos);
  CHECK(write_dpr(uneven, options)[1].content.find("$ extrapolated beyond -200 ... 300 mm/s" +
                                                   drive) != std::string::npos);
  const PrintUnit speed{"mm/s", 1000};
  CHECK(extrapolation_note(uneven, {.velocities = {0.3}, .currents = {2}}, speed).empty());

  // Compression is positive there, and rises.
  const std::string carsim = write_carsim(uneven, options)[0].content;
  CHECK(carsim.starts_with("compression rate [mm/s]; extrapolated beyond -300 ... 200 mm/s" +
                           drive +
                           ",force [N] at 0 A,force [N] at 0.84 A,force [N] at 3 A\n-500,"));
  CHECK(carsim.find("\n200," + format_exact(-map.at(0, 0)) + ",") != std::string::npos);

  // Units that are asked for are those of the CSV files; CarSim and Adams keep theirs.
  ExportOptions inches = options;
  inches.units = "lbf,in/s";
  CHECK(write_tables(uneven, inches)[0].content.find("-7.874 ... 11.81 in/s") != std::string::npos);
  CHECK(write_carsim(uneven, inches)[0].content == carsim);
}

TEST_CASE("tables: heads are numbers that people read") {
  const LawModel model = viscous();
  ExportedModel wide = exported(model);
  wide.domain.current_max = 2.8;
  for (const double current : force_map(wide, 1e-3).current)
    CHECK(format_exact(current).size() <= 4);
}

TEST_CASE("tables and dpr: what is written is what was computed") {
  const LawModel model = viscous();
  const ForceMap map = force_map(exported(model), 1e-3);
  const auto files = write_tables(exported(model), {.name = "m"});
  REQUIRE(files.size() == 3);
  CHECK(files[0].name == "m_force.csv");
  CHECK(files[0].content.starts_with("force[N]: velocity[m/s] \\ current[A],0,0.2,"));
  CHECK(files[0].content.find("\n" + format_exact(map.velocity.back()) + "," +
                              format_exact(map.at(map.velocity.size() - 1, 0)) + ",") !=
        std::string::npos);
  CHECK_NOTHROW(check_mat(files[2].content, "m.mat"));
  for (const char* matrix : {"velocity", "current", "force", "wanted_force", "inverse_current"})
    CHECK(files[2].content.find(matrix) != std::string::npos);
  const auto curves = write_dpr(exported(model), {.name = "m"});
  REQUIRE(curves.size() == map.current.size());
  CHECK(curves[0].name == "m_00.dpr");
  CHECK(curves[0].content.find("{vel force}\n-300 " + format_exact(map.at(0, 0)) + "\n") !=
        std::string::npos);
  CHECK(curves[0].content.find("LENGTH = 'mm'") != std::string::npos);
}
