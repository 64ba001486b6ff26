#include "studies/one_sensor/one_sensor_document.h"

#include <cmath>

#include <fmt/format.h>

#include "dashpot/report/words.h"
#include "studies/one_sensor/one_sensor_parts.h"

namespace dashpot {
namespace {

/// The two networks with the same one sensor, over all experiments of a damper.
std::string against_each_other(const OneSensorView& view, std::size_t damper) {
  const auto plain = view.study.all(damper, kStatic), bank = view.study.all(damper, kHysteresis);
  const std::string& name = view.study.dampers[damper].damper.name;
  if (!plain || !bank) return {};
  if (plain->diverged_at || bank->diverged_at) return " On " + name + " one of the two diverged.";
  return fmt::format(
      " On {} it leaves {} % of half the force span, the paper's static network {} %; as a power "
      "ratio (ESR) {} and {} %.",
      name, view.half_text(damper, *bank), view.half_text(damper, *plain), view.esr_text(*bank),
      view.esr_text(*plain));
}

/// True when the hysteresis network leaves less than the paper's network on every damper.
bool answers(const OneSensorView& view) {
  for (std::size_t d = 0; d < view.study.dampers.size(); ++d) {
    const auto plain = view.study.all(d, kStatic), bank = view.study.all(d, kHysteresis);
    if (!plain || !bank || bank->diverged_at || !(bank->metrics.rmse < plain->metrics.rmse))
      return false;
  }
  return true;
}

std::string verdict_of(const OneSensorView& view) {
  // The answer, where the hysteresis network leaves less on every damper.
  std::string text = "The paper's question is how well one sensor can do.";
  if (answers(view))
    text =
        "One sensor can do more than the paper found: the hysteresis network carries the past in "
        "internal states where the paper would add a sensor.";

  // Both networks in figures, damper by damper.
  for (std::size_t d = 0; d < view.study.dampers.size(); ++d) text += against_each_other(view, d);
  if (view.is_virtual())
    text +=
        " MR1 and MR2 are virtual dampers, shaped after the paper's words: orderings can be "
        "compared with the paper's, sizes cannot.";
  return text;
}

}  // namespace

OneSensorView::OneSensorView(const OneSensorStudy& shown) : study(shown) {
  for (const DamperStudy& one : study.dampers) half_spans_.push_back(one.damper.half_span());
}

std::string OneSensorView::example_name() const {
  const StudiedDamper& damper = study.dampers[example_damper()].damper;
  if (!damper.is_virtual) return "all divisions of " + damper.name;
  return damper.experiments[damper.example.front()].name + " of " + damper.name +
         ", a virtual damper";
}

double OneSensorView::half_percent(std::size_t damper, double rms) const {
  return 100 * rms / half_spans_[damper];
}

std::string OneSensorView::half_text(std::size_t damper, const StudiedResult& result) const {
  return result.diverged_at ? "diverged" : number_text(half_percent(damper, result.metrics.rmse));
}

std::string OneSensorView::span_text(std::size_t damper, const StudiedResult& result) const {
  return result.diverged_at ? "diverged"
                            : number_text(half_percent(damper, result.metrics.rmse) / 2);
}

std::string OneSensorView::esr_text(const StudiedResult& result) const {
  return result.diverged_at ? "diverged" : number_text(result.metrics.esr);
}

std::optional<double> OneSensorView::example_percent(const std::string& key) const {
  const auto result = study.example(example_damper(), key);
  if (!result || result->diverged_at) return std::nullopt;
  return half_percent(example_damper(), result->metrics.rmse);
}

std::string change_text(double from, double to) {
  const double change = 100 * (to / from - 1);
  if (std::abs(change) < 0.05) return "stays";
  return fmt::format("{} by {} %", change < 0 ? "falls" : "rises",
                     number_text(std::abs(change), 2));
}

DocumentSection protocol_section(const OneSensorView& view) {
  DocumentSection section{"protocol", "How it was done", {}};

  // The paper's task.
  section.paragraphs.push_back(
      "The paper (MR Damper Identification using ANN based on 1-Sensor) identifies two dampers in "
      "five experiments with a perceptron of ten neurons that sees the velocity and the current, "
      "and shows by experiments why. Each part below repeats one of them; the paper's figure "
      "stands beside ours.");

  // The data: virtual dampers, or measured ones.
  section.paragraphs.push_back(
      view.is_virtual()
          ? "Virtual dampers: the paper prints no data of its dampers, so two virtual ones stand "
            "in for them. MR1 takes any current, spans about 4000 N either way and has a marked "
            "hysteresis at high frequencies; MR2 has two levels, -6000 ... 11000 N, and little "
            "hysteresis. The bench records at 1650 Hz, 0.5-15 Hz, 25 mm either way, 0-2.5 A, at "
            "most 1.5 m/s; its sensors have noise (force 1 % of the span, velocity 5 mm/s, "
            "displacement 20 um) and the load cell a zero of its own in every recording."
          : "Measured: these recordings are real. Each division leaves something out (" +
                std::to_string(view.study.dampers.front().damper.experiments.size()) +
                " divisions); what the paper shows for one experiment is shown for all divisions "
                "together.");

  // Judging: virtual dampers are recorded twice, measured data are divided.
  section.paragraphs.push_back(
      view.is_virtual()
          ? "Judging: the paper does not state its cross-validation. Here every experiment is "
            "recorded twice, and a model learns from the first recording and is judged on the "
            "whole second one, which it has not seen: other random numbers, frequencies and speeds "
            "between those of the first, stepped currents that fall where they rose. Leaving out "
            "the end of a recording would not do: there the stepped current stands at levels that "
            "its beginning does not have."
          : "Judging: what is left out are whole records, never samples of a record that was "
            "learnt from. The velocity is the one sensor; where it was derived from a "
            "displacement, that is the one sensor, as the paper's figure 10 proposes.");

  // Free run and percentages mean the same for both kinds of data.
  section.paragraphs.push_back(
      "Free run: a model sees motion and current, never the measured force. One-step errors, for "
      "which the measured force is fed back, stand beside it under that name and decide nothing. "
      "Each record's force zero is a free nuisance.");
  section.paragraphs.push_back(
      "Percentages: the paper says 'normalised by the span', but 291.4 N and 597.8 N are 7.25 % "
      "and 7.02 % of 4000 N and 8500 N: of half the span. Both stand here; they refer to the span "
      "of all forces of a damper. ESR is the power ratio, sum of squared errors over the force's "
      "variance.");
  return section;
}

Document one_sensor_document(const OneSensorStudy& study) {
  const OneSensorView view(study);
  Document document;
  document.title = "The one-sensor paper, repeated";
  document.subtitle = view.is_virtual() ? "two virtual dampers, five experiments"
                                        : study.dampers.front().damper.name;
  document.verdict = verdict_of(view);
  document.sections = {protocol_section(view), excitation_section(view), recurrence_section(view),
                       sensors_section(view),  regressors_section(view), size_section(view),
                       accuracy_section(view), curves_section(view),     velocity_section(view),
                       esr_section(view)};
  return document;
}

}  // namespace dashpot
