#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "dashpot/report/document.h"
#include "studies/one_sensor/one_sensor_study.h"

// Parts of the one-sensor study's page, and the figures of the paper that it stands beside.
namespace dashpot {

/// The figures that the paper prints, % of half the span of the force where nothing else is said.
namespace one_sensor_paper {
inline constexpr double kFeedForward = 4.38, kRecurrent = 3.80;   // table 3
inline constexpr double kOneSensor = 8.22, kTwoSensors = 4.38;    // table 4
inline constexpr std::array kRegressors{8.22, 8.24, 8.86, 8.79};  // table 5
inline constexpr std::array<std::array<double, 5>, 2> kExperiments{
    // table 6
    {{5.9, 8.2, 3.1, 4.1, 14.95}, {6.9, 6.8, 7.2, 8.0, 6.2}}};
inline constexpr std::array kMeanRms{291.4, 597.8};  // N
inline constexpr int kNeurons = 10;
inline constexpr double kEsr = 4.7, kBinghamEsr = 14.5, kPhenomenologicalEsr = 8.7,
                        kSemiPhenomenologicalEsr = 38.7;  // %, of powers
inline constexpr const char* kRecurrentEsr = "0.9, 2";
}  // namespace one_sensor_paper

/// The study, and its figures as text. It refers to the study, which must outlive it.
class OneSensorView {
 public:
  explicit OneSensorView(const OneSensorStudy& study);

  const OneSensorStudy& study;
  bool is_virtual() const { return study.dampers.front().damper.is_virtual; }
  /// The damper of the paper's examples; it has one.
  std::size_t example_damper() const { return 0; }
  std::string example_name() const;  ///< "experiment 2 of MR1, a virtual damper"

  double half_percent(std::size_t damper, double rms) const;  ///< of half the damper's force span
  /// "3.62" or "diverged"; by span it is half of that.
  std::string half_text(std::size_t damper, const StudiedResult& result) const;
  std::string span_text(std::size_t damper, const StudiedResult& result) const;
  std::string esr_text(const StudiedResult& result) const;
  /// Error on the example, % of half-span; nothing where the model was not fitted there or
  /// diverged.
  std::optional<double> example_percent(const std::string& key) const;

 private:
  std::vector<double> half_spans_;
};

/// "falls by 13 %", "rises by 0.2 %".
std::string change_text(double from, double to);

DocumentSection protocol_section(const OneSensorView& view);
DocumentSection recurrence_section(const OneSensorView& view);  // table 3
DocumentSection sensors_section(const OneSensorView& view);     // table 4
DocumentSection regressors_section(const OneSensorView& view);  // table 5
DocumentSection size_section(const OneSensorView& view);        // the number of neurons, figure 5
DocumentSection accuracy_section(const OneSensorView& view);    // table 6, figure 6
DocumentSection esr_section(const OneSensorView& view);         // the conclusions
DocumentSection excitation_section(const OneSensorView& view);  // table 2, figures 3 and 4
DocumentSection curves_section(const OneSensorView& view);      // figures 7 to 9
DocumentSection velocity_section(const OneSensorView& view);    // figure 10

}  // namespace dashpot
