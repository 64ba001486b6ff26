#include "dashpot/machine/watch.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <numeric>

#include "dashpot/base/parallel.h"
#include "dashpot/base/text.h"
#include "dashpot/error.h"
#include "dashpot/machine/recording_parts.h"
#include "dashpot/numerics/distributions.h"
#include "dashpot/numerics/median.h"
#include "dashpot/plant.h"

namespace dashpot {
namespace {

/// Where the search for what is unknown of the plant begins: stated, or its table's.
void begin_unknowns(InPlantSetup& setup) {
  const auto& rows = setup.model->parameters;
  for (PlantUnknown& unknown : setup.unknown) {
    if (!unknown.about)
      unknown.about = rows[row_named(rows, unknown.name, setup.model->name, "plant")].value;
    if (!(*unknown.about > 0))
      throw Error("plant, " + unknown.name, "is unknown, and nothing says about how large it is",
                  "{about: ..., from: ..., to: ...}");
  }
}

/// The plant with what is unknown taken as where its search begins.
InPlantSetup as_begun(InPlantSetup setup) {
  for (const PlantUnknown& unknown : setup.unknown)
    setup.known.emplace_back(unknown.name, *unknown.about);
  setup.unknown.clear();
  return setup;
}

/// The plant as it is stated, before its days are looked at.
WatchedPlant as_stated(ObservedDampers dampers, InPlantSetup setup, const WatchOptions& options) {
  require_setup(setup);
  require_watchable(setup, options);
  assert(dampers.size() == setup.dampers());
  begin_unknowns(setup);
  for (std::size_t d = 0; d < dampers.size(); ++d)
    dampers[d].model =
        mounted(std::move(dampers[d].model), resting_drive(setup.drive_of(d), dampers[d].domain));
  WatchedPlant watched{
      .dampers = std::move(dampers), .setup = std::move(setup), .level = options.level};
  for (const std::string& name : options.wears)
    watched.wears.push_back(&find_wear(name, "tracked"));
  return watched;
}

/// The share of each chart in the rate of false alarms.
ChartOptions share_of(const WatchOptions& options, std::size_t charts) {
  ChartOptions chart = options.chart;
  chart.days *= static_cast<double>(charts);
  return chart;
}

/// What the reference days together tell: the mean of what each leaves open.
std::vector<WearOutlook> mean_of(const std::vector<std::vector<WearOutlook>>& days) {
  std::vector<WearOutlook> mean = days.front();
  for (std::size_t a = 0; a < mean.size(); ++a) {
    double squares = 0, alone = 0;
    for (const std::vector<WearOutlook>& day : days) {
      squares += day[a].deviation * day[a].deviation / static_cast<double>(days.size());
      alone += day[a].alone * day[a].alone / static_cast<double>(days.size());
    }
    mean[a].deviation = std::sqrt(squares);
    mean[a].alone = std::sqrt(alone);
  }
  return mean;
}

/// "18 %", or with its unit.
std::string amount_words(double value, const WatchedQuantity& q) {
  return q.unit == "1" ? format_number(100 * value, 2) + " %"
                       : format_number(value, 2) + " " + q.unit;
}

/// "front_force ±18 %, ±2 % if rear_force were known"
std::string outlook_words(const std::vector<WatchedQuantity>& quantities, const WearOutlook& one,
                          const WatchedQuantity& q) {
  return q.name + " ±" + amount_words(kNormal95 * one.deviation, q) + ", ±" +
         amount_words(kNormal95 * one.alone, q) + " if " + quantities[one.like].name +
         " were known";
}

/// Throws Error where a name stands twice: shared between two, a fade would look half as large.
void require_once(const std::vector<std::string>& names, const char* where) {
  for (auto name = names.begin(); name != names.end(); ++name)
    if (std::find(names.begin(), name, *name) != name)
      throw Error(where, "'" + *name + "' is named twice", "each once");
}

/// Refuses what no day can tell: half of a damper's force lies within what is open.
void require_told(const WatchedPlant& watched) {
  constexpr double kMost = 25;  // usual amounts: half of the force
  const std::vector<WatchedQuantity> quantities = watched_quantities(watched);
  for (std::size_t a = 0; a < watched.outlook.size(); ++a) {
    const WearOutlook& one = watched.outlook[a];
    const double most = kMost * watched.wears[a % watched.wears.size()]->usual;
    if (kNormal95 * one.deviation < most) continue;
    const bool is_alone = !(kNormal95 * one.alone < most);
    throw Error("plant, sensors",
                is_alone ? "do not tell " + quantities[a].name + ": no day shows whether it fades"
                         : "cannot tell " + quantities[a].name + " from " +
                               quantities[one.like].name + ": a day of the first ones leaves " +
                               outlook_words(quantities, one, quantities[a]) + " (95 %)",
                "a sensor of each damper's own: its deflection, its wheel's acceleration");
  }
}

/// Mean and scatter of numbers, two or more.
std::pair<double, double> mean_and_scatter(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / (count - 1))};
}

