#pragma once
#include "dashpot/report/document.h"
#include "dashpot/suspension/ride/ride_study.h"

namespace dashpot {

// The limits of the one-sensor paper: less body acceleration than passive up to 2 Hz; a gain of the
// tyre's deflection of 2.5 at most up to 20 Hz.
constexpr double kPaperComfortTo = 2, kPaperHoldingTo = 20;  ///< Hz
constexpr double kPaperHoldingLimit = 2.5;                   ///< 1

/// The greatest fundamental gain by sines up to that frequency, Hz.
double greatest_gain(const RiddenVehicle& ridden, Gain GainPoint::* signal, double to);

DocumentFigure gain_figure(const RideStudy& study);
/// Gains read from one chirp, beside those by sines.
DocumentFigure chirp_figure(const RideStudy& study);
/// Comfort against road holding, with the same dampers held at their currents as the line to beat.
DocumentFigure trade_off_figure(const RideStudy& study);
/// Needs a study with a bound.
DocumentFigure possible_figure(const RideStudy& study);
DocumentFigure road_figure(const RideStudy& study);
DocumentFigure step_figure(const RideStudy& study);

}  // namespace dashpot
