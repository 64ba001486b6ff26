#include <algorithm>
#include <cmath>

#include "dashpot/damper/kinds/passive_network/energy_balance.h"
#include "dashpot/record/cycles.h"
#include "dashpot/report/ranking_figures.h"
#include "dashpot/report/ranking_tables.h"

namespace dashpot {
namespace {

constexpr std::size_t kPoints = 80;  // of a curve

/// The cycle of the longest way; the whole record where it has none.
Cycle widest_cycle(const RecordResult& record) {
  const auto way = [&](const Cycle& cycle) {
    double sum = 0;
    for (std::size_t k = cycle.first; k < cycle.first + cycle.count; ++k)
      sum += std::abs(record.velocity[k]);
    return sum;
  };
  const std::vector<Cycle> cycles = find_cycles(record.velocity);
  return cycles.empty() ? Cycle{0, record.velocity.size()}
                        : *std::ranges::max_element(cycles, {}, way);
}

/// The curves of one model on one record, from the start of its widest cycle on.
void add_balance(FigurePanel& panel, const PassiveNetworkModel& model, const RecordResult& record,
                 const When& here) {
  std::vector<DamperInput> inputs;
  for (std::size_t k = 0; k < record.time.size(); ++k)
    inputs.push_back({record.displacement.empty() ? 0 : record.displacement[k], record.velocity[k],
                      record.drive[k]});
  const EnergyBalance balance = energy_balance(model, record.time, inputs);
  const Cycle cycle = widest_cycle(record);
  const std::size_t end = std::min(cycle.first + cycle.count + 1, record.time.size());

  // Each part that this network has, from the start of the cycle on.
  const std::tuple<const char*, const char*, const std::vector<double>*> curves[] = {
      {"work done on it", "measured", &balance.work},
      {"stored", "series-1", &balance.stored},
      {"drained by friction", "series-2", &balance.friction},
      {"by creep", "series-3", &balance.creep},
      {"by the viscous term", "series-4", &balance.viscous},
      {"by the slip of its mass", "series-5", &balance.inertia}};
  const std::size_t step = std::max<std::size_t>(1, cycle.count / kPoints);
  for (const auto& [label, colour, joules] : curves) {
    if (std::ranges::all_of(*joules, [](double e) { return e == 0; })) continue;
    FigureSeries series{.label = label, .colour = colour, .x = {}, .y = {}, .when = here};
    for (std::size_t k = cycle.first; k < end; k += step) {
      series.x.push_back(record.time[k] - record.time[cycle.first]);
      series.y.push_back((*joules)[k] - (*joules)[cycle.first]);
    }
    panel.series.push_back(std::move(series));
  }
}

}  // namespace

std::vector<DocumentFigure> energy_figures(const Ranking& ranking) {
  FigurePanel panel{
      .title = "Energy over a cycle",
      .x_label = "Time (s)",
      .y_label = "Energy",
      .series = {},
      .note =
          "Since the start of the widest cycle of the record. What is stored and what "
          "is drained add up to the work, and nothing drained ever falls.",
      .height = 300,
      .empty =
          "The energy of this model cannot be told apart: it is no passive "
          "network.",
      .y_unit = "J"};

  // A balance for each passive network over each record that a reader can choose.
  const std::vector<ShownRecord> records = shown_records(ranking);
  for (std::size_t m = 0; m < ranking.models.size(); ++m) {
    const RankedModel& ranked = ranking.models[m];
    const auto* model =
        ranked.fit.model ? model_as<PassiveNetworkModel>(*ranked.fit.model) : nullptr;
    if (!model) continue;
    for (std::size_t r = 0; r < records.size(); ++r) {
      const RecordResult* record = records[r].of(ranked);
      if (!record || record->velocity.empty()) continue;
      add_balance(panel, *model, *record, {{"model", {m}}, {"record", {r}}});
    }
  }

  if (panel.series.empty()) return {};
  return {{.name = "energy", .title = {}, .caption = {}, .panels = {std::move(panel)}}};
}

}  // namespace dashpot
