#include "dashpot/record/repeats.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "dashpot/base/text.h"

namespace dashpot {
namespace {

/// How far and fast a record moves, and its force: m, m/s, N.
struct Size {
  const Record* record = nullptr;
  double stroke = 0, speed = 0, force = 0;
};

/// The root mean square about the mean.
double spread_of(const std::vector<double>& samples) {
  double mean = 0, square = 0;
  for (const double value : samples) mean += value / static_cast<double>(samples.size());
  for (const double value : samples) square += (value - mean) * (value - mean);
  return std::sqrt(square / static_cast<double>(samples.size()));
}

bool is_repeat(const Size& one, const Size& other) {
  constexpr double kAlike = 0.05;
  const auto close = [](double a, double b) { return std::abs(a - b) <= kAlike * std::max(a, b); };
  return one.record->drive_level == other.record->drive_level &&
         one.record->conditions == other.record->conditions && close(one.stroke, other.stroke) &&
         close(one.speed, other.speed);
}

/// Records whose force is that of one before, sample for sample, as no measurement comes twice.
std::vector<Suspect> copies(std::span<const Record> records) {
  const auto less = [](const Record* a, const Record* b) {
    return a->find("force")->samples < b->find("force")->samples;
  };
  std::set<const Record*, decltype(less)> seen(less);
  std::vector<Suspect> found;
  for (const Record& record : records) {
    const Channel* force = record.find("force");
    if (!force || !(spread_of(force->samples) > 0)) continue;
    const auto [first, is_new] = seen.insert(&record);
    if (!is_new)
      found.push_back(
          {record.name,
           "its force is that of " + (*first)->name +
               " in every sample: a copy counts twice, and judges a model by what taught "
               "it; leave one of the two out"});
  }
  return found;
}

}  // namespace

std::vector<Suspect> doubts_about_repeats(std::span<const Record> records) {
  // The records of each motion at each drive.
  std::vector<std::vector<Size>> motions;
  for (const Record& record : records) {
    const Channel *x = record.find("displacement"), *v = record.find("velocity"),
                  *f = record.find("force");
    if (!record.drive_level || !x || !v || !f) continue;
    const Size size{&record, spread_of(x->samples), spread_of(v->samples), spread_of(f->samples)};
    if (!(size.stroke > 0 && size.speed > 0 && size.force > 0)) continue;
    const auto same = std::ranges::find_if(
        motions, [&](const std::vector<Size>& here) { return is_repeat(here.front(), size); });
    (same == motions.end() ? motions.emplace_back() : *same).push_back(size);
  }

  // Each that is far from the one in the middle, by size of the force.
  constexpr double kUnlike = 1.3;  // times
  std::vector<Suspect> found = copies(records);
  for (const std::vector<Size>& here : motions) {
    std::vector<Size> sorted = here;
    std::ranges::stable_sort(sorted, {}, &Size::force);
    const Size& middle = here.size() == 2 ? here.front() : sorted[sorted.size() / 2];
    for (const Size& one : here) {
      const double times = one.force / middle.force;
      if (times < kUnlike && times > 1 / kUnlike) continue;
      found.push_back(
          {one.record->name,
           "its force has " + format_number(times, 2) + " times the size of that of " +
               middle.record->name +
               ", which moves alike at the same drive: another damper, another gain or unit of the "
               "load cell, a current that did not flow or a damper much warmer? Leave out the one "
               "that is wrong, or state in a dataset file what differs, its 'level' or "
               "'conditions'"});
    }
  }
  return found;
}

}  // namespace dashpot
