#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "dashpot/base/text.h"
#include "dashpot/damper/kinds/family/family_model.h"
#include "dashpot/error.h"
#include "dashpot/export.h"
#include "dashpot/model_file.h"

namespace dashpot {
namespace {

bool is_c_name(const std::string& name) {
  const auto is_word = [](char c) {
    return c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
  };
  return !name.empty() && !(name[0] >= '0' && name[0] <= '9') && std::ranges::all_of(name, is_word);
}

}  // namespace

ExportedModel exported_model(const ModelFile& file) {
  const Provenance& from = file.provenance;
  ExportedModel exported{.model = *file.model,
                         .drive_unit = file.drive_unit,
                         .domain = file.domain,
                         .sample_time = file.sample_time,
                         .origin = from.created.empty()
                                       ? from.dataset + ": " + from.citation
                                       : "Identified from " + from.dataset + ", " + from.created,
                         .interval = file.interval};
  if (const std::string active = activity(dissipation_of(file), file.drive_unit); !active.empty())
    exported.origin += ". WARNING: " + active;
  if (const auto* family = model_as<FamilyModel>(*file.model))
    exported.origin += ". Of its family it is the damper of " + describe(family->member());
  Domain& domain = exported.domain;
  if (!(domain.velocity_min < domain.velocity_max))
    domain = usual_domain(domain.current_min, domain.current_max);
  return exported;
}

std::string usual_compiler() {
  const char* usual = std::getenv("CC");
  return usual && *usual != '\0' ? usual : "cc";
}

void require_export_sample_time(double seconds, const std::string& where) {
  constexpr double kShortest = 1e-6, kLongest = 0.1;
  if (!(seconds >= kShortest && seconds <= kLongest))
    throw Error(where, "a sample time of " + format_number(seconds) + " s",
                "between 1 us and 0.1 s, as 5ms");
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

std::string c_name(const std::string& name) {
  constexpr std::size_t kLongest = 100;  // files have it with an ending, and most systems take 255
  if (!is_c_name(name))
    throw Error("name", "'" + name + "' cannot begin names in C",
                "letters, digits and _, no digit first");
  if (name.size() > kLongest)
    throw Error("name", "has " + std::to_string(name.size()) + " letters",
                "at most " + std::to_string(kLongest));
  return name;
}

std::string export_name(const ExportedModel& model, const ExportOptions& options) {
  std::string name = options.name.empty() ? model.model.name() + "_damper" : options.name;
  if (options.name.empty()) std::ranges::replace(name, '+', '_');
  return c_name(name);
}

}  // namespace dashpot
