#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/registry.h"
#include "dashpot/damper/virtual_bench.h"
#include "dashpot/error.h"
#include "dashpot/identify.h"
#include "dashpot/model_file.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A damper whose hysteresis follows the path, not the acceleration: laws that look at a filtered
/// acceleration follow it best with one that feeds energy into quick motions.
const std::vector<Record>& records_of_a_dahl_damper() {
  static const std::vector<Record> records = [] {
    BenchOptions options;
    options.motions = {{0.01, 1}, {0.005, 3}, {0.002, 6}};
    options.drive_levels = {0, 1, 2};
    options.sample_rate = 200;
    options.cycles = 1;
    return run_virtual_bench(load_parameters("labcontrol_dahl"), DriveUnit::Volt, options).records;
  }();
  return records;
}

Dissipation verdict(const FitReport& fit) {
  return dissipation(*fit.model, domain_of(records_of_a_dahl_damper(), DriveUnit::Volt));
}

std::string restriction_of(const FitReport& fit) {
  for (const std::string& warning : fit.warnings)
    if (contains(warning, "its filter is slowed to dissipate")) return warning;
  return "";
}

FitReport fit_of_dahl(const std::string& law, const IdentifyOptions& options = {}) {
  FitReport fit = identify(law, records_of_a_dahl_damper(), DriveUnit::Volt, options);
  REQUIRE(fit.model);
  return fit;
}

/// The fit without any options, made once for all cases here.
const FitReport& usual_fit_of_dahl(const std::string& law) {
  static std::map<std::string, FitReport> fits;
  const auto known = fits.find(law);
  return known != fits.end() ? known->second : fits.emplace(law, fit_of_dahl(law)).first->second;
}

constexpr std::array kLawsWithAFilter{"tanh_acceleration", "arctan", "sigmoid",
                                      "hysteretic_biviscous", "polynomial"};

}  // namespace

TEST_CASE("a law that would feed energy in is fitted so that it does not, and says what that cost" *
          doctest::test_suite("long")) {
  for (const std::string name : kLawsWithAFilter) {
    CAPTURE(name);
    const FitReport active = fit_of_dahl(name, {.allow_active = true});
    CHECK_FALSE(verdict(active).dissipates());
    CHECK(restriction_of(active).empty());

    const FitReport& fit = usual_fit_of_dahl(name);
    CHECK(verdict(fit).dissipates());
    CHECK(contains(restriction_of(fit), format_number(fit.training_rmse, 3) + " N in place of " +
                                            format_number(active.training_rmse, 3) + " N"));
    CHECK(fit.training_rmse < 1.5 * active.training_rmse);
  }
}

TEST_CASE("the restricted fit stands within the law's set at every drive, and its table says so" *
          doctest::test_suite("long")) {
  for (const std::string name : kLawsWithAFilter) {
    CAPTURE(name);
    const FitReport& fit = usual_fit_of_dahl(name);
    const LawModel& model = *fit.model->law_inside();
    const Law& law = model.law();
    std::vector<double> p(law.params.size());
    for (const double drive : {0.0, 0.4, 1.0, 1.7, 2.0}) {
      model.parameters_at(drive, p.data());
      CHECK(p[law.rate_parameter] <= law.fastest_rate(p.data()) * (1 + 1e-9));
    }
    for (const FittedParameter& fitted : fit.parameters)
      if (fitted.name == "r") CHECK(fitted.value == p[law.rate_parameter]);
  }
}

TEST_CASE("a fit that dissipates as it is keeps its bits") {
  // A damper of the kind itself, whose filter is slow enough, tells its law so.
  BenchOptions options;
  options.motions = {{0.01, 1}, {0.005, 3}};
  options.drive_levels = {0, 1};
  options.sample_rate = 200;
  options.cycles = 1;
  const Law& law = find_law("tanh_acceleration");
  std::vector<double> p;
  for (const ParamInfo& param : law.params) p.push_back(param.value);
  p[law.index_of("tau")] = 0.8 / p[law.rate_parameter];
  const std::vector<Record> records =
      run_virtual_bench(LawModel::constant(law, p), DriveUnit::Ampere, options).records;

  const FitReport fit = identify("tanh_acceleration", records, DriveUnit::Ampere, {});
  const FitReport free =
      identify("tanh_acceleration", records, DriveUnit::Ampere, {.allow_active = true});
  CHECK(restriction_of(fit).empty());
  CHECK(fit.training_rmse == free.training_rmse);
  CHECK(format_json(fit.model->to_json()) == format_json(free.model->to_json()));
}

