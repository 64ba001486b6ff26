#include <cmath>
#include <memory>

#include <fmt/core.h>

#include "console.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/law_list.h"
#include "studies.h"
#include "studies/recovery/recovery_study.h"

namespace dashpot::cli {
namespace {

constexpr std::string_view kStudyRecoveryExample =
    "# Every law, a hundred times each; the table goes into a file:\n"
    "dashpot study recovery > recovery.md\n"
    "\n"
    "# One law, quickly:\n"
    "dashpot study recovery --laws tanh_kwok --repetitions 20";

std::string percent(int part, int whole) {
  return whole == 0 ? "-" : fmt::format("{:.0f} %", 100.0 * part / whole);
}

/// Why repetitions were not counted.
std::string remark(const ParameterRecovery& p) {
  if (p.fixed) return "fixed";
  std::vector<std::string> parts;
  if (p.weak > 0) parts.push_back(fmt::format("not determined by the data: {}", p.weak));
  if (p.at_bound > 0) parts.push_back(fmt::format("at a bound: {}", p.at_bound));
  return join(parts, ", ");
}

std::string verdict(const LawRecovery& recovery) {
  if (!recovery.enough()) return "too few to tell";
  return recovery.trustworthy() ? "trustworthy" : "NOT TRUSTWORTHY";
}

std::string overview(const std::vector<LawRecovery>& recoveries) {
  std::string text =
      "| law | intervals | hold the truth | fits that failed | time per fit | verdict |\n"
      "|---|--:|--:|--:|--:|---|\n";
  for (const LawRecovery& r : recoveries)
    text += fmt::format("| {} | {} | {} | {} | {:.0f} ms | {} |\n", r.law, r.counted(),
                        r.counted() == 0 ? "-" : fmt::format("{:.1f} %", 100 * r.share()), r.failed,
                        1000 * r.seconds, verdict(r));
  return text;
}

std::string details(const std::vector<LawRecovery>& recoveries) {
  std::string text =
      "| law | parameter | unit | true | counted | hold the truth | bias | spread | not counted |\n"
      "|---|---|---|--:|--:|--:|--:|--:|---|\n";
  for (const LawRecovery& r : recoveries)
    for (const ParameterRecovery& p : r.parameters)
      text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", r.law, p.name, p.unit,
                          format_number(p.truth), p.counted, percent(p.inside, p.counted),
                          p.counted < 2 ? "-" : fmt::format("{:+.2f}", p.bias),
                          p.counted < 2 ? "-" : fmt::format("{:.2f}", p.spread), remark(p));
  return text;
}

Value to_json(const LawRecovery& recovery) {
  Value parameters = Value::array();
  for (const ParameterRecovery& p : recovery.parameters)
    parameters.push_back(Value::object({{"name", p.name},
                                        {"unit", p.unit},
                                        {"truth", p.truth},
                                        {"counted", p.counted},
                                        {"inside", p.inside},
                                        {"weak", p.weak},
                                        {"at_bound", p.at_bound},
                                        {"fixed", p.fixed},
                                        {"bias", p.bias},
                                        {"spread", p.spread}}));

  return Value::object({{"law", recovery.law},
                        {"counted", recovery.counted()},
                        {"inside", recovery.inside()},
                        {"failed", recovery.failed},
                        {"seconds_per_fit", recovery.seconds},
                        {"enough", recovery.enough()},
                        {"trustworthy", recovery.trustworthy()},
                        {"parameters", std::move(parameters)}});
}

int run_study_recovery(RecoveryStudyOptions options, Console& console) {
  if (options.force_noise == 0 && !options.noisy_motion)
    throw UsageError("--noise", "is 0, and the motion exact: there is no error to state",
                     "more than 0, or --noisy-motion");
  options.monitor = console.monitor();
  const std::vector<LawRecovery> recoveries = study_recovery(options);

  // The page states its protocol, so that the table can be read without this program.
  console.print(
      fmt::format("# Parameter recovery\n\n"
                  "A damper with known parameters, for each law, on the virtual bench; the law is "
                  "fitted to its records {} times, each with other noise (force noise {} % of the "
                  "span, {} motion, seed {}). How often do the 95 % intervals hold the truth? "
                  "Between 90 and 99 % counts as trustworthy. Made by `{}`.\n\n",
                  options.repetitions, format_number(100 * options.force_noise),
                  options.noisy_motion ? "noisy" : "exact", options.seed, console.command_line()) +
      overview(recoveries) +
      "\nBias and spread of what was found are counted in standard errors as the fits state them: "
      "0 and 1 are right.\n\n" +
      details(recoveries));

  Value list = Value::array();
  for (const LawRecovery& recovery : recoveries) list.push_back(to_json(recovery));
  if (console.json) console.print_json(Value::object({{"laws", std::move(list)}}));

  // A law whose intervals are too narrow or too wide fails the study, and so does one of which
  // nothing is known.
  std::vector<std::string> missed, few;
  for (const LawRecovery& recovery : recoveries)
    if (!recovery.enough())
      few.push_back(recovery.law);
    else if (!recovery.trustworthy())
      missed.push_back(recovery.law);
  if (!missed.empty())
    console.error("fewer than 90 % or more than 99 % of the intervals hold the truth: " +
                  join(missed, ", "));
  if (!few.empty())
    console.error("too few intervals to tell: " + join(few, ", ") + "; more --repetitions");
  return missed.empty() && few.empty() ? kDone : kNotUsable;
}

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (const Law* law : laws()) names.emplace_back(law->name);
  return names;
}

}  // namespace

Command recovery_study() {
  auto settings = std::make_shared<RecoveryStudyOptions>();
  RecoveryStudyOptions& options = *settings;
  return {
      .name = "study recovery",
      .title = "Do the 95 % intervals of Dashpot's fits hold the truth?",
      .description =
          "Records dampers with known parameters on the virtual bench, fits each law to its own "
          "records many times with other noise, and counts how often the 95 % intervals hold the "
          "truth. What a fit itself calls unknown (weak, at a bound, fixed) is listed and not "
          "counted. The table is Markdown.",

      .options =
          {{.names = "--laws",
            .target = &options.laws,
            .help = "the laws to study, separated by commas",
            .value = "NAMES",
            .choices = law_names(),
            .noun = "law",
            .default_text = "all"},
           {.names = "--repetitions",
            .target = &options.repetitions,
            .help = "records and fits of each law",
            .value = "N",
            .minimum = 1},

           // The flaws of the virtual sensors.
           {.names = "--noise",
            .target = &options.force_noise,
            .help = "standard deviation of the force noise, as a share of each record's force span",
            .value = "SHARE",
            .minimum = 0},
           {.names = "--noisy-motion",
            .target = &options.noisy_motion,
            .help = "derive the velocity from a noisy displacement, as on a real bench: the "
                    "intervals know of noise in the force alone"},

           seed_option(options.seed),
           threads_option(options.threads)},
      .example = std::string(kStudyRecoveryExample),
      .run = [settings](Console& console) { return run_study_recovery(*settings, console); }};
}

}  // namespace dashpot::cli
