#include <cmath>
#include <numbers>

#include "dashpot/base/file.h"
#include "dashpot/suspension/ground/deterministic.h"
#include "dashpot/suspension/ground/earthquake.h"
#include "dashpot/suspension/ground/ground_sequences.h"
#include "dashpot/suspension/ground/road_profile.h"
#include "support.h"

using namespace dashpot;

namespace {

constexpr double kTurn = 2 * std::numbers::pi;

/// One-sided density of x at n cycle/m: power of its Fourier sum over lines around n, Hann windows
/// that overlap by half (Welch).
double density_at(const std::vector<double>& x, double spacing, double n, std::size_t window) {
  double power = 0, squares = 0;
  int windows = 0;
  for (std::size_t k = 0; k < window; ++k)
    squares += std::pow(
        0.5 - 0.5 * std::cos(kTurn * static_cast<double>(k) / static_cast<double>(window)), 2);
  for (std::size_t first = 0; first + window <= x.size(); first += window / 2, ++windows) {
    double re = 0, im = 0;
    for (std::size_t k = 0; k < window; ++k) {
      const double at = static_cast<double>(k);
      const double w = 0.5 - 0.5 * std::cos(kTurn * at / static_cast<double>(window));
      re += w * x[first + k] * std::cos(kTurn * n * spacing * at);
      im += w * x[first + k] * std::sin(kTurn * n * spacing * at);
    }
    power += re * re + im * im;
  }
  return 2 * spacing * power / (squares * windows);
}

/// Density over the class's own, mean of its logarithm over wave numbers, dB.
double deviation_db(const std::vector<double>& z, double spacing, double roughness) {
  double sum = 0;
  int lines = 0;
  for (double n = 0.05; n < 1; n *= 1.1, ++lines)
    sum += 10 * std::log10(density_at(z, spacing, n, 2048) / road_density(roughness, n));
  return sum / lines;
}

double height(const GroundMotion& ground, double t) { return ground.foot(t, 0, 0).height; }

/// The rate is the derivative of the height.
void check_rate(const GroundMotion& ground, double t) {
  const double h = 1e-5, slope = (height(ground, t + h) - height(ground, t - h)) / (2 * h);
  CHECK_CLOSE(ground.foot(t, 0, 0).velocity, slope, 1e-5, 1e-8);
}

}  // namespace

TEST_CASE("a class C road as a sum of cosines: TC-9.2") {
  std::vector<RoadWave> waves;
  const double step = (10 - 0.01) / 1000;
  double power = 0;
  for (int i = 0; i < 1000; ++i) {
    const double n = 0.01 + step * (i + 0.5), golden = 0.6180339887498949 * i;
    waves.push_back({wave_amplitude(256e-6, n, step), n, kTurn * (golden - std::floor(golden))});
    power += 0.5 * waves.back().amplitude * waves.back().amplitude;
  }
  CHECK_CLOSE(height_at(waves, 0), 9.9247617e-3, 1e-8, 0);
  CHECK_CLOSE(height_at(waves, 1), 1.0179912e-2, 1e-8, 0);
  CHECK_CLOSE(height_at(waves, 12.34), 9.6087041e-3, 1e-8, 0);
  CHECK_CLOSE(std::sqrt(power), 1.5462228e-2, 1e-8, 0);
  CHECK_CLOSE(kTurn * 0.1 * std::sqrt(256e-6 * 20), 4.4958814e-2, 1e-8, 0);
}

TEST_CASE("roads of all classes are within 1 dB of their density, by all generators" *
          doctest::test_suite("long")) {
  for (char letter = 'A'; letter <= 'H'; ++letter) {
    CAPTURE(letter);
    const RoadOptions options{.roughness = road_roughness(letter),
                              .length = 1200,
                              .spacing = 0.05,
                              .waves = 1000,
                              .seed = static_cast<std::uint64_t>(letter)};
    CHECK_CLOSE(deviation_db(cosine_road(options).tracks[0], 0.05, options.roughness), 0, 0, 1);
    CHECK_CLOSE(deviation_db(harmonic_road(options).tracks[0], 0.05, options.roughness), 0, 0, 1);
    CHECK_CLOSE(deviation_db(filtered_road(options).tracks[0], 0.05, options.roughness), 0, 0, 1);
  }
  CHECK(road_roughness('A') == 16e-6);
  CHECK(road_roughness('C') == 256e-6);
  CHECK_CLOSE(road_roughness('H'), 262144e-6, 1e-12, 0);
}

