#include "dashpot/report/ranking_figures.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "dashpot/base/text.h"
#include "dashpot/report/quantity.h"
#include "dashpot/report/ranking_tables.h"
#include "dashpot/report/ranking_words.h"
#include "dashpot/report/residual.h"
#include "dashpot/report/series.h"
#include "dashpot/report/words.h"

namespace dashpot {
namespace {

using Mark = FigureSeries::Mark;

constexpr double kSeriesBytes = 4e6;  ///< of the page, for all curves together
constexpr std::size_t kHistogramBins = 41, kLags = 100, kLongestLag = 1000;
constexpr std::size_t kMostBars = 5;

/// The results of all models on one record; the first one gives motion and measured force.
struct RecordCurves {
  std::size_t record = 0;  ///< its place among shown_records()
  ShownRecord::Part part = ShownRecord::Part::LeftOut;
  const RecordResult* first = nullptr;
  std::vector<std::pair<std::size_t, const RecordResult*>> models;  ///< by place in the ranking
  std::vector<std::size_t> chosen;                                  ///< the samples that are shown
};

/// One for every record that some model was run on.
std::vector<RecordCurves> curves_by_record(const Ranking& ranking) {
  std::vector<RecordCurves> curves;
  const std::vector<ShownRecord> records = shown_records(ranking);
  for (std::size_t r = 0; r < records.size(); ++r) {
    RecordCurves here{.record = r, .part = records[r].part, .models = {}, .chosen = {}};

    // Only forces over the same samples can share their time.
    for (std::size_t m = 0; m < ranking.models.size(); ++m) {
      const RecordResult* result = records[r].of(ranking.models[m]);
      if (!result || result->time.empty() || result->modelled.size() != result->time.size())
        continue;
      if (!here.first) here.first = result;
      if (result->time.size() == here.first->time.size()) here.models.emplace_back(m, result);
    }
    if (here.first) curves.push_back(std::move(here));
  }
  return curves;
}

/// Points per record that keep the page within kSeriesBytes: time takes 4 bytes, displacement,
/// velocity, measured force, and each model's force and interval take 2, all of them 4/3 in base64.
std::size_t points_per_record(const std::vector<RecordCurves>& curves, std::size_t models) {
  const double bytes_per_point = (4.0 + 2.0 * (3.0 + 2.0 * static_cast<double>(models))) * 4 / 3;
  return static_cast<std::size_t>(kSeriesBytes / bytes_per_point /
                                  static_cast<double>(curves.size()));
}

std::vector<std::size_t> shown_samples(const RecordCurves& curves, std::size_t points) {
  std::vector<std::span<const double>> leading{curves.first->measured};
  if (curves.first->velocity.size() == curves.first->time.size())
    leading.push_back(curves.first->velocity);
  for (const auto& [model, result] : curves.models) leading.push_back(result->modelled);
  return thinned_indices(leading, points);
}

std::string drive_text(const RecordResult& result, const std::string& unit) {
  return result.drive_level ? level_text(*result.drive_level, unit) : result.record;
}

std::string level_class(std::size_t level, std::size_t count) {
  return fmt::format("level-{}-{}", level + 1, count);
}

bool moves(const std::vector<double>& samples) {
  return std::ranges::any_of(samples, [](double x) { return x != 0; });
}

/// A force over time.
FigurePanel in_time(const std::string& title, const std::string& y_label, int height) {
  return {.title = title,
          .x_label = "Time (s)",
          .y_label = y_label,
          .series = {},
          .reads_along_x = true,
          .height = height,
          .y_unit = "N"};
}

/// Fills the panels of one model on one record, record by record, each with the condition under
/// which its curves are shown.
class RecordPanels {
 public:
  RecordPanels(const ReportInput& input, std::vector<SharedSamples>& samples)
      : input_(input), samples_(samples) {
    force_ = in_time("Force in time", "Force", 340);
    force_.note =
        "Where its start is shaded, it is simulated but not scored. Every plot: drag to zoom, "
        "Shift and drag to move, double-click to reset; with the keyboard + - arrows 0.";
    residual_ = in_time("Residual in time", "Residual", 280);

    // Loops over velocity and displacement.
    for (const auto& [panel, name, unit] :
         {std::tuple{&velocity_, "velocity", "m/s"}, {&displacement_, "displacement", "m"}})
      *panel = {.title = std::string("Force against ") + name,
                .x_label = name == std::string("velocity") ? "Velocity" : "Displacement",
                .y_label = "Force",
                .series = {},
                .note = "Lines: measured. Dashes: modelled.",
                .height = 320,
                .empty = std::string("The recordings hold no ") + name + ".",
                .x_unit = unit,
                .y_unit = "N"};
    histogram_ = {.title = "Distribution of the residual",
                  .x_label = "Residual",
                  .y_label = "Share of samples (%)",
                  .series = {},
                  .reads_along_x = true,
                  .height = 280,
                  .x_unit = "N"};
    correlation_ = {.title = "Autocorrelation of the residual",
                    .x_label = "Lag (s)",
                    .y_label = "Correlation (1)",
                    .series = {},
                    .note =
                        "Between the dashed lines, the residual cannot be told from noise (95 %). "
                        "Structure outside them is what the model misses.",
                    .reads_along_x = true,
                    .height = 280};
  }

