#include "dashpot/record/characterise.h"

#include <numbers>
#include <random>

#include "dashpot/base/random.h"
#include "dashpot/numerics/filter.h"
#include "dashpot/record/cycle_figures.h"
#include "dashpot/record/differentiate.h"
#include "support.h"

using namespace dashpot;

namespace {

/// A virtual damper whose truth is of another structure than the estimators': valves that open with
/// a soft maximum, unlike in both directions, a polytropic gas spring, and friction that saturates
/// within 0.3 mm/s.
struct Truth {
  double friction = 40;                                 // N
  double knee_rebound = 0.12, knee_compression = 0.09;  // m/s
  double below = 5000, above = 900;                     // N*s/m
  double asymmetry = 0.7;                               // compression over rebound
  double gas = 180, column = 0.09;                      // N at mid stroke; m of gas behind it
  double field = 0;                                     // N, per current at any speed
  double bend = 0.1;                                    // of the knee, width of its soft maximum

  double rate() const { return gas / column; }  // N/m, of p V = constant, at mid stroke

  double valves(double v, double knee) const {
    const double width = bend * knee;
    const auto soft = [&](double u) { return width * std::log1p(std::exp(u / width)); };
    return below * v - (below - above) * (soft(v - knee) - soft(-knee));
  }
  double force(double x, double v) const {
    const double resisting =
        v >= 0 ? valves(v, knee_rebound) : -asymmetry * valves(-v, knee_compression);
    return resisting + (friction + field) * std::tanh(v / 0.0003) - gas * column / (column + x);
  }
};

/// A record as a dyno gives it: force through a second-order low-pass of 200 Hz, noise in force and
/// displacement, the velocity derived as load_dataset derives it.
Record dyno_record(const Truth& truth, const std::vector<double>& frequencies, double amplitude,
                   int cycles, double noise, unsigned seed, const std::string& name = "run",
                   double current = 0) {
  constexpr double kStep = 1.0 / 2000;
  Record record;
  record.name = name;
  record.drive_level = current;
  record.sample_time = kStep;
  Channel x{"displacement", "m", {}, ""}, f{"force", "N", {}, ""};
  std::vector<double> exact;
  double phase = -std::numbers::pi / 2 - 2 * std::numbers::pi * 0.1, time = 0;
  for (const double hz : frequencies)
    for (double done = 0; done < 2 * std::numbers::pi * cycles;
         done += 2 * std::numbers::pi * hz * kStep) {
      phase += 2 * std::numbers::pi * hz * kStep;
      x.samples.push_back(amplitude * std::sin(phase));
      exact.push_back(truth.force(amplitude * std::sin(phase),
                                  amplitude * 2 * std::numbers::pi * hz * std::cos(phase)));
      record.time.push_back(time);
      time += kStep;
    }

  // The load cell's filter, and noise as a share of the span.
  f.samples = filter_zero_phase(butterworth_lowpass(2, 200, kStep), exact);
  const auto [least, greatest] = std::ranges::minmax(f.samples);
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  for (double& sample : f.samples) sample += noise * (greatest - least) / 2 * normal(generator);
  for (double& sample : x.samples) sample += 0.0002 * amplitude * normal(generator);
  record.channels = {x, f};
  record.channels.push_back(
      {"velocity", "m/s",
       differentiate_zero_phase(x.samples, kStep, choose_cutoff_hz(x.samples, kStep)), "derived"});
  return record;
}

Dataset dataset_of(std::vector<Record> records) {
  Dataset dataset;
  dataset.records = std::move(records);
  return dataset;
}

const std::vector<double> kSpeeds = {0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.65,
                                     0.8,  1,   1.3, 1.6, 2,   2.5};  // Hz, of +- 25 mm

}  // namespace

