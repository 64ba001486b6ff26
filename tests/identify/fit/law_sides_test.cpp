#include <array>
#include <cmath>

#include "dashpot/base/random.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/damper/law_side.h"
#include "dashpot/damper/virtual_bench.h"
#include "dashpot/error.h"
#include "dashpot/identify.h"
#include "dashpot/identify/fit/parameter_choice.h"
#include "dashpot/model_file.h"
#include "studies/ride_rank/true_dampers.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A damper that is no law of Dashpot's: a valve behind a spring, with friction of the seals, whose
/// force in compression is that share of the one in rebound.
Dataset recorded(double compression, std::vector<SineMotion> motions, std::vector<double> levels,
                 double sample_rate = 200) {
  const TrueDamperParts parts{.name = "a valve",
                              .what = "",
                              .orifice = 600,
                              .compression = compression,
                              .spring = 8e5,
                              .friction = 60};
  BenchOptions bench;
  bench.motions = std::move(motions);
  bench.drive_levels = std::move(levels);
  bench.sample_rate = sample_rate;
  bench.cycles = 2;
  return run_virtual_bench(*make_true_damper(parts), DriveUnit::Ampere, bench);
}

FitReport fit_of(const std::string& law, double compression, const IdentifyOptions& options = {},
                 double sample_rate = 200) {
  const Dataset known =
      recorded(compression, {{0.02, 0.5}, {0.015, 2}, {0.005, 6}}, {0, 1, 2}, sample_rate);
  FitReport fit = identify(law, known.records, DriveUnit::Ampere, options);
  REQUIRE(fit.model);
  return fit;
}

/// %, on motions and currents that the fit has not seen.
double unseen_esr(const FitReport& fit, double compression) {
  const Dataset unseen = recorded(compression, {{0.01, 1}, {0.008, 4}}, {0.5, 1.5}, 400);
  return evaluate(*fit.model, unseen.records, DriveUnit::Ampere).pooled_without_offset.esr;
}

bool says_apart(const FitReport& fit) {
  return std::ranges::any_of(fit.warnings, [](const std::string& warning) {
    return contains(warning, "rebound and compression are apart: on training records held back");
  });
}

bool has_side(const FitReport& fit) { return fit.model->law_inside()->law().side_row > 0; }

}  // namespace

TEST_CASE(
    "a valve of one direction takes energy out, whatever its numbers, and yields to one side") {
  Random random(3);
  const Law& law = with_side(find_law("bouc_wen"));
  std::vector<double> p(law.params.size());
  for (int trial = 0; trial < 10000; ++trial) {
    for (std::size_t k = 0; k < 2; ++k) p[law.side_row + k] = random.uniform(-1e4, 1e4);
    p[law.side_row + 2] = std::exp(random.uniform(-10, 2));
    const double v = random.uniform(-1, 1);
    CHECK(side_force(law, p.data(), v) * v >= 0);
  }
  p[law.side_row] = 300, p[law.side_row + 1] = 1000, p[law.side_row + 2] = 1e-3;
  CHECK(side_force(law, p.data(), 0.5) == doctest::Approx(800));
  CHECK(side_force(law, p.data(), -0.5) == 0);
  p[law.side_row] = -300;
  CHECK(side_force(law, p.data(), 0.5) == doctest::Approx(500));
  CHECK(side_force(law, p.data(), -0.5) == doctest::Approx(-300));
}

TEST_CASE("asked to, laws take rebound and compression apart where the damper has them so" *
          doctest::test_suite("long")) {
  for (const std::string law : {"bouc_wen", "tanh_acceleration"}) {
    CAPTURE(law);
    const FitReport fit = fit_of(law, 0.4, {.asymmetric = true}, 400),
                    alike = fit_of(law, 0.4, {}, 400);
    CHECK(says_apart(fit));
    CHECK_FALSE(says_apart(alike));
    CHECK(has_side(fit));
    CHECK_FALSE(has_side(alike));
    CHECK(unseen_esr(fit, 0.4) < 0.8 * unseen_esr(alike, 0.4));
    CHECK(dissipation(*fit.model, usual_domain(0, 2)).dissipates());

    // Rebound is the harder side, and grows with the current.
    const auto row = std::ranges::find(fit.parameters, "f_side_b", &FittedParameter::name);
    REQUIRE(row != fit.parameters.end());
    CHECK(row->value > 0);
    CHECK(row->unit == "N/A");
    CHECK(row->low < row->value);
  }
}

TEST_CASE("a damper alike in both directions keeps the bits of its fit" *
          doctest::test_suite("long")) {
  for (const std::string law : {"bingham", "bouc_wen"}) {
    const FitReport fit = fit_of(law, 1, {.asymmetric = true}), alike = fit_of(law, 1);
    CHECK(format_json(fit.model->to_json()) == format_json(alike.model->to_json()));
  }
}

TEST_CASE("a law with its directions apart is written and read, and its valve can be chosen") {
  const FitReport fit = fit_of("bouc_wen", 0.4, {.asymmetric = true}, 100);
  const Value json = fit.model->to_json();
  const std::unique_ptr<LawModel> read = law_model_from_json(parse_json(format_json(json), "test"));
  CHECK(format_json(read->to_json()) == format_json(json));
  std::vector<double> state(read->state_size());
  const DamperInput input{0.003, 0.08, 0.7};
  CHECK(read->force(input, state) == fit.model->force(input, state));

  // Asked for, it is fitted though nothing tells it; fixed, it stays.
  const FitReport freed =
      fit_of("bingham", 1, {.choices = {{.parameter = "c_side", .free = true}}});
  CHECK(has_side(freed));
  const FitReport fixed =
      fit_of("bingham", 1, {.choices = {{.parameter = "c_side", .fixed = 250}}});
  const LawModel& model = *fixed.model->law_inside();
  CHECK(model.parameters().at(model.law().side_row + 1, 0.5) == 250);

  // A wrong name is told the right one.
  try {
    parse_free_choice("f_sides", "--free", {"bingham"});
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(contains(error.what(), "did you mean 'f_side'?"));
  }
}