  /// `together`: all records of the same condition, whose loops are drawn in one panel.
  void add(const RecordCurves& curves, const std::vector<const RecordCurves*>& together) {
    const RecordResult& first = *curves.first;
    const When here{{"record", {curves.record}}};

    // The measured record, once for all models.
    const std::size_t time = keep(first.time, curves, "s"),
                      measured = keep(first.measured, curves, "N");
    const auto scored = std::ranges::lower_bound(curves.chosen, first.warm_up);
    const auto from = static_cast<std::size_t>(scored - curves.chosen.begin());
    FigureSeries line{.label = "measured", .colour = "measured", .x = {}, .y = {}, .width = 2.2};
    line.shared = {.x = time, .y = measured};
    line.when = here;
    force_.series.push_back(line);
    if (first.warm_up > 0 && first.warm_up < first.time.size())
      for (FigurePanel* panel : {&force_, &residual_})
        panel->series.push_back({.label = "",
                                 .colour = "shade",
                                 .x = {first.time.front(), first.time[first.warm_up]},
                                 .y = {0, 0},
                                 .mark = Mark::Span,
                                 .when = here});

    // Loops are shown beside those of the same condition, in the colours of the drive.
    When condition{{"record", {}}};
    for (const RecordCurves* other : together) condition[0].second.push_back(other->record);
    const bool is_alone = together.size() == 1;
    const auto place =
        static_cast<std::size_t>(std::ranges::find(together, &curves) - together.begin());
    const std::string drive = drive_text(first, to_string(input_.dataset.drive_unit)),
                      colour = level_class(place, together.size());
    std::vector<std::pair<FigurePanel*, std::size_t>> axes;
    for (const auto& [panel, samples] :
         {std::pair{&velocity_, &first.velocity}, std::pair{&displacement_, &first.displacement}})
      if (samples->size() == first.time.size() && moves(*samples))
        axes.emplace_back(panel, keep(*samples, curves, panel->x_unit));
    for (const auto& [panel, x] : axes)
      panel->series.push_back({.label = is_alone ? "measured" : drive,
                               .colour = is_alone ? "measured" : colour,
                               .x = {},
                               .y = {},
                               .width = 2,
                               .reading = "measured, " + drive,
                               .opacity = 0.55,
                               .shared = SharedCurve{.x = x, .y = measured, .first = from},
                               .when = condition});

    // Sliders show it once, though it may be among the records of the fit and those left out.
    const auto record = std::ranges::find(input_.dataset.records, first.record, &Record::name);
    if (axes.size() == 2 && first.drive_level && record != input_.dataset.records.end() &&
        std::ranges::find(loops_, first.record, &DocumentSliders::Loop::name) == loops_.end())
      loops_.push_back({.name = first.record,
                        .drive = *first.drive_level,
                        .conditions = record->conditions,
                        .displacement = axes[1].second,
                        .velocity = axes[0].second,
                        .force = measured,
                        .first = from});

    // Each model's force on it.
    for (const auto& [model, result] : curves.models) {
      const std::size_t modelled = keep(result->modelled, curves, "N");
      const When both{{"model", {model}}, {"record", {curves.record}}};
      add_force(curves, *result, {.x = time, .y = modelled}, both);
      residual_.series.push_back(
          {.label = "measured - modelled",
           .colour = "modelled",
           .x = {},
           .y = {},
           .width = 1,
           .shared = SharedCurve{.x = time, .y = measured, .minus = modelled},
           .when = both});
      for (const auto& [panel, x] : axes)
        panel->series.push_back({.label = is_alone ? "modelled" : drive,
                                 .colour = is_alone ? "modelled" : colour,
                                 .x = {},
                                 .y = {},
                                 .mark = Mark::Dashes,
                                 .width = 1.6,
                                 .reading = "modelled, " + drive,
                                 .is_listed = is_alone,
                                 .shared = SharedCurve{.x = x, .y = modelled, .first = from},
                                 .when = {{"model", {model}}, condition[0]}});
      if (result->time.size() > 1 && result->measured.size() == result->time.size())
        add_statistics(*result, both);
    }
  }

