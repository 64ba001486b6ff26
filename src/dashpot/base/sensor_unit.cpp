#include "dashpot/base/sensor_unit.h"

#include "dashpot/base/text.h"

namespace dashpot {

std::optional<Unit> parse_sensor_unit(std::string_view text) {
  if (lower(std::string(text)) == "gal") return parse_unit("cm/s^2");
  if (text != "g" && text != "G" && text != "mg") return parse_unit(text);
  std::optional<Unit> gravity = parse_unit("g0");
  if (text == "mg") gravity->factor *= 1e-3;
  return gravity;
}

}  // namespace dashpot
