// Text from model files, vehicles and command lines, written by somebody who wants it to be more
// than text, through every exporter.
#include <fstream>
#include <map>

#include <pugixml.hpp>

#include "conformance/c_compile.h"
#include "conformance/control_cases.h"
#include "damper/inverse/example_network.h"
#include "dashpot/base/file.h"
#include "export/example_models.h"
#include "export/fmu_importer.h"
#include "support.h"

using namespace dashpot;

namespace {

/// Each would be more than text somewhere, were it not escaped; OWNED is a file that the first
/// would make when a program starts or a library is loaded.
const std::vector<std::string> kHostile{
    "*/\n#include <stdlib.h>\n__attribute__((constructor)) static void p(void) "
    "{ system(\"touch OWNED\"); }\n/* ",
    "*?\?/\n/ int owned; /*",
    "ends in a backslash \\",
    "ends in a trigraph ?\?/",
    "//\\\nint owned;",
    "/* opened once more",
    "*//*/ */* **//",
    "\"; end damper; package owned",
    "</html>\")); end x; model owned end owned;",
    "]]> --> <script>alert(1)</script> <!ENTITY x \"y\">",
    "@command@ @title@ @prefix@ @name@ @about@",
    "%s%n%d 100 %",
    std::string("nul \0 int owned;", 16),
    "bidi \xE2\x80\xAE\xE2\x81\xA6 */ int owned; /* \xE2\x81\xA9",
    "line \xE2\x80\xA8 paragraph \xE2\x80\xA9 next \xC2\x85 bell \x07 return \r not UTF-8 \xFF\xC0",
    "'q",
    std::string(100000, 'x') + "*/"};

/// C as the compiler sees it behind comments: trigraphs and broken lines made whole, and one space
/// for each comment and for all blanks.
std::string code_alone(const std::string& text) {
  std::string whole;
  whole.reserve(text.size());
  for (std::size_t k = 0; k < text.size(); ++k) {
    char next = text[k];
    if (next == '?' && text.compare(k, 3, "?\?/") == 0) next = '\\', k += 2;
    if (next == '\\' && text.compare(k + 1, 1, "\n") == 0)
      ++k;
    else
      whole += next;
  }

  std::string code;
  for (std::size_t k = 0; k < whole.size(); ++k) {
    if (whole.compare(k, 2, "/*") == 0) {
      k = whole.find("*/", k + 2);
      REQUIRE(k != std::string::npos);
      ++k;
      code += ' ';
    } else if (whole.compare(k, 2, "//") == 0) {
      k = std::min(whole.find('\n', k), whole.size()) - 1;
    } else if (whole[k] == '"') {
      const std::size_t from = k++;
      while (k < whole.size() && whole[k] != '"') k += whole[k] == '\\' ? 2 : 1;
      code += whole.substr(from, k + 1 - from);
    } else if (whole[k] != ' ' || !code.ends_with(' ')) {
      code += whole[k];
    }
  }
  return code;
}

/// Modelica without comments and without the insides of strings.
std::string modelica_alone(const std::string& text) {
  std::string code;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text.compare(k, 2, "//") == 0) {
      k = std::min(text.find('\n', k), text.size()) - 1;
    } else if (text[k] == '"') {
      for (++k; k < text.size() && text[k] != '"';) k += text[k] == '\\' ? 2 : 1;
      code += "\"\"";
    } else {
      code += text[k];
    }
  }
  return code;
}

std::string ending(const std::string& name) {
  return std::filesystem::path(name).extension().string();
}

/// The files within an FMU too.
std::vector<ExportedFile> unpacked(const std::vector<ExportedFile>& files) {
  std::vector<ExportedFile> all;
  for (const ExportedFile& file : files) {
    if (ending(file.name) != ".fmu") {
      all.push_back(file);
      continue;
    }
    for (const auto& [name, content] : unzipped(file.content)) all.push_back({name, content});
  }
  std::ranges::sort(all, {}, &ExportedFile::name);
  return all;
}

/// Elements and attributes by name: what text may not change.
std::string structure_of(const std::string& xml) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed =
      document.load_buffer(xml.data(), xml.size(), pugi::parse_default | pugi::parse_doctype);
  CAPTURE(parsed.description());
  CHECK(parsed);
  struct Walker : pugi::xml_tree_walker {
    bool for_each(pugi::xml_node& node) override {
      found += std::string(static_cast<std::size_t>(depth()), ' ') + node.name();
      for (const pugi::xml_attribute& one : node.attributes())
        found += std::string(" ") + one.name();
      found += '\n';
      return true;
    }
    std::string found;
  } walker;
  document.traverse(walker);
  return walker.found;
}

