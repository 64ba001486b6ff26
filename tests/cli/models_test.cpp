#include "dashpot/base/file.h"
#include "dashpot/damper/registry.h"
#include "dashpot/value.h"
#include "program.h"

using namespace dashpot;

TEST_CASE("models: the table names every registered model") {
  const ProgramResult result = run_dashpot("models");
  CHECK(result.exit_code == 0);
  for (const std::string& name : model_names()) CHECK(contains(result.output, name));
}

TEST_CASE("models fits 80 columns, the list and every model" * doctest::test_suite("long")) {
  CHECK(longest_line(run_dashpot("models", "COLUMNS=80").output) <= 80);
  for (const std::string& name : model_names()) {
    CAPTURE(name);
    CHECK(longest_line(run_dashpot("models " + name, "COLUMNS=80").output) <= 80);
  }
}

TEST_CASE("models NAME: equation, every parameter with its unit, source" *
          doctest::test_suite("long")) {
  for (const Law* law : laws()) {
    CAPTURE(law->name);
    const ProgramResult result = run_dashpot("models " + std::string(law->name));
    CHECK(result.exit_code == 0);
    const std::string equation(law->equation.substr(0, law->equation.find('\n')));
    CHECK(contains(result.output, equation));
    CHECK(contains(result.output, "Source: "));
    for (const ParamInfo& p : law->params)
      CHECK(contains(result.output, "\n" + std::string(p.name) + " "));
  }
}

TEST_CASE("models --json holds the tables as they stand in the registry" *
          doctest::test_suite("long")) {
  const Value list = parse_json(run_dashpot("models --json").output, "models --json");
  REQUIRE(list.items().size() == model_names().size());
  const Value one =
      parse_json(run_dashpot("models bingham --json").output, "models bingham --json");
  const Law& law = find_law("bingham");
  REQUIRE(one.find("parameters")->items().size() == law.params.size());
  const Value& first = one.find("parameters")->items().front();
  CHECK(first.find("name")->as_string() == law.params.front().name);
  CHECK(first.find("default")->as_number() == law.params.front().value);
  CHECK(first.find("upper")->as_number() == law.params.front().upper);
}

TEST_CASE("models --markdown has a section per model, and the page in docs/ is up to date" *
          doctest::test_suite("long")) {
  const ProgramResult page = run_dashpot("models --markdown");
  CHECK(page.output == read_file(project_file("docs/models.md")));
  for (const std::string& name : model_names()) CHECK(contains(page.output, "\n## `" + name + "`"));
}