TEST_CASE("a damping in series does not fall over the drive, unless the user says so" *
          doctest::test_suite("long")) {
  // A damper whose series damping does fall: what a law is fitted to may be of any kind.
  const LawModel published = load_parameters("spencer1997");
  Dependence parameters = published.parameters();
  const std::size_t c1 = published.law().index_of("c1");
  parameters.coefficients[c1] = {40000, -12000};
  BenchOptions bench;
  bench.motions = {{0.01, 1}, {0.005, 3}};
  bench.drive_levels = {0, 1, 2};
  bench.sample_rate = 200;
  bench.cycles = 1;
  const std::vector<Record> records =
      run_virtual_bench(LawModel(published.law(), parameters, DriveUnit::Volt, 0), DriveUnit::Volt,
                        bench)
          .records;
  const auto form_of_c1 = [&](const FitReport& fit) {
    return fit.model->law_inside()->parameters().forms[c1];
  };
  const auto is_told = [](const FitReport& fit) {
    return std::ranges::any_of(fit.warnings, [](const std::string& warning) {
      return contains(warning, "c1 would fall over the drive, and is constant instead");
    });
  };

  const FitReport held = identify("modified_bouc_wen", records, DriveUnit::Volt, {});
  CHECK(form_of_c1(held) == Form::Constant);
  CHECK(is_told(held));
  CHECK(held.training_rmse < 50);

  const IdentifyOptions asked{.choices = {{.parameter = "c1", .form = Form::Linear}}};
  const FitReport linear = identify("modified_bouc_wen", records, DriveUnit::Volt, asked);
  CHECK(form_of_c1(linear) == Form::Linear);
  CHECK_FALSE(is_told(linear));
  CHECK(linear.training_rmse < held.training_rmse);
}

TEST_CASE("a filter whose rate the user has fixed is left alone") {
  const IdentifyOptions options{.choices = {{.parameter = "r", .fixed = 200}}};
  const FitReport fit = fit_of_dahl("tanh_acceleration", options);
  CHECK_FALSE(verdict(fit).dissipates());
  CHECK(restriction_of(fit).empty());
}

TEST_CASE("a filter's rate that is fitted, or follows the drive, is slowed too" *
          doctest::test_suite("long")) {
  for (const std::optional<Form> form : {std::optional<Form>(), std::optional(Form::Linear)}) {
    const IdentifyOptions options{.choices = {{.parameter = "r", .form = form, .free = true}}};
    CHECK(verdict(fit_of_dahl("tanh_acceleration", options)).dissipates());
  }
}

TEST_CASE("a best fit whose sign is all but sharp is left by the usual start" *
          doctest::test_suite("long")) {
  // Beside the modified Bouc-Wen damper `sigmoid` ends with the least a_s there is, where no rate
  // of its filter dissipates and no step shows the way out.
  BenchOptions options;
  options.motions = {{0.015, 1}, {0.01, 2}, {0.005, 3}};
  options.drive_levels = {0, 1, 2};
  options.sample_rate = 200;
  options.cycles = 2;
  const std::vector<Record> records =
      run_virtual_bench(load_parameters("spencer1997"), DriveUnit::Volt, options).records;
  const Domain domain = domain_of(records, DriveUnit::Volt);

  const FitReport active = identify("sigmoid", records, DriveUnit::Volt, {.allow_active = true});
  CHECK_FALSE(dissipation(*active.model, domain).dissipates());
  const FitReport fit = identify("sigmoid", records, DriveUnit::Volt, {});
  CHECK(dissipation(*fit.model, domain).dissipates());
  CHECK(fit.training_rmse < 1.1 * active.training_rmse);
}
