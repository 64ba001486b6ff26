#include "dashpot/record/integrate.h"

#include <numbers>

#include "dashpot/base/random.h"
#include "dashpot/dataset.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr double kSampleTime = 0.002;  // s

/// Velocity of a sine of 30 mm, with a zero of its own.
std::vector<double> velocity_of_sine(double hz, double seconds, double zero = 0) {
  std::vector<double> v;
  const double w = 2 * std::numbers::pi * hz;
  for (int k = 0; k < seconds / kSampleTime; ++k)
    v.push_back(0.03 * w * std::cos(w * k * kSampleTime) + zero);
  return v;
}

double greatest_error(const std::vector<double>& x, double hz) {
  double error = 0;
  for (std::size_t k = 0; k < x.size(); ++k)
    error = std::max(error, std::abs(x[k] - 0.03 * std::sin(2 * std::numbers::pi * hz *
                                                            static_cast<double>(k) * kSampleTime)));
  return error;
}

/// Velocity and force as CSV; `row` may change either.
template <class Change>
std::string velocity_csv(double hz, double seconds, const Change& row) {
  std::string text = "t_s,v_m_s,F_N\n";
  const std::vector<double> v = velocity_of_sine(hz, seconds);
  for (std::size_t k = 0; k < v.size(); ++k)
    text += row(static_cast<double>(k) * kSampleTime, v[k]) + "\n";
  return text;
}

std::string as_measured(double t, double v) {
  return std::to_string(t) + "," + std::to_string(v) + "," + std::to_string(900 * v);
}

}  // namespace

TEST_CASE("the integral of a sine's velocity is the sine, whatever the sensor's zero") {
  for (const double zero : {0.0, 0.02, -0.05}) {
    CAPTURE(zero);
    const IntegratedDisplacement found =
        integrate_without_drift(velocity_of_sine(2, 5, zero), kSampleTime);
    CHECK_CLOSE(found.velocity_zero, zero, 0, 1e-4);
    CHECK_CLOSE(found.drift, 5 * std::abs(zero), 0.02, 1e-4);
    CHECK(greatest_error(found.x, 2) < 5e-4);
  }
}

TEST_CASE("a record that ends within a cycle drifts as little") {
  for (const double seconds : {1.6, 2.3, 3.9, 5.25})
    CHECK(greatest_error(integrate_without_drift(velocity_of_sine(2, seconds, 0.03), kSampleTime).x,
                         2) < 2e-3);
}

TEST_CASE("a zero that wanders is removed where the record is long enough to tell it from motion") {
  // The zero swings by 2 mm/s within 60 s: integrated alone that is 19 mm to either side.
  std::vector<double> v = velocity_of_sine(2, 60);
  for (std::size_t k = 0; k < v.size(); ++k)
    v[k] += 0.002 * std::cos(2 * std::numbers::pi * static_cast<double>(k) * kSampleTime / 60);
  const IntegratedDisplacement found = integrate_without_drift(v, kSampleTime);
  CHECK(found.highpass_hz > 0);
  CHECK(found.drift > 0.03);
  CHECK(greatest_error(found.x, 2) < 4.5e-3);
  CHECK(contains(describe(found), "and what is slower than"));
}

TEST_CASE("the displacement of a random motion keeps its shape") {
  // Ten sines of unlike frequency and phase: nothing repeats within the record.
  Random random(4);
  std::vector<double> truth(10000), v(truth.size());
  for (int n = 0; n < 10; ++n) {
    const double w = 2 * std::numbers::pi * random.uniform(1, 8), phase = random.uniform(0, 6.28);
    for (std::size_t k = 0; k < truth.size(); ++k) {
      const double t = static_cast<double>(k) * kSampleTime;
      truth[k] += 0.005 * std::sin(w * t + phase);
      v[k] += 0.005 * w * std::cos(w * t + phase);
    }
  }
  const IntegratedDisplacement found = integrate_without_drift(v, kSampleTime);
  double error = 0, power = 0;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    error += std::pow(found.x[k] - truth[k], 2);
    power += std::pow(truth[k], 2);
  }
  CHECK(error < 0.01 * power);
}

TEST_CASE("less than two whole cycles tell nothing of drift") {
  const auto message = [](const std::vector<double>& v) {
    return message_of([&] { integrate_without_drift(v, kSampleTime); });
  };
  CHECK(contains(message(velocity_of_sine(2, 0.9)), "only 1 whole cycle"));
  CHECK(contains(message(std::vector<double>(100, 0.3)), "only 0 whole cycles"));
  CHECK(contains(message({}), "only 0 whole cycles"));
}

TEST_CASE("a record without displacement has one integrated, and it is said") {
  const TemporaryFolder folder;
  folder.write("run_1A.csv", velocity_csv(2, 3, as_measured));
  const Dataset dataset = load_dataset({folder.path()});
  const Channel& x = dataset.records.front().channel("displacement");
  CHECK(contains(x.origin, "integrated from velocity"));
  CHECK(greatest_error(x.samples, 2) < 1e-3);
  CHECK(contains(describe(dataset), "displacement integrated from velocity in 1 of 1 records"));
  // What it is called still comes from what was measured.
  CHECK(contains(dataset.records.front().condition, "mm/s"));
}

TEST_CASE("a record that cannot be integrated stays without, with the reason") {
  const TemporaryFolder folder;
  folder.write("short_1A.csv", velocity_csv(2, 0.95, as_measured));
  folder.write("slip_1A.csv", velocity_csv(2, 3, [](double t, double v) {
                 return as_measured(t > 1 ? t + 0.004 : t, v);
               }));
  const Dataset dataset = load_dataset({folder.path()});
  for (const Record& record : dataset.records) CHECK(record.find("displacement") == nullptr);
  const std::string text = describe(dataset);
  CHECK(contains(text, "2 of 2 records have no displacement"));
  CHECK(contains(text, "only 1 whole cycle"));
  CHECK(contains(text, "the time stamps are not uniform"));
}
