#include "dashpot/record/cycles.h"

#include <numbers>

#include "dashpot/dataset.h"
#include "support.h"

using namespace dashpot;

namespace {

/// sin(2 pi (k - shift) / period): rises through zero at shift, shift + period ...
std::vector<double> sine(std::size_t count, double period, double shift) {
  std::vector<double> samples;
  for (std::size_t k = 0; k < count; ++k)
    samples.push_back(std::sin(2 * std::numbers::pi * (static_cast<double>(k) - shift) / period));
  return samples;
}

}  // namespace

TEST_CASE("cycles of a sine: from behind each rise, as long as the period, rounded") {
  // Rises at 10.3, 60.7, 111.1 and 161.5; a period of 50.4 samples.
  const std::vector<Cycle> cycles = find_cycles(sine(180, 50.4, 10.3));
  REQUIRE(cycles.size() == 3);
  CHECK(cycles[0].first == 11);
  CHECK(cycles[1].first == 61);
  CHECK(cycles[2].first == 112);
  for (const Cycle& cycle : cycles) CHECK(cycle.count == 50);
  CHECK(find_cycles(sine(180, 50.6, 10.3)).front().count == 51);
}

TEST_CASE("what wavers around zero is no cycle; neither is what does not come back") {
  std::vector<double> samples = sine(180, 50.4, 10.3);
  for (const std::size_t k : {59, 60, 61, 62}) samples[k] = k % 2 ? -0.05 : 0.05;
  CHECK(find_cycles(samples).size() == 3);
  CHECK(find_cycles(sine(40, 50.4, 10.3)).empty());
  CHECK(find_cycles({}).empty());
  CHECK(find_cycles(std::vector<double>(20, 0.0)).empty());
}

TEST_CASE("the last cycle of a record; a record without one is refused") {
  Record record;
  record.name = "sine";
  for (int k = 0; k < 180; ++k) record.time.push_back(0.01 * k);
  record.sample_time = 0.01;
  record.warm_up = 5;
  record.channels = {{"velocity", "m/s", sine(180, 50.4, 10.3), ""}};
  const Record cycle = last_cycle(record);
  CHECK(cycle.size() == 50);
  CHECK(cycle.time.front() == record.time[112]);
  CHECK(cycle.warm_up == 0);
  record.keep(0, 50);
  CHECK(message_of([&] { last_cycle(record); }).find("record 'sine': has no whole cycle") == 0);
}

TEST_CASE(
    "one cycle of each published record of the family: the paper's authors have 13333 samples" *
    doctest::test_suite("long")) {
  const std::filesystem::path folder = shared_data("family-dnn");
  if (folder.empty()) return;
  const Dataset dataset = load_dataset({folder});
  REQUIRE(dataset.records.size() == 108);  // 18 dampers, 6 field levels
  std::size_t samples = 0;
  for (const Record& record : dataset.records) samples += last_cycle(record).size();
  CHECK(samples == 13333);  // TC-3.4: what their notebook extracts
}