TEST_CASE("left and right agree in long waves, not in short ones, and are as rough") {
  const RoadOptions options{.length = 3000, .spacing = 0.05, .waves = 1500, .track_width = 1.5};
  RoadProfile road;
  SUBCASE("sum of cosines") { road = cosine_road(options); }
  SUBCASE("sum of harmonics") { road = harmonic_road(options); }
  REQUIRE(road.tracks.size() == 2);
  std::vector<double> apart;
  for (std::size_t k = 0; k < road.tracks[0].size(); ++k)
    apart.push_back(road.tracks[0][k] - road.tracks[1][k]);
  CHECK_CLOSE(deviation_db(road.tracks[1], 0.05, options.roughness), 0, 0, 1);
  // Density of the difference over twice that of a track: 1 - coherence, 1 - x K_1(x) with x = 2 pi
  // n t: 0.0158 at n = 0.012, and all but 1 at n = 1.
  CHECK(density_at(apart, 0.05, 0.02, 4096) < 0.2 * road_density(256e-6, 0.02));
  CHECK_CLOSE(density_at(apart, 0.05, 1, 4096) / (2 * road_density(256e-6, 1)), 1, 0.35, 0);
}

TEST_CASE("the same seed gives the same road, another one another") {
  const RoadOptions options{.length = 100};
  RoadOptions other = options;
  other.seed = 2;
  CHECK(cosine_road(options).tracks == cosine_road(options).tracks);
  CHECK(cosine_road(options).tracks != cosine_road(other).tracks);
  CHECK(filtered_road(options).tracks != filtered_road(other).tracks);
}

TEST_CASE("a road met at several instants at once is that met one by one, to the bit") {
  const GroundPointer ground =
      drive_over(cosine_road({.length = 10, .spacing = 0.05, .track_width = 1.5}), 7);
  for (const std::size_t count : {1, 4, 5, 11}) {
    std::vector<double> t;
    for (std::size_t k = 0; k < count; ++k) t.push_back(-0.1 + 0.17 * static_cast<double>(k));
    std::vector<FootMotion> feet(count);
    ground->feet_at(t, 1, 2.5, feet);
    for (std::size_t k = 0; k < count; ++k) {
      const FootMotion alone = ground->foot(t[k], 1, 2.5);
      CHECK(feet[k].height == alone.height);
      CHECK(feet[k].velocity == alone.velocity);
    }
  }
}

TEST_CASE("chirps and bump: TC-9.3") {
  const GroundPointer linear = make_ground("chirp", 1),
                      exponential = make_ground("exponential_chirp", 1);
  const double t[] = {1, 7.3, 29.9};
  const double expected[] = {-0.01782013, -0.0038401627, -4.0837866e-4};
  const double expected_exponential[] = {-0.0039991681, -0.01056263, -0.011447506};
  for (int k = 0; k < 3; ++k) {
    CHECK_CLOSE(height(*linear, t[k]), expected[k], 1e-7, 0);
    CHECK_CLOSE(height(*exponential, t[k]), expected_exponential[k], 1e-7, 0);
    check_rate(*linear, t[k]);
    check_rate(*exponential, t[k]);
  }
  const GroundPointer bump = make_ground("bump,height=8cm,length=3m,speed=10,at=0", 1);
  CHECK_CLOSE(height(*bump, 0.05), 0.02, 1e-12, 0);
  CHECK_CLOSE(height(*bump, 0.15), 0.08, 1e-12, 0);
  CHECK_CLOSE(height(*bump, 0.25), 0.02, 1e-12, 0);
  CHECK(height(*bump, 0.31) == 0);
  check_rate(*bump, 0.07);
  CHECK_CLOSE(bump->foot(0.25, 0, 1).height, height(*bump, 0.15), 1e-12, 0);
}

