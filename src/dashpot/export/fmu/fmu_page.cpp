#include <sstream>

#include <pugixml.hpp>

#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
#include "dashpot/export/fmu/fmu.h"

namespace dashpot {
namespace {

using Node = pugi::xml_node;

constexpr const char* kStyle =
    "body { font: 16px/1.5 system-ui, sans-serif; max-width: 52rem; margin: 2rem auto;"
    " padding: 0 1rem; }\n"
    "table { border-collapse: collapse; }"
    " td, th { text-align: left; padding: 0.2rem 0.8rem 0.2rem 0; border-bottom: 1px solid #ddd; "
    "}\n"
    "pre { background: #f4f5f6; padding: 0.8rem; overflow-x: auto; }\n";

Node add(Node parent, const char* element, const std::string& text) {
  Node node = parent.append_child(element);
  node.append_child(pugi::node_pcdata).set_value(xml_text(text).c_str());
  return node;
}

std::string range(const FmuVariable& variable) {
  if (!std::isfinite(variable.lower) && !std::isfinite(variable.upper)) return "";
  return format_number(variable.lower) + " ... " + format_number(variable.upper);
}

void add_variables(const Fmu& fmu, Node body) {
  Node table = body.append_child("table");
  Node head = table.append_child("tr");
  for (const char* title : {"name", "unit", "start", "range", "meaning"}) add(head, "th", title);
  for (const FmuVariable& variable : fmu.variables) {
    const bool starts = variable.role == FmuRole::Input || variable.role == FmuRole::Parameter;
    Node row = table.append_child("tr");
    for (const std::string& cell :
         {variable.name, variable.unit, starts ? format_number(variable.start) : "",
          range(variable), variable.meaning})
      add(row, "td", cell);
  }
}

}  // namespace

std::string fmu_page(const Fmu& fmu) {
  pugi::xml_document document;
  document.append_child(pugi::node_doctype).set_value("html");
  Node html = document.append_child("html");
  html.append_attribute("lang") = "en";
  Node head = html.append_child("head");
  head.append_child("meta").append_attribute("charset") = "utf-8";
  add(head, "title", fmu.name);
  add(head, "style", kStyle);

  // Its title and source, its variables, how it steps, and the command that made it.
  Node body = html.append_child("body");
  add(body, "h1", fmu.name + ": " + fmu.title);
  add(body, "p", fmu.origin);
  if (!fmu.equation.empty()) add(body, "pre", fmu.equation);
  for (const std::string& remark : fmu.remarks)
    if (!remark.empty()) add(body, "p", remark);
  add(body, "h2", "Variables");
  add_variables(fmu, body);
  add(body, "h2", "Steps");
  for (const std::string& paragraph : fmu.steps) add(body, "p", paragraph);
  add(body, "h2", "Made by");
  add(body, "pre", fmu.tool + ":\n" + fmu.command);

  std::ostringstream out;
  document.save(out, " ", pugi::format_raw | pugi::format_no_declaration, pugi::encoding_utf8);
  return out.str();
}

std::string fmu_reference_run(const Fmu& fmu) {
  std::string rows = "time";
  for (std::size_t k = 1; k <= fmu.run[0].size(); ++k)
    rows += ',' + csv_field(fmu.variables[k].name);
  rows += '\n';
  for (std::size_t k = 0; k < fmu.run.size(); ++k) {
    rows += format_exact(static_cast<double>(k) * fmu.sample_time);
    for (const double value : fmu.run[k]) rows += ',' + format_exact(value);
    rows += '\n';
  }
  return rows;
}

}  // namespace dashpot
