#include "conformance/laws.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "dashpot/base/random.h"
#include "dashpot/base/units.h"
#include "support.h"

using namespace dashpot;

namespace {

/// Anywhere between the bounds, by order of magnitude.
double anywhere(const ParamInfo& info, Random& random) {
  const double reach = std::max(std::abs(info.lower), std::abs(info.upper));
  const double size = reach * std::pow(10.0, -12 * random.uniform());
  return std::clamp(random.uniform() < 0.5 ? size : -size, info.lower, info.upper);
}

/// The defaults, each shape and size within a factor of three of them.
std::vector<double> near_defaults(const Law& law, Random& random) {
  std::vector<double> p;
  for (const ParamInfo& info : law.params) {
    const double factor =
        info.fit != Fit::Free && info.fit != Fit::Rises ? 1 : std::pow(3.0, random.uniform(-1, 1));
    p.push_back(std::clamp(info.value * factor, info.lower, info.upper));
  }
  return p;
}

double energy(const std::vector<Sample>& cycle) {
  double sum = 0;
  for (const Sample& s : cycle) sum += s.force * s.input.velocity;
  return sum / static_cast<double>(cycle.size());  // the cycle lasts 1 s
}

double middle(const std::vector<Sample>& cycle) {
  const auto by_force = [](const Sample& a, const Sample& b) { return a.force < b.force; };
  const auto [low, high] = std::minmax_element(cycle.begin(), cycle.end(), by_force);
  return (low->force + high->force) / 2;
}

}  // namespace

TEST_CASE(
    "every field of a law's struct stands in its table, with a name of its own and what docs "
    "need") {
  for_each_law([](const Law& law) {
    std::set<std::string_view> names;
    for (const ParamInfo& info : law.params) {
      CHECK_FALSE(info.name.empty());  // a field that the table leaves out has no name
      CHECK(names.insert(info.name).second);
      CHECK_FALSE(info.meaning.empty());
      CHECK(parse_unit(info.unit).has_value());
    }
    for (const std::string_view text : {law.name, law.title, law.equation, law.source, law.remarks})
      CHECK_FALSE(text.empty());
    CHECK(law.params.size() <= kMaxParams);
    CHECK(law.states.size() <= kMaxStates);
    CHECK((law.states.empty() || (law.rest && law.derivative && law.rate)));
  });
}

TEST_CASE("bounds hold the default; one parameter in N is the bias, and adds to the force") {
  for_each_law([](const Law& law) {
    for (const ParamInfo& info : law.params) {
      CAPTURE(std::string(info.name));
      CHECK(info.lower < info.upper);
      CHECK(info.value >= info.lower);
      CHECK(info.value <= info.upper);
      CHECK(std::isfinite(info.start));
    }
    CHECK(std::count_if(law.params.begin(), law.params.end(),
                        [](const ParamInfo& p) { return p.fit == Fit::Bias; }) == 1);
    const LawModel model = LawModel::constant(law, defaults(law));
    std::vector<double> state(model.state_size());
    model.rest(sine(0), state);
    CHECK_CLOSE(model.with_offset(7)->force(sine(0.1), state), model.force(sine(0.1), state) + 7,
                1e-12, 0);
  });
}

TEST_CASE(
    "a parameter of the table is the field of the struct that its place says: the force feels it") {
  for_each_law([](const Law& law) {
    const double z[kMaxStates] = {0.004, 0.003, 0, 0, 0, 0, 0, 0};
    const auto response = [&](const std::vector<double>& p) {
      double sum = 0;
      // some parameters count in one direction only, those of a map within their own range of
      // speeds
      for (double v = 0.002; v < 0.5; v *= 1.5)
        for (const double sign : {1.0, -2.0}) {
          double dz[kMaxStates] = {};
          if (law.derivative) law.derivative(p.data(), 0.005, sign * v, z, dz);
          sum += sign * law.force(p.data(), 0.005, sign * v, z);
          for (const double d : dz) sum += d;
        }
      return sum;
    };
    std::vector<double> p = defaults(law);
    const double before = response(p);
    for (std::size_t k = 0; k < p.size(); ++k) {
      CAPTURE(std::string(law.params[k].name));
      const double kept = p[k];
      p[k] = kept != 0 ? 1.01 * kept : 0.1;
      CHECK(response(p) != before);
      p[k] = kept;
    }
  });
}