TEST_CASE(
    "a road driven over begins level, comes later to the rear, and its rate is its height's") {
  const GroundPointer road =
      make_ground("iso8608,class=d,speed=36km/h,length=200,track_width=1.5", 3);
  CHECK(height(*road, 0) == 0);
  CHECK_CLOSE(road->foot(5.27, 0, 2.7).height, road->foot(5, 0, 0).height, 0, 1e-12);
  CHECK(road->foot(5, 1, 0).height != road->foot(5, 0, 0).height);
  for (const double t : {0.3, 3.001, 12.34}) check_rate(*road, t);
  CHECK(road->duration() > 19.9);
  CHECK(make_ground("step,height=3cm,at=1", 1)->jumps(0) == std::vector<double>{1});
}

TEST_CASE("the measured road and the earthquakes can be read") {
  const auto folder = shared_data("road");
  if (folder.empty()) return;
  const RoadProfile road = load_road(folder / "i76_eastbound_left.txt", "ft", "in");
  CHECK(road.tracks.size() == 2);
  CHECK_CLOSE(road.length(), 760, 0.05, 0);
  CHECK_CLOSE(road.spacing, 0.025, 0.01, 0);
  double top = 0;
  for (const double z : road.tracks[0]) top = std::max(top, std::abs(z));
  CHECK(top < 1);
  const auto shaking = shared_data("earthquake");
  const GroundPointer quake = load_earthquake(shaking / "el_centro_g.dat", "g0", 0.2);
  double peak = 0;
  for (double t = 0; t < quake->duration(); t += 0.002)
    peak = std::max(peak, std::abs(quake->acceleration(t)));
  CHECK_CLOSE(peak / 9.80665, 0.348737, 1e-3, 0);
  CHECK(load_earthquake(shaking / "kobe.mat")->duration() > 10);
}

