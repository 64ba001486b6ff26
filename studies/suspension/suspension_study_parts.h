#pragma once
#include <string>
#include <vector>

#include "dashpot/report/document.h"
#include "dashpot/report/front_parts.h"
#include "studies/suspension/suspension_study.h"

// The parts of the page of the suspension study.
namespace dashpot {

/// The figures that the paper prints of its suspension.
namespace paper {
inline constexpr double kWheelGain = 2.0, kWheelGainLess = 40.4;  // 1; %
/// Read as "reduces by 2 units", those 40.4 % are 2.0 of the passive gain.
inline constexpr double kWheelGainPassiveBy = kWheelGain / (kWheelGainLess / 100);
inline constexpr double kWheelGainBy = kWheelGainPassiveBy - kWheelGain;
inline constexpr double kWheelGainLimit = 2.5;
inline constexpr double kHoldingSettlingLess = 64.7;                    // %, by its table 8
inline constexpr double kComfortRmsLess = 7.4, kHoldingRmsLess = 64.9;  // %
/// A row of its table 8.
struct StepRow {
  double settling, decay, deviation;  ///< s, 1, m/s^2 or cm
};
inline constexpr StepRow kComfort{0.3, 0.07, 4.1}, kComfortPassive{0.8, 0.15, 4.5};
inline constexpr StepRow kHolding{0.6, 0, -3.8}, kHoldingPassive{1.7, 0.23, -4.5};
}  // namespace paper

/// 100 (1 - to / from): by how many % a figure falls.
double less_percent(double from, double to);
/// "falls by 12 %", "rises by 3 %".
std::string change_words(double from, double to);

DocumentSection suspension_protocol(const SuspensionStudy& study);
DocumentSection suspension_dampers(const SuspensionStudy& study);
DocumentSection frequency_section(const SuspensionStudy& study);
DocumentSection step_section(const SuspensionStudy& study);
DocumentSection possible_section(const SuspensionStudy& study);
DocumentSection least_damping_section(const SuspensionStudy& study);
DocumentSection claims_section(const SuspensionStudy& study);

/// Least damping, N*s/m, from which on Mix-1-sensor keeps the wheel's gain at or below
/// `wheel_gain`; 0: none of the sweep does.
double least_damping_for(const SuspensionStudy& study, double wheel_gain);

}  // namespace dashpot
