#include "help.h"

#include <algorithm>
#include <cctype>

#include <fmt/core.h>

#include "console.h"
#include "dashpot/base/escape.h"
#include "dashpot/base/text.h"
#include "layout.h"

namespace dashpot::cli {
namespace {

constexpr std::size_t kLabelColumns = 26;

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

std::string option_block(const Option& option, std::size_t width) {
  const std::string label = "  " + option_label(option);
  const std::vector<std::string> lines = wrap(option_text(option), width - kLabelColumns);
  std::string block;
  const bool fits = columns_of(label) + 2 <= kLabelColumns;
  if (!fits) block = label + '\n';
  for (std::size_t i = 0; i < lines.size(); ++i)
    block += (i == 0 && fits ? label + std::string(kLabelColumns - columns_of(label), ' ')
                             : std::string(kLabelColumns, ' ')) +
             lines[i] + '\n';
  return block;
}

std::string section(const std::string& title, const std::vector<Option>& options, bool positional,
                    const Console& console) {
  std::string text;
  for (const Option& option : options)
    if (option.is_positional() == positional)
      text += option_block(option, static_cast<std::size_t>(console.width()));
  return text.empty() ? text : '\n' + console.bold(title) + '\n' + text;
}

std::string indented(const std::string& text) {
  std::string result;
  for (const std::string& line : split(text, '\n'))
    result += line.empty() ? "\n" : "  " + line + '\n';
  return result;
}

std::string markdown_options(const std::vector<Option>& options) {
  std::string text = "| option | meaning |\n|---|---|\n";
  for (const Option& option : options)
    text += "| `" + option_label(option) + "` | " + markdown_cell(option_text(option)) + " |\n";
  return text;
}

std::string markdown_command(const Command& command, const std::string& mark) {
  std::string text = "\n" + mark + "dashpot " + command.name + "\n\n    " + usage(command) +
                     "\n\n" + command.description + "\n\n";
  if (!command.options.empty()) text += markdown_options(command.options) + '\n';
  return text + "```sh\n" + command.example + "\n```\n";
}

}  // namespace

std::string option_label(const Option& option) {
  if (option.is_positional()) return option.names + (option.is_list() ? "..." : "");
  std::string label = join(split(option.names, ','), ", ");
  if (!option.value.empty()) label += ' ' + option.value;
  return label;
}

std::string option_text(const Option& option) {
  std::string text = option.help;
  if (!option.choices.empty() && !option.is_positional()) text += ": " + join(option.choices, ", ");
  const std::string fallback = default_of(option);
  return fallback.empty() ? text : text + " (default: " + fallback + ")";
}

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
  return console.bold("Usage") + "\n  " + usage(command) + "\n\n" +
         paragraph(command.description, width) + subcommand_list(command, console) +
         section("Arguments", command.options, true, console) +
         section("Options", command.options, false, console) +
         section("Common options", common, false, console) + '\n' + console.bold("Example") + '\n' +
         indented(command.example);
}

std::string help_markdown(const std::vector<Command>& commands, const std::vector<Option>& common) {
  std::string text =
      "# The command line\n\n"
      "Made by `dashpot --help-markdown`; `dashpot COMMAND --help` says the same on a terminal.\n\n"
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