/// `made` holds the same code and markup as `plain` and differs in text alone.
void check_same_code(const std::vector<ExportedFile>& made,
                     const std::vector<ExportedFile>& plain) {
  REQUIRE(made.size() == plain.size());
  for (std::size_t k = 0; k < made.size(); ++k) {
    CAPTURE(made[k].name);
    const std::string kind = ending(made[k].name);
    const std::string &here = made[k].content, &there = plain[k].content;
    REQUIRE(made[k].name == plain[k].name);
    if (kind == ".c" || kind == ".h") {
      // The token of an FMU is a hash of its texts.
      if (made[k].name.ends_with("fmu_model.h"))
        CHECK(std::ranges::count(code_alone(here), '\n') ==
              std::ranges::count(code_alone(there), '\n'));
      else
        CHECK(code_alone(here) == code_alone(there));
      CHECK(here.find_first_of(std::string("\0\r\x07", 3)) == std::string::npos);
      CHECK(!contains(here, "\xE2\x80\xAE"));
    } else if (kind == ".mo" || kind == ".mjs") {
      // JavaScript, too, has its strings between double quotes, and no comment with text in it.
      CHECK(modelica_alone(here) == modelica_alone(there));
      if (kind == ".mjs")
        CHECK(std::ranges::all_of(here, [](char c) { return c > 0 && c < 0x7F; }));
    } else if (kind == ".xml" || kind == ".html") {
      CHECK(structure_of(here) == structure_of(there));
      CHECK(here.find_first_of(std::string("\0\x07", 2)) == std::string::npos);
    }
  }
}

/// A law from a file that says this wherever it may say anything.
LawModel law_saying(const std::string& words) {
  constexpr std::size_t kMost = 2000;
  const std::string said = words.substr(0, kMost);
  Value definition = Value::object({{"title", said}, {"source", said}, {"remarks", said}});
  for (const auto& [key, value] : travelling_law_text()->definition().members()) {
    if (key == "source") continue;
    if (key != "parameters") {
      definition.add(key, value);
      continue;
    }
    Value parameters = Value::object();
    for (const auto& [name, parameter] : value.members()) {
      Value row = parameter;
      row.add("meaning", said);
      parameters.add(name, std::move(row));
    }
    definition.add(key, std::move(parameters));
  }
  const auto text = LawText::make(definition);
  LawModel model = example_law(text->law());

  // What a model file holds of it reads back.
  ModelFile file;
  file.model = model.with_offset(0);
  CHECK(format_model(parse_model(format_model(file), "m.json")) == format_model(file));
  return model;
}

/// A model of each kind; those that carry a name of their own under this one, or, where it is
/// empty, under one that the registry knows.
std::vector<ExampleModel> models_named(const std::string& name) {
  std::vector<ExampleModel> models;
  const auto add = [&](const std::string& kind, auto model) {
    models.push_back({kind, std::make_shared<const decltype(model)>(std::move(model))});
  };
  const auto or_known = [&](const char* known) { return name.empty() ? known : name; };
  const std::vector<std::string> inputs{"velocity", "current"};
  const Regressors regressors = example_regressors();
  add("law", example_law(find_law("bouc_wen")));
  add("mlp", NetworkModel(or_known("mlp_one_sensor"), inputs, {example_mlp(1)}));
  add("narx",
      NarxModel(or_known("narx_one_sensor"), regressors, {example_narx_network(regressors)}, 0));
  add("hysteresis",
      HysteresisNetworkModel(or_known("hysteresis_network"), {example_hysteresis_network(1)}, 0));
  add("state_space", StateSpaceModel(or_known("neural_state_space"), {example_state_space(1)}, 0));
  add("passive", PassiveNetworkModel(or_known("passive_network"), {example_passive_network(1)}, 0));
  const FuzzyModel fuzzy = example_fuzzy();
  add("fuzzy", FuzzyModel(or_known("takagi_sugeno"), fuzzy.inputs(), fuzzy.sugeno()));
  add("hybrid", example_hybrid());
  add("passive_hybrid",
      PassiveHybridModel(example_law(find_law("bouc_wen")),
                         {or_known("passive_network"), {example_passive_network(1)}}, 0.5));
  add("family", example_family());
  add("law_of_file", law_saying(name.empty() ? "plain" : name));
  return models;
}

/// The same, made once for each name.
const std::vector<ExampleModel>& known_models_named(const std::string& name) {
  static std::map<std::string, std::vector<ExampleModel>> known;
  const auto found = known.find(name);
  return found != known.end() ? found->second
                              : known.emplace(name, models_named(name)).first->second;
}

ExportedModel with_origin(const DamperModel& model, const std::string& origin) {
  ExportedModel made = exported(model);
  made.origin = origin;
  return made;
}

ExportOptions options_with(const std::string& command) {
  return {
      .name = "x", .sample_time = 1e-3, .sources_only = true, .command = command, .version = "1"};
}

