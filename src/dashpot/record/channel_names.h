#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "dashpot/base/units.h"

namespace dashpot {

/// The channel and unit that a column's name stands for: "F_N" is force in N, "Desplazamiento [mm]"
/// displacement in mm.
struct NamedChannel {
  std::string channel;  ///< "" when not recognised; "time" for the time base
  std::string unit;     ///< "" when the name holds none
  std::string problem;  ///< why a name that looks familiar is not used
  bool plain = false;   ///< the name is the channel's and nothing else: "force", not "force2"
};

/// `row_unit`: from a units row; "" when there is none. Conservative: a name that may mean two
/// things ("V", "A" without a unit) or a wish instead of a measurement ("target force") is not
/// used, since a wrong channel costs more than a question. A unit that is there and unknown comes
/// as the `problem` of a channel: whoever uses the column must refuse it. Never throws.
NamedChannel recognise_channel(std::string_view column, std::string_view row_unit);

/// A column's name and the unit in brackets behind it; nothing where there is none that is known.
struct ColumnParts {
  std::string name, unit;
};
std::optional<ColumnParts> parts_by_brackets(std::string_view column);

/// SI unit text of a channel or "time"; "" for a channel that is not standard.
std::string_view si_unit(std::string_view channel);

}  // namespace dashpot