TEST_CASE("a multi-speed file gives knee, friction, gas force and its rate within 2 %" *
          doctest::test_suite("long")) {
  const Truth truth;
  for (const double noise : {0.005, 0.01})
    for (const unsigned seed : {1u, 2u}) {
      CAPTURE(noise);
      CAPTURE(seed);
      const Characterisation all =
          characterise(dataset_of({dyno_record(truth, kSpeeds, 0.025, 4, noise, seed)}));
      REQUIRE(all.levels.size() == 1);
      const LevelFigures& level = all.levels.front();
      CHECK(level.basis == "speeds");
      CHECK_CLOSE(level.rebound.knee.value, truth.knee_rebound, 0.02, 0);
      CHECK_CLOSE(level.compression.knee.value, truth.knee_compression, 0.02, 0);
      CHECK_CLOSE(level.friction.value, truth.friction, 0.02, 0);
      CHECK_CLOSE(level.static_force.value, truth.gas, 0.02, 0);
      CHECK_CLOSE(level.rate.value, truth.rate(), 0.02, 0);
    }
}

TEST_CASE("levels of the drive: yield force, dynamic range at stated speeds, none beyond them" *
          doctest::test_suite("long")) {
  Truth off, on;
  on.field = 600;
  const Dataset dataset = dataset_of({dyno_record(off, kSpeeds, 0.025, 3, 0.005, 4, "off", 0),
                                      dyno_record(on, kSpeeds, 0.025, 3, 0.005, 5, "on", 1)});
  const Characterisation all = characterise(dataset, {{0.05, 0.2, 1}});
  REQUIRE(all.levels.size() == 2);
  CHECK_CLOSE(all.levels[1].friction.value, on.friction + on.field, 0.02, 0);
  CHECK_CLOSE(all.levels[1].yield.value - all.levels[0].yield.value, on.field, 0.02, 0);

  // 1 m/s was not measured.
  REQUIRE(all.range.size() == 2);
  for (const DynamicRange& range : all.range) {
    const auto damping = [&](const Truth& t) {
      return (t.force(0, range.speed) - t.force(0, -range.speed)) / 2;
    };
    CHECK_CLOSE(range.ratio, damping(on) / damping(off), 0.02, 0);
  }
}

TEST_CASE("energy, equivalent damping and hysteresis of a dashpot are those of the formula") {
  // F = c v exactly: E = pi c w X^2, no hysteresis.
  constexpr double kDamping = 1500, kAmplitude = 0.02, kHz = 1.5;
  Truth dashpot{.friction = 0, .below = kDamping, .above = kDamping, .asymmetry = 1, .gas = 0};
  const Characterisation all =
      characterise(dataset_of({dyno_record(dashpot, {kHz}, kAmplitude, 5, 0, 1)}));
  REQUIRE(all.records.front().cycles.size() >= 4);
  const double w = 2 * std::numbers::pi * kHz;
  for (const CycleFigures& cycle : all.records.front().cycles) {
    CHECK_CLOSE(cycle.equivalent_damping, kDamping, 0.01, 0);
    CHECK_CLOSE(cycle.energy, std::numbers::pi * kDamping * w * kAmplitude * kAmplitude, 0.01, 0);
    CHECK_CLOSE(cycle.hysteresis, 0, 0, 0.01 * kDamping * w * kAmplitude);
    CHECK_CLOSE(cycle.rebound.peak_speed, w * kAmplitude, 0.01, 0);
    CHECK_CLOSE(cycle.stroke, 2 * kAmplitude, 0.005, 0);
  }
  CHECK(all.levels.front().rebound.why_no_knee != "");
}

