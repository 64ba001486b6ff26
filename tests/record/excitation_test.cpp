#include "dashpot/record/excitation.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "dashpot/numerics/spectrum.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr double kStep = 1e-3;  // s

std::vector<MotionPoint> sampled(const PistonMotion& motion) {
  std::vector<MotionPoint> points;
  for (double t = 0; t <= motion.duration; t += kStep) points.push_back(motion.at(t));
  return points;
}

std::vector<double> displacement_of(const std::vector<MotionPoint>& points) {
  std::vector<double> x;
  for (const MotionPoint& point : points) x.push_back(point.displacement);
  return x;
}

/// Share of the motion's power between low and high Hz.
double share_within(const PistonMotion& motion, double low, double high) {
  const PowerSpectrum spectrum = power_spectrum(displacement_of(sampled(motion)), kStep);
  double inside = 0, all = 0;
  for (std::size_t k = 0; k < spectrum.power.size(); ++k) {
    const double f = spectrum.spacing_hz * static_cast<double>(k);
    all += spectrum.power[k];
    if (f >= low && f <= high) inside += spectrum.power[k];
  }
  return inside / all;
}

double variance(const std::vector<double>& x) {
  double sum = 0, squares = 0;
  for (const double value : x) sum += value, squares += value * value;
  const auto n = static_cast<double>(x.size());
  return squares / n - sum * sum / (n * n);
}

std::vector<double> sampled(const DriveSignal& drive, double duration, double step) {
  std::vector<double> values;
  for (double t = step / 2; t < duration; t += step) values.push_back(drive.at(t));
  return values;
}

struct Limits {
  const char* text;
  double amplitude, speed;
};

}  // namespace

TEST_CASE(
    "every motion starts at rest, stays within amplitude and speed, and its velocity is its "
    "slope") {
  for (const Limits& limits :
       {Limits{"AM", 0.025, 1.5}, Limits{"FM", 0.025, 1.5}, Limits{"RP", 0.025, 1.5},
        Limits{"SFS", 0.025, 1.5}, Limits{"TPNVS", 0.025, 1},
        // the limit of speed binds
        Limits{"AM,carrier=14,modulation=1,depth=0.4", 0.025, 1.5},
        Limits{"FM,speed_max=0.3", 0.025, 0.3},
        Limits{"RP,speed_max=0.1,roughness=0.004", 0.025, 0.1},
        Limits{"SFS,speed_max=0.2", 0.025, 0.2},
        Limits{"TPNVS,speed_max=5,speed_min=0.5", 0.025, 5},
        // the limit of displacement binds
        Limits{"RP,amplitude=5mm", 0.005, 1.5},
        Limits{"FM,amplitude=2mm,modulation=0.5", 0.002, 1.5}}) {
    CAPTURE(std::string(limits.text));
    const PistonMotion motion = make_motion(limits.text, 3);
    CHECK_CLOSE(motion.at(0).velocity, 0, 0, 1e-12);
    double most_x = 0, most_v = 0, worst = 0;
    for (double t = kStep; t < motion.duration - kStep; t += 0.37 * kStep) {
      constexpr double kNear = 1e-6;
      const MotionPoint here = motion.at(t);
      most_x = std::max(most_x, std::abs(here.displacement));
      most_v = std::max(most_v, std::abs(here.velocity));
      const double slope =
          (motion.at(t + kNear).displacement - motion.at(t - kNear).displacement) / (2 * kNear);
      worst = std::max(worst, std::abs(slope - here.velocity));
    }
    CHECK(most_x <= limits.amplitude * (1 + 1e-12));
    CHECK(most_v <= limits.speed * (1 + 1e-12));
    // it uses what it is given
    CHECK((most_x > 0.99 * limits.amplitude || most_v > 0.9 * limits.speed));
    // rounding: 1e-17 m over 1e-6 s; bends of 60 m/s^2 at the turns over 1e-6 s
    CHECK(worst < 1e-4);
  }
}

