// What an FMU holds and says of itself. The rules are those of FMI 2.0.5 and 3.0.2.
#include <cctype>
#include <cstdlib>
#include <set>

#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/damper/registry.h"
#include "dashpot/export/c/c_controller.h"
#include "dashpot/export/c/c_model.h"
#include "export/fmu_importer.h"

using namespace dashpot;

namespace {

const ExampleModel& example(const std::string& name) {
  static const std::vector<ExampleModel> models = example_models();
  for (const ExampleModel& model : models)
    if (model.name == name) return model;
  throw std::runtime_error("no example " + name);
}

/// A controller of four dampers with a command between 0 and 1.
CBlockMaker full_car() {
  return [](const ExportOptions& options) {
    return c_controller_block(
        make_vehicle(
            {.plant = "ikenaga2000", .dampers = {"ideal"}, .controller = "clipped_lqr,force=1e-8"}),
        options);
  };
}

ExportOptions sources_only() {
  return {.sources_only = true, .command = "dashpot export", .version = "9.9"};
}

std::string description_of(const std::string& name, int version) {
  return unzipped(fmu_of(exported(*example(name).model), version, sources_only()))
      .at("modelDescription.xml");
}

/// SOURCE_DATE_EPOCH while this lives.
struct FixedDate {
  explicit FixedDate(const char* seconds) { setenv("SOURCE_DATE_EPOCH", seconds, 1); }
  ~FixedDate() { unsetenv("SOURCE_DATE_EPOCH"); }
};

/// The text with 0 in place of each hexadecimal digit.
std::string shape_of(std::string text) {
  for (char& c : text)
    if (std::isxdigit(static_cast<unsigned char>(c))) c = '0';
  return text;
}

unsigned number(const std::string& bytes, std::size_t at, std::size_t size) {
  unsigned value = 0;
  for (std::size_t k = 0; k < size; ++k)
    value |= static_cast<unsigned>(static_cast<unsigned char>(bytes.at(at + k))) << (8 * k);
  return value;
}

using Set = std::set<std::string>;

/// The variables of a kind, as ModelStructure must name them.
Set variables(pugi::xml_node root, const std::string& causality, bool derivatives) {
  Set found;
  const bool fmi2 = !root.attribute("guid").empty();
  int place = 0;
  for (const pugi::xml_node variable : root.child("ModelVariables")) {
    ++place;
    const pugi::xml_node value = fmi2 ? variable.child("Real") : variable;
    if (variable.attribute("causality").value() != causality) continue;
    if (derivatives != !value.attribute("derivative").empty()) continue;
    found.insert(fmi2 ? std::to_string(place) : variable.attribute("valueReference").value());
  }
  return found;
}

Set listed(pugi::xml_node parent, const char* element, const char* attribute) {
  Set found;
  for (const pugi::xml_node node : parent.children(element))
    found.insert(node.attribute(attribute).value());
  return found;
}

void check_structure(pugi::xml_node root, std::size_t output_count = 1) {
  const bool fmi2 = !root.attribute("guid").empty();
  const pugi::xml_node structure = root.child("ModelStructure");
  const Set outputs = variables(root, "output", false), slopes = variables(root, "local", true),
            states = variables(root, "local", false);
  Set unknowns = outputs;
  unknowns.insert(slopes.begin(), slopes.end());
  unknowns.insert(states.begin(), states.end());
  CHECK(outputs.size() == output_count);
  CHECK(slopes.size() == states.size());
  if (fmi2) {
    CHECK(listed(structure.child("Outputs"), "Unknown", "index") == outputs);
    CHECK(listed(structure.child("Derivatives"), "Unknown", "index") == slopes);
    CHECK(listed(structure.child("InitialUnknowns"), "Unknown", "index") == unknowns);
  } else {
    CHECK(listed(structure, "Output", "valueReference") == outputs);
    CHECK(listed(structure, "ContinuousStateDerivative", "valueReference") == slopes);
    CHECK(listed(structure, "InitialUnknown", "valueReference") == unknowns);
  }
}

/// `units`: what is no unit but may stand for one.
void check_variables(pugi::xml_node root, Set units = {}) {
  const bool fmi2 = !root.attribute("guid").empty();
  Set names, references;
  for (const pugi::xml_node unit : root.child("UnitDefinitions"))
    units.insert(unit.attribute("name").value());
  int independent = 0;
  std::size_t count = 0;
  for (const pugi::xml_node variable : root.child("ModelVariables")) {
    const pugi::xml_node value = fmi2 ? variable.child("Real") : variable;
    CAPTURE(variable.attribute("name").value());
    ++count;
    names.insert(variable.attribute("name").value());
    references.insert(variable.attribute("valueReference").value());
    const std::string causality = variable.attribute("causality").value();
    independent += causality == "independent";
    const bool starts = causality == "input" || causality == "parameter";
    CHECK(starts == !value.attribute("start").empty());
    CHECK(units.count(value.attribute("unit").value()));
    CHECK(value.attribute("nominal").as_double(1) > 0);
    CHECK(value.attribute("min").as_double(-HUGE_VAL) <= value.attribute("start").as_double(0));
    CHECK(value.attribute("max").as_double(HUGE_VAL) >= value.attribute("start").as_double(0));
  }
  CHECK(independent == 1);
  CHECK(names.size() == count);
  CHECK(references.size() == count);
}

}  // namespace