TEST_CASE("the energy of a cycle is told where the strokes of a speed are alike") {
  // 20 mm at 1 Hz and 10 mm at 2 Hz have one speed: their cycles take unlike energies, and the same
  // damping.
  const Truth truth{.friction = 0, .gas = 0};
  const std::vector<Record> alike{dyno_record(truth, {1}, 0.02, 4, 0, 1, "a"),
                                  dyno_record(truth, {1}, 0.0206, 4, 0, 1, "b")},
      unlike{alike.front(), dyno_record(truth, {2}, 0.01, 4, 0, 1, "c")};
  const SpeedFigures told = characterise(dataset_of(alike)).levels.front().speeds.front();
  CHECK_CLOSE(told.stroke, 0.0406, 0.01, 0);
  CHECK(told.energy > 0);
  const SpeedFigures untold = characterise(dataset_of(unlike)).levels.front().speeds.front();
  CHECK(untold.cycles > told.cycles / 2);
  CHECK(std::isnan(untold.stroke));
  CHECK(std::isnan(untold.energy));
  CHECK_CLOSE(untold.equivalent_damping, told.equivalent_damping, 0.05, 0);

  // Nor between two speeds of unlike strokes.
  const LevelFigures level =
      characterise(dataset_of({alike.front(), dyno_record(truth, {4}, 0.01, 4, 0, 1, "d")}))
          .levels.front();
  REQUIRE(level.speeds.size() == 2);
  CHECK(level.speeds.front().energy > 0);
  CHECK(std::isnan(at_speed(level, 0.18)->energy));
  CHECK(at_speed(level, 0.18)->damping_force > 0);
}

TEST_CASE("force that fades is a drift; over temperature a fade per kelvin; steady force is none") {
  // The force falls by 5 % over the record, and the oil warms by 10 K.
  Record record = dyno_record({.friction = 0, .gas = 0}, {1}, 0.025, 20, 0.002, 6);
  const double length = record.time.back();
  Channel& force = *record.find("force");
  Channel temperature{"temperature", "K", {}, ""};
  for (std::size_t k = 0; k < record.size(); ++k) {
    force.samples[k] *= 1 - 0.05 * record.time[k] / length;
    temperature.samples.push_back(300 + 10 * record.time[k] / length);
  }
  record.channels.push_back(temperature);
  const RecordFigures fading = figures_of_record(record, DriveUnit::Ampere);
  const double share = (fading.cycles.back().start - fading.cycles.front().start) / length;
  CHECK_CLOSE(fading.drift.value, -5 / 0.975 * share, 0.02, 0);
  CHECK_CLOSE(fading.fade.value, -0.5 / 0.975, 0.02, 0);

  const RecordFigures steady =
      figures_of_record(dyno_record({}, {1}, 0.025, 20, 0.005, 7), DriveUnit::Ampere);
  CHECK(std::abs(steady.drift.value) < 3 * steady.drift.error);
  CHECK(!steady.fade.is_told());
  CHECK(steady.repeatability < 1);
}

