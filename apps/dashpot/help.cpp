#include "help.h"

#include <algorithm>
#include <cctype>

#include <fmt/core.h>

#include "console.h"
#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
#include "help_topics.h"
#include "layout.h"

namespace dashpot::cli {
namespace {

constexpr std::size_t kLabelColumns = 26;

/// A help that is longer than this, at so many columns, leaves what few need to topics.
constexpr std::size_t kMostLines = 59, kUsualColumns = 80;

/// How much is said of an option: in a long help only what most users need.
enum class Depth { Brief, Whole };

/// The default as help prints it; empty where there is none to print.
struct DefaultText {
  std::string operator()(const bool*) const { return {}; }
  std::string operator()(const int* target) const { return fmt::format("{}", *target); }
  std::string operator()(const std::uint64_t* target) const { return fmt::format("{}", *target); }
  std::string operator()(const double* target) const { return format_number(*target); }
  std::string operator()(const std::string* target) const { return *target; }
  std::string operator()(const std::vector<std::string>* target) const {
    return join(*target, ",");
  }
};

std::string default_of(const Option& option) {
  return option.default_text.empty() ? std::visit(DefaultText{}, option.target)
                                     : option.default_text;
}

/// "STUDY": what usage calls the subcommand of a group.
std::string group_word(const Command& command) {
  std::string word = command.name;
  std::ranges::transform(word, word.begin(), [](unsigned char c) { return std::toupper(c); });
  return word;
}

/// "--starts N", "-q, --quiet", "DATA...".
std::string option_label(const Option& option) {
  if (option.is_positional()) return option.names + (option.is_list() ? "..." : "");
  std::string label = join(split(option.names, ','), ", ");
  if (!option.value.empty()) label += ' ' + option.value;
  return label;
}

std::string usage(const Command& command) {
  std::string line = "dashpot " + command.name;
  for (const Option& option : command.options)
    if (option.is_positional())
      line += option.required ? fmt::format(" {}", option_label(option))
                              : fmt::format(" [{}]", option_label(option));
  if (!command.subcommands.empty()) line += " " + group_word(command);
  return line + " [options]";
}

std::string subcommand_list(const Command& command, const Console& console) {
  if (command.subcommands.empty()) return {};
  std::string text = "\n" + console.bold("Subcommands") + "\n";
  for (const Command& one : command.subcommands)
    text += fmt::format("  {:<{}}{}\n", one.last_word(), kLabelColumns - 2, one.title);
  return text;
}

/// The words that an option allows; of many, the first few where it is to be brief.
std::string choices_of(const Option& option, Depth depth) {
  constexpr std::size_t kFew = 12, kNamed = 3;
  if (option.choices.empty() || option.is_positional()) return {};
  if (depth == Depth::Whole || option.choices.size() <= kFew)
    return ": " + join(option.choices, ", ");
  const std::vector<std::string> first(option.choices.begin(), option.choices.begin() + kNamed);
  return fmt::format(": {} ... ({} in all)", join(first, ", "), option.choices.size());
}

std::string help_text(const Option& option, Depth depth) {
  std::string text = option.help + choices_of(option, depth);
  if (depth == Depth::Whole) text += option.details;
  const std::string fallback = default_of(option);
  return fallback.empty() ? text : text + " (default: " + fallback + ")";
}

std::string option_block(const Option& option, std::size_t width, Depth depth) {
  const std::string label = "  " + option_label(option);
  const std::vector<std::string> lines = wrap(help_text(option, depth), width - kLabelColumns);
  std::string block;
  const bool fits = columns_of(label) + 2 <= kLabelColumns;
  if (!fits) block = label + '\n';
  for (std::size_t i = 0; i < lines.size(); ++i)
    block += (i == 0 && fits ? label + std::string(kLabelColumns - columns_of(label), ' ')
                             : std::string(kLabelColumns, ' ')) +
             lines[i] + '\n';
  return block;
}

using Options = std::vector<const Option*>;

Options pointers_to(const std::vector<Option>& options) {
  Options pointers;
  for (const Option& option : options) pointers.push_back(&option);
  return pointers;
}

/// A heading and its options; nothing where there are none.
std::string section(const std::string& title, const Options& options, std::size_t width,
                    Depth depth, const Console& console) {
  std::string text;
  for (const Option* option : options) text += option_block(*option, width, depth);
  return text.empty() ? text : '\n' + console.bold(title) + '\n' + text;
}

std::string indented(const std::string& text) {
  std::string result;
  for (const std::string& line : split(text, '\n'))
    result += line.empty() ? "\n" : "  " + line + '\n';
  return result;
}

std::size_t count_lines(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

/// The steps of an example, from the first on, of which `most` lines have room.
std::string first_steps(const std::string& example, std::size_t most) {
  std::string shown;
  for (std::size_t begin = 0; begin < example.size();) {
    const std::size_t end = std::min(example.find("\n\n", begin), example.size());
    const std::string step = example.substr(begin, end - begin);
    const std::string more = shown.empty() ? step : shown + "\n\n" + step;
    if (!shown.empty() && count_lines(more) + 1 > most) break;
    shown = more;
    begin = end + 2;
  }
  return shown;
}

std::string example_section(const std::string& example, const Console& console) {
  return '\n' + console.bold("Example") + '\n' + indented(example);
}

/// What stands over the options: how the command is called, and what it does.
std::string head_of(const Command& command, std::size_t width, const Console& console) {
  return console.bold("Usage") + "\n  " + usage(command) + "\n\n" +
         paragraph(command.description, width) + subcommand_list(command, console);
}

/// The arguments and options that no topic has.
std::string own_sections(const Command& command, const std::vector<HelpTopic>& topics,
                         std::size_t width, Depth depth, const Console& console) {
  Options arguments, options;
  for (const Option& option : command.options) {
    const bool is_elsewhere = std::ranges::any_of(topics, [&](const HelpTopic& topic) {
      return std::ranges::find(topic.options, &option) != topic.options.end();
    });
    if (!is_elsewhere) (option.is_positional() ? arguments : options).push_back(&option);
  }
  return section("Arguments", arguments, width, depth, console) +
         section("Options", options, width, depth, console);
}

/// The names of the topics with those of their options, and how they are read.
std::string topic_list(const Command& command, const std::vector<HelpTopic>& topics,
                       std::size_t width, const Console& console) {
  constexpr std::size_t kNameColumns = 14;
  std::string text = '\n' + console.bold("More options") + '\n';
  for (const HelpTopic& topic : topics) {
    std::vector<std::string> names;
    for (const Option* option : topic.options) names.push_back(option->long_name());
    const std::vector<std::string> lines = wrap(join(names, ", "), width - kNameColumns);
    for (std::size_t i = 0; i < lines.size(); ++i)
      text += fmt::format("  {:<{}}{}\n", i == 0 ? topic.name : "", kNameColumns - 2, lines[i]);
  }
  const std::string help = "'dashpot help " + command.name + ' ';
  return text + paragraph(help + "TOPIC' explains one line of these, " + help +
                              "--OPTION' one option, " + help + "all' everything.",
                          width);
}

std::string whole_help(const Command& command, const std::vector<Option>& common, std::size_t width,
                       const Console& console) {
  return head_of(command, width, console) +
         own_sections(command, {}, width, Depth::Whole, console) +
         section("Common options", pointers_to(common), width, Depth::Whole, console) +
         example_section(command.example, console);
}

/// What most users need, with as much of the example as there is room for, one step at least.
std::string brief_help(const Command& command, const std::vector<Option>& common, std::size_t width,
                       const Console& console) {
  const std::vector<HelpTopic> topics = topics_of(command);
  const auto text_at = [&](std::size_t columns) {
    return head_of(command, columns, console) +
           own_sections(command, topics, columns, Depth::Brief, console) +
           topic_list(command, topics, columns, console) +
           section("Common options", pointers_to(common), columns, Depth::Brief, console);
  };
  const std::size_t used = count_lines(text_at(kUsualColumns)) + 2;  // with the example's heading
  const std::size_t room = used < kMostLines ? kMostLines - used : 1;
  return text_at(width) + example_section(first_steps(command.example, room), console);
}

std::string markdown_options(const std::vector<Option>& options) {
  std::string text = "| option | meaning |\n|---|---|\n";
  for (const Option& option : options)
    text += "| `" + option_label(option) + "` | " + markdown_cell(help_text(option, Depth::Whole)) +
            " |\n";
  return text;
}

std::string markdown_command(const Command& command, const std::string& mark) {
  std::string text = "\n" + mark + "dashpot " + command.name + "\n\n    " + usage(command) +
                     "\n\n" + command.description + "\n\n";
  if (!command.options.empty()) text += markdown_options(command.options) + '\n';
  return text + "```sh\n" + command.example + "\n```\n";
}

}  // namespace

std::string overview(const std::vector<Command>& commands, const Console& console) {
  const auto width = static_cast<std::size_t>(console.width());
  std::string text = console.bold("Dashpot") + " " DASHPOT_VERSION "\n" +
                     paragraph(
                         "Turns test-bench recordings of magnetorheological dampers into models "
                         "that can be trusted.",
                         width);

  // Three commands for someone who has never used the program.
  text += '\n' + console.bold("Start here") +
          "\n"
          "  dashpot demo                 a virtual damper, measured and identified\n"
          "  dashpot inspect recordings/  what Dashpot understands of your files\n"
          "  dashpot identify recordings/ models, ranked, and a report to read\n"
          "\n" +
          console.bold("Commands") + '\n';

  for (const Command& command : commands)
    text += fmt::format("  {:<14}{}\n", command.name, command.title);

  return text + '\n' +
         paragraph("Each one explains itself, with an example: 'dashpot COMMAND --help'.", width);
}

std::string command_help(const Command& command, const std::vector<Option>& common,
                         const Console& console) {
  const auto width = static_cast<std::size_t>(console.width());
  const bool is_short =
      count_lines(whole_help(command, common, kUsualColumns, console)) <= kMostLines;
  return is_short || topics_of(command).empty() ? whole_help(command, common, width, console)
                                                : brief_help(command, common, width, console);
}

std::string help_on(const std::string& word, const Command& command,
                    const std::vector<Option>& common, const Console& console) {
  const auto width = static_cast<std::size_t>(console.width());
  if (word == "all") return whole_help(command, common, width, console);

  // A topic, by its name.
  std::vector<std::string> known{"all"};
  for (const HelpTopic& topic : topics_of(command)) {
    if (word == topic.name)
      return section(std::string(topic.title), topic.options, width, Depth::Whole, console)
          .substr(1);
    known.emplace_back(topic.name);
  }

  // One option, by any of its names.
  for (const std::vector<Option>* options : {&command.options, &common})
    for (const Option& option : *options)
      for (const std::string& name : split(option.names, ','))
        if (word == name) return option_block(option, width, Depth::Whole);
  throw UsageError(command.name, "help has no topic '" + word + "'",
                   "known: " + join(known, ", ") + ", and the names of its options");
}

std::string help_markdown(const std::vector<Command>& commands, const std::vector<Option>& common) {
  std::string text =
      "# The command line\n\n"
      "Made by `dashpot --help-markdown`. On a terminal `dashpot help COMMAND` says what most "
      "users need, and `dashpot help COMMAND all` the same as this page.\n\n"
      "Exit codes: 0 done; 1 unusable input; 2 the command line cannot be understood; 3 it ran, "
      "but the result is not usable; 4 done, but without files of a folder that could not be "
      "read; 130 interrupted.\n";
  for (const Command& command : commands) {
    text += markdown_command(command, "## ");
    for (const Command& one : command.subcommands) text += markdown_command(one, "### ");
  }
  return text + "\n## Options of every command\n\n" + markdown_options(common);
}

}  // namespace dashpot::cli
