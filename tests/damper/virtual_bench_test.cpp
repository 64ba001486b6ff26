#include "dashpot/damper/virtual_bench.h"

#include <algorithm>
#include <numeric>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/registry.h"
#include "support.h"

using namespace dashpot;

namespace {

LawModel viscous() { return LawModel::constant(find_law("bingham"), {5000, 0, 0, 0}); }

BenchOptions clean() {
  BenchOptions options;
  options.motions = {{0.01, 1}};
  options.drive_levels = {0.5};
  options.force_noise = options.displacement_noise = options.force_offset = 0;
  options.force_resolution = options.displacement_resolution = 0;
  return options;
}

double mean(const std::vector<double>& x) {
  return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

}  // namespace

TEST_CASE("without flaws the bench gives the closed form: a sine through a viscous damper") {
  const Dataset data = run_virtual_bench(viscous(), DriveUnit::Ampere, clean());
  REQUIRE(data.records.size() == 1);
  const Record& record = data.records[0];
  CHECK(record.size() == 2001);  // 4 cycles of 1 s at 500 Hz, both ends
  CHECK(record.name == "10 mm 1 Hz, 0.5 A");
  CHECK(record.condition == "10 mm 1 Hz");
  CHECK(record.drive_level == 0.5);
  CHECK(record.channel("current").samples.back() == 0.5);
  const double w = 2 * M_PI;
  for (std::size_t k = 0; k < record.size(); k += 37) {
    const double t = record.time[k], v = 0.01 * w * std::sin(w * t);
    CHECK_CLOSE(record.channel("displacement").samples[k], -0.01 * std::cos(w * t), 0, 1e-15);
    CHECK_CLOSE(record.channel("force").samples[k], 5000 * v, 0, 1e-9);
    if (t > 0.2 && t < 3.8)
      CHECK_CLOSE(record.channel("velocity").samples[k], v, 0, 0.02 * 0.01 * w);
  }
}

TEST_CASE("the flaws are as large as asked for") {
  BenchOptions options = clean();
  options.cycles = 40;
  options.force_noise = 0.01;
  options.force_offset = 30;
  options.force_resolution = 4;
  const Record record = run_virtual_bench(viscous(), DriveUnit::Ampere, options).records[0];
  const Record ideal = run_virtual_bench(viscous(), DriveUnit::Ampere, clean()).records[0];
  const std::vector<double>& force = record.channel("force").samples;
  for (const double f : force) CHECK(f == 4 * std::round(f / 4));
  // over whole cycles the viscous force has mean 0: what is left is the offset that the note tells
  const double offset =
      std::stod(record.notes.at(0).substr(record.notes[0].find_first_of("-0123456789")));
  CHECK(std::abs(offset) < 150);
  CHECK_CLOSE(mean(force), offset, 0, 0.2);
  double squared = 0;
  for (std::size_t k = 0; k < ideal.size(); ++k) {
    const double e = force[k] - offset - ideal.channel("force").samples[k];
    squared += e * e;
  }
  const double noise = 0.01 * 2 * 5000 * 0.01 * 2 * M_PI;  // of the span
  CHECK_CLOSE(std::sqrt(squared / static_cast<double>(ideal.size())),
              std::hypot(noise, 4 / std::sqrt(12.0)), 0.06, 0);
}

TEST_CASE("the whole matrix is run, the same for the same seed") {
  const LawModel damper = viscous();
  const Dataset once = run_virtual_bench(damper, DriveUnit::Volt, {}),
                again = run_virtual_bench(damper, DriveUnit::Volt, {});
  BenchOptions other;
  other.seed = 2;
  const Dataset different = run_virtual_bench(damper, DriveUnit::Volt, other);
  CHECK(once.records.size() == 20);
  CHECK(once.drive_unit == DriveUnit::Volt);
  CHECK(once.notes.at(0).find("\"law\":\"bingham\"") != std::string::npos);
  for (std::size_t k = 0; k < once.records.size(); ++k) {
    CHECK(once.records[k].channel("force").samples == again.records[k].channel("force").samples);
    CHECK(once.records[k].channel("force").samples !=
          different.records[k].channel("force").samples);
    CHECK(once.records[k].find("voltage"));
    CHECK(once.records[k].time.back() >= 1 - 1e-9);
  }
}

TEST_CASE("a bench that cannot run says why") {
  const auto message = [](auto change) {
    BenchOptions options;
    change(options);
    return message_of([&] { run_virtual_bench(viscous(), DriveUnit::Ampere, options); });
  };
  CHECK(message([](BenchOptions& o) { o.motions.clear(); }).find("no motion") != std::string::npos);
  CHECK(message([](BenchOptions& o) { o.motions = {{0.01, 200}}; }).find("200 Hz") !=
        std::string::npos);
  CHECK(message([](BenchOptions& o) { o.sample_rate = 0; }).find("sample rate") !=
        std::string::npos);
  CHECK(message([](BenchOptions& o) { o.sample_rate = 1e12; }).find("at most 1e+08") !=
        std::string::npos);
  CHECK(message_of([] { run_virtual_bench(viscous(), DriveUnit::None, {}); }).find("no drive") !=
        std::string::npos);
}
