#include "dashpot/damper/kinds/family/family_model.h"

#include "dashpot/base/random.h"
#include "dashpot/model_file.h"
#include "example_family.h"
#include "support.h"

using namespace dashpot;

namespace {

std::string file_of(const FamilyModel& model) {
  ModelFile file;
  file.model = model.with_offset(0);
  return format_model(file);
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace

TEST_CASE("a gated family is the sum of its terms, each through its gates") {
  const FamilyGates gates = example_gates();
  const FamilyModel model = example_family();
  const std::vector<double> state{0.3, -0.8, 0.004};
  const DamperInput input{0, 0.02, 0.5};
  const double terms[] = {0.02, 0.3, -0.8, 0.016, std::tanh(2.0), 1};
  const double b = (0.5 / 1.1 - 0.4) / 0.2, e = std::log(2.8) / 0.9, h = -0.5e-3 / 4e-4,
               l = -2e-3 / 1.6e-3;
  const double open[] = {1, b, b * b, b * b * b, e,     b * e, b * b * e,
                         h, l, e * h, e * l,     b * h, b * l};
  double sum = 0;
  for (std::size_t j = 0; j < 6; ++j)
    for (std::size_t k = 0; k < 13; ++k)
      sum += gates.weights[j * 13 + k] * open[k] * terms[j] / gates.term_scale[j];
  CHECK_CLOSE(model.force(input, state), sum + 0.5, 1e-12, 0);
  CHECK(model.state_size() == 3);
  CHECK(model.parameter_count() == 78);
  CHECK_FALSE(model.needs_displacement());
}

TEST_CASE("conditions give another member, and what says nothing gives none") {
  const FamilyModel model = example_family();
  CHECK(model.specialised({}) == nullptr);
  CHECK(model.specialised({{"temperature", 300}}) == nullptr);
  const auto wide = model.specialised({{"gap", 1.8e-3}});
  REQUIRE(wide);
  FamilyMember member = example_member();
  member.gap = 1.8e-3;
  const DamperInput input{0, 0.02, 0.5};
  const std::vector<double> state(3);
  CHECK(wide->force(input, state) == model.with_member(member)->force(input, state));
  CHECK(wide->force(input, state) != model.force(input, state));
}

TEST_CASE("a build one standard deviation strong is stronger by the family's spread") {
  const FamilyModel model = example_family();
  const DamperInput input{0, 0.02, 0.5};
  const std::vector<double> state(3);
  const double mean = model.force(input, state) - 0.5;
  CHECK_CLOSE(model.specialised({{"build", 1}})->force(input, state), 1.1 * mean + 0.5, 1e-13, 0);
  CHECK(model.is_ensemble());
  CHECK_CLOSE(model.spread(input, state), 0.1 * std::abs(mean), 1e-13, 0);
}

TEST_CASE("a build that not one in a hundred would be is marked") {
  const FamilyModel model = example_family();
  CHECK(model.specialised({{"build", -2.5}})->extrapolations().empty());
  CHECK(model.specialised({{"build", -9}})->extrapolations() ==
        std::vector<std::string>{"build is -9 standard deviations, not one build in a hundred "
                                 "lies beyond 2.58"});
  const auto refuses = model.with_outside(OutsideFamily::Refuse);
  CHECK(contains(message_of([&] { refuses->specialised({{"build", 9}}); }), "build is 9"));
  CHECK(contains(message_of([&] { model.specialised({{"build", -11}}); }), "more than -10"));

  // A family that knows no builds has none that is odd.
  Family alike = model.family();
  alike.build_spread = 0;
  const FamilyModel unknowing(std::make_shared<Family>(alike), example_member());
  CHECK(unknowing.specialised({{"build", 9}})->extrapolations().empty());
}

TEST_CASE("a member outside the family is marked, or refused where that is asked") {
  const FamilyModel marks = example_family();
  const Conditions far{{"gap", 5e-3}};
  const auto marked = marks.specialised(far);
  REQUIRE(marked->extrapolations().size() == 1);
  CHECK(marked->extrapolations()[0] == "gap is 0.005 m, the family has 0.0005 to 0.002");
  CHECK_CLOSE(
      marks.with_member(dynamic_cast<const FamilyModel&>(*marked).member())->extrapolation(),
      (5 - 2) / 1.5, 1e-12, 0);
  CHECK(marks.extrapolations().empty());
  CHECK_CLOSE(marks.extrapolation(), -0.5 / 1.5, 1e-12, 0);  // half a value from the lower end
  CHECK_CLOSE(
      marks
          .with_member(
              dynamic_cast<const FamilyModel&>(*marks.specialised({{"gap", 2e-3}})).member())
          ->extrapolation(),
      -0.5 / 1.5, 1e-12, 0);  // the gap is at its end
  CHECK(marks.specialised({{"gap", 2e-3 * (1 + 1e-9)}})->extrapolations().empty());  // rounding
  CHECK(marks.specialised({{"gap", 2.001e-3}})->extrapolations().size() == 1);
  const auto refuses = marks.with_outside(OutsideFamily::Refuse);
  CHECK(message_of([&] { refuses->specialised(far); }).find("gap is 0.005 m") != std::string::npos);
  CHECK(refuses->specialised({{"gap", 1.5e-3}}) != nullptr);
}

TEST_CASE("files of a family come back bit for bit") {
  for (const FamilyModel& model :
       {example_family(), example_family(FamilyTarget::Residual), example_family_network()}) {
    const std::string text = file_of(model);
    const ModelFile file = parse_model(text, "f");
    CHECK(format_model(file) == text);
    const std::vector<double> state(model.state_size(), 0.1);
    for (const double v : {-0.03, 0.0, 0.01}) {
      const DamperInput input{0.005, v, 0.3};
      CHECK(file.model->force(input, state) == model.force(input, state));
    }
  }
}

TEST_CASE("damaged files of a family are refused") {
  const std::string gates = file_of(example_family()), network = file_of(example_family_network());
  const auto refuses = [](const std::string& text, const std::string& words) {
    return message_of([&] { parse_model(text, "f"); }).find(words) != std::string::npos;
  };
  CHECK(refuses(with(gates, "\"mark\"", "\"skip\""), "mark or refuse"));
  CHECK(refuses(with(gates, "\"gap\": 0.001", "\"gap\": -0.001"), "gap is -0.001"));
  CHECK(refuses(with(gates, "\"half_current\": 0.6", "\"half_current\": 0"), "half_current"));
  for (const char* earlier : {"line", "physics"})
    CHECK(refuses(with(gates, "\"kind\": \"gates\"", "\"kind\": \"" + std::string(earlier) + '"'),
                  "fit it again"));
  CHECK(refuses(with(gates, "\"kind\": \"gates\"", "\"kind\": \"gate\""),
                "network, gates, ellipses or plate_flow"));
  CHECK(refuses(with(gates, "\"target\": \"total\"", "\"target\": \"tot\""), "unknown target"));
  CHECK(refuses(with(network, "\"yield_stress\"", "\"yield\""), "unknown input"));
}

TEST_CASE("any motion of any member gives a finite force, and no memory is asked for") {
  Random random(3);
  for (const FamilyModel& model :
       {example_family(FamilyTarget::Residual), example_family_network()}) {
    std::vector<double> state(model.state_size());
    DamperInput from;
    model.rest(from, state);
    bool finite = true;
    for (int k = 0; k < 20000; ++k) {
      const auto any = [&] {
        return std::pow(10, random.uniform(-30, 30)) * (random.uniform() < 0.5 ? -1 : 1);
      };
      const DamperInput to{any(), any(), any()};
      model.advance(from, to, std::abs(any()), state);
      finite = finite && std::isfinite(model.force(to, state));
      from = to;
    }
    CHECK(finite);
  }
}

TEST_CASE("a yield stress beyond those of the family is outside of it, as a geometry is") {
  Family family = family_of(std::make_shared<GatedFamily>(example_gates()));
  family.yield = Family::Range{nullptr, 1000, 40000};
  const FamilyModel model(std::make_shared<Family>(family), example_member());
  REQUIRE(model.extrapolations().size() == 1);
  CHECK(model.extrapolations()[0] == "yield_stress is 5e+04 Pa, the family has 1000 to 4e+04");
  CHECK_CLOSE(model.extrapolation(), 10. / 39, 1e-12, 0);

  // One within, one a little above as noise makes it, one below all; a file keeps the range.
  const auto outside = [&](double stress) {
    return model.specialised({{"yield_stress", stress}})->extrapolations().size();
  };
  CHECK(outside(40000) == 0);
  CHECK(outside(41000) == 0);
  CHECK(outside(500) == 1);
  CHECK(family_model_from_json(model.to_json())->extrapolations() == model.extrapolations());
}