  const std::vector<DocumentSliders::Loop>& loops() const { return loops_; }
  std::vector<DocumentFigure> take() {
    return {{.name = "force", .title = {}, .caption = {}, .panels = {force_}},
            {.name = "loops",
             .title = {},
             .caption = {},
             .panels = {velocity_, displacement_},
             .columns = 2},
            {.name = "residual", .title = {}, .caption = {}, .panels = {residual_}},
            {.name = "statistics",
             .title = {},
             .caption = {},
             .panels = {histogram_, correlation_},
             .columns = 2}};
  }

 private:
  std::size_t keep(const std::vector<double>& values, const RecordCurves& curves,
                   const std::string& si_unit) {
    SharedSamples shared{{}, si_unit == "s", si_unit};
    for (const std::size_t i : curves.chosen) shared.values.push_back(values[i]);
    samples_.push_back(std::move(shared));
    return samples_.size() - 1;
  }

  void add_force(const RecordCurves& curves, const RecordResult& result, SharedCurve curve,
                 const When& when) {
    const std::size_t size = result.time.size();
    const std::string outcome = result.diverged_at
                                    ? "diverged at " + format_number(*result.diverged_at, 3) + " s"
                                    : "fit " + percent_text(result.metrics.fit) + " %";
    force_.series.push_back({.label = "modelled, " + outcome,
                             .colour = "modelled",
                             .x = {},
                             .y = {},
                             .width = 1.4,
                             .reading = "modelled",
                             .shared = curve,
                             .when = when});
    if (!result.band || result.coverage.samples == 0 || result.velocity.size() != size ||
        result.drive.size() != size)
      return;

    // The interval as one area behind the curves.
    std::vector<double> half(size);
    for (std::size_t i = 0; i < size; ++i)
      half[i] =
          result.band->half_width_at({0, result.velocity[i], result.drive[i]}, result.spread_at(i));
    curve.half_width = keep(half, curves, "N");
    force_.series.push_back(
        {.label = fmt::format("{:.0f} % interval, covers {} %", 100 * result.band->level,
                              percent_text(result.coverage.percent())),
         .colour = "modelled",
         .x = {},
         .y = {},
         .mark = Mark::Area,
         .is_read = false,
         .opacity = 0.2,
         .shared = curve,
         .when = when});
  }

  /// Distribution and autocorrelation of the residual.
  void add_statistics(const RecordResult& result, const When& when) {
    std::vector<double> residual;
    for (std::size_t i = result.warm_up; i < result.modelled.size(); ++i)
      if (const double e = result.measured[i] - result.modelled[i]; std::isfinite(e))
        residual.push_back(e);

    const Histogram shares = histogram(residual, kHistogramBins);
    FigureSeries bars{.label = "share",
                      .colour = "modelled",
                      .x = {},
                      .y = shares.shares,
                      .mark = Mark::Bars,
                      .is_listed = false,
                      .when = when};
    for (std::size_t k = 0; k < shares.shares.size(); ++k)
      bars.x.push_back(shares.low + (static_cast<double>(k) + 0.5) * shares.width);
    histogram_.series.push_back(std::move(bars));

    const Autocorrelation correlation = autocorrelation(residual, kLags, kLongestLag);
    const double dt =
        (result.time.back() - result.time.front()) / static_cast<double>(result.time.size() - 1);
    FigureSeries line{.label = "correlation",
                      .colour = "modelled",
                      .x = {},
                      .y = correlation.values,
                      .is_listed = false,
                      .when = when};
    for (const std::size_t lag : correlation.lags) line.x.push_back(static_cast<double>(lag) * dt);
    for (const double edge : {correlation.band, -correlation.band})
      if (!line.x.empty())
        correlation_.series.push_back({.label = "95 % band of noise",
                                       .colour = "muted",
                                       .x = {line.x.front(), line.x.back()},
                                       .y = {edge, edge},
                                       .mark = Mark::Dashes,
                                       .width = 1,
                                       .is_read = false,
                                       .when = when});
    correlation_.series.push_back(std::move(line));
  }

