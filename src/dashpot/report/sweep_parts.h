#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "dashpot/report/document.h"
#include "dashpot/suspension/sweep/statistics.h"

// Parts that the sections of a sweep's page share.
namespace dashpot {

/// A measure as people read it: shares in %, travel in mm.
struct ShownMeasure {
  const SweepMeasure* measure;
  std::string name;  ///< "Travel"; its title, with what the vehicle stands on: "Seat load index"
  std::string unit;
  double factor = 1;

  std::string title() const;  ///< "Travel (mm)"
  std::string text(double value) const;
};

/// Those that are not 0 everywhere, comfort and road holding first.
std::vector<ShownMeasure> shown_measures(const Sweep& sweep);
/// Comfort and road holding: weighted acceleration and, where there are tyres, their load index.
std::vector<ShownMeasure> main_measures(const Sweep& sweep);

DocumentSection input_section(const Sweep& sweep);
DocumentSection ratio_section(const Sweep& sweep);
DocumentSection quantile_section(const Sweep& sweep);
DocumentSection grid_section(const Sweep& sweep);
DocumentSection sensitivity_section(const Sweep& sweep);

}  // namespace dashpot