TEST_CASE("every motion stays within its band") {
  // the rest are side bands of changes that are quick beside 0.5 Hz
  CHECK(share_within(make_motion("AM", 1), 1.85, 2.15) > 0.9999);
  CHECK(share_within(make_motion("FM", 1), 0.4, 15.2) > 0.99);
  CHECK(share_within(make_motion("RP", 1), 0.45, 15.05) > 0.9999);
  CHECK(share_within(make_motion("SFS", 1), 0.2, 15.5) > 0.998);
  CHECK(share_within(make_motion("TPNVS", 1), 0.2, 25) > 0.999);  // a triangle has harmonics
}

TEST_CASE("AM: closed form") {
  const PistonMotion motion =
      make_motion("AM,amplitude=10 mm,carrier=3,modulation=0.25,depth=0.5", 1);
  // at t = 2 the modulation is at its most; at t = 1 halfway
  CHECK_CLOSE(motion.at(2).displacement, -0.01, 1e-12, 0);
  CHECK_CLOSE(motion.at(1).displacement, -0.01 / 1.5, 1e-12, 0);
  CHECK_CLOSE(motion.at(0).displacement, -0.01 * 0.5 / 1.5, 1e-12, 0);
}

TEST_CASE("FM: the frequency between zero crossings goes from the least to the greatest and back") {
  const PistonMotion motion =
      make_motion("FM,frequency_min=2,frequency_max=10,modulation=0.1,duration=10", 1);
  std::vector<double> crossings;
  for (double t = kStep; t < motion.duration; t += kStep) {
    const double before = motion.at(t - kStep).displacement, now = motion.at(t).displacement;
    if (before < 0 && now >= 0) crossings.push_back(t - kStep * now / (now - before));
  }
  CHECK(crossings.size() == 60);  // mean 6 Hz over 10 s
  for (std::size_t k = 1; k < crossings.size(); ++k) {
    const double middle = 0.5 * (crossings[k] + crossings[k - 1]);
    CHECK_CLOSE(1 / (crossings[k] - crossings[k - 1]), 6 - 4 * std::cos(2 * M_PI * 0.1 * middle),
                0.02, 0);
  }
}

TEST_CASE("SFS: whole periods at each frequency, as fast as allowed and no faster") {
  const PistonMotion motion =
      make_motion("SFS,frequency_min=1,frequency_max=13,step=6,hold=0.5,repeats=2", 1);
  // 1, 7, 13 Hz: 1, 4 and 7 full periods and one to come and go
  const double pass = 2 / 1.0 + 5 / 7.0 + 8 / 13.0;
  CHECK_CLOSE(motion.duration, 2 * pass, 1e-12, 0);
  CHECK_CLOSE(motion.at(0.75).displacement, -0.025, 1e-12, 0);
  const double third = 2 + 5 / 7.0;
  CHECK_CLOSE(motion.at(third + 1.25 / 13).displacement, 1.5 / (2 * M_PI * 13), 1e-12, 0);
  CHECK_CLOSE(motion.at(third + 2 / 13.0).velocity, 1.5, 1e-12, 0);
  CHECK_CLOSE(motion.at(pass + 0.75).displacement, -0.025, 1e-12, 0);
}

TEST_CASE("TPNVS: constant speeds in equal ratios, up and down") {
  const PistonMotion motion = make_motion("TPNVS,speed_min=0.1,speed_max=0.4,levels=3,cycles=2", 1);
  double begin = 0;
  for (const double speed : {0.1, 0.2, 0.4})
    for (int cycle = 0; cycle < 2; ++cycle)
      for (const double side : {1.0, -1.0}) {
        const double length = 0.05 / speed + speed / 60;
        CHECK_CLOSE(motion.at(begin).displacement, -side * 0.025, 0, 1e-12);
        for (const double share : {0.3, 0.5, 0.7})
          CHECK_CLOSE(motion.at(begin + share * length).velocity, side * speed, 1e-12, 0);
        begin += length;
      }
  CHECK_CLOSE(motion.duration, begin, 1e-12, 0);
}