TEST_CASE("what cannot be told is said: rest, half a cycle, random motion, a rod that stops") {
  const auto remark_of = [](const Record& record) {
    const RecordFigures figures = figures_of_record(record, DriveUnit::Ampere);
    return figures.remarks.empty() ? std::string() : figures.remarks.front();
  };
  const Record whole = dyno_record({}, {1}, 0.025, 3, 0.005, 8);
  CHECK(remark_of(whole).empty());
  CHECK(contains(remark_of(whole.slice(0, 1100)), "no whole cycle"));

  // One turning point that is reached by half: the cycles before and behind it.
  Record half = dyno_record({}, {1}, 0.025, 8, 0.005, 8);
  Channel& stroke = *half.find("displacement");
  for (std::size_t k = 5600; k < 6800; ++k) stroke.samples[k] = std::max(stroke.samples[k], 0.0);
  CHECK(remark_of(half).starts_with(
      "2 cycles left out: the two strokes differ by more than 10 % in length"));

  // Noise about one place.
  Record rest = whole;
  std::mt19937 generator(9);
  std::normal_distribution<double> normal;
  for (double& x : rest.find("displacement")->samples) x = 0.01 + 1e-5 * normal(generator);
  CHECK(contains(remark_of(rest), "at rest"));
  for (double& x : rest.find("displacement")->samples) x = 0.01;
  CHECK(contains(remark_of(rest), "at rest"));

  // A walk of white noise, smoothed.
  Record random = dyno_record({}, {1}, 0.025, 40, 0.005, 10);
  std::vector<double> noise(random.size());
  for (double& sample : noise) sample = normal(generator);
  random.find("displacement")->samples =
      filter_zero_phase(butterworth_lowpass(2, 5, random.sample_time), noise);
  CHECK(contains(remark_of(random), "not cyclic but random"));

  // A pause of a tenth of a second in the middle of each stroke.
  Record stuck = whole;
  for (Channel& channel : stuck.channels) {
    std::vector<double> held;
    for (std::size_t k = 0; k < whole.size(); ++k) {
      held.push_back(channel.samples[k]);
      const auto& v = whole.channel("displacement").samples;
      if (k > 0 && (v[k] > 0.003) != (v[k - 1] > 0.003))
        held.insert(held.end(), 200, channel.name == "velocity" ? 0.0 : channel.samples[k]);
    }
    channel.samples = held;
  }
  stuck.time.clear();
  for (std::size_t k = 0; k < stuck.channels.front().samples.size(); ++k)
    stuck.time.push_back(static_cast<double>(k) * stuck.sample_time);
  CHECK(contains(remark_of(stuck), "the rod stops within"));
}

TEST_CASE("velocity alone: displacement is integrated, and said so" * doctest::test_suite("long")) {
  Record record = dyno_record({}, kSpeeds, 0.025, 4, 0.005, 11);
  std::erase_if(record.channels, [](const Channel& c) { return c.name == "displacement"; });
  const Characterisation all = characterise(dataset_of({record}));
  CHECK(contains(all.records.front().remarks.front(), "integrated"));
  REQUIRE(!all.levels.empty());
  CHECK_CLOSE(all.levels.front().rebound.knee.value, 0.12, 0.05, 0);
}

TEST_CASE("a record without force cannot be characterised") {
  Record record = dyno_record({}, {1}, 0.025, 3, 0, 12);
  std::erase_if(record.channels, [](const Channel& c) { return c.name == "force"; });
  CHECK(contains(message_of([&] { characterise(dataset_of({record})); }), "force"));
}

TEST_CASE("knee: two lines are found again, one line and a progressive curve have none") {
  std::vector<double> v, two, one, progressive;
  for (int k = 1; k <= 12; ++k) {
    const double speed = 0.05 * k;
    v.push_back(speed);
    two.push_back(50 + 2000 * std::min(speed, 0.27) + 300 * std::max(0.0, speed - 0.27));
    one.push_back(50 + 900 * speed + (k % 2 ? 1 : -1));
    progressive.push_back(50 + 900 * speed * speed);
  }
  const KneeFit fit = fit_knee(v, two);
  CHECK_CLOSE(fit.knee.value, 0.27, 1e-3, 0);
  CHECK_CLOSE(fit.at_rest.value, 50, 1e-3, 0);
  CHECK_CLOSE(fit.yield.value, 50 + 1700 * 0.27, 1e-3, 0);
  CHECK_CLOSE(fit.slope_above, 300, 1e-2, 0);
  CHECK(contains(fit_knee(v, one).why_no_knee, "one straight line"));
  CHECK(contains(fit_knee(v, progressive).why_no_knee, "progressive"));
  CHECK(contains(fit_knee({0.1, 0.2}, {1, 2}).why_no_knee, "fewer than three"));
}