TEST_CASE("recorded ground is read in the unit that its column names") {
  const TemporaryFolder folder;
  const auto peak_of = [&](const std::string& text, std::string_view unit = "") {
    write_file(folder.path() / "quake.csv", text);
    const GroundPointer quake = load_earthquake(folder.path() / "quake.csv", unit);
    CHECK_CLOSE(quake->duration(), 0.04, 1e-9, 0);
    return quake->acceleration(0.02);
  };
  constexpr double kHalf = 0.5 * 9.80665;
  CHECK_CLOSE(peak_of("time (s),acc (g)\n0,0\n0.02,0.5\n0.04,0\n"), kHalf, 1e-9, 0);
  CHECK_CLOSE(peak_of("time [ms],acc [mg]\n0,0\n20,500\n40,0\n"), kHalf, 1e-9, 0);
  CHECK_CLOSE(peak_of("t_s,a_g0\n0,0\n0.02,0.5\n0.04,0\n"), kHalf, 1e-9, 0);
  CHECK_CLOSE(peak_of("time,acc\ns,cm/s^2\n0,0\n0.02,50\n0.04,0\n"), 0.5, 1e-9, 0);
  CHECK_CLOSE(peak_of("time (s),acc (gal)\n0,0\n0.02,50\n0.04,0\n"), 0.5, 1e-9, 0);
  CHECK_CLOSE(peak_of("time (s),acc\n0,0\n0.02,0.5\n0.04,0\n"), 0.5, 1e-9, 0);
  CHECK_CLOSE(peak_of("time (s),acc (g)\n0,0\n0.02,0.5\n0.04,0\n", "m/s^2"), 0.5, 1e-9, 0);

  // The result says how strong it was, and what nobody stated.
  const auto described = [&](const std::string& head) {
    write_file(folder.path() / "quake.csv", head + "\n0,0\n0.02,0.5\n0.04,0\n");
    return load_earthquake(folder.path() / "quake.csv")->description();
  };
  CHECK(described("t,acc (g)") == "quake.csv, greatest acceleration 4.9 m/s^2, time scale 1");
  CHECK(described("t,acc").find("taken as m/s^2") != std::string::npos);

  // What cannot be meant is refused.
  const auto refused = [&](const std::string& text) {
    write_file(folder.path() / "quake.csv", text);
    return message_of([&] { load_earthquake(folder.path() / "quake.csv"); });
  };
  CHECK(refused("t (s),z (mm)\n0,0\n0.02,1\n0.04,0\n").find("an acceleration") !=
        std::string::npos);
  CHECK(refused("t,acc\n0,0\n20,1\n40,0\n").find("no seconds") != std::string::npos);
  CHECK(refused("t,ax (g),ay (g)\n0,0,0\n0.02,1,2\n0.04,0,0\n").find("has 3 columns") !=
        std::string::npos);

  // Roads alike.
  for (const std::string_view head : {"s [m],z [mm]", "s_m,z_mm", "s (m),z (mm)"}) {
    write_file(folder.path() / "road.csv", std::string(head) + "\n0,0\n1,20\n2,0\n");
    const RoadProfile road = load_road(folder.path() / "road.csv");
    CHECK_CLOSE(road.tracks[0][1], 0.02, 1e-9, 0);
    CHECK(road.description.find("heights over 20 mm") != std::string::npos);
  }

  // Brackets within brackets belong to the name; the unit stands in the last ones.
  write_file(folder.path() / "road.csv",
             "(Profile 1 (Gocator2342)) - Distance (ft),(Profile 1 (Gocator2342)) - Height (in)\n"
             "0,0\n1,1\n2,0\n");
  const RoadProfile feet = load_road(folder.path() / "road.csv");
  CHECK_CLOSE(feet.spacing, 0.3048, 1e-12, 0);
  CHECK_CLOSE(feet.tracks[0][1], 0.0254, 1e-12, 0);

  write_file(folder.path() / "road.csv", "s,z\n0,0\n1,0.02\n2,0\n");
  CHECK(load_road(folder.path() / "road.csv").description.find("taken as m)") != std::string::npos);

  // Tracks have labels; what may have been meant as a unit is refused with its column.
  write_file(folder.path() / "road.csv",
             "s_A,height_A,s_B,height_B\n0,0,0,0\n1,0.02,1,0.01\n2,0,2,0\n");
  const RoadProfile tracks = load_road(folder.path() / "road.csv");
  CHECK(tracks.tracks[1][1] == 0.01);
  CHECK(tracks.description.find("its column 'height_A' names no unit: taken as m)") !=
        std::string::npos);
  write_file(folder.path() / "road.csv", "s_m,height_kg\n0,0\n1,0.02\n2,0\n");
  CHECK(message_of([&] { load_road(folder.path() / "road.csv"); })
            .find("'height_kg' is counted in 'kg'; a length: m, mm, ft or in, there or as "
                  "height_unit=mm") != std::string::npos);
}

