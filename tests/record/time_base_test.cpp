#include "dashpot/record/time_base.h"

#include "support.h"

using namespace dashpot;

namespace {

double rounded(double value, double places) { return std::round(value * places) / places; }

}  // namespace

TEST_CASE("stamps within the rounding of their digits are uniform") {
  std::vector<double> exact, decimals, significant, jittered, gap;
  for (int k = 0; k < 3000; ++k) {
    exact.push_back(k / 200.0);
    decimals.push_back(rounded(k / 3004.8, 1e5));
    const double t = k * 0.0123;
    significant.push_back(t == 0 ? 0 : rounded(t, std::pow(10, 4 - std::floor(std::log10(t)))));
    jittered.push_back(k / 200.0 + (k % 7 == 3 ? 1e-3 : 0));
    gap.push_back(k / 200.0 + (k > 1500 ? 0.005 : 0));
  }
  CHECK(uniform_step(exact) == 1 / 200.0);
  CHECK_CLOSE(uniform_step(decimals), 1 / 3004.8, 1e-6, 0);
  CHECK_CLOSE(uniform_step(significant), 0.0123, 1e-6, 0);
  CHECK(uniform_step(jittered) == 0);
  CHECK(uniform_step(gap) == 0);
  CHECK(uniform_step(std::vector<double>{0, 1, 2, 4, 5}) == 0);
  std::vector<double> long_test;
  for (int k = 0; k < 3000000; ++k) long_test.push_back(k / 1000.0);
  CHECK(uniform_step(long_test) == 0.001);
}

TEST_CASE("stamps in single precision are uniform within its resolution") {
  const auto step = [](std::size_t count, double rate, double off) {
    std::vector<double> stamps;
    for (std::size_t k = 0; k < count; ++k)
      stamps.push_back(static_cast<double>(
          static_cast<float>(static_cast<double>(k) / rate + (k == count / 2 ? off : 0))));
    return uniform_step(stamps);
  };
  CHECK(step(2500, 500, 0) == 1 / 500.0);
  CHECK(step(200000, 500, 0) == 1 / 500.0);  // up to 400 s, in steps of 3e-5 s
  CHECK(step(20000, 2000, 0) == 1 / 2000.0);
  CHECK(step(2500, 500, 2e-5) == 0);
}

TEST_CASE("time that does not increase is refused at its line") {
  RawTable table;
  table.file = "run.csv";
  table.lines = {{0, 2}};
  CHECK(message_of([&] {
          require_increasing(std::vector<double>{0, 1, 1}, table);
        }).find("run.csv:4: time 1 is repeated") == 0);
  CHECK(message_of([&] {
          require_increasing(std::vector<double>{0, 1, 0.5}, table);
        }).find("run.csv:4: time runs backwards: 0.5 after 1") == 0);
}

TEST_CASE("where time runs backwards it is told what stands there") {
  // Ten rows, then the rows from `again` on, their times moved by `moved`.
  const auto message = [](std::size_t again, double moved) {
    RawTable table;
    table.file = "run.csv";
    table.lines = {{0, 2}};
    table.columns.resize(1);
    std::vector<double> stamps;
    for (std::size_t k = 0; k < 10; ++k) {
      stamps.push_back(static_cast<double>(k));
      table.columns[0].values.push_back(10 + stamps.back());
    }
    stamps.push_back(static_cast<double>(again) + moved);
    table.columns[0].values.push_back(10 + static_cast<double>(again));
    return message_of([&] { require_increasing(stamps, table); });
  };
  CHECK(contains(message(0, 0), "another recording seems to begin; time must increase: give each"));
  CHECK(
      contains(message(6, 0), "the row is that of run.csv:8 again; time must increase: leave out"));
  CHECK(
      contains(message(6, 0.5), "runs backwards: 6.5 after 9; time must increase: sort the rows"));
}

TEST_CASE("samples that are missing are counted where nothing else is uneven") {
  std::vector<double> stamps;
  for (int k = 0; k < 100; ++k)
    if (k != 20 && k != 21 && k != 60) stamps.push_back(k / 200.0);
  const LostSamples lost = lost_samples(stamps);
  CHECK(lost.samples == 3);
  CHECK(lost.places == 2);
  CHECK(describe(lost) ==
        "3 samples are missing in 2 places by the time stamps, the first behind "
        "0.095 s");
  stamps[50] += 0.001;
  CHECK(lost_samples(stamps).places == 0);
}

TEST_CASE("resampling interpolates linearly") {
  Record record;
  record.time = {0, 0.1, 0.4, 1};
  record.channels = {{"force", "N", {0, 1, 4, 10}, ""}};  // 10 t
  resample(record, 5);
  REQUIRE(record.size() == 6);
  CHECK(record.sample_time == 0.2);
  for (std::size_t k = 0; k < 6; ++k)
    CHECK_CLOSE(record.channels[0].samples[k], 2.0 * static_cast<double>(k), 0, 1e-12);
}

TEST_CASE("rest at both ends is found, and turning points are not rest") {
  std::vector<double> time, motion;
  for (int k = 0; k < 1000; ++k) {
    time.push_back(k * 0.01);
    motion.push_back(k < 200 || k >= 700 ? 0 : std::sin(2 * M_PI * (k - 200) * 0.01));
  }
  const auto [first, last] = moving_part(time, motion);
  CHECK(first >= 200);
  CHECK(first <= 202);
  CHECK(last >= 698);
  CHECK(last <= 700);
  std::vector<double> cosine;
  for (int k = 0; k < 1000; ++k) cosine.push_back(std::cos(2 * M_PI * k * 0.01));
  CHECK(moving_part(time, cosine) == std::pair<std::size_t, std::size_t>{0, 1000});
}
