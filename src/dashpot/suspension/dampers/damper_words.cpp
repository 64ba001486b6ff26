#include "dashpot/suspension/dampers/damper_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "dashpot/base/file.h"
#include "dashpot/base/file_kind.h"
#include "dashpot/base/settings.h"
#include "dashpot/base/text.h"
#include "dashpot/base/units.h"
#include "dashpot/damper/inverse/observer.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/error.h"
#include "dashpot/model_file.h"
#include "dashpot/suspension/dampers/passive_curve.h"
#include "dashpot/suspension/dampers/soft_friction.h"

namespace dashpot {
namespace {

enum Mounting { kMotionRatio, kForceFactor };
constexpr std::array kMounting{
    ParameterRow{"motion_ratio", "1", 1, 0.01, 100, "damper's travel over the strut's"},
    ParameterRow{"force_factor", "1", 1, 0.01, 100,
                 "this piece's force over its model's, as built"}};

const std::array kSimple{SimpleDamper{"ideal",
                                      "any damping within limits, at once but for a lag",
                                      {{"damping_min", "N*s/m", 300, 0, 1e7, "least"},
                                       {"damping_max", "N*s/m", 3900, 0, 1e7, "greatest"},
                                       {"lag_rate", "1/s", 2 * std::numbers::pi * 50, 0, 1e6,
                                        "of the damping; 0: none"}}},
                         SimpleDamper{"viscous",
                                      "passive, linear in the velocity",
                                      {{"damping", "N*s/m", 1500, 0, 1e7, "of the damper"}}}};

/// F = (soft + (hard - soft) drive) v.
std::shared_ptr<const DamperModel> linear_damper(double soft, double hard) {
  const Law& law = find_law("bingham");
  Dependence parameters;
  for (const ParamInfo& param : law.params) {
    const bool damping = param.name == "c0";
    parameters.forms.push_back(damping ? Form::Linear : Form::Constant);
    parameters.coefficients.push_back(damping ? std::vector{soft, hard - soft} : std::vector{0.0});
  }
  return std::make_shared<LawModel>(law, parameters, DriveUnit::Ampere, 0);
}

std::string damping_text(double value) { return format_number(value) + " N*s/m"; }

using Words = std::span<const std::string>;

ChosenDamper make_simple(const SimpleDamper& kind, Words settings, const std::string& where) {
  const std::vector<double> p = parse_values(kind.parameters, settings, kind.name, where);
  ChosenDamper damper{.drive_unit = DriveUnit::None};

  if (kind.name == "viscous") {
    damper.name = "viscous, " + damping_text(p[0]);
    damper.model = linear_damper(p[0], p[0]);
    damper.damping = {p[0], p[0], p[0]};
    return damper;
  }

  if (!(p[0] < p[1]))
    throw Error(where, "damping from " + damping_text(p[0]) + " to " + damping_text(p[1]),
                "damping_min below damping_max");
  damper.name = "ideal, " + format_number(p[0]) + " to " + damping_text(p[1]);
  damper.model = linear_damper(p[0], p[1]);
  damper.drive_max = 1;
  damper.lag_rate = p[2];
  damper.damping = {p[0], p[0], p[1]};
  return damper;
}

std::string friction_note(const DamperModel& model) {
  return "the friction of " + model.name() + " sets in over " +
         format_number(1000 * kFrictionSpeed) + " mm/s here, not at once";
}

/// With a law's own speed over which friction sets in, where it has such a one and states none.
std::shared_ptr<const DamperModel> without_jump(const LawModel& model,
                                                std::vector<std::string>& notes) {
  const auto& params = model.law().params;
  const auto row = std::ranges::find(params, "v_s", &ParamInfo::name);
  const auto k = static_cast<std::size_t>(row - params.begin());
  Dependence parameters = model.parameters();
  if (row == params.end() || parameters.coefficients[k] != std::vector{0.0}) return nullptr;
  parameters.coefficients[k] = {kFrictionSpeed};
  notes.push_back(friction_note(model));
  return std::make_shared<LawModel>(model.law(), parameters, model.drive_unit(), model.lag_rate());
}

/// The law with these of its parameters constant.
LawModel with_settings(const LawModel& model, Words settings, const std::string& where) {
  const Law& law = model.law();
  Dependence parameters = model.parameters();
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    const std::string name(trim(setting.substr(0, equals)));

    std::vector<std::string> known;
    for (const ParamInfo& param : law.params) known.emplace_back(param.name);
    const auto found = std::ranges::find(known, name);
    if (found == known.end() || equals == std::string::npos)
      throw Error(where, std::string(law.name) + " has no parameter '" + name + "'",
                  suggest(name, known));
    const auto k = static_cast<std::size_t>(found - known.begin());

    parameters.forms[k] = Form::Constant;
    parameters.coefficients[k] = {
        parse_quantity(setting.substr(equals + 1), law.params[k].unit, where + ", " + name)};
  }