TEST_CASE("FMU: every variable and unknown of every model is declared as the standard asks" *
          doctest::test_suite("long")) {
  for (const ExampleModel& model : example_models())
    for (const int version : {2, 3}) {
      CAPTURE(model.name);
      CAPTURE(version);
      pugi::xml_document document;
      const std::string text = description_of(model.name, version);
      REQUIRE(document.load_string(text.c_str()));
      CHECK(text.starts_with("<?xml version=\"1.0\" encoding=\"UTF-8\"?>"));
      const pugi::xml_node root = document.child("fmiModelDescription");
      check_variables(root);
      check_structure(root);
      CHECK(has_settable(*model.model) == (text.find("parameter.") != std::string::npos));
      const std::string date = root.attribute("generationDateAndTime").value();
      CHECK(shape_of(date) == "0000-00-00T00:00:00Z");
    }
}

TEST_CASE(
    "FMU: every variable and unknown of a controller of four dampers is declared as the standard "
    "asks") {
  for (const int version : {2, 3}) {
    CAPTURE(version);
    const LoadedFmu fmu(fmu_of(full_car(), version, sources_only()));
    check_variables(fmu.root(), {""});
    check_structure(fmu.root(), 4);
  }
}

TEST_CASE("FMU: what a parameter is at current 0 has its bounds, its slope over current none") {
  pugi::xml_document document;
  document.load_string(description_of("bouc_wen", 3).c_str());
  const pugi::xml_node variables = document.child("fmiModelDescription").child("ModelVariables");
  const auto variable = [&](const char* name) {
    return variables.find_child_by_attribute("name", name);
  };
  CHECK(variable("parameter.c0_a").attribute("min").as_double(-1) == 0);
  CHECK(variable("parameter.c0_a").attribute("max").as_double() == 1e8);
  CHECK(variable("parameter.c0_b").attribute("min").empty());
  CHECK(variable("parameter.c0_a").attribute("description").value() ==
        std::string("viscous damping, without drive"));
  CHECK(variable("parameter.c0_b").attribute("description").value() ==
        std::string("viscous damping, per drive"));
}

