#include "arguments.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <CLI/CLI.hpp>

#include "dashpot/base/settings.h"
#include "dashpot/base/text.h"

namespace dashpot::cli {
namespace {

/// ", in s" where the option's word for its value is a unit, else empty.
std::string unit_words(const Option& option) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kUnits{{{"A", "A"},
                                                                                 {"A/S", "A/s"},
                                                                                 {"HZ", "Hz"},
                                                                                 {"M/S", "m/s"},
                                                                                 {"MM", "mm"},
                                                                                 {"MS", "ms"},
                                                                                 {"S", "s"}}};
  for (const auto& [word, unit] : kUnits)
    if (option.value == word) return ", in " + std::string(unit);
  return {};
}

double number_in(const std::string& text, const Option& option, bool whole) {
  const std::optional<double> value = parse_number(text);
  if (!value || !std::isfinite(*value) || (whole && *value != std::floor(*value)))
    throw UsageError(option.long_name(),
                     "'" + text + "' is not a " + (whole ? "whole number" : "number"),
                     (whole ? "write it as 4" : "write it as 0.25") + unit_words(option));
  if (option.minimum && *value < *option.minimum)
    throw UsageError(option.long_name(), text + " is too small",
                     "give at least " + format_number(*option.minimum));
  return *value;
}

/// A whole number that the type can hold.
template <class Integer>
Integer integer_in(const std::string& text, const Option& option) {
  const double value = number_in(text, option, true);
  const double largest =
      std::min(static_cast<double>(std::numeric_limits<Integer>::max()), 9007199254740992.0);
  if (value > largest || value < static_cast<double>(std::numeric_limits<Integer>::min()))
    throw UsageError(option.long_name(), text + " is too large",
                     "give at most " + format_exact(largest));
  return static_cast<Integer>(value);
}

/// What the word means, which is one of the option's choices where it has such.
std::string chosen_word(const std::string& word, const Option& option) {
  const auto is_among = [&](const std::vector<std::string>& words) {
    return std::ranges::find(words, word) != words.end();
  };
  if (option.meaning)
    if (std::string meant = option.meaning(word); meant != word) return meant;
  if (option.takes == Takes::File && is_path(word)) return word;
  if (option.takes_parts && word.find('=') != std::string::npos) {
    for (const std::string& part : split(word, ','))
      chosen_word(part.substr(part.find('=') + 1), option);
    return word;
  }
  if (option.choices.empty() || is_among(option.choices) || is_among(option.more_choices))
    return word;
  throw UsageError(option.is_positional() ? "" : option.long_name(),
                   "unknown " + option.noun + " '" + word + "'",
                   suggest(word, option.choices, option.more_choices));
}

/// Throws UsageError where a list gives one name two values, of which one would count for nothing.
void require_one_value_each(const std::vector<std::string>& words, const Option& option) {
  if (const auto twice = stated_twice(words))
    throw UsageError(option.long_name(), *twice + " is stated twice", "one value of each name");
}

/// Throws UsageError where an option with one value was given several, of which one would count.
void require_one_word(const std::vector<std::string>& words, const Option& option) {
  if (words.size() < 2 || option.is_list()) return;
  throw UsageError(option.long_name(), "is given " + std::to_string(words.size()) + " times",
                   "one value: " + join(words, " or "));
}

/// Writes the words given for one option to its variable.
struct StoreWords {
  const Option& option;
  const std::vector<std::string>& words;

  void operator()(bool*) const {}  // a switch has no words
  void operator()(int* target) const { *target = integer_in<int>(words.back(), option); }
  void operator()(std::uint64_t* target) const {
    *target = integer_in<std::uint64_t>(words.back(), option);
  }
  void operator()(double* target) const {
    const double value = number_in(words.back(), option, false);
    // Where a default is told in words, the variable's own number stands for it: said, it would be
    // taken for nothing said.
    if (!option.default_text.empty() && value == *target)
      throw UsageError(option.long_name(), words.back() + " is no value of it",
                       "another one, or leave it out: " + option.default_text);
    *target = value;
  }
  void operator()(std::string* target) const { *target = chosen_word(words.back(), option); }
  void operator()(std::vector<std::string>* target) const {
    target->clear();
    for (const std::string& word : words) {
      // Paths may hold commas; lists of names are separated by them.
      const std::vector<std::string> parts =
          option.is_positional() ? std::vector<std::string>{word} : split(word, ',');
      for (const std::string& part : parts)
        target->push_back(chosen_word(std::string(trim(part)), option));
    }
    if (!option.is_positional()) require_one_value_each(*target, option);
  }
};

void add(CLI::App& app, const Option& option) {
  if (option.is_switch()) {
    bool* target = std::get<bool*>(option.target);
    app.add_flag_callback(option.names, [target] { *target = !*target; });
    return;
  }
  CLI::Option* added = app.add_option(option.names, [&option](const CLI::results_t& words) {
    require_one_word(words, option);
    std::visit(StoreWords{option, words}, option.target);
    return true;
  });
  added->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  if (option.is_list() && option.is_positional())
    added->expected(1, CLI::detail::expected_max_vector_size)->allow_extra_args();
}

void refuse_leftovers(const std::string& command, const std::vector<Option>& options,
                      const std::vector<std::string>& leftovers) {
  if (leftovers.empty()) return;
  const std::string word = leftovers.front().substr(0, leftovers.front().find('='));
  if (word.front() != '-') {
    const bool takes_damper = std::ranges::any_of(options, [](const Option& option) {
      return option.names == "--damper" && option.choices.empty();
    });
    throw UsageError(command, "'" + word + "' is one argument too many",
                     takes_damper && word.ends_with(".json") ? "a model file as --damper " + word
                                                             : "give options as --name value");
  }
  std::vector<std::string> known = {"--help"};
  for (const Option& option : options)
    if (!option.is_positional()) known.push_back(option.long_name());
  const std::optional<std::string> near = closest(word, known);
  throw UsageError(command, "unknown option '" + word + "'",
                   near ? "did you mean '" + *near + "'?" : "");
}

}  // namespace

bool parse_arguments(const std::string& command, const std::vector<Option>& options,
                     const std::vector<std::string>& arguments) {
  CLI::App app;
  app.allow_extras();
  for (const Option& option : options) add(app, option);

  // The parser's own errors become ours, so that every message names option and remedy.
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::CallForHelp&) {
    return false;
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string text = error.what();  // "--starts: 1 required ..."
    throw UsageError(text.substr(0, text.find(':')), "needs a value");
  } catch (const CLI::ParseError& error) {
    throw UsageError(command, error.what());
  }

  // A misspelled option is a leftover of the parser; it is reported before one that is missing.
  refuse_leftovers(command, options, app.remaining());
  for (const Option& option : options)
    if (option.required && app.count(option.long_name()) == 0)
      throw UsageError(command, option.long_name() + " is missing", option.help);

  // Nor may one be without effect.
  for (const Option& option : options)
    if (!option.needs.empty() && app.count(option.long_name()) > 0 && app.count(option.needs) == 0)
      throw UsageError(option.long_name(), "has no effect without " + option.needs,
                       "give both, or leave it out");
  for (const Option& option : options) {
    if (option.idles.empty() || app.count(option.long_name()) == 0) continue;
    for (const IdleOptions& idle : option.idles)
      for (const std::string& name : idle.names)
        if (app.count(name) > 0)
          throw UsageError(name, "has no effect with " + option.long_name() + idle.why, idle.right);
  }
  return true;
}

}  // namespace dashpot::cli