  // Values that no longer suit each other are refused here.
  LawModel changed(law, parameters, model.drive_unit(), model.lag_rate());
  require_bounds(changed, 0, where);
  return changed;
}

/// Puts the model there, and the lag of its coil beside it.
void take_model(ChosenDamper& damper, const DamperModel& model) {
  BareDamper bare = without_coil_lag(model);
  damper.lag_rate = bare.lag_rate;
  if (const auto* law = model_as<LawModel>(*bare.model))
    damper.model = without_jump(*law, damper.notes);
  if (!damper.model) damper.model = std::move(bare.model);
}

/// Says where the damper feeds energy into what moves it. The verdict is that of its file or set:
/// another offset changes nothing of it, other parameters make a damper that nobody has judged.
void warn_of_activity(ChosenDamper& damper, const Dissipation& result, Words settings) {
  const auto is_offset = [](const std::string& setting) { return setting.starts_with("f0="); };
  if (!std::ranges::all_of(settings, is_offset)) {
    damper.notes.push_back(damper.name +
                           ": whether it takes energy out of all motions was not judged with "
                           "these parameters");
    return;
  }
  if (const std::string active = activity(result, damper.drive_unit); !active.empty())
    damper.warnings.push_back(damper.name + ": " + active + "; what swings with it may never rest");
}

/// Where the model's data were, and what drove them.
void take_data(ChosenDamper& damper, const ModelFile& file) {
  damper.drive_unit = file.drive_unit;
  damper.drive_min = std::max(0.0, file.domain.current_min);
  damper.drive_max = std::max(damper.drive_min, file.domain.current_max);
  damper.domain = file.domain;
}

void require_nothing(Words settings, const std::string& name, const std::string& where) {
  if (!settings.empty())
    throw Error(where, "'" + settings.front() + "' says nothing to " + name,
                "motion_ratio=... or force_factor=...");
}

/// A file of YAML is a law, a drawing or another of Dashpot's, none of which is yet a damper.
void refuse_unmountable(const std::filesystem::path& path, const std::string& extension) {
  if (extension != ".yaml" && extension != ".yml") return;
  const std::string kind = file_kind(parse_yaml(read_file(path), path.string()));
  if (!kind.empty())
    throw Error(path.string(), "is " + kind + ", not the model of a damper",
                "a model file, as 'dashpot identify' and 'dashpot design' write them");
}

/// A curve, or a model file; a law's parameters may be set as those of a published damper are.
ChosenDamper from_file(const std::filesystem::path& path, Words settings,
                       const std::string& where) {
  ChosenDamper damper{.name = path.filename().string()};
  const std::string extension = lower(path.extension().string());
  if (extension != ".json") {
    require_nothing(settings, path.string(), where);
    refuse_unmountable(path, extension);
    const PassiveCurve curve = load_passive_curve(path.string());
    damper.model = std::make_shared<PassiveCurve>(curve);
    return damper;
  }

  const ModelFile file = load_model(path);
  take_data(damper, file);
  if (const auto* law = model_as<LawModel>(*file.model); law && !settings.empty()) {
    take_model(damper, with_settings(*law, settings, where));
    for (const std::string& setting : settings) damper.name += ", " + setting;
  } else {
    require_nothing(settings, path.string(), where);
    take_model(damper, *file.model);
  }
  warn_of_activity(damper, dissipation_of(file), settings);
  return damper;
}

ChosenDamper from_set(const std::string& name, Words settings, const std::string& where) {
  const ParameterSet set = load_parameter_set(name);
  ChosenDamper damper{.name = name};
  take_model(damper, with_settings(set.model, settings, where));
  for (const std::string& setting : settings) damper.name += ", " + setting;
  damper.drive_unit = set.model.drive_unit();
  damper.drive_min = set.drive_min;
  damper.drive_max = set.drive_max;
  if (!set.verified)
    damper.notes.push_back("the numbers of " + name + " are an example: " + set.reason);
  warn_of_activity(damper, set.dissipation, settings);
  return damper;
}

ChosenDamper by_name(const std::string& name, Words settings, const std::string& where) {
  const auto simple = std::ranges::find(kSimple, name, &SimpleDamper::name);
  if (simple != kSimple.end()) return make_simple(*simple, settings, where);
  std::vector<std::string> known = parameter_set_names();
  if (std::ranges::find(known, name) != known.end()) return from_set(name, settings, where);
  const std::vector<std::string> curves = passive_curve_names();
  if (std::ranges::find(curves, name) != curves.end()) {
    require_nothing(settings, name, where);
    return {.name = name, .model = std::make_shared<PassiveCurve>(load_passive_curve(name))};
  }
  for (const SimpleDamper& kind : kSimple) known.emplace_back(kind.name);
  known.insert(known.end(), curves.begin(), curves.end());
  throw Error(where, "unknown damper '" + name + "'", suggest(name, known) + "; or a file");
}

/// Takes the settings of kMounting out; their values in its order.
std::array<double, kMounting.size()> take_mounting(std::vector<std::string>& parts,
                                                   const std::string& where) {
  std::array<double, kMounting.size()> values;
  for (std::size_t k = 0; k < values.size(); ++k) {
    values[k] = kMounting[k].value;
    std::erase_if(parts, [&](const std::string& part) {
      const std::size_t equals = part.find('=');
      if (equals == std::string::npos || trim(part.substr(0, equals)) != kMounting[k].name)
        return false;
      values[k] = parse_value(kMounting[k], part.substr(equals + 1), where);
      return true;
    });
  }
  return values;
}

/// Integrators need forces without jumps.
void take_jumps_off(ChosenDamper& damper) {
  if (jumps_at_rest(*damper.model, damper.drive_min, damper.drive_max)) {
    damper.notes.push_back(friction_note(*damper.model));
    damper.model = with_soft_friction(damper.model);
  }
  if (jumps_in_middle(*damper.model, damper.drive_min, damper.drive_max)) {
    damper.notes.push_back("the force of " + damper.model->name() +
                           " jumps in the middle of the stroke; it changes over " +
                           format_number(1000 * kSideWay) + " mm to both sides here");
    damper.model = with_soft_sides(damper.model);
  }
}

}  // namespace