TEST_CASE("FMU: units have their SI factors") {
  pugi::xml_document document;
  document.load_string(description_of("bouc_wen", 3).c_str());
  const pugi::xml_node units = document.child("fmiModelDescription").child("UnitDefinitions");
  const pugi::xml_node force = units.find_child_by_attribute("name", "N").child("BaseUnit");
  CHECK(force.attribute("kg").as_int() == 1);
  CHECK(force.attribute("m").as_int() == 1);
  CHECK(force.attribute("s").as_int() == -2);
  const pugi::xml_node gain = units.find_child_by_attribute("name", "N/(m*A)").child("BaseUnit");
  CHECK(gain.attribute("A").as_int() == -1);
  CHECK(gain.attribute("s").as_int() == -2);
}

TEST_CASE("FMU: a voltage-driven damper takes volts") {
  const ExampleModel& model = example("bouc_wen");
  ExportedModel volts = exported(*model.model);
  volts.drive_unit = DriveUnit::Volt;
  const std::string text = unzipped(fmu_of(volts, 3, sources_only())).at("modelDescription.xml");
  CHECK(text.find("name=\"u\"") != std::string::npos);
  CHECK(text.find("name=\"i\"") == std::string::npos);
}

TEST_CASE("FMU: well-formed for another parser") {
  if (run_program("xmllint --version").exit_code != 0) {
    MESSAGE("SKIPPED: no xmllint is here");
    return;
  }
  const TemporaryFolder folder;
  for (const int version : {2, 3})
    for (const std::string& archive :
         {fmu_of(exported(*example("hybrid").model), version, sources_only()),
          fmu_of(full_car(), version, sources_only())})
      for (const auto& [name, content] : unzipped(archive)) {
        if (!name.ends_with(".xml") && !name.ends_with(".html")) continue;
        const auto path = folder.write("file", content);
        const ProgramResult result =
            run_program((name.ends_with(".html") ? "xmllint --noout --html " : "xmllint --noout ") +
                        path.string());
        CAPTURE(result.output);
        CHECK(result.exit_code == 0);
        CHECK(result.output == "");
      }
}

TEST_CASE("FMU: the archive keeps to what importers read") {
  const std::string bytes = fmu_of(exported(*example("bingham").model), 3, sources_only());
  std::size_t at = 0, files = 0;
  for (; number(bytes, at, 4) == 0x04034b50; ++files) {
    const std::string name = bytes.substr(at + 30, number(bytes, at + 26, 2));
    CAPTURE(name);
    const unsigned flags = number(bytes, at + 6, 2), method = number(bytes, at + 8, 2);
    CHECK(number(bytes, at + 4, 2) <= 20);  // version needed
    CHECK((method == 0 || method == 8));
    CHECK((flags & ~0x0806U) == 0);  // neither encrypted nor with sizes behind the data
    CHECK(name.find('\\') == std::string::npos);
    CHECK(name[0] != '/');
    CHECK(name[0] != '.');
    at += 30 + number(bytes, at + 26, 2) + number(bytes, at + 28, 2) + number(bytes, at + 18, 4);
  }
  CHECK(files == unzipped(bytes).size());
}

TEST_CASE("FMU: cut off, it is no archive any more") {
  const std::string bytes = fmu_of(exported(*example("bingham").model), 2, sources_only());
  for (const std::size_t size : {bytes.size() - 1, bytes.size() / 2, std::size_t{10}})
    CHECK(message_of([&] { unzipped(bytes.substr(0, size)); }).starts_with("zip: "));
}