  const ReportInput& input_;
  std::vector<SharedSamples>& samples_;
  std::vector<DocumentSliders::Loop> loops_;
  FigurePanel force_, velocity_, displacement_, residual_, histogram_, correlation_;
};

/// Least and greatest of the scored samples.
std::pair<double, double> scored_extent(const RecordResult& result,
                                        const std::vector<double>& samples) {
  std::pair<double, double> extent{NAN, NAN};
  for (std::size_t i = result.warm_up; i < samples.size(); ++i) {
    extent.first = std::fmin(extent.first, samples[i]);
    extent.second = std::fmax(extent.second, samples[i]);
  }
  return extent;
}

/// The greatest and least force of a record at its greatest and least velocity.
struct Peak {
  std::string record;
  double velocity, measured, modelled;
};

/// A model's peaks in one colour per level of the drive.
void add_peaks(FigurePanel& panel, const RankedModel& model, std::size_t place,
               const std::string& unit) {
  std::map<std::pair<double, std::string>, std::vector<Peak>> levels;
  for (const RecordResult& result : model.left_out.records) {
    if (result.time.empty() || result.velocity.size() != result.time.size() ||
        result.modelled.size() != result.time.size())
      continue;
    const auto v = scored_extent(result, result.velocity),
               measured = scored_extent(result, result.measured),
               modelled = scored_extent(result, result.modelled);
    auto& peaks = levels[{result.drive_level.value_or(0),
                          result.drive_level ? drive_text(result, unit) : "varying drive"}];
    peaks.push_back({result.record, v.first, measured.first, modelled.first});
    peaks.push_back({result.record, v.second, measured.second, modelled.second});
  }

  std::size_t level = 0;
  for (auto& [key, peaks] : levels) {
    std::ranges::sort(peaks, {}, &Peak::velocity);
    FigureSeries measured{.label = key.second,
                          .colour = level_class(level++, levels.size()),
                          .x = {},
                          .y = {},
                          .mark = Mark::Dots,
                          .width = 3.5,
                          .reading = "measured, " + key.second,
                          .when = {{"model", {place}}}};
    FigureSeries modelled = measured, line = measured;
    for (const Peak& peak : peaks) {
      // The line is broken between compression and extension: nothing was judged in between.
      if (!line.x.empty() && line.x.back() < 0 && peak.velocity >= 0) {
        line.x.push_back(NAN);
        line.y.push_back(NAN);
      }
      for (const auto& [series, force] :
           {std::pair{&measured, peak.measured}, std::pair{&modelled, peak.modelled},
            std::pair{&line, peak.modelled}}) {
        series->x.push_back(peak.velocity);
        series->y.push_back(force);
        if (series != &line) series->names.push_back(peak.record);
      }
    }
    line.mark = Mark::Dashes;
    line.width = 1.5;
    modelled.mark = Mark::Rings;
    modelled.width = 4.5;
    modelled.reading = "modelled, " + key.second;
    line.is_listed = line.is_read = modelled.is_listed = false;
    for (FigureSeries* series : {&line, &measured, &modelled})
      panel.series.push_back(std::move(*series));
  }
}

FigurePanel band_panel(const Ranking& ranking) {
  FigurePanel panel{.title = "Error by speed",
                    .x_label = "Band of speed (" + unit_name("m/s") + ")",
                    .y_label = "RMS error",
                    .series = {},
                    .note =
                        "Every bar is the RMS error of the samples in a band of |v|. The first "
                        "band is the pre-yield region, where laws without hysteresis fail.",
                    .height = 320,
                    .y_unit = "N"};
  if (ranking.models.size() > kMostBars)
    panel.note += fmt::format(" Shown are the {} best models and the chosen one.", kMostBars);

  // The best models always, any other one when it is chosen.
  for (std::size_t m = 0; m < ranking.models.size(); ++m) {
    const std::vector<BandResult>& bands = ranking.models[m].left_out.bands;
    if (bands.empty()) continue;
    FigureSeries bars{.label = display_name(ranking.models[m]),
                      .colour = "series-" + std::to_string(m % 6 + 1),
                      .x = {},
                      .y = {},
                      .mark = Mark::Bars};
    if (m >= kMostBars) bars.when = {{"model", {m}}};
    for (std::size_t k = 0; k < bands.size(); ++k) {
      bars.x.push_back(static_cast<double>(k));
      bars.y.push_back(bands[k].metrics.rmse);
      if (panel.places.size() < bands.size())
        panel.places.push_back(split(bands[k].name, ',').front() + "\n" +
                               plain_quantity(bands[k].low, "m/s") + "–" +
                               plain_quantity(bands[k].high, "m/s"));
    }
    panel.series.push_back(std::move(bars));
  }
  return panel;
}

/// No shade at an ESR of 0.3 %, all of it at 100 %; logarithmic, since errors differ by decades.
double heat_of(double esr) {
  return esr > 0 ? std::clamp(std::log10(esr / 0.3) / std::log10(100 / 0.3), 0., 1.) : 0;
}

/// A cell of one condition and one level of the drive; several records there count by their mean.
DocumentTable heat_map(const RankedModel& model, const std::string& unit) {
  const auto condition_of = [](const RecordResult& r) {
    return r.condition.empty() ? r.record : r.condition;
  };
  std::vector<std::string> conditions;
  std::map<std::optional<double>, std::size_t> levels;
  for (const RecordResult& r : model.left_out.records) {
    levels[r.drive_level];
    if (std::ranges::find(conditions, condition_of(r)) == conditions.end())
      conditions.push_back(condition_of(r));
  }
  DocumentTable table{
      .title = "ESR in %, " + display_name(model), .columns = {{"Condition"}}, .rows = {}};
  for (const auto& [level, none] : levels)
    table.columns.push_back({level ? level_text(*level, unit) : "varying", true});

  for (const std::string& condition : conditions) {
    std::vector<std::string> row{condition};
    std::vector<double> shades{NAN};
    for (const auto& [level, none] : levels) {
      double sum = 0, count = 0;
      bool has_diverged = false;
      for (const RecordResult& r : model.left_out.records) {
        if (condition_of(r) != condition || r.drive_level != level) continue;
        has_diverged = has_diverged || r.diverged_at.has_value();
        sum += r.metrics.esr;
        ++count;
      }
      row.push_back(count == 0 ? "–" : has_diverged ? "diverged" : percent_text(sum / count));
      shades.push_back(count == 0 ? NAN : has_diverged ? 1 : heat_of(sum / count));
    }
    table.rows.push_back(std::move(row));
    table.shades.push_back(std::move(shades));
  }
  return table;
}

}  // namespace

std::vector<DocumentFigure> record_figures(const ReportInput& input,
                                           std::vector<SharedSamples>& samples,
                                           std::string& display,
                                           std::vector<DocumentSliders::Loop>& loops) {
  // Choose the samples that are shown, record by record.
  std::vector<RecordCurves> curves = curves_by_record(input.ranking);
  std::size_t thinned = 0;
  for (RecordCurves& one : curves) {
    one.chosen = shown_samples(one, points_per_record(curves, input.ranking.models.size()));
    thinned += one.chosen.size() < one.first->time.size();
  }
  display =
      (thinned ? fmt::format("Curves of {} of {} records are thinned for display; least and "
                             "greatest values of every stretch are kept.",
                             thinned, curves.size())
               : std::string("Curves show every sample.")) +
      " They are rounded to 1/65534 of their range. Every figure is computed from the full data.";

  // Draw each with those of the same condition.
  RecordPanels panels(input, samples);
  for (const RecordCurves& one : curves) {
    std::vector<const RecordCurves*> together;
    for (const RecordCurves& other : curves)
      if (&other == &one || (one.part == other.part && !one.first->condition.empty() &&
                             one.first->condition == other.first->condition))
        together.push_back(&other);
    panels.add(one, together);
  }
  loops = panels.loops();
  return panels.take();
}

DocumentFigure overview_figure(const ReportInput& input) {
  FigurePanel peaks{.title = "Peak force against velocity",
                    .x_label = "Peak velocity",
                    .y_label = "Peak force",
                    .series = {},
                    .note = "Filled: measured. Rings and dashes: modelled.",
                    .height = 320,
                    .x_unit = "m/s",
                    .y_unit = "N"};
  for (std::size_t m = 0; m < input.ranking.models.size(); ++m)
    add_peaks(peaks, input.ranking.models[m], m, to_string(input.dataset.drive_unit));
  return {.name = "overview",
          .title = {},
          .caption = {},
          .panels = {std::move(peaks), band_panel(input.ranking)},
          .columns = 2};
}

std::vector<DocumentTable> heat_maps(const ReportInput& input) {
  std::vector<DocumentTable> tables;
  for (std::size_t m = 0; m < input.ranking.models.size(); ++m) {
    tables.push_back(heat_map(input.ranking.models[m], to_string(input.dataset.drive_unit)));
    tables.back().when = {{"model", {m}}};
  }
  return tables;
}

}  // namespace dashpot
