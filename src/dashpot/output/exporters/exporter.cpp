#include "dashpot/output/exporters/exporter.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dashpot/base/error.h"
#include "dashpot/base/text.h"
#include "dashpot/output/exporters/c_source.h"

namespace dashpot {
namespace {

constexpr std::array kExporters{
    Exporter{"c", "C99 for an ECU or a simulator", "every model",
             "NAME.h, NAME.c and NAME_test.c, a main that checks them along a run", write_c_source}};

bool is_c_name(const std::string& name) {
  const auto is_word = [](char c) {
    return c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  };
  return !name.empty() && !(name[0] >= '0' && name[0] <= '9') && std::ranges::all_of(name, is_word);
}

}  // namespace

std::span<const Exporter> exporters() { return kExporters; }

const Exporter& find_exporter(std::string_view name, const std::string& where) {
  std::vector<std::string> known;
  for (const Exporter& exporter : kExporters) {
    if (exporter.name == name) return exporter;
    known.emplace_back(exporter.name);
  }
  throw Error(where, "unknown format '" + std::string(name) + "'", suggest(name, known));
}

double export_sample_time(const ExportedModel& model, const ExportOptions& options) {
  constexpr double kUsual = 1e-3;
  for (const double time : {options.sample_time, model.model.feedback_step(), model.sample_time}) {
    if (time == 0) continue;
    if (!(time > 0 && std::isfinite(time)))
      throw Error("sample time", "is " + format_number(time) + " s", "a positive number");
    return time;
  }
  return kUsual;
}

std::string export_name(const ExportedModel& model, const ExportOptions& options) {
  std::string name = options.name.empty() ? model.model.name() + "_damper" : options.name;
  if (options.name.empty()) std::ranges::replace(name, '+', '_');
  if (!is_c_name(name))
    throw Error("name", "'" + name + "' cannot begin names in C", "letters, digits and _, no digit first");
  return name;
}

}  // namespace dashpot
