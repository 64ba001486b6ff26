#include "dashpot/identify/fit/parameter_choice.h"

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/registry.h"
#include "dashpot/damper/virtual_bench.h"
#include "dashpot/identify.h"
#include "support.h"

using namespace dashpot;

namespace {

const ModelNames kModels = {"bingham", "tanh_kwok", "modified_bouc_wen"};

/// Three currents, 0, 0.5 and 1 A, of a Bingham damper with c0 = 2000 + 1000 i and f_c = 300 + 400
/// i.
Dataset bingham_campaign(std::vector<double> levels = {0, 0.5, 1}) {
  const LawModel damper(find_law("bingham"),
                        {{Form::Linear, Form::Linear, Form::Constant, Form::Constant},
                         {{2000, 1000}, {300, 400}, {0}, {0}}},
                        DriveUnit::Ampere, 0);
  BenchOptions options;
  options.motions = {{0.01, 1}};
  options.drive_levels = std::move(levels);
  options.sample_rate = 200;
  options.cycles = 2;
  options.displacement_noise = options.displacement_resolution = 0;
  return run_virtual_bench(damper, DriveUnit::Ampere, options);
}

FitReport fitted(const Dataset& data, const std::vector<ParameterChoice>& choices) {
  IdentifyOptions options;
  options.starts = 1;
  options.threads = 1;
  options.choices = choices;
  require_choices(choices, {"bingham"});
  return identify("bingham", data.records, DriveUnit::Ampere, options);
}

double value_of(const FitReport& report, const std::string& name) {
  for (const FittedParameter& p : report.parameters)
    if (p.name == name) return p.value;
  return NAN;
}

std::string refusal(const std::vector<ParameterChoice>& choices) {
  return message_of([&] { require_choices(choices, {"bingham", "modified_bouc_wen"}); });
}

}  // namespace

TEST_CASE("choices are read with their units") {
  CHECK(*parse_fixed_choice("n=2", "--fix", kModels).fixed == 2);
  CHECK_CLOSE(*parse_fixed_choice("modified_bouc_wen.k1 = 5 N/cm", "--fix", kModels).fixed, 500,
              1e-12, 0);
  CHECK(parse_fixed_choice("modified_bouc_wen.k1=5N/cm", "--fix", kModels).law ==
        "modified_bouc_wen");
  CHECK_CLOSE(*parse_fixed_choice("gamma=363cm^-2", "--fix", kModels).fixed, 3.63e6, 1e-12, 0);
  CHECK(parse_form_choice("alpha=exponential", "--form", kModels).form == Form::Exponential);
  const ParameterChoice bounds = parse_bounds_choice("c0=-1e1:5 N*s/mm", "--bounds", kModels);
  CHECK(bounds.bounds->lower == -10);
  CHECK_CLOSE(bounds.bounds->upper, 5000, 1e-12, 0);
  const ParameterChoice prior = parse_prior_choice("k1=500+-1N/cm", "--prior", kModels);
  CHECK(prior.prior->value == 500);
  CHECK_CLOSE(prior.prior->deviation, 100, 1e-12, 0);
  CHECK(parse_free_choice("n", "--free", kModels).free);
}

TEST_CASE("choices that cannot be understood say what would be right") {
  CHECK(message_of([] {
          parse_fixed_choice("gama=2", "--fix", kModels);
        }).find("did you mean 'gamma'") != std::string::npos);
  CHECK(message_of([] {
          parse_fixed_choice("binham.c0=2", "--fix", kModels);
        }).find("did you mean 'bingham'") != std::string::npos);
  CHECK(message_of([] { parse_fixed_choice("n", "--fix", kModels); }).find("write n=2") !=
        std::string::npos);
  CHECK(message_of([] { parse_fixed_choice("k1=soft", "--fix", kModels); }) ==
        "--fix, k1: 'soft' is not a number; a number in N/m, or one with its unit");
  CHECK(message_of([] { parse_fixed_choice("modified_bouc_wen.k1=5mm", "--fix", kModels); }) ==
        "--fix, k1: 'mm' is not a unit of it; it is counted in N/m");
  CHECK(message_of([] {
          parse_form_choice("alpha=square", "--form", kModels);
        }).find("known: constant") != std::string::npos);
  CHECK(message_of([] {
          parse_form_choice("lag_rate=linear", "--form", kModels);
        }).find("does not follow") != std::string::npos);
  CHECK(message_of([] { parse_bounds_choice("c0=5", "--bounds", kModels); }).find("one bound") !=
        std::string::npos);
  CHECK(message_of([] {
          parse_prior_choice("c0=5", "--prior", kModels);
        }).find("no standard deviation") != std::string::npos);
  CHECK(message_of([] { parse_prior_choice("c0=5+-0", "--prior", kModels); }).find("not above 0") !=
        std::string::npos);
}