TEST_CASE("force and derivative are finite wherever the bounds allow") {
  for_each_law([](const Law& law) {
    Random random(11);
    for (int trial = 0; trial < 3000; ++trial) {
      std::vector<double> p;
      for (const ParamInfo& info : law.params) p.push_back(anywhere(info, random));
      double z[kMaxStates], dz[kMaxStates] = {};
      for (double& state : z) state = random.normal() * 0.01;
      const double x = random.normal() * 0.05, v = trial % 7 ? random.normal() : 0;
      bool finite = std::isfinite(law.force(p.data(), x, v, z));
      if (law.derivative) {
        law.derivative(p.data(), x, v, z, dz);
        finite &=
            std::all_of(std::begin(dz), std::end(dz), [](double d) { return std::isfinite(d); });
        finite &= law.rate(p.data(), v) >= 0 && std::isfinite(law.rate(p.data(), v));
      }
      CHECK(finite);
    }
  });
}

TEST_CASE("whether the force needs the displacement is stated rightly") {
  for_each_law([](const Law& law) {
    const LawModel model = LawModel::constant(law, defaults(law));
    const auto force_about = [&](double x) {
      std::vector<double> state(model.state_size());
      model.rest({0, 0, 0}, state);
      model.advance({0, 0.1, 0}, {x, 0.1, 0}, 0.01, state);
      return model.force({x, 0.1, 0}, state);
    };
    CHECK((force_about(0.001) != force_about(-0.002)) == model.needs_displacement());
  });
}

TEST_CASE("at rest nothing moves") {
  for_each_law([](const Law& law) {
    if (law.states.empty()) return;
    const std::vector<double> p = defaults(law);
    for (const double x : {-0.02, 0.0, 0.013}) {
      double z[kMaxStates] = {}, dz[kMaxStates] = {};
      law.rest(p.data(), x, 0, z);
      law.derivative(p.data(), x, 0, z, dz);
      for (const double slope : dz) CHECK(slope == 0);
    }
  });
}

TEST_CASE("a cycle dissipates: the F-x loop runs clockwise, for the defaults and about them") {
  for_each_law([](const Law& law) {
    Random random(5);
    CHECK(energy(steady_cycle(LawModel::constant(law, defaults(law)))) > 0);
    for (int trial = 0; trial < 20; ++trial)
      CHECK(energy(steady_cycle(LawModel::constant(law, near_defaults(law, random)), 1000)) > 0);
  });
}

TEST_CASE(
    "hysteresis runs counter-clockwise in F-v: on the rising branch the force crosses its middle "
    "at v > 0") {
  for_each_law([](const Law& law) {
    const std::vector<Sample> cycle = steady_cycle(LawModel::constant(law, defaults(law)));
    const double centre = middle(cycle);
    const bool hysteretic = law.needs_displacement || !law.states.empty();
    for (std::size_t k = 1; k < cycle.size(); ++k) {
      if (!(cycle[k - 1].force < centre && cycle[k].force >= centre)) continue;
      CAPTURE(cycle[k].input.velocity);
      CHECK(cycle[k].input.displacement < 0);  // the rising branch: acceleration > 0
      if (hysteretic) CHECK(cycle[k - 1].input.velocity > 0);
    }
  });
}

TEST_CASE("JSON gives back the same model to the last bit") {
  for_each_law([](const Law& law) {
    Random random(3);
    Dependence d;
    for (const ParamInfo& info : law.params) {
      d.forms.push_back(info.form);
      d.coefficients.emplace_back();
      for (std::size_t k = 0; k < coefficient_count(info.form); ++k)
        d.coefficients.back().push_back(anywhere(info, random));
      if (info.fit == Fit::Drive) d.coefficients.back() = {0, 1};
    }
    const LawModel model(law, d, DriveUnit::Volt, random.uniform(0, 300));
    const auto back = law_model_from_json(parse_json(format_json(model.to_json()), "m.json"));
    CHECK(&back->law() == &law);
    CHECK(back->parameters().forms == d.forms);
    CHECK(back->parameters().coefficients == d.coefficients);
    CHECK(back->lag_rate() == model.lag_rate());
    CHECK(back->drive_unit() == DriveUnit::Volt);
  });
}

TEST_CASE("the same run gives the same bits") {
  for_each_law([](const Law& law) {
    const LawModel model = LawModel::constant(law, defaults(law));
    const std::vector<Sample> once = steady_cycle(model, 500), again = steady_cycle(model, 500);
    for (std::size_t k = 0; k < once.size(); ++k) CHECK(once[k].force == again[k].force);
  });
}