TEST_CASE("RP: the power is that of the road through the car") {
  // TC-3.6b: c = 2280, 5 Hz: |sprung acceleration / road| = 334.235181; m_s a = (k + c s)
  // deflection
  const double gain = 387 * 334.235181 / std::hypot(37300, 2280 * 2 * M_PI * 5);
  // over a narrow band, class D at 20 m/s: G_d n0^2 v / f^2
  const PistonMotion motion = make_motion(
      "RP,damping=2280,frequency_min=4.75,frequency_max=5.25,duration=300,amplitude=1", 1);
  const double expected = 1.024e-3 * 0.01 * 20 / 25 * gain * gain * 0.5;
  CHECK_CLOSE(variance(displacement_of(sampled(motion))), expected, 0.06, 0);
}

TEST_CASE("the same seed gives the same road, another one another road") {
  const MotionPoint once = make_motion("RP", 7).at(12.3), again = make_motion("RP", 7).at(12.3);
  CHECK(once.displacement == again.displacement);
  CHECK(once.velocity == again.velocity);
  CHECK(once.displacement != make_motion("RP", 8).at(12.3).displacement);
}

TEST_CASE("PRBS7: TC-9.1") {
  const std::vector<bool> bits = maximum_length_bits(7, 0x7f, 127);
  std::string first;
  for (std::size_t k = 0; k < 32; ++k) first += bits[k] ? '1' : '0';
  CHECK(first == "11111110000001000001100001010001");
  CHECK(std::ranges::count(bits, true) == 64);
}

TEST_CASE("maximum-length sequences of every order: period, balance and autocorrelation") {
  for (int order = 3; order <= 16; ++order) {
    CAPTURE(order);
    const std::size_t period = (std::size_t{1} << order) - 1;
    const std::vector<bool> bits = maximum_length_bits(order, 1, 2 * period);
    CHECK(std::equal(bits.begin(), bits.begin() + static_cast<std::ptrdiff_t>(period),
                     bits.begin() + static_cast<std::ptrdiff_t>(period)));
    CHECK(static_cast<std::size_t>(
              std::count(bits.begin(), bits.begin() + static_cast<std::ptrdiff_t>(period), true)) ==
          (period + 1) / 2);
    for (const std::size_t shift : {std::size_t{1}, std::size_t{3}, period / 3, period / 2}) {
      long sum = 0;  // of +-1 times +-1: -1 at every shift of a maximum-length sequence
      for (std::size_t k = 0; k < period; ++k) sum += bits[k] == bits[k + shift] ? 1 : -1;
      CHECK(sum == -1);
    }
  }
  CHECK(message_of([] { maximum_length_bits(17, 1, 1); }).find("3 to 16") != std::string::npos);
  CHECK(message_of([] { maximum_length_bits(7, 0x80, 1); }).find("starts empty") !=
        std::string::npos);
}

TEST_CASE("PRBS: two levels, the clock, the seed") {
  const DriveFrame frame{.low = 0.5, .high = 2, .duration = 127 * 0.1, .seed = 5};
  const std::vector<double> values =
      sampled(make_drive("prbs,order=7,clock=100ms", frame), frame.duration, 0.1);
  CHECK(values.size() == 127);
  CHECK(std::ranges::count(values, 2.0) == 64);
  CHECK(std::ranges::count(values, 0.5) == 63);
  CHECK(values == sampled(make_drive("PRBS,order=7,clock=0.1", frame), frame.duration, 0.1));
  DriveFrame other = frame;
  other.seed = 6;
  CHECK(values != sampled(make_drive("PRBS,order=7,clock=0.1", other), frame.duration, 0.1));
}

TEST_CASE("APRBS: switches where PRBS does, to levels over the whole range") {
  const DriveFrame frame{.duration = 511 * 0.05, .seed = 5};
  const std::vector<double> binary = sampled(make_drive("PRBS", frame), frame.duration, 0.05);
  const std::vector<double> values = sampled(make_drive("APRBS", frame), frame.duration, 0.05);
  REQUIRE(values.size() == 511);
  for (std::size_t k = 1; k < values.size(); ++k)
    CHECK((values[k] == values[k - 1]) == (binary[k] == binary[k - 1]));
  const auto [low, high] = std::ranges::minmax(values);
  CHECK(low >= 0);
  CHECK(low < 0.1);
  CHECK(high <= 2.5);
  CHECK(high > 2.4);
}

