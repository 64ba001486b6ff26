#include <set>
#include <sstream>

#include <pugixml.hpp>

#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/export/fmu/fmu.h"

namespace dashpot {
namespace {

using Node = pugi::xml_node;

void set(Node node, const char* name, const std::string& value) {
  node.append_attribute(name) = xml_text(value).c_str();
}

std::string text_of(const pugi::xml_document& document) {
  std::ostringstream out;
  document.save(out, "  ", pugi::format_default, pugi::encoding_utf8);
  return out.str();
}

Node begin(pugi::xml_document& document, const char* root) {
  Node declaration = document.append_child(pugi::node_declaration);
  set(declaration, "version", "1.0");
  set(declaration, "encoding", "UTF-8");
  return document.append_child(root);
}

void add_units(const Fmu& fmu, Node root) {
  Node units = root.append_child("UnitDefinitions");
  std::set<std::string> names;
  for (const FmuVariable& variable : fmu.variables)
    if (!variable.unit.empty()) names.insert(variable.unit);

  // Each in powers of the base units of SI.
  for (const std::string& name : names) {
    const Unit unit = require_unit(name, "unit");
    Node node = units.append_child("Unit");
    set(node, "name", name);
    Node base = node.append_child("BaseUnit");
    constexpr std::array kBases{"kg", "m", "s", "A", "K"};
    for (std::size_t k = 0; k < kBases.size(); ++k)
      if (unit.dimension[k] != 0) set(base, kBases[k], std::to_string(unit.dimension[k]));
    if (unit.factor != 1) set(base, "factor", format_exact(unit.factor));
    if (unit.offset != 0) set(base, "offset", format_exact(unit.offset));
  }
}

void add_experiment(const Fmu& fmu, Node root) {
  Node node = root.append_child("DefaultExperiment");
  set(node, "startTime", "0");
  set(node, "stopTime", format_exact(fmu.stop_time()));
  set(node, "stepSize", format_exact(fmu.sample_time));
}

void add_log_categories(Node root) {
  Node category = root.append_child("LogCategories").append_child("Category");
  set(category, "name", "logStatusError");
  set(category, "description", "what was wrong with a call");
}

/// Causality, variability and start of a variable, for which both versions have the same words.
void describe_kind(const Fmu& fmu, const FmuVariable& variable, Node node) {
  constexpr const char* kCausalities[] = {"independent", "input", "output",
                                          "local",       "local", "parameter"};
  set(node, "causality", kCausalities[static_cast<std::size_t>(variable.role)]);
  const bool parameter = variable.role == FmuRole::Parameter,
             discrete = variable.role == FmuRole::Output && fmu.sampled;
  set(node, "variability", parameter ? "tunable" : discrete ? "discrete" : "continuous");
  if (parameter)
    set(node, "initial", "exact");
  else if (variable.role != FmuRole::Time && variable.role != FmuRole::Input)
    set(node, "initial", "calculated");
}

void describe_values(const FmuVariable& variable, Node node) {
  if (!variable.unit.empty()) set(node, "unit", variable.unit);
  if (std::isfinite(variable.lower)) set(node, "min", format_exact(variable.lower));
  if (std::isfinite(variable.upper)) set(node, "max", format_exact(variable.upper));
  if (variable.role != FmuRole::Time && variable.nominal != 1)
    set(node, "nominal", format_exact(variable.nominal));
  if (variable.role == FmuRole::Input || variable.role == FmuRole::Parameter)
    set(node, "start", format_exact(variable.start));
}

/// Outputs, then states and derivatives: exactly what is calculated at the start.
template <class Add>
void for_each_unknown(const Fmu& fmu, Add add) {
  for (const FmuRole role : {FmuRole::Output, FmuRole::State, FmuRole::Derivative})
    for (std::size_t k = 0; k < fmu.variables.size(); ++k)
      if (fmu.variables[k].role == role) add(k);
}

std::string about(const Fmu& fmu) { return fmu.title + ". " + fmu.origin; }

/// The capabilities that both versions have; their names end in different ways.
void add_capabilities(const Fmu& fmu, const char* state, const char* derivatives, Node node) {
  set(node, (std::string("canGetAndSet") + state).c_str(), "true");
  set(node, (std::string("canSerialize") + state).c_str(), "true");
  if (!fmu.sampled) set(node, derivatives, "true");
}

void add_fmi2_interface(const Fmu& fmu, const char* kind, Node root) {
  Node node = root.append_child(kind);
  set(node, "modelIdentifier", fmu.name);
  if (kind == std::string_view("CoSimulation"))
    set(node, "canHandleVariableCommunicationStepSize", "true");
  add_capabilities(fmu, "FMUstate", "providesDirectionalDerivative", node);
  Node files = node.append_child("SourceFiles");
  for (const std::string& unit : fmu_translation_units(fmu))
    set(files.append_child("File"), "name", unit);
}

void add_fmi3_interface(const Fmu& fmu, const char* kind, Node root) {
  Node node = root.append_child(kind);
  set(node, "modelIdentifier", fmu.name);
  add_capabilities(fmu, "FMUState", "providesDirectionalDerivatives", node);
  if (kind != std::string_view("CoSimulation")) return;
  set(node, "canHandleVariableCommunicationStepSize", "true");
  if (fmu.grid > 0) set(node, "fixedInternalStepSize", format_exact(fmu.grid));
}

void add_fmi2_variables(const Fmu& fmu, Node root) {
  Node list = root.append_child("ModelVariables");
  for (std::size_t k = 0; k < fmu.variables.size(); ++k) {
    const FmuVariable& variable = fmu.variables[k];
    Node node = list.append_child("ScalarVariable");
    set(node, "name", variable.name);
    set(node, "valueReference", std::to_string(k));
    set(node, "description", variable.meaning);
    describe_kind(fmu, variable, node);

    // The state of which it is the slope, counted from 1.
    Node real = node.append_child("Real");
    describe_values(variable, real);
    if (variable.role == FmuRole::Derivative)
      set(real, "derivative", std::to_string(variable.derivative_of + 1));
  }
}

void add_fmi2_structure(const Fmu& fmu, Node root) {
  Node structure = root.append_child("ModelStructure");
  const auto add = [](Node list, std::size_t k) {
    set(list.append_child("Unknown"), "index", std::to_string(k + 1));
  };
  Node outputs = structure.append_child("Outputs");
  Node derivatives =
      fmu.count(FmuRole::State) == 0 ? Node() : structure.append_child("Derivatives");
  for (std::size_t k = 0; k < fmu.variables.size(); ++k) {
    if (fmu.variables[k].role == FmuRole::Output) add(outputs, k);
    if (fmu.variables[k].role == FmuRole::Derivative) add(derivatives, k);
  }
  Node unknowns = structure.append_child("InitialUnknowns");
  for_each_unknown(fmu, [&](std::size_t k) { add(unknowns, k); });
}

}  // namespace

std::string fmi2_description(const Fmu& fmu) {
  pugi::xml_document document;
  Node root = begin(document, "fmiModelDescription");
  set(root, "fmiVersion", "2.0");
  set(root, "modelName", fmu.name);
  set(root, "guid", fmu.token);
  set(root, "description", about(fmu));
  set(root, "generationTool", fmu.tool);
  set(root, "generationDateAndTime", fmu.date);
  set(root, "variableNamingConvention", "structured");
  set(root, "numberOfEventIndicators", "0");

  // The order of these elements is that of the standard's schema.
  if (fmu.exchanges) add_fmi2_interface(fmu, "ModelExchange", root);
  add_fmi2_interface(fmu, "CoSimulation", root);
  add_units(fmu, root);
  add_log_categories(root);
  add_experiment(fmu, root);
  add_fmi2_variables(fmu, root);
  add_fmi2_structure(fmu, root);
  return text_of(document);
}

std::string fmi3_description(const Fmu& fmu) {
  pugi::xml_document document;
  Node root = begin(document, "fmiModelDescription");
  set(root, "fmiVersion", "3.0");
  set(root, "modelName", fmu.name);
  set(root, "instantiationToken", fmu.token);
  set(root, "description", about(fmu));
  set(root, "generationTool", fmu.tool);
  set(root, "generationDateAndTime", fmu.date);
  set(root, "variableNamingConvention", "structured");

  // The order of these elements is that of the standard's schema.
  if (fmu.exchanges) add_fmi3_interface(fmu, "ModelExchange", root);
  add_fmi3_interface(fmu, "CoSimulation", root);
  add_units(fmu, root);
  add_log_categories(root);
  add_experiment(fmu, root);

  // Variables by their value references.
  Node variables = root.append_child("ModelVariables");
  Node structure = root.append_child("ModelStructure");
  for (std::size_t k = 0; k < fmu.variables.size(); ++k) {
    const FmuVariable& variable = fmu.variables[k];
    Node node = variables.append_child("Float64");
    set(node, "name", variable.name);
    set(node, "valueReference", std::to_string(k));
    set(node, "description", variable.meaning);
    describe_kind(fmu, variable, node);
    describe_values(variable, node);
    if (variable.role == FmuRole::Derivative)
      set(node, "derivative", std::to_string(variable.derivative_of));
  }

  // The unknowns: outputs and derivatives while it runs, states at the start, too.
  for_each_unknown(fmu, [&](std::size_t k) {
    const FmuRole role = fmu.variables[k].role;
    if (role == FmuRole::State) return;
    set(structure.append_child(role == FmuRole::Output ? "Output" : "ContinuousStateDerivative"),
        "valueReference", std::to_string(k));
  });
  for_each_unknown(fmu, [&](std::size_t k) {
    set(structure.append_child("InitialUnknown"), "valueReference", std::to_string(k));
  });
  return text_of(document);
}

std::string fmu_build_description(const Fmu& fmu) {
  pugi::xml_document document;
  Node root = begin(document, "fmiBuildDescription");
  set(root, "fmiVersion", "3.0");
  Node configuration = root.append_child("BuildConfiguration");
  set(configuration, "modelIdentifier", fmu.name);
  set(configuration, "description", "C99 and its library of mathematics, nothing else");

  // The files to compile, and the library to link.
  Node files = configuration.append_child("SourceFileSet");
  set(files, "language", "C99");
  for (const std::string& unit : fmu_translation_units(fmu))
    set(files.append_child("SourceFile"), "name", unit);
  Node library = configuration.append_child("Library");
  set(library, "name", "m");
  set(library, "external", "true");
  return text_of(document);
}

std::string fmu_reference_manifest(const Fmu& fmu) {
  pugi::xml_document document;
  Node root = begin(document, "fmiReferences");
  set(root, "xmlns:fmi-ls", "http://fmi-standard.org/fmi-ls-manifest");
  set(root, "fmi-ls:fmi-ls-name", "org.fmi-standard.fmi-ls-ref");
  set(root, "fmi-ls:fmi-ls-version", "1.0.0-alpha.1");
  set(root, "fmi-ls:fmi-ls-description", "reference files");
  Node file = root.append_child("Related");
  set(file, "type", "text/csv");
  set(file, "source", fmu.name + "_out.csv");
  set(file, "role", "result");
  set(file, "description", "inputs and outputs at the same instants, by Dashpot itself");
  return text_of(document);
}

}  // namespace dashpot