TEST_CASE("choices that do not go together are refused") {
  CHECK(refusal({{.parameter = "c0", .fixed = 100}}).empty());
  CHECK(
      refusal({{.law = "tanh_kwok", .parameter = "c0", .fixed = 100}}).find("none of the models") !=
      std::string::npos);
  CHECK(refusal({{.parameter = "c0", .bounds = ParameterBounds{5, 5}}}).find("hold nothing") !=
        std::string::npos);
  CHECK(refusal({{.parameter = "c0", .bounds = ParameterBounds{-5, 5}}})
            .find("reach beyond the law's; 0 ...") != std::string::npos);
  CHECK(refusal({{.parameter = "c0", .fixed = -1}}).find("lies outside its bounds") !=
        std::string::npos);
  CHECK(refusal({{.parameter = "c0", .fixed = 1}, {.parameter = "c0", .form = Form::Linear}})
            .find("is fixed, and something else") != std::string::npos);
  CHECK(refusal({{.parameter = "c0", .bounds = ParameterBounds{0, 5}},
                 {.parameter = "c0", .prior = Prior{6, 1}}})
            .find("the prior's value 6 lies outside") != std::string::npos);
}

TEST_CASE("what names the law goes before what does not") {
  const std::vector<ParameterChoice> choices = {{.law = "bingham", .parameter = "c0", .fixed = 1},
                                                {.parameter = "c0", .fixed = 2}};
  const Law& law = find_law("bingham");
  CHECK(*choice_for(choices, "bingham", law.params[0]).fixed == 1);
  CHECK(*choice_for(choices, "tanh_kwok", law.params[0]).fixed == 2);
  CHECK(*choice_for(choices, "bingham+network", law.params[0]).fixed == 2);
}

TEST_CASE("the law inside a hybrid is chosen for by the hybrid's name or by none") {
  const ModelNames models = {"bingham+network"};
  CHECK(parse_fixed_choice("bingham+network.c0=5", "--fix", models).law == "bingham+network");
  CHECK(*parse_fixed_choice("c0=5N*s/cm", "--fix", models).fixed == 500);
  CHECK(message_of([&] {
          parse_fixed_choice("binham+network.c0=5", "--fix", models);
        }).find("did you mean 'bingham+network'") != std::string::npos);
  require_choices({{.law = "bingham+network", .parameter = "c0", .fixed = 5}}, models);
  CHECK(message_of([&] {
          require_choices({{.law = "bingham", .parameter = "c0", .fixed = 5}}, models);
        }).find("none of the models") != std::string::npos);
}

TEST_CASE("a fixed parameter keeps its value, a freed one is found, bounds hold") {
  const Dataset data = bingham_campaign();
  const FitReport fixed = fitted(data, {{.parameter = "c0", .fixed = 2500}});
  CHECK(value_of(fixed, "c0") == 2500);
  CHECK(fixed.parameters.front().fixed);

  // The friction of this damper sets in at once: the speed over which it does is found to be next
  // to nothing.
  const FitReport freed = fitted(data, {{.parameter = "v_s", .free = true}});
  CHECK(value_of(freed, "v_s") < 2e-3);
  CHECK_FALSE(freed.parameters.back().fixed);

  const FitReport bounded = fitted(data, {{.parameter = "c0", .bounds = ParameterBounds{0, 1800}}});
  CHECK_CLOSE(value_of(bounded, "c0_a"), 1800, 1e-9, 0);
  CHECK(bounded.parameters.front().at_bound);
}

TEST_CASE("a form that these currents cannot tell falls back, in words") {
  const FitReport report =
      fitted(bingham_campaign({0, 1}), {{.parameter = "f_c", .form = Form::Exponential}});
  CHECK_CLOSE(value_of(report, "f_c_b"), 400, 0.1, 0);
  REQUIRE(!report.warnings.empty());
  CHECK(report.warnings.front() ==
        "f_c is linear, not exponential: these data hold too few currents to tell");
}

TEST_CASE("a prior and the data meet where their precisions say") {
  // With one current c0 is one number: its posterior is the mean of prior and data, weighed by 1 /
  // variance.
  const Dataset data = bingham_campaign({0});
  const FitReport alone = fitted(data, {});
  const FittedParameter& c0 = alone.parameters.front();
  const double deviation = (c0.high - c0.low) / 2 / 1.959963984540054;
  const double told = c0.value + 3 * deviation;
  const FitReport both = fitted(data, {{.parameter = "c0", .prior = Prior{told, deviation}}});
  CHECK_CLOSE(value_of(both, "c0"), c0.value + 1.5 * deviation, 0, 0.1 * deviation);
  const FittedParameter& known = both.parameters.front();
  CHECK_CLOSE(known.high - known.low, (c0.high - c0.low) / std::sqrt(2), 0.03, 0);

  // A vague prior changes nothing, a sharp one rules.
  const FitReport vague = fitted(data, {{.parameter = "c0", .prior = Prior{told, 1e6}}});
  CHECK_CLOSE(value_of(vague, "c0"), c0.value, 0, 0.1 * deviation);
  CHECK_CLOSE(value_of(fitted(data, {{.parameter = "c0", .prior = Prior{3000, 1e-3}}}), "c0"), 3000,
              1e-6, 0);
}