TEST_CASE("FMU: what lies inside") {
  for (const int version : {2, 3}) {
    const auto files =
        unzipped(fmu_of(exported(*example("bouc_wen").model), version, sources_only()));
    Set names;
    for (const auto& [name, content] : files) names.insert(name);
    Set expected{"modelDescription.xml",
                 "documentation/index.html",
                 "extra/org.fmi-standard.fmi-ls-ref/fmi-ls-manifest.xml",
                 "extra/org.fmi-standard.fmi-ls-ref/bouc_wen_damper_out.csv",
                 "sources/damper.h",
                 "sources/damper.c",
                 "sources/fmu_model.h",
                 "sources/fmu.h",
                 "sources/fmu_between.h",
                 "sources/fmu_damper.h",
                 "sources/fmu_run.h",
                 "sources/fmu_snapshot.h",
                 "sources/fmu_derivative.h"};
    if (version == 2)
      expected.insert("sources/fmi2.c");
    else
      expected.insert({"sources/fmi3.c", "sources/fmi3_types.h", "sources/fmi3_absent.h",
                       "sources/buildDescription.xml"});
    CHECK(names == expected);
    CHECK(files.at("documentation/index.html").find("parameter.alpha_a") != std::string::npos);
    const std::vector<std::string> rows =
        split(files.at("extra/org.fmi-standard.fmi-ls-ref/bouc_wen_damper_out.csv"), '\n');
    CHECK(rows[0] == "time,s,v,i,f");
    CHECK(rows.size() == 503);  // the title, 501 instants, the end
  }
}

TEST_CASE("FMU: SOURCE_DATE_EPOCH makes it the same bytes each time" *
          doctest::test_suite("long")) {
  if (!has_compiler()) return;
  const FixedDate date("1700000000");
  for (const int version : {2, 3}) {
    const auto make = [&] { return shipped_fmu_of(exported(*example("bingham").model), version); };
    const std::string once = make();
    CHECK(once == make());
    CHECK(unzipped(once).at("modelDescription.xml").find("\"2023-11-14T22:13:20Z\"") !=
          std::string::npos);
  }
}

TEST_CASE("FMU: the token is that of the content") {
  const auto token = [](const ExportedModel& model, const ExportOptions& options) {
    pugi::xml_document document;
    document.load_string(unzipped(fmu_of(model, 3, options)).at("modelDescription.xml").c_str());
    return std::string(
        document.child("fmiModelDescription").attribute("instantiationToken").value());
  };
  const ExportedModel model = exported(*example("bingham").model);
  ExportOptions options = sources_only();
  const std::string own = token(model, options);
  CHECK(shape_of(own) == "{00000000-0000-0000-0000-000000000000}");
  {
    const FixedDate date("1700000000");
    CHECK(token(model, options) == own);
  }
  options.sample_time = 0.5e-3;
  CHECK(token(model, options) != own);
}

TEST_CASE("FMU: the binary needs the C library only and exports FMI only" *
          doctest::test_suite("long")) {
  if (!has_compiler()) return;
  for (const int version : {2, 3}) {
    const LoadedFmu fmu(shipped_fmu_of(exported(*example("hybrid").model), version));
    const ProgramResult needs = run_program("objdump -p " + fmu.library_path());
    for (const std::string& line : split(needs.output, '\n'))
      if (line.find("NEEDED") != std::string::npos)
        CHECK((line.find("libm.so") != std::string::npos ||
               line.find("libc.so") != std::string::npos));
    std::size_t functions = 0;
    for (const std::string& line :
         split(run_program("nm -D --defined-only " + fmu.library_path()).output, '\n')) {
      if (line.empty()) continue;
      CAPTURE(line);
      CHECK(line.find(version == 2 ? " T fmi2" : " T fmi3") != std::string::npos);
      ++functions;
    }
    CHECK(functions == (version == 2 ? 44 : 75));  // all of the standard
  }
}

TEST_CASE("FMU: without a compiler, or with one that complains, a message says what to do") {
  const ExportedModel model = exported(*example("bingham").model);
  ExportOptions options{.compiler = "no-such-compiler"};
  CHECK(message_of([&] {
          shipped_fmu_of(model, 3, options);
        }).find("the C compiler cannot be run") != std::string::npos);
  options.compiler = "cc --no-such-flag";
  if (has_compiler())
    CHECK(message_of([&] { shipped_fmu_of(model, 3, options); }).find("the C compiler complains") !=
          std::string::npos);
}