/// Days on which an input seems to count otherwise than on the reference days.
std::vector<std::string> odd_inputs(const Chart& chart, const std::vector<WatchedDay>& days) {
  constexpr double kOdd = 3.5, kLeast = 0.05;
  constexpr std::size_t kFewest = 4;
  std::vector<std::string> sentences;
  if (days.empty()) return sentences;
  for (std::size_t i = 0; i < days.back().estimate.input_gains.size(); ++i) {
    std::vector<double> reference;
    bool learns = true;
    for (std::size_t d = 0; d < days.size(); ++d) {
      const DayEstimate& day = days[d].estimate;
      if (!day.converged || i >= day.input_gains.size()) continue;
      const auto& [channel, gain] = day.input_gains[i];
      learns &= !chart.points[d].is_judged;
      if (learns) reference.push_back(gain);
      if (learns || reference.size() < kFewest) continue;

      // Beside the mean and the scatter of the reference days: of normal numbers a Student's t.
      const auto [mean, scatter] = mean_and_scatter(reference);
      const auto count = static_cast<double>(reference.size());
      const double t = (gain - mean) / (scatter * std::sqrt(1 + 1 / count));
      if (!(std::abs(normal_score(count - 1, t)) > kOdd)) continue;
      if (!(std::abs(gain - mean) > kLeast)) continue;
      sentences.push_back(day.name + ": its sensors fit the plant better if " + channel +
                          " is some " + format_number(gain, 2) +
                          " times what the recording shows (on the reference days " +
                          format_number(mean, 3) + " ± " + format_number(scatter, 2) +
                          "): look at that input, or at the sensors, before the damper");
    }
  }
  return sentences;
}

}  // namespace

std::vector<std::string> hardly_apart(const WatchedPlant& watched) {
  constexpr double kHardly = 3;
  const std::vector<WatchedQuantity> quantities = watched_quantities(watched);
  std::vector<std::string> sentences;
  for (std::size_t a = 0; a < watched.outlook.size(); ++a) {
    const WearOutlook& one = watched.outlook[a];
    if (one.deviation < kHardly * one.alone) continue;
    sentences.push_back(
        "the sensors hardly tell " + quantities[a].name + " from " + quantities[one.like].name +
        ", and a fade of one may be called one of the other: a day leaves " +
        outlook_words(quantities, one, quantities[a]) +
        " (95 %); a sensor of each damper's own, as its deflection, would tell them apart");
  }
  return sentences;
}

void require_watchable(const InPlantSetup& setup, const WatchOptions& options) {
  require_no_follower(setup, "'watch'");
  if (unmeasured_road(setup))
    require_one_damper(setup, "'watch' beside a road that nothing measures");

  // What is followed must not say one thing twice, and the plant must be known but for its numbers.
  const auto follows = [&](const char* name) {
    return std::ranges::find(options.wears, name) != options.wears.end();
  };
  require_once(options.wears, "tracked");
  require_once(options.known, "known");
  if (follows("force") && follows("rebound") && follows("compression"))
    throw Error("tracked", "force is the sum of rebound and compression", "leave one of them out");
  require_known_lags(setup);

  // Enough days to learn from, with what explains a day.
  const std::size_t known = 1 + options.known.size() +
                            (options.level.empty() ? 0 : setup.unknown.size()),
                    fewest = fewest_reference_days(known);
  if (options.chart.reference < fewest)
    throw Error("reference", "is " + std::to_string(options.chart.reference) + " days",
                std::to_string(fewest) + " or more, from which the healthy scatter is learnt");
  if (options.level.empty()) return;
  std::vector<std::string> sensors;
  for (const PlantSensor& sensor : setup.sensors) sensors.push_back(sensor.channel);
  if (std::ranges::find(sensors, options.level) == sensors.end())
    throw Error("level", "'" + options.level + "' is no sensor of the plant",
                suggest(options.level, sensors));
}

