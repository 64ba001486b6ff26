#include "dashpot/machine/watched.h"

#include "dashpot/base/text.h"
#include "dashpot/machine/found_noise.h"

namespace dashpot {
namespace {

Value day_json(const Watched& watched, std::size_t d) {
  const WatchedDay& day = watched.days[d];
  Value amounts = Value::object(), plant = Value::object(), known = Value::object();
  for (const WatchedQuantity& q : watched.quantities) {
    const ChartPoint& point = q.chart.points[d];
    amounts.add(q.name, Value::object({{"value", day.estimate.wear[q.place]},
                                       {"deviation", day.estimate.wear_deviation[q.place]},
                                       {"expected", point.expected},
                                       {"scatter", point.scatter},
                                       {"score", point.score},
                                       {"sum", point.sum}}));
  }
  for (std::size_t k = 0; k < day.estimate.plant.size(); ++k)
    plant.add(watched.plant.setup.unknown[k].name, day.estimate.plant[k]);
  for (std::size_t k = 0; k < day.known.size(); ++k)
    known.add(watched.options.known[k], day.known[k]);
  return Value::object({{"name", day.estimate.name},
                        {"amounts", std::move(amounts)},
                        {"plant", std::move(plant)},
                        {"excitation", day.estimate.excitation},
                        {"known", std::move(known)},
                        {"converged", day.estimate.converged},
                        {"remark", watched.remark(d)}});
}

}  // namespace

const WatchedQuantity* Watched::first_alarm() const { return first_alarm_of(quantities); }

bool Watched::is_judged(std::size_t day) const {
  return quantities.front().chart.points[day].is_judged;
}

std::string Watched::remark(std::size_t day) const {
  std::vector<std::string> remarks;
  for (const WatchedQuantity& q : quantities)
    if (q.chart.alarm == day) remarks.push_back("ALARM: " + q.name);
  const std::string at_end = at_an_end(plant, days[day].estimate);
  if (!days[day].estimate.converged)
    remarks.push_back("does not count: " +
                      (at_end.empty() ? "not converged" : at_end + " at an end of its range"));
  if (remarks.empty() && !is_judged(day)) remarks.emplace_back("reference");
  return join(remarks, ", ");
}

Value to_json(const Watched& watched) {
  // The charts, with an alarm where there is one, and the days.
  Value charts = Value::array(), days = Value::array();
  for (const WatchedQuantity& q : watched.quantities) {
    Value chart =
        Value::object({{"quantity", q.name}, {"unit", q.unit}, {"threshold", q.chart.threshold}});
    if (!q.strut.empty()) chart.add("damper", q.strut);
    if (q.chart.alarm) {
      chart.add("alarm", watched.days[*q.chart.alarm].estimate.name);
      chart.add("since", watched.days[q.chart.since].estimate.name);
      chart.add("fall", q.chart.fall);
      chart.add("fall_deviation", q.chart.fall_deviation);
    }
    charts.push_back(std::move(chart));
  }
  for (std::size_t d = 0; d < watched.days.size(); ++d) days.push_back(day_json(watched, d));

  // The plant and its dampers; of several, which alarm came first and what is in doubt.
  Value told =
      Value::object({{"plant", watched.plant.setup.model->name},
                     {"noise", identified_noise_words(watched.plant.setup, PrintUnits::si())}});
  const WatchedQuantity* alarm = watched.first_alarm();
  const ObservedDampers& dampers = watched.plant.dampers;
  if (dampers.size() == 1) {
    told.add("damper", dampers.front().model->name());
  } else {
    Value named = Value::object(), doubts = Value::array();
    const std::vector<std::string> struts = observer_names(watched.plant.setup).struts;
    for (std::size_t d = 0; d < dampers.size(); ++d) named.add(struts[d], dampers[d].model->name());
    for (std::string& sentence : hardly_apart(watched.plant)) doubts.push_back(std::move(sentence));
    told.add("dampers", std::move(named));
    told.add("hardly_apart", std::move(doubts));
    if (alarm) told.add("first_alarm", alarm->name);
  }

  Value left_out = Value::array(), odd = Value::array();
  for (const std::string& why : watched.left_out) left_out.push_back(why);
  for (std::string& day : odd_days(watched.quantities, watched.days)) odd.push_back(std::move(day));
  told.add("left_out", std::move(left_out));
  told.add("odd_days", std::move(odd));
  told.add("alarm", alarm != nullptr);
  told.add("days_between_false_alarms", watched.options.chart.days);
  told.add("reference_days", watched.options.chart.reference);
  told.add("found", found_of(watched.plant));
  told.add("charts", std::move(charts));
  told.add("days", std::move(days));
  return told;
}

}  // namespace dashpot