TEST_CASE("knee: beyond the speeds that could show it none is told, and no error of one") {
  std::vector<double> v, slow, fast;
  for (int k = 1; k <= 10; ++k) {
    v.push_back(0.05 * k);
    slow.push_back(500 * std::min(1.0, v.back() / 0.06) + 300 * v.back() + (k % 2 ? 0.1 : -0.1));
    fast.push_back(50 + 2000 * std::min(v.back(), 0.47) + (k % 2 ? 0.1 : -0.1));
  }

  // The line above a slow knee stands; below it, none leads to v = 0.
  const KneeFit below = fit_knee(v, slow);
  CHECK(!below.knee.is_told());
  CHECK(contains(below.why_no_knee, "second slowest speed or below"));
  CHECK_CLOSE(below.yield.value, 500, 0.01, 0);
  CHECK(!below.at_rest.is_told());

  // Above a fast one there is no line: that below it stands.
  const KneeFit above = fit_knee(v, fast);
  CHECK(!above.knee.is_told());
  CHECK(contains(above.why_no_knee, "second fastest speed or above"));
  CHECK_CLOSE(above.at_rest.value, 50, 0.05, 0);
  CHECK(above.yield.value == above.at_rest.value);
}

namespace {

/// Loops of one damper: a knee at 50 mm/s and 500 N above it, each cycle up and down by 10 N and a
/// tenth of its slope, with little else.
struct Loops {
  std::vector<double> speed, force;
  std::vector<std::size_t> ends;
  Loops(int cycles, Random& random) {
    for (int cycle = 0; cycle < cycles; ++cycle) {
      const double zero = 10 * random.normal(), steep = 1 + 0.1 * random.normal();
      for (int k = 1; k <= 48; ++k) {
        const double v = 0.002 * k;
        speed.push_back(v);
        force.push_back(zero + 500 * std::min(1.0, v / 0.05) + 1500 * steep * v + random.normal());
      }
      ends.push_back(speed.size());
    }
  }
};

}  // namespace

TEST_CASE("errors of loops that differ as wholes tell two of one damper apart by chance only" *
          doctest::test_suite("long")) {
  Random random(7);
  int clear = 0, clear_by_points = 0;
  constexpr int kPairs = 30;
  for (int pair = 0; pair < kPairs; ++pair) {
    const Loops a(5, random), b(5, random);
    const auto differ = [](const Measured& one, const Measured& other) {
      return std::abs(one.value - other.value) > 2 * std::hypot(one.error, other.error);
    };
    clear += differ(fit_knee_of_parts(a.speed, a.force, a.ends).yield,
                    fit_knee_of_parts(b.speed, b.force, b.ends).yield);
    clear_by_points += differ(fit_knee(a.speed, a.force).yield, fit_knee(b.speed, b.force).yield);
  }
  CAPTURE(clear);
  CAPTURE(clear_by_points);
  CHECK(clear <= 5);
  CHECK(clear_by_points >= 8);
}

TEST_CASE("what one part alone says, or a knee that comes with one of them, has no error") {
  Random random(8);
  const Loops one(1, random);
  const KneeFit single = fit_knee_of_parts(one.speed, one.force, one.ends);
  CHECK(single.knee.is_told());
  CHECK(single.yield.is_told());
  CHECK(!std::isfinite(single.knee.error));
  CHECK(!std::isfinite(single.yield.error));

  // Four speeds, each of a record: three have no knee.
  const std::vector<double> v{0.01, 0.01, 0.02, 0.02, 0.05, 0.05, 0.1, 0.1};
  std::vector<double> f;
  for (const double speed : v) f.push_back(500 * std::min(1.0, speed / 0.03) + 1000 * speed);
  const KneeFit few = fit_knee_of_parts(v, f, {2, 4, 6, 8});
  CHECK(few.knee.is_told());
  CHECK(!std::isfinite(few.yield.error));
}

TEST_CASE("turning points of a saw with noise below the threshold") {
  const std::vector<double> saw = {0, 1, 2, 3, 2.9, 3.1, 2, 1, 0, -1, 0, 0.9, 0.8, 2};
  CHECK(turning_points(saw, 0.5) == std::vector<std::size_t>{0, 5, 9, 13});
  CHECK(turning_points({1, 1, 1}, 0.5).empty());
}