TEST_CASE("ICPS: the k-th level lasts k clocks") {
  const DriveFrame frame{.duration = 0.01 * 2016, .seed = 9};  // 1 + 2 + ... + 63
  const std::vector<double> values =
      sampled(make_drive("ICPS,clock=0.01", frame), frame.duration, 0.01);
  std::set<double> levels;
  std::size_t k = 0;
  for (std::size_t clocks = 1; clocks <= 63; ++clocks)
    for (std::size_t tick = 0; tick < clocks; ++tick, ++k) {
      CHECK(values.at(k) == values[k - tick]);
      levels.insert(values[k]);
    }
  CHECK(levels.size() == 63);
  CHECK(*levels.begin() >= 0);
  CHECK(*levels.rbegin() < 2.5);
  // uniform: mean 1.25, standard deviation of the mean of 63: 0.09
  CHECK_CLOSE(std::accumulate(levels.begin(), levels.end(), 0.0) / 63, 1.25, 0, 0.36);
}

TEST_CASE("SC: the paper's ten and two levels over the whole duration; a hold begins again") {
  const DriveFrame frame{.duration = 20};
  const DriveSignal ten = make_drive("SC", frame), two = make_drive("SC,levels=2", frame);
  for (int k = 0; k < 10; ++k) CHECK_CLOSE(ten.at(2 * k + 1), 2.5 * k / 9, 1e-12, 0);
  for (double duration = 1; duration < 3; duration += 0.001)  // however it is rounded
    CHECK(make_drive("SC", {.duration = duration}).at(duration) == 2.5);
  CHECK(two.at(9.9) == 0);
  CHECK(two.at(10) == 2.5);
  const DriveSignal again = make_drive("SC,levels=3,hold=1", frame);
  CHECK(sampled(again, 5, 1) == std::vector<double>{0, 1.25, 2.5, 0, 1.25});
}

TEST_CASE("a sequence says what it is, in SI") {
  CHECK(make_motion("tpnvs, amplitude = 10 mm", 1).description ==
        "TPNVS: amplitude 0.01 m, speed_min 0.05 m/s, speed_max 1 m/s, levels 8, cycles 1, "
        "acceleration 60 "
        "m/s^2, repeats 1");
  CHECK(make_drive("ICPS", {}).description == "ICPS: clock 0.02 s");
}

TEST_CASE("a sequence that cannot be understood is refused with what would be right") {
  const auto motion = [](const std::string& text) {
    return message_of([&] { make_motion(text, 1); });
  };
  CHECK(motion("AN") ==
        "motion: unknown sequence 'AN'; did you mean 'AM'? known: AM, FM, RP, SFS, TPNVS");
  CHECK(motion("AM,carier=2").find("did you mean 'carrier'") != std::string::npos);
  CHECK(motion("AM,carrier").find("write NAME=VALUE") != std::string::npos);
  CHECK(motion("AM,carrier=fast").find("carrier: 'fast' is not a number; a number in Hz") !=
        std::string::npos);
  CHECK(motion("AM,carrier=2 mm").find("carrier: 'mm' is not a unit of it; it is counted in Hz") !=
        std::string::npos);
  CHECK(motion("AM,amplitude=25").find("amplitude is 25 m; between 1e-06 and 1") !=
        std::string::npos);
  CHECK(motion("FM,frequency_min=9,frequency_max=3").find("ends below") != std::string::npos);
  CHECK(motion("RP,frequency_min=9,frequency_max=3").find("not below") != std::string::npos);
  CHECK(motion("TPNVS,speed_min=3").find("speed_min is above") != std::string::npos);
  CHECK(motion("TPNVS,levels=2.5") == "motion: levels is 2.5; a whole number");
  CHECK(motion("SFS,step=0.001").find("a larger step") != std::string::npos);
  const auto drive = [](const std::string& text) {
    return message_of([&] { make_drive(text, {}); });
  };
  CHECK(drive("PRSB").find("did you mean 'PRBS'") != std::string::npos);
  CHECK(drive("PRBS,order=20").find("between 3 and 16") != std::string::npos);
  CHECK(drive("ICPS,clock=0.000001").find("clock is 1e-06 s") != std::string::npos);
}
