#include "dashpot/damper/inverse/inverse_file.h"

#include <cmath>

#include "dashpot/base/file.h"
#include "dashpot/base/file_kind.h"
#include "dashpot/damper/file_parts.h"
#include "dashpot/damper/nets/mlp_json.h"
#include "dashpot/error.h"

namespace dashpot {
namespace {

constexpr FileFormat kFormat{"dashpot-inverse", "a file of an inverse", 1};

Value to_json(const InverseNetwork& network) {
  Value inputs = Value::array();
  for (const Tap& tap : network.taps)
    inputs.push_back(Value::object({{"signal", name_of(tap.signal)}, {"delay", tap.delay}}));
  Value value = Value::object({{"name", network.name}, {"inputs", std::move(inputs)}});
  if (network.rate_max > 0) value.add("rate_max", network.rate_max);
  add_mlp(value, network.mlp);
  return value;
}

Tap read_tap(const Value& value) {
  ObjectReader reader(value, "an input");
  const Value& signal = reader.required("signal");
  const double delay = reader.number("delay");
  reader.finish();
  if (!(delay >= 0 && delay <= InverseNetwork::kMostDelay && delay == std::floor(delay)))
    throw Error(value.where(), "its delay is no number of steps",
                "a whole number, 0 to " + std::to_string(InverseNetwork::kMostDelay));
  return {tap_signal_named(signal.as_string(), signal.where()), static_cast<int>(delay)};
}

InverseNetwork read_network(const Value& value, double sample_time, const Domain& domain) {
  ObjectReader reader(value, "an inverse network");
  InverseNetwork network{.name = reader.string("name"),
                         .taps = {},
                         .spacing = sample_time,
                         .current_min = domain.current_min,
                         .current_max = domain.current_max,
                         .rate_max = 0,
                         .mlp = {}};

  for (const Value& item : reader.required("inputs").items())
    network.taps.push_back(read_tap(item));
  network.rate_max = reader.number("rate_max", 0);
  network.mlp = read_mlp(reader);
  reader.finish();

  require_usable(network, value.where());
  return network;
}

}  // namespace

std::string format_inverse(const InverseFile& file) {
  return format_json(Value::object({{"format", kFormat.name},
                                    {"version", kFormat.version},
                                    {"drive_unit", to_string(file.drive_unit)},
                                    {"sample_time", file.network.spacing},
                                    {"domain", to_json(file.domain, file.drive_unit)},
                                    {"network", to_json(file.network)},
                                    {"quality", file.quality},
                                    {"provenance", to_json(file.provenance)}}));
}

InverseFile parse_inverse(std::string_view text, const std::string& source) {
  const Value document = parse_json_of(text, source, "a file of an inverse");
  ObjectReader reader(document, "a file of an inverse");
  require_format(reader, kFormat);
  InverseFile file;
  file.drive_unit = read_drive_unit(reader);
  const double sample_time = reader.number("sample_time");
  file.domain = read_domain(reader.required("domain"), file.drive_unit);

  file.network = read_network(reader.required("network"), sample_time, file.domain);
  if (const Value* quality = reader.optional("quality")) {
    ObjectReader(*quality, "the quality");  // any keys, but a mapping
    file.quality = *quality;
  }

  file.provenance = read_provenance(reader.required("provenance"));
  reader.finish();
  return file;
}

InverseFile load_inverse(const std::filesystem::path& path) {
  return parse_inverse(read_file(path), path.string());
}

void require_drive(const InverseFile& file, DriveUnit taken, const std::string& where) {
  const auto words = [](DriveUnit unit) {
    return unit == DriveUnit::None ? "a number without a unit" : to_string(unit);
  };
  if (file.drive_unit != taken)
    throw Error(where, "gives " + words(file.drive_unit) + ", but the damper takes " + words(taken),
                "an inverse that 'dashpot invert' made for this damper");
}

void save_inverse(const InverseFile& file, const std::filesystem::path& path) {
  write_file(path, format_inverse(file));
}

}  // namespace dashpot
