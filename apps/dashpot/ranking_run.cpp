#include "ranking_run.h"

#include "console.h"

namespace dashpot::cli {

Option leave_out_option(std::string& text) {
  return {.names = "--leave-out",
          .target = &text,
          .help =
              "what is left out to judge a model: condition, current, record, groups (of "
              "conditions or records), blocks (of time, one after the other), fraction (the end of "
              "every record), roles or each",
          .value = "WHAT",
          .default_text = "as the dataset file says, else as the records allow",
          .details =
              "; name which ones as current=0.5,1,varies (the records whose drive varies), "
              "groups=6, blocks=5 or fraction=0.3, or of which conditions as "
              "each=gap,pole_length. The records allow the first of condition, current and record "
              "of which there are several, groups=6 where these are more than six conditions or "
              "records, a single record blocks=5"};
}

std::optional<LeaveOut> stated_leave_out(const std::string& text) {
  if (text.empty()) return std::nullopt;
  try {
    return parse_leave_out(text);
  } catch (const Error& error) {
    throw UsageError("--leave-out", error.what());
  }
}

std::vector<Option> ranking_options(RankingSettings& settings) {
  std::vector<Option> options = data_options(settings.data);
  options.push_back(leave_out_option(settings.leave_out));
  append(options, fit_options(settings.fit));
  append(options, result_options(settings.results));
  return options;
}

Option fresh_option(RankingSettings& settings) {
  return {
      .names = "--fresh", .target = &settings.fresh, .help = "neither use nor keep finished fits"};
}

Option from_option(RankingSettings& settings) {
  return {.names = "--from",
          .target = &settings.fit.from,
          .help =
              "model files of laws whose numbers are the first start of these laws' fits, as "
              "of a damper of the same series; with --starts 1 the only one",
          .value = "MODEL",
          .takes = Takes::File,
          .default_text = "the size of the data alone"};
}

RankingData ranking_data(const RankingSettings& settings, Console& console) {
  const std::optional<LeaveOut> stated = stated_leave_out(settings.leave_out);
  Dataset dataset = load_recordings(settings.data, console);
  prepare_results(settings.results);
  const LeaveOut leave_out = stated ? *stated : default_leave_out(dataset);
  console.talk("judged by leaving out: " + format_leave_out(leave_out) + '\n');
  return {std::move(dataset), leave_out};
}

std::unique_ptr<FitStore> fit_store(const RankingSettings& settings, Console& console) {
  if (settings.fresh) return nullptr;
  return kept_fits(settings.results.folder, console);
}

}  // namespace dashpot::cli
