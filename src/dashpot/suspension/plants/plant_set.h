#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/suspension/plants/plant.h"

namespace dashpot {

/// Damping of a plant's own damper, N*s/m: as it is, and between what limits it can be set.
struct DampingRange {
  double least = 0, nominal = 0, greatest = 0;
};

/// A plant with the numbers of a source: a file of data/plants, in SI.
struct PlantSet {
  std::string name;  ///< "savaresi_spelta"
  std::string source;
  bool verified = false;  ///< false: an example, not to be called published
  std::string reason;     ///< how it was verified, or why it is not
  Plant plant;
  std::optional<DampingRange> damping;  ///< per strut
  std::string kind = {};  ///< of plant, whose parameters it states; empty: matrices of its own
};

/// Names of the sets that come with Dashpot, in alphabetical order.
std::vector<std::string> plant_set_names();

/// The text of such a file: a kind of plant and its parameters ("sprung_mass": "387 kg"), or
/// matrices of its own. `values` replace parameters. `source` stands in messages.
PlantSet parse_plant_set(std::string_view text, const std::string& source, const std::string& name,
                         const NamedValues& values = {});

/// A set, or a kind of plant with the numbers of its table. Throws Error "unknown plant ...; did
/// you mean ...".
PlantSet load_plant_set(const std::string& name, const NamedValues& values = {});

}  // namespace dashpot
