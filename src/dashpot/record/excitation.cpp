#include "dashpot/record/excitation.h"

#include <algorithm>

#include "dashpot/base/settings.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

/// A sequence and the values of its parameters.
template <class Sequence>
struct Chosen {
  const Sequence& sequence;
  std::vector<double> values;

  std::string description() const {
    return describe_values(sequence.info.params, values, sequence.info.name);
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
  const std::vector<std::string> parts = split_words(text, where);
  const Sequence& sequence = find_sequence(sequences, parts.front(), where);
  return {sequence, parse_values(sequence.info.params, std::span(parts).subspan(1),
                                 sequence.info.name, where)};
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
