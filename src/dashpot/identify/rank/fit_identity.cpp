#include "dashpot/identify/rank/fit_identity.h"

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/dependence.h"
#include "dashpot/identify/fit/network_design.h"

namespace dashpot {
namespace {

std::string_view bytes_of(const std::vector<double>& samples) {
  return {reinterpret_cast<const char*>(samples.data()), samples.size() * sizeof(double)};
}

std::string text_of(const std::vector<std::shared_ptr<const DamperModel>>& models) {
  std::string text;
  for (const auto& model : models) text += format_json(model->to_json(), false) + ';';
  return text;
}

std::string text_of(const std::vector<ParameterChoice>& choices) {
  std::string text;
  for (const auto& [law, parameter, form, fixed, free, bounds, prior] : choices) {
    text += law + '.' + parameter + (free ? " free" : "");
    if (form) text.append(" ").append(name_of(*form));
    if (fixed) text += " = " + format_exact(*fixed);
    if (bounds) text += " in " + format_exact(bounds->lower) + ':' + format_exact(bounds->upper);
    if (prior)
      text += " about " + format_exact(prior->value) + "+-" + format_exact(prior->deviation);
    text += ';';
  }
  return text;
}

}  // namespace

std::string fingerprint(const std::vector<Record>& records) {
  std::string text;
  for (const Record& record : records) {
    text += record.name + '\n' + record.condition + '\n' + std::to_string(record.warm_up) + '\n' +
            sha256(bytes_of(record.time));
    if (record.drive_level) text += format_exact(*record.drive_level);
    for (const auto& [name, value] : record.conditions)
      text += '\n' + name + '=' + format_exact(value);
    for (const Channel& channel : record.channels)
      text += '\n' + channel.name + ' ' + channel.unit + ' ' + sha256(bytes_of(channel.samples));
    text += "\n\n";
  }
  return sha256(text);
}

NamedTexts describe_options(const IdentifyOptions& identify_options) {
  // All members by name, so that a new option does not compile until it is dealt with here. Threads
  // and who follows it do not change a fit.
  const auto& [offset, choices, allow_active, asymmetric, network, starts, search, from, seed,
               threads, monitor, on_parameters] = identify_options;
  (void)threads, (void)monitor, (void)on_parameters;
  NamedTexts texts{
      {"force offset", offset == OffsetMode::Record ? "an offset per record" : "no offsets"},
      {"parameter choices", text_of(choices)},
      {"models that feed energy in", allow_active ? "kept" : "refitted"},
      {"rebound and compression", asymmetric ? "apart where it pays" : "alike"},
      {"network", format_design(network)},
      {"starts", std::to_string(starts)},
      {"global search", std::to_string(search)},
      {"seed", std::to_string(seed)}};
  if (!from.empty()) texts.emplace_back("first start", text_of(from));
  return texts;
}

}  // namespace dashpot
