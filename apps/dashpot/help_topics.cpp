#include "help_topics.h"

#include <algorithm>

namespace dashpot::cli {
namespace {

/// One row: the options that make up a topic, in every command or in those named.
struct TopicRow {
  std::string_view name, title;
  std::vector<std::string_view> commands;  ///< empty: every command
  std::vector<std::string_view> options;   ///< long names
};

/// An option that stands in no row is for everybody. The first row that fits a command takes it.
const std::vector<TopicRow>& topic_rows() {
  static const std::vector<TopicRow> rows{
      // What a word means in certain commands only.
      {"ride",
       "The models in a vehicle",
       {"identify", "rank"},
       {"--plant", "--set", "--controller", "--inverse", "--force-loop", "--current",
        "--current-max", "--lag-rate", "--sample-time", "--in-car", "--delay", "--road",
        "--duration", "--draws"}},
      {"controller",
       "A vehicle's controller, or an inverse",
       {"export"},
       {"--plant", "--set", "--damper", "--controller", "--inverse", "--force-loop",
        "--current-max", "--lag-rate", "--in-car"}},
      {"code",
       "The code that is written",
       {"export"},
       {"--precision", "--sample-time", "--tunable", "--compiler", "--sources-only",
        "--platforms"}},
      {"tables", "The grid of tables", {"export"}, {"--velocities", "--currents"}},
      {"current",
       "The current, its controller's sensors and the coil",
       {"simulate", "ride"},
       {"--inverse", "--force-loop", "--current", "--current-max", "--lag-rate", "--sample-time",
        "--in-car", "--delay"}},
      {"motion",
       "The motion and the wanted force",
       {"track", "invert"},
       {"--wanted", "--force", "--band", "--motion", "--amplitude", "--frequency", "--duration",
        "--sample-rate"}},
      {"sines",
       "The sines, the chirp and the step",
       {"ride"},
       {"--frequencies", "--amplitude", "--settling", "--chirp", "--step", "--held"}},
      {"family",
       "A family of drawings",
       {"bench"},
       {"--family", "--fluid", "--builds", "--asymmetry", "--give"}},
      {"line", "A production line", {"bench"}, {"--dampers", "--faults", "--trend", "--scatter"}},
      {"plant",
       "The damper in a plant",
       {"bench", "export"},
       {"--in", "--true", "--road", "--push", "--duration", "--hold", "--grade", "--force-error",
        "--velocity-shift", "--wear"}},
      {"sensors",
       "The sensors of the bench",
       {"bench"},
       {"--velocity-sensor", "--noise", "--zero-drift"}},

      // What it means wherever it stands.
      {"data",
       "How recordings are read",
       {},
       {"--no-recognise", "--velocity-cutoff", "--keep-inertia", "--verbose", "--units"}},
      {"laws",
       "The parameters of laws",
       {},
       {"--force-offset", "--form", "--fix", "--free", "--bounds", "--prior", "--allow-active",
        "--asymmetric", "--from"}},
      {"networks", "How networks are built and trained", {}, {"--network"}},
      {"current",
       "The coil and its driver",
       {},
       {"--current-max", "--lag-rate", "--rate-limit", "--period"}},
      {"numerics",
       "The accuracy of the integration",
       {},
       {"--outside", "--tolerance", "--max-step"}},
      {"effort",
       "Effort, threads and random numbers",
       {},
       {"--budget", "--starts", "--search", "--generations", "--method", "--trials", "--steps",
        "--effort", "--seed", "--threads"}},
      {"files",
       "More files of results",
       {},
       {"--figures", "--pdf", "--no-report", "--traces", "--covariance", "--mat", "--samples",
        "--markdown"}},
      {"machines", "Many machines", {}, {"--part", "--simd"}},
      {"plant", "The damper in a plant", {"identify"}, {"--grade", "--profile"}}};
  return rows;
}

template <class Words>
bool holds(const Words& words, const std::string& word) {
  return std::ranges::find(words, word) != words.end();
}

}  // namespace

std::vector<HelpTopic> topics_of(const Command& command) {
  std::vector<HelpTopic> topics;
  std::vector<const Option*> taken;

  for (const TopicRow& row : topic_rows()) {
    if (!row.commands.empty() && !holds(row.commands, command.name)) continue;
    HelpTopic topic{row.name, row.title, {}};
    for (const Option& option : command.options)
      if (holds(row.options, option.long_name()) &&
          std::ranges::find(taken, &option) == taken.end())
        topic.options.push_back(&option);

    taken.insert(taken.end(), topic.options.begin(), topic.options.end());
    if (!topic.options.empty()) topics.push_back(std::move(topic));
  }
  return topics;
}

}  // namespace dashpot::cli