std::span<const SimpleDamper> simple_dampers() { return kSimple; }
std::span<const ParameterRow> mounting_settings() { return kMounting; }

ChosenDamper choose_damper(const std::string& text, const std::string& where) {
  std::vector<std::string> parts = split_words(text, where);
  const auto mounting = take_mounting(parts, where);
  if (parts.empty()) throw Error(where, "'" + text + "' names no damper");

  // A file, or a name with settings.
  const std::string name = parts.front();
  const Words settings = Words(parts).subspan(1);
  const bool is_file = name.find_first_of("./") != std::string::npos;
  ChosenDamper damper = is_file ? from_file(name, settings, where) : by_name(name, settings, where);

  take_jumps_off(damper);

  // How it is mounted.
  damper.motion_ratio = mounting[kMotionRatio];
  damper.force_factor = mounting[kForceFactor];
  if (damper.motion_ratio != 1)
    damper.name += ", motion ratio " + format_number(damper.motion_ratio);
  if (damper.force_factor != 1)
    damper.name += ", force factor " + format_number(damper.force_factor);
  return damper;
}

ChosenDamper choose_damper(const ModelFile& file) {
  ChosenDamper damper{.name = file.model->name()};
  take_data(damper, file);
  take_model(damper, *file.model);
  warn_of_activity(damper, dissipation_of(file), {});
  take_jumps_off(damper);
  return damper;
}

double force_at_rest(const DamperModel& model, double drive) {
  std::vector<double> state(model.state_size());
  const DamperInput at_rest{0, 0, drive};
  model.rest(at_rest, state);
  return model.force(at_rest, state);
}

double equivalent_damping(const DamperModel& model, double current, double amplitude,
                          double speed) {
  constexpr int kSteps = 1000, kCycles = 3;
  const double omega = speed / amplitude, h = 2 * std::numbers::pi / (omega * kSteps);
  const auto at = [&](int k) {
    const double phase = 2 * std::numbers::pi * k / kSteps;
    return DamperInput{amplitude * std::sin(phase), speed * std::cos(phase), current};
  };

  // Energy of the last cycle, when what came before is forgotten.
  std::vector<double> state(model.state_size());
  model.rest({0, 0, current}, state);
  double energy = 0;
  for (int k = 0; k < kCycles * kSteps; ++k) {
    model.advance(at(k), at(k + 1), h, state);
    if (k >= (kCycles - 1) * kSteps)
      energy += model.force(at(k + 1), state) * at(k + 1).velocity * h;
  }
  return energy / (std::numbers::pi * omega * amplitude * amplitude);
}

ReferenceStroke reference_stroke(const ChosenDamper& damper) {
  ReferenceStroke stroke;
  if (const auto& d = damper.domain) {
    const double reach = 0.25 * (d->displacement_max - d->displacement_min);
    const double speed = 0.5 * std::max(d->velocity_max, -d->velocity_min);
    if (reach > 0) stroke.amplitude = std::min(stroke.amplitude, reach);
    if (speed > 0) stroke.speed = std::min(stroke.speed, speed);
  }
  return stroke;
}

DampingRange damping_between(const ChosenDamper& damper, double current_min, double current_max) {
  const double lever = damper.motion_ratio * damper.motion_ratio;
  if (const auto& stated = damper.damping)
    return {lever * stated->least, lever * stated->nominal, lever * stated->greatest};
  const auto [amplitude, speed] = reference_stroke(damper);
  const auto at = [&](double current) {
    return std::max(0.0, lever * equivalent_damping(*damper.model, current, amplitude, speed));
  };
  const double soft = at(current_min), hard = damper.is_passive() ? soft : at(current_max);
  return {std::min(soft, hard), soft, std::max(soft, hard)};
}

}  // namespace dashpot