WatchedPlant watched_plant(ObservedDampers dampers, InPlantSetup setup,
                           const std::vector<PlantRecording>& reference,
                           const WatchOptions& options) {
  constexpr int kRounds = 2;
  if (reference.empty()) throw Error("recordings", "there are none", "name at least one");
  WatchedPlant watched = as_stated(std::move(dampers), std::move(setup), options);
  watched.sample_time = reference.front().sample_time;

  // The uncertainties by the plant's numbers, these by the uncertainties, and once more.
  const bool has_several = watched.dampers.size() > 1;
  std::vector<std::vector<WearOutlook>> outlooks(reference.size());
  for (int round = 0; round < kRounds; ++round) {
    Monitor monitor = options.monitor;
    monitor.on_progress = [&, round](const Progress& own) {
      if (options.monitor.on_progress)
        options.monitor.on_progress({own.stage, kPreparation * (round + own.fraction) / kRounds});
    };
    const ObserveReport observed =
        observe(watched.dampers, as_begun(watched.setup), moving_parts(watched.setup, reference),
                {.causal = true,
                 .threads = options.threads,
                 .monitor = monitor,
                 .is_straight = true,
                 .seeks_faults = false});
    watched.noise = observed.noise;
    watched.steps = observed.steps;
    std::vector<DayEstimate> days(reference.size());
    parallel_for(days.size(), options.threads, [&](std::size_t d) {
      days[d] = estimate_day(watched, reference[d], has_several ? &outlooks[d] : nullptr);
    });
    for (std::size_t k = 0; k < watched.setup.unknown.size(); ++k) {
      std::vector<double> values;
      for (const DayEstimate& day : days) values.push_back(day.plant[k]);
      watched.setup.unknown[k].about = median(values);
    }
  }
  if (!has_several) return watched;
  watched.outlook = mean_of(outlooks);
  require_told(watched);
  return watched;
}

WatchedDay watch_day(const WatchedPlant& watched, const PlantRecording& recording,
                     const WatchOptions& options) {
  WatchedDay day{.estimate = estimate_day(watched, recording), .known = {}};
  for (const std::string& name : options.known) {
    const std::vector<double>& shown = recording.channel(name).samples;
    day.known.push_back(std::accumulate(shown.begin(), shown.end(), 0.0) /
                        static_cast<double>(shown.size()));
  }
  return day;
}

std::vector<WatchedQuantity> watched_quantities(const WatchedPlant& watched) {
  // What wears, in each strut.
  std::vector<WatchedQuantity> quantities;
  const std::vector<std::string> struts = observer_names(watched.setup).struts;
  for (const std::string& strut : struts)
    for (const Wear* wear : watched.wears) {
      if (struts.size() == 1) {
        quantities.push_back({wear->name, wear->unit, wear->meaning, quantities.size()});
        continue;
      }
      constexpr std::string_view kWhose = "the damper's";
      std::string meaning = wear->meaning;
      meaning.replace(meaning.find(kWhose), kWhose.size(), "the " + strut + " damper's");
      quantities.push_back(
          {strut + "_" + wear->name, wear->unit, std::move(meaning), quantities.size(), strut});
    }

  // The sensor whose mean is followed.
  for (const PlantSensor& sensor : watched.setup.sensors)
    if (!watched.level.empty() && sensor.channel == watched.level)
      quantities.push_back({watched.level, unit_of(sensor.place.quantity),
                            "the mean of " + watched.level, quantities.size()});
  return quantities;
}

