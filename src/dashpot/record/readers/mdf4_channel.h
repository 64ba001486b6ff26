#pragma once
#include <optional>
#include <string>
#include <vector>

#include "dashpot/record/readers/mdf4_blocks.h"

namespace dashpot {

/// How a stored number becomes a physical one: y = x, a line, a quotient of parabolas or a table.
struct Mdf4Conversion {
  enum class Kind { None, Linear, Rational, Interpolated, Nearest, Ranges };
  Kind kind = Kind::None;
  std::vector<double> numbers;  ///< as the block CC lists them

  double operator()(double stored) const;
};

/// A channel of numbers: where it lies in a record, and what it means.
struct Mdf4Channel {
  enum class Type { Unsigned, Signed, Float };

  std::string name, unit;
  Type type = Type::Unsigned;
  bool big_endian = false, is_time = false;
  bool is_virtual = false;  ///< the number of the record, nothing stored
  std::uint32_t byte = 0, bytes = 0, first_bit = 0, bits = 0;
  std::optional<std::uint32_t> invalid_bit;  ///< behind the data of a record
  Mdf4Conversion conversion;
  std::vector<double> texts;  ///< pairs of ends, both inside: stored values that stand for texts

  /// The physical value in a record, no number where a text stands for it; `number` is the record's
  /// own.
  double value(const char* record, std::uint64_t number) const;
};

/// A channel, or the reason why it is passed over. `data_bytes`: of a record, which the channel
/// must lie in. Throws Error on damage.
struct Mdf4ChannelOrReason {
  Mdf4Channel channel;
  std::string reason;  ///< "" when it is read
};
Mdf4ChannelOrReason read_mdf4_channel(Mdf4Blocks& blocks, const Mdf4Block& block,
                                      std::uint32_t data_bytes);

}  // namespace dashpot
