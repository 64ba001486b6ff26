#include "dashpot/physics/steel.h"

#include <algorithm>
#include <cmath>

#include "dashpot/base/file_kind.h"
#include "dashpot/base/read_quantity.h"
#include "dashpot/base/text.h"
#include "dashpot/physics/fluid_curves.h"
#include "dashpot/physics/flux_curve.h"
#include "dashpot/physics/named_file.h"
#include "dashpot/physics/read_points.h"

namespace dashpot {

double Steel::field(double flux_density) const { return field_on(points, flux_density / scale); }

double Steel::flux_density(double field) const {
  const auto& last = points.back();
  if (field >= last.first) return scale * (last.second + DASHPOT_MU0 * (field - last.first));
  return scale * curve_at(points, field);
}

double Steel::saturated() const {
  double most = 0;
  for (const auto& [field, flux] : points) most = std::max(most, flux - DASHPOT_MU0 * field);
  return scale * most;
}

std::vector<std::string> steel_names() { return data_names("steels", ".yaml"); }

std::shared_ptr<const Steel> find_steel(std::string_view name, const std::string& where,
                                        const std::filesystem::path& folder) {
  return find_named<Steel>({"steel", "steels", read_steel}, name, where, folder);
}

Steel read_steel(const Value& value) {
  refuse_other_kind(value, "a steel");
  ObjectReader reader(value, "a steel");
  Steel steel;
  read_words(reader, steel);

  // Points, or the two numbers of the soft knee.
  if (const Value* points = reader.optional("points")) {
    steel.points = read_flux_curve(*points);
    if (const Value* scale = reader.optional("scale")) steel.scale = read_quantity(*scale, "1");
  } else {
    steel.permeability = read_quantity(reader.required("permeability"), "1");
    steel.saturation = read_quantity(reader.required("saturation"), "T");
    const auto require = [&](const char* key, double number, double low, double high,
                             const std::string& unit) {
      if (!(number >= low && number <= high))
        throw Error(
            value.find(key)->where(),
            std::string(key) + " is " + format_number(number) + unit + ", which no steel has",
            format_number(low) + " to " + format_number(high) + unit);
    };
    require("permeability", steel.permeability, 1, 1e6, "");
    require("saturation", steel.saturation, 0.1, 3, " T");
  }
  if (const Value* uncertainty = reader.optional("uncertainty"))
    steel.uncertainty = read_quantity(*uncertainty, "1");
  if (!(steel.uncertainty >= 0 && steel.uncertainty <= 1 && steel.scale > 0))
    throw Error(value.where(), "its uncertainty or scale is no share", "as 'uncertainty: 5 %'");
  reader.finish();
  return steel;
}

Value to_json(const Steel& steel) {
  Value out = words_json(steel);
  if (steel.points.empty()) {
    out.add("permeability", steel.permeability);
    out.add("saturation", steel.saturation);
  } else {
    out.add("points", points_json(steel.points));
    if (steel.scale != 1) out.add("scale", steel.scale);
  }
  if (steel.uncertainty > 0) out.add("uncertainty", steel.uncertainty);
  return out;
}

}  // namespace dashpot