std::vector<WatchedQuantity> watch_charts(const WatchedPlant& watched,
                                          const std::vector<WatchedDay>& days,
                                          const WatchOptions& options) {
  std::vector<WatchedQuantity> quantities = watched_quantities(watched);
  const std::size_t amounts = quantities.size() - (watched.level.empty() ? 0 : 1);
  for (WatchedQuantity& quantity : quantities) {
    const bool is_level = quantity.place >= amounts;
    std::vector<ChartDay> values;
    for (const WatchedDay& day : days) {
      // Nothing follows from a day without any motion, which states of before may hold.
      const bool moved = day.estimate.excitation > 0;
      values.push_back(
          {day.estimate.wear[quantity.place], day.known, day.estimate.converged && moved});
      values.back().known.push_back(moved ? std::log(day.estimate.excitation) : 0);
      if (is_level)
        values.back().known.insert(values.back().known.end(), day.estimate.plant.begin(),
                                   day.estimate.plant.end());
    }
    quantity.chart = health_chart(values, share_of(options, quantities.size()));
  }
  return quantities;
}

std::vector<std::string> odd_days(const std::vector<WatchedQuantity>& quantities,
                                  const std::vector<WatchedDay>& days) {
  constexpr double kOdd = 3.5;  // of normal numbers one in 2000 goes beyond
  constexpr std::size_t kFewest = 4;
  std::vector<std::string> sentences;
  for (const WatchedQuantity& q : quantities) {
    for (std::size_t d = 0; d < days.size(); ++d) {
      const ChartPoint& point = q.chart.points[d];
      if (point.is_judged && point.score > kOdd)
        sentences.push_back(
            days[d].estimate.name + " lies far above what was to be expected: " + q.name + " is " +
            amount_words(days[d].estimate.wear[q.place], q) + ", by the days before " +
            amount_words(point.expected, q) + " ± " + amount_words(point.scatter, q) +
            "; that is seldom the damper: look at the sensors and at what is known "
            "of the day, since a fade would hide behind it");
    }

    std::vector<std::size_t> reference;
    for (std::size_t d = 0; d < days.size(); ++d)
      if (days[d].estimate.converged && days[d].estimate.excitation > 0 &&
          !q.chart.points[d].is_judged)
        reference.push_back(d);
    if (reference.size() < kFewest) continue;

    // Each beside the mean and the scatter of the others: of normal numbers a Student's t.
    const auto others = static_cast<double>(reference.size() - 1);
    for (const std::size_t odd : reference) {
      double sum = 0, squares = 0;
      for (const std::size_t d : reference)
        if (d != odd) sum += days[d].estimate.wear[q.place];
      const double mean = sum / others, value = days[odd].estimate.wear[q.place];
      for (const std::size_t d : reference)
        if (d != odd) squares += std::pow(days[d].estimate.wear[q.place] - mean, 2);
      const double scatter = std::sqrt(squares / (others - 1));
      if (!(scatter > 0)) continue;
      const double t = (value - mean) / (scatter * std::sqrt(1 + 1 / others));
      if (std::abs(normal_score(others - 1, t)) < kOdd) continue;
      sentences.push_back(days[odd].estimate.name + " lies far from the other reference days: " +
                          q.name + " is " + amount_words(value, q) + ", theirs " +
                          amount_words(mean, q) + " ± " + amount_words(scatter, q) +
                          "; unless something known explains it, the chart takes that for the "
                          "scatter of healthy days, and may be blind to a fade: if it is no "
                          "healthy day, start anew without it");
    }
  }
  if (!quantities.empty())
    std::ranges::move(odd_inputs(quantities.front().chart, days), std::back_inserter(sentences));
  return sentences;
}

const WatchedQuantity* first_alarm_of(const std::vector<WatchedQuantity>& quantities) {
  const WatchedQuantity* first = nullptr;
  const auto beyond = [](const WatchedQuantity& q) {
    return q.chart.points[*q.chart.alarm].sum / q.chart.threshold;
  };
  for (const WatchedQuantity& q : quantities) {
    if (!q.chart.alarm) continue;
    const bool is_other = first && q.strut != first->strut;
    if (!first || *q.chart.alarm < *first->chart.alarm ||
        (is_other && *q.chart.alarm == *first->chart.alarm && beyond(q) > beyond(*first)))
      first = &q;
  }
  return first;
}

