#pragma once
#include <string>

#include "dashpot/record/characterise.h"
#include "dashpot/report/document.h"

namespace dashpot {

struct CharacterisationInput {
  const Dataset& dataset;
  const Characterisation& figures;  ///< of that dataset
  std::string command, version, date;
};

/// The dyno sheet of a damper: what each level of the drive says, forces over speed, loops, what
/// changes over time. Its data are in SI.
Document characterisation_document(const CharacterisationInput& input);

/// One line per cycle with every figure.
std::string cycles_csv(const Characterisation& figures, const PrintUnits& units = PrintUnits::si());

/// "0.5 A", "every drive" where it is not known.
std::string level_name(const LevelFigures& level, DriveUnit unit);

/// Adds a level's forces over its speeds to a panel, both directions, as a line and as dots on it.
/// `line` has no points yet.
void add_level_curve(FigurePanel& panel, FigureSeries line, const LevelFigures& level,
                     double StrokeFigures::* speed, double StrokeFigures::* force);

}  // namespace dashpot