TEST_CASE("no point of a measured road is lost where its steps are uneven") {
  // A bump of 12 mm between two points 2.5 and 3 m along; the mean step of 6 m strode over it.
  const TemporaryFolder folder;
  write_file(folder.path() / "road.csv", "s [m],z [mm]\n0,0\n1,10\n2.5,12\n3,-5\n30,0\n");
  const RoadProfile road = load_road(folder.path() / "road.csv");
  CHECK_CLOSE(road.length(), 30, 1e-9, 0);
  CHECK_CLOSE(road.spacing, 0.125, 1e-9, 0);
  CHECK_CLOSE(road.tracks[0][8], 0.01, 1e-9, 0);
  CHECK_CLOSE(road.tracks[0][20], 0.012, 1e-9, 0);
  CHECK_CLOSE(road.tracks[0][24], -0.005, 1e-9, 0);
  CHECK(road.description.find("30 m, heights over 17 mm") != std::string::npos);

  // The finer track serves both.
  write_file(folder.path() / "two.csv", "s_A,z_A,s_B,z_B\n0,0,0,0\n1,0,0.2,0.01\n2,0,2,0\n");
  CHECK_CLOSE(load_road(folder.path() / "two.csv").spacing, 0.05, 1e-9, 0);

  // A track that ends early, goes on or begins elsewhere would be cut, extended or shifted.
  for (const char* other :
       {"0,0\n1,0,0.5,0\n2,0,1,0\n3,0,1.5,0\n4,0,2,0\n",
        "0,0\n1,0,5,0\n2,0,10,0\n3,0,15,0\n4,0,20,0\n", "9,0\n1,0,10,0\n2,0,11,0\n"}) {
    write_file(folder.path() / "two.csv", std::string("s_A,z_A,s_B,z_B\n0,0,") + other);
    const std::string message = message_of([&] { load_road(folder.path() / "two.csv"); });
    CAPTURE(message);
    CHECK(message.find("its first track is from 0 to") != std::string::npos);
  }

  // Steps that differ beyond measure are refused, and so is a time in a distance's place.
  write_file(folder.path() / "fine.csv", "s [m],z [mm]\n0,0\n1e-6,10\n100,12\n");
  CHECK(message_of([&] {
          load_road(folder.path() / "fine.csv");
        }).find("steps from 1e-06 to 100 m") != std::string::npos);
  write_file(folder.path() / "time.csv", "time,z [mm]\n0,0\n1,10\n2,12\n");
  CHECK(message_of([&] {
          load_road(folder.path() / "time.csv");
        }).find("'time' is a time, and a road is heights over distance") != std::string::npos);
  CHECK_CLOSE(load_road(folder.path() / "time.csv", "m").length(), 2, 1e-9, 0);
}

TEST_CASE("ground that cannot be made is refused, with what would be right") {
  const auto refusal = [](const std::string& text) {
    return message_of([&] { make_ground(text, 1); });
  };
  CHECK(refusal("iso8606").find("did you mean 'iso8608'") != std::string::npos);
  CHECK(refusal("iso8608,class=Z").find("A (smooth) to H") != std::string::npos);
  CHECK(refusal("iso8608,speed=3kg").find("not a unit of it") != std::string::npos);
  CHECK(refusal("step,hight=3cm").find("did you mean 'height'") != std::string::npos);
  CHECK(refusal("iso8608,class=A,class=E").find("class is stated twice") != std::string::npos);
  CHECK(refusal("iso8608,class=A,roughness=1e-6").find("one of the two") != std::string::npos);
  CHECK(refusal("measured,file=a.csv,file=b.csv").find("file is stated twice") !=
        std::string::npos);
  CHECK(refusal("own/road.csv,speed=10").find("measured,file=own/road.csv") != std::string::npos);
  const TemporaryFolder folder;
  write_file(folder.path() / "road.csv", "s (m),z (m),q\n0,0,0\n1,0,0\n2,0,0\n");
  CHECK(message_of([&] { load_road(folder.path() / "road.csv"); }).find("in pairs") !=
        std::string::npos);
  write_file(folder.path() / "back.csv", "s (m),z (m)\n0,0\n1,0\n0.5,0\n");
  CHECK(message_of([&] { load_road(folder.path() / "back.csv"); }).find("does not rise in row 3") !=
        std::string::npos);
  write_file(folder.path() / "quake.csv", "time,a\n0,0\n0.02,0.1\n0.04,20.1kilo\n0.06,0\n");
  CHECK(message_of([&] {
          load_earthquake(folder.path() / "quake.csv");
        }).find("row 3 of 'a' is no number") != std::string::npos);
  write_file(folder.path() / "far.csv", "s (m),z (m)\n0,0\n1,1e200\n2,0\n");
  CHECK(message_of([&] { load_road(folder.path() / "far.csv"); }).find(" is 1e+200") !=
        std::string::npos);
}
