#include "dashpot/base/units.h"
#include "dashpot/identify/fit/network_design.h"
#include "dashpot/identify/fit/parameter_choice.h"
#include "dashpot/identify/search/search_space.h"
#include "dashpot/record/channel_names.h"
#include "dashpot/record/excitation.h"
#include "dashpot/value.h"
#include "fuzz.h"

// Words of options, units and names of columns; JSON and YAML below all files.

namespace {

void units(const std::string& input) {
  if (const auto unit = dashpot::parse_unit(input))
    require_true(unit->factor > 0 && std::isfinite(unit->factor) && std::isfinite(unit->offset));
  dashpot::recognise_channel(input, "");
}

void quantity(const std::string& input) {
  require_true(std::isfinite(dashpot::parse_quantity(input, "m/s", "fuzz")));
}

/// What was read is written, and reads back as the same text.
void json(const std::string& input) {
  const std::string text = dashpot::format_json(dashpot::parse_json(input, "fuzz.json"));
  require_true(dashpot::format_json(dashpot::parse_json(text, "again")) == text);
}

void yaml(const std::string& input) { dashpot::parse_yaml(input, "fuzz.yaml"); }

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

void motion_words(const std::string& input) {
  const dashpot::PistonMotion motion = dashpot::make_motion(input, 1);
  for (const double t : {0.0, 0.1, motion.duration})
    require_true(std::isfinite(motion.at(t).displacement) && std::isfinite(motion.at(t).velocity));
}

void drive_words(const std::string& input) {
  const dashpot::DriveSignal drive = dashpot::make_drive(input, {0, 2.5, 10, 1});
  for (const double t : {0.0, 0.1, 10.0}) require_true(std::isfinite(drive.at(t)));
}

const FuzzTarget targets[] = {{"units", units},
                              {"quantity", quantity},
                              {"json", json},
                              {"yaml", yaml},
                              {"network_words", network_words},
                              {"search_words", search_words},
                              {"parameter_words", parameter_words},
                              {"motion_words", motion_words},
                              {"drive_words", drive_words}};

}  // namespace
