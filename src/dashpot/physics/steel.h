#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "dashpot/value.h"

namespace dashpot {

/// The steel of a magnetic circuit, as its file states it: points of its B-H curve, or a
/// permeability and a saturation, B = B_s b / (b + B_s) with b = mu H. SI.
struct Steel {
  std::string name, source, note;
  /// A/m and T, ascending from 0; straight between them, with mu_0 beyond. Empty: the two numbers.
  std::vector<std::pair<double, double>> points;
  double permeability = 0, saturation = 0;
  double uncertainty = 0;  ///< of the flux density, a standard deviation as a share
  double scale = 1;        ///< times which the flux density of the points is taken

  // These three are of points only.
  double field(double flux_density) const;  ///< A/m in the steel, at T >= 0
  double flux_density(double field) const;  ///< T
  /// T, the flux density of the iron itself that the points reach.
  double saturated() const;
};

/// Names of the steels that come with Dashpot, data/steels.
std::vector<std::string> steel_names();
/// A steel by its name or its file, as find_fluid does. Throws Error that names file and line where
/// the points are out of order.
std::shared_ptr<const Steel> find_steel(std::string_view name, const std::string& where = {},
                                        const std::filesystem::path& folder = {});
Steel read_steel(const Value& value);
Value to_json(const Steel& steel);

}  // namespace dashpot