Value found_of(const WatchedPlant& watched) {
  Value plant = Value::object(), errors = Value::array();
  for (const PlantUnknown& unknown : watched.setup.unknown) plant.add(unknown.name, *unknown.about);
  for (const ForceError& one : watched.noise.force)
    errors.push_back(Value::array(std::vector<double>{one.deviation, one.memory}));
  Value found = Value::object({{"plant", std::move(plant)},
                               {"force_errors", std::move(errors)},
                               {"sensor_noise", Value::array(watched.noise.sensors)},
                               {"roughness", watched.noise.roughness},
                               {"steps", watched.steps},
                               {"sample_time", watched.sample_time}});
  if (watched.outlook.empty()) return found;
  Value outlook = Value::array();
  for (const WearOutlook& one : watched.outlook)
    outlook.push_back(Value::object({{"deviation", one.deviation},
                                     {"alone", one.alone},
                                     {"like", static_cast<double>(one.like)}}));
  found.add("outlook", std::move(outlook));
  return found;
}

WatchedPlant watched_again(ObservedDampers dampers, InPlantSetup setup, const Value& found,
                           const WatchOptions& options) {
  WatchedPlant watched = as_stated(std::move(dampers), std::move(setup), options);
  ObjectReader reader(found, "what was found of a watched plant");

  // The plant's unknown numbers and the noise.
  const Value& plant = reader.required("plant");
  for (PlantUnknown& unknown : watched.setup.unknown) {
    const Value* about = plant.find(unknown.name);
    if (!about) throw Error(found.where(), "says nothing of " + unknown.name);
    unknown.about = about->as_number();
  }
  watched.noise.force.clear();
  for (const Value& one : reader.required("force_errors").items()) {
    const std::vector<double> numbers = one.as_numbers();
    if (numbers.size() != 2) throw Error(one.where(), "is no deviation with its memory");
    watched.noise.force.push_back({numbers[0], numbers[1]});
  }
  watched.noise.sensors = reader.required("sensor_noise").as_numbers();
  watched.noise.roughness = reader.number("roughness");
  watched.steps = static_cast<int>(reader.number("steps"));
  watched.sample_time = reader.number("sample_time", 0);

  // Of several dampers, how well the first days tell each amount.
  const std::size_t amounts =
      watched.dampers.size() > 1 ? watched.dampers.size() * watched.wears.size() : 0;
  if (amounts > 0) {
    for (const Value& one : reader.required("outlook").items()) {
      ObjectReader own(one, "what a day tells of an amount");
      const double like = own.number("like");
      if (!(like >= 0) || like >= static_cast<double>(amounts))
        throw Error(one.where(), "is of no amount");
      watched.outlook.push_back({.deviation = own.number("deviation"),
                                 .alone = own.number("alone"),
                                 .like = static_cast<std::size_t>(like)});
      own.finish();
    }
    if (watched.outlook.size() != amounts) throw Error(found.where(), "is of other dampers");
  }
  reader.finish();
  return watched;
}

Value to_json(const WatchedDay& day) {
  const DayEstimate& e = day.estimate;
  Value gains = Value::object();
  for (const auto& [channel, gain] : e.input_gains) gains.add(channel, gain);
  return Value::object({{"name", e.name},
                        {"wear", Value::array(e.wear)},
                        {"wear_deviation", Value::array(e.wear_deviation)},
                        {"plant", Value::array(e.plant)},
                        {"plant_deviation", Value::array(e.plant_deviation)},
                        {"excitation", e.excitation},
                        {"input_gains", std::move(gains)},
                        {"iterations", e.iterations},
                        {"converged", e.converged},
                        {"known", Value::array(day.known)}});
}

WatchedDay watched_day_from_json(const Value& value) {
  ObjectReader reader(value, "a watched day");
  WatchedDay day;
  day.estimate = {.name = reader.string("name"),
                  .wear = reader.required("wear").as_numbers(),
                  .wear_deviation = reader.required("wear_deviation").as_numbers(),
                  .plant = reader.required("plant").as_numbers(),
                  .plant_deviation = reader.required("plant_deviation").as_numbers(),
                  .excitation = reader.number("excitation"),
                  .iterations = static_cast<int>(reader.number("iterations")),
                  .converged = reader.boolean("converged", false)};
  if (const Value* gains = reader.optional("input_gains"))  // states of before have none
    for (const auto& [channel, gain] : gains->members())
      day.estimate.input_gains.emplace_back(channel, gain.as_number());
  day.known = reader.required("known").as_numbers();
  reader.finish();
  return day;
}

}  // namespace dashpot
