#include "dashpot/record/excitation.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/error.h"
#include "dashpot/base/text.h"
#include "dashpot/base/units.h"

namespace dashpot {
namespace {

const SequenceParam& find_param(const SequenceInfo& info, const std::string& name, const std::string& where) {
  const auto found = std::ranges::find(info.params, name, &SequenceParam::name);
  if (found != info.params.end()) return *found;
  std::vector<std::string> known;
  for (const SequenceParam& param : info.params) known.emplace_back(param.name);
  throw Error(where, std::string(info.name) + " has no parameter '" + name + "'", suggest(name, known));
}

/// "4mm", "4 mm" or "0.004", in SI.
double parse_value(std::string_view text, const SequenceParam& param, const std::string& where) {
  const std::size_t end = std::min(text.find_first_not_of("+-.0123456789eE"), text.size());
  const auto number = parse_number(trim(text.substr(0, end)));
  if (!number)
    throw Error(where, "'" + std::string(text) + "' is not a value of " + std::string(param.name),
                "write it as " + std::string(param.name) + "=" + format_number(param.value));
  const std::string_view unit_text = trim(text.substr(end));
  const Unit unit = require_unit(unit_text.empty() ? param.unit : unit_text, where);
  if (unit.dimension != require_unit(param.unit, where).dimension)
    throw Error(where, "'" + std::string(unit_text) + "' does not measure " + std::string(param.name),
                "write it in " + std::string(param.unit));
  const double value = unit.factor * *number + unit.offset;
  if (!(value >= param.lower && value <= param.upper))
    throw Error(where,
                std::string(param.name) + " is " + format_number(value) + " " + std::string(param.unit),
                "between " + format_number(param.lower) + " and " + format_number(param.upper));
  if (param.whole && value != std::round(value))
    throw Error(where, std::string(param.name) + " is " + format_number(value), "a whole number");
  return value;
}

/// A sequence and the values of its parameters.
template <class Sequence>
struct Chosen {
  const Sequence& sequence;
  std::vector<double> values;

  std::string description() const {
    std::string text(sequence.info.name);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const SequenceParam& param = sequence.info.params[k];
      text += (k == 0 ? ": " : ", ") + std::string(param.name) + " " + format_number(values[k]);
      if (param.unit != "1") text += " " + std::string(param.unit);
    }
    return text;
  }
};

template <class Sequence>
const Sequence& find_sequence(std::span<const Sequence> sequences, std::string_view name,
                              const std::string& where) {
  std::vector<std::string> known;
  for (const Sequence& sequence : sequences) {
    if (lower(sequence.info.name) == lower(name)) return sequence;
    known.emplace_back(sequence.info.name);
  }
  throw Error(where, "unknown sequence '" + std::string(name) + "'", suggest(name, known));
}

template <class Sequence>
Chosen<Sequence> choose(std::span<const Sequence> sequences, const std::string& text,
                        const std::string& where) {
  const std::vector<std::string> parts = split(text, ',');
  Chosen<Sequence> chosen{find_sequence(sequences, trim(parts.front()), where), {}};
  const SequenceInfo& info = chosen.sequence.info;
  for (const SequenceParam& param : info.params) chosen.values.push_back(param.value);
  for (std::size_t k = 1; k < parts.size(); ++k) {
    const std::size_t equals = parts[k].find('=');
    if (equals == std::string::npos)
      throw Error(where, "'" + parts[k] + "' states no value", "write NAME=VALUE");
    const SequenceParam& param = find_param(info, std::string(trim(parts[k].substr(0, equals))), where);
    chosen.values[static_cast<std::size_t>(&param - info.params.data())] =
        parse_value(trim(std::string_view(parts[k]).substr(equals + 1)), param, where);
  }
  return chosen;
}

}  // namespace

PistonMotion make_motion(const std::string& text, std::uint64_t seed, const std::string& where) {
  const auto chosen = choose(motion_sequences(), text, where);
  PistonMotion motion = chosen.sequence.make(chosen.values, seed);
  motion.description = chosen.description();
  return motion;
}

DriveSignal make_drive(const std::string& text, const DriveFrame& frame, const std::string& where) {
  const auto chosen = choose(drive_sequences(), text, where);
  DriveSignal drive = chosen.sequence.make(chosen.values, frame);
  drive.description = chosen.description();
  return drive;
}

}  // namespace dashpot
