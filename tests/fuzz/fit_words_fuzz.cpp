#include "dashpot/identify/fit/network_design.h"
#include "dashpot/identify/fit/parameter_choice.h"
#include "dashpot/identify/search/search_space.h"
#include "fuzz.h"

// Words of options of fits.

namespace {

void network_words(const std::string& input) {
  dashpot::NetworkDesign design, again;
  dashpot::parse_network_setting(input, "--network", design);
  const std::string text = dashpot::format_design(design);
  dashpot::parse_network_setting(text, "--network", again);
  require_true(design == again);
}

void search_words(const std::string& input) {
  const dashpot::SearchAxis axis = dashpot::parse_search_axis(input, "--search");
  const std::string text = dashpot::format_axis(axis);
  require_true(dashpot::format_axis(dashpot::parse_search_axis(text, "--search")) == text);
  const dashpot::SearchSpace space{{axis}, {}};
  dashpot::require_space(space, "mlp_one_sensor");
  require_true(!dashpot::grid_designs(space, 3).empty());
  require_true(dashpot::random_designs(space, 3, 1).size() <= 3);
}

/// One line each: a form, a fixed value, a freed one, bounds, a prior.
void parameter_words(const std::string& input) {
  static const dashpot::ModelNames models{"bouc_wen"};
  constexpr auto kNone = std::string::npos;
  std::vector<dashpot::ParameterChoice> choices;
  std::size_t begin = 0;
  for (const auto parse :
       {dashpot::parse_form_choice, dashpot::parse_fixed_choice, dashpot::parse_free_choice,
        dashpot::parse_bounds_choice, dashpot::parse_prior_choice}) {
    if (begin == kNone) break;
    const std::size_t end = input.find('\n', begin);
    const std::string word = input.substr(begin, end == kNone ? kNone : end - begin);
    if (!word.empty()) choices.push_back(parse(word, "--option", models));
    begin = end == kNone ? kNone : end + 1;
  }
  dashpot::require_choices(choices, models);
}

const FuzzTarget targets[] = {{"network_words", network_words},
                              {"search_words", search_words},
                              {"parameter_words", parameter_words}};

}  // namespace