/// A controller whose plant, struts, dampers and own name are this.
CBlockMaker controller_named(const std::string& name) {
  auto vehicle = std::make_shared<Vehicle>(make_vehicle({.dampers = {"spencer1997"},
                                                         .controller = "skyhook_modified",
                                                         .inverse = "numeric",
                                                         .sample_time = 2e-3}));
  vehicle->controller_name = vehicle->set.name = name;
  for (std::string& damper : vehicle->damper_names) damper = name;
  for (Strut& strut : vehicle->set.plant.struts) strut.name = name;
  return controller_block(vehicle);
}

CBlockMaker inverse_named(const std::string& name) {
  return [name](const ExportOptions& options) {
    InverseFile inverse{.network = example_network(inverse_network_presets().front()),
                        .domain = {-0.02, 0.02, -0.3, 0.3, 0, 1}};
    inverse.network.name = name;
    return c_inverse_block(inverse, options);
  };
}

}  // namespace

TEST_CASE("hostile names: every exporter of every kind of model writes the same code" *
          doctest::test_suite("long")) {
  for (const Exporter& exporter : exporters()) {
    CAPTURE(exporter.name);
    const auto files_of = [&](const std::string& name, std::size_t kind, const std::string& words) {
      const ExampleModel& model = known_models_named(name)[kind];
      return unpacked(exporter.write(with_origin(*model.model, words), options_with(words)));
    };
    for (std::size_t m = 0; m < known_models_named("").size(); ++m) {
      // FMUs describe a model as the registry has it, and are refused for another name.
      CAPTURE(m);
      const bool takes_any = message_of([&] { files_of("plain", m, ""); }).empty();
      const std::vector<ExportedFile> expected = files_of(takes_any ? "plain" : "", m, "plain");
      REQUIRE(!expected.empty());
      // Each name meets a twelfth of the kinds, and each kind a twelfth of the names.
      for (std::size_t k = 0; k < std::size(kHostile); ++k) {
        const std::string& name = kHostile[k];
        if ((k + m) % 12 == 0) check_same_code(files_of(takes_any ? name : "", m, name), expected);
      }
    }
  }
}

TEST_CASE("hostile names: every exporter of controllers and inverses writes the same code" *
          doctest::test_suite("long")) {
  for (const Exporter& exporter : exporters()) {
    if (!exporter.write_block) continue;
    CAPTURE(exporter.name);
    // Each name meets a controller or an inverse.
    for (const std::size_t which : {0, 1}) {
      const auto maker = which == 0 ? controller_named : inverse_named;
      const std::vector<ExportedFile> expected =
          unpacked(exporter.write_block(maker("plain"), options_with("plain")));
      for (std::size_t k = which; k < std::size(kHostile); k += 2)
        check_same_code(
            unpacked(exporter.write_block(maker(kHostile[k]), options_with(kHostile[k]))),
            expected);
    }
  }
}

TEST_CASE("hostile names: exported C compiles without a warning, and does nothing but its work" *
          doctest::test_suite("long")) {
  if (!is_there("cc")) return;
  const TemporaryFolder folder;
  std::string all;
  for (const std::string& name : kHostile)
    if (name.size() < 1000) all += name + "\n";
  std::size_t count = 0;
  const auto write = [&](const std::vector<ExportedFile>& files) {
    for (const ExportedFile& file : files) folder.write(file.name, file.content);
  };
  for (const std::string& name : {all, kHostile[1], kHostile[2], kHostile[3]}) {
    for (const ExampleModel& one : models_named(name)) {
      if (count > 12 && one.name != "mlp") continue;
      ExportOptions options = options_with(name);
      options.name = "x" + std::to_string(count++);
      write(find_exporter("c").write(with_origin(*one.model, name), options));
    }
    for (const auto maker : {controller_named, inverse_named}) {
      ExportOptions options = options_with(name);
      options.name = "x" + std::to_string(count++);
      write(find_exporter("c").write_block(maker(name), options));
    }
  }
  check_that_it_runs(folder, "-Wtrigraphs -Wcomment");
  CHECK(!std::filesystem::exists(folder.path() / "OWNED"));
}

TEST_CASE("hostile names: an FMU loads inert") {
  if (!has_compiler()) return;
  std::filesystem::remove("OWNED");
  ExportOptions options = options_with(kHostile[0]);
  options.sources_only = false;
  const ExampleModel model = models_named("")[1];
  const LoadedFmu fmu(fmu_of(with_origin(*model.model, kHostile[0]), 3, options));
  CHECK(!std::filesystem::exists("OWNED"));
}

TEST_CASE("hostile names: text that is not escaped would be seen as code") {
  for (const std::size_t k : {0, 1})
    CHECK(code_alone("/* " + kHostile[k] + " */\n") != code_alone("/* plain */\n"));
  CHECK(modelica_alone("\"" + kHostile[7] + "\"") != modelica_alone("\"plain\""));
}
