#include "dashpot/suspension/ride/ride_study.h"

#include <numbers>
#include <set>
#include <tuple>

#include "dashpot/report/ride_document.h"
#include "dashpot/report/ride_figures.h"
#include "dashpot/suspension/ground/ground_sequences.h"
#include "dashpot/suspension/plants/linear.h"
#include "support.h"

using namespace dashpot;

namespace {

/// Gains of the Savaresi-Spelta quarter car with a linear damper, by its frequency response.
struct LinearGains {
  double body_acceleration, tyre_deflection;
};
LinearGains linear_gains(double damping, double f) {
  const Plant plant = load_plant_set("savaresi_spelta").plant;
  const auto q = frequency_response(plant, {damping}, f);
  const double rate = 2 * std::numbers::pi * f;
  return {rate * rate * std::abs(q[0]), std::abs(q[1] - 1.0)};
}

RideStudyOptions small_study() {
  RideStudyOptions options;
  options.controllers = {"skyhook", "sh_add"};
  options.frequencies = {4, 8};
  options.gains = {.settling = 4, .counted = 1, .chirp = 3};
  options.road_duration = 6;
  options.held = 2;
  options.threads = 1;
  return options;
}

}  // namespace

TEST_CASE(
    "gains by a sine and by a chirp are those of the frequency response, where all is linear") {
  const Vehicle vehicle = make_vehicle({.dampers = {"viscous,damping=1500"}});
  const double f = 4;
  const LinearGains exact = linear_gains(1500, f);
  const GainPoint sine = gain_by_sine(vehicle, f, {.settling = 6});
  CHECK_CLOSE(sine.body_acceleration.fundamental, exact.body_acceleration, 1e-4, 0);
  CHECK_CLOSE(sine.body_acceleration.variance, exact.body_acceleration, 1e-4, 0);
  CHECK_CLOSE(sine.tyre_deflection.fundamental, exact.tyre_deflection, 1e-4, 0);
  for (const GainPoint& point : gains_by_chirp(vehicle, {2, 4, 8}, {.chirp = 60})) {
    // A chirp is read while it moves on: a few per cent.
    const LinearGains there = linear_gains(1500, point.frequency);
    CHECK_CLOSE(point.body_acceleration.fundamental, there.body_acceleration, 0.03, 0);
    CHECK_CLOSE(point.tyre_deflection.fundamental, there.tyre_deflection, 0.03, 0);
  }
}

TEST_CASE("the integrals over the usual frequencies are those of TC-7.13 for passive dampers") {
  const std::vector<double> f = usual_frequencies();
  CHECK(f.size() == 18);
  const auto integrals = [&](double damping) {
    std::vector<double> comfort, holding;
    for (const double one : f) {
      comfort.push_back(linear_gains(damping, one).body_acceleration);
      holding.push_back(linear_gains(damping, one).tyre_deflection);
    }
    return std::pair{gain_integral(f, comfort), gain_integral(f, holding)};
  };
  const auto nominal = integrals(1500), soft = integrals(300), hard = integrals(3900);
  CHECK_CLOSE(soft.first / nominal.first, 0.646, 0.005, 0);
  CHECK_CLOSE(soft.second / nominal.second, 2.083, 0.005, 0);
  CHECK_CLOSE(hard.first / nominal.first, 1.322, 0.005, 0);
  CHECK_CLOSE(hard.second / nominal.second, 0.735, 0.005, 0);
}

TEST_CASE("a small study: TC-7.13 within 3 %, and the same bits for any number of threads") {
  RideStudyOptions options = small_study();
  const RideStudy study = study_ride(options);
  CHECK(study.passive.name() == "viscous, 1500 N*s/m");
  CHECK_CLOSE(study.passive.sines[0].body_acceleration.fundamental, 120.6, 0.03, 0);
  CHECK_CLOSE(study.controlled[0].sines[0].body_acceleration.fundamental, 70.2, 0.03, 0);
  CHECK_CLOSE(study.controlled[1].sines[0].body_acceleration.fundamental, 49.6, 0.03, 0);
  CHECK_CLOSE(study.controlled[1].sines[1].body_acceleration.fundamental, 109.0, 0.03, 0);
  // Variance counts what the law adds at other frequencies.
  CHECK(study.controlled[0].sines[0].body_acceleration.variance >
        1.1 * study.controlled[0].sines[0].body_acceleration.fundamental);
  CHECK(study.held.front().tyre > study.held.back().tyre);
  options.threads = 3;
  CHECK(format_json(ride_json(study_ride(options))) == format_json(ride_json(study)));
}

TEST_CASE("the page of a ride has a section each for road, frequency and step") {
  RideStudyOptions options = small_study();
  options.controllers = {"mix1"};
  options.frequencies = {8};
  const Document page = ride_document(study_ride(options));
  REQUIRE(page.sections.size() == 3);
  CHECK(page.sections[0].tables[0].rows.size() == 2);
  CHECK(page.sections[0].figures[0].panels[0].series.size() == 4);  // line, its dots, passive, mix1
  CHECK(page.sections[1].figures[0].panels.size() == 6);
  CHECK(page.verdict.find("mix1: ") != std::string::npos);
}

TEST_CASE("gains of a vehicle with several tyres say whose they are") {
  RideStudyOptions options = small_study();
  options.controllers = {"mix1"};
  options.frequencies = {8};
  CHECK(ride_document(study_ride(options)).sections[1].remarks.empty());
  options.vehicle = {.plant = "half_car_a", .dampers = {"ideal,damping_min=300,damping_max=3900"}};
  const Document page = ride_document(study_ride(options));
  REQUIRE(page.sections[1].remarks.size() == 1);
  CHECK(contains(page.sections[1].remarks[0], "those of front_tyre and of the strut front alone"));
}

TEST_CASE("a ride's verdict tells of one controller once, whatever it is best or nearest in") {
  RideStudyOptions options = small_study();
  options.frequencies = {8};
  RideStudy study = study_ride(options);
  study.held.clear();

  // sh_add is the best of both controllers in both aims, beside a passive car of its own making.
  const auto set = [](RiddenVehicle& one, double comfort, double holding) {
    for (RideMeasure& measure : one.road.measures) {
      if (measure.name == "weighted_acceleration") measure.value = comfort;
      if (measure.name == "tyre_load") measure.value = holding;
    }
  };
  set(study.controlled[0], 3, 30);
  set(study.controlled[1], 2, 20);
  for (const auto& [comfort, holding, said] :
       {std::tuple{2.5, 25.0, "Best in comfort and in road holding is sh_add: "},
        {2.5, 10.0,
         "Most comfortable, and nearest to passive on the road, where none beats it, "
         "is sh_add: "},
        {1.0, 25.0,
         "Best on the road, and nearest to passive in comfort, where none beats it, "
         "is sh_add: "},
        {1.0, 10.0,
         "None beats passive in comfort or on the road; the nearest in both is "
         "sh_add: "}}) {
    set(study.passive, comfort, holding);
    const std::string verdict = ride_document(study).verdict;
    CHECK_MESSAGE(verdict.starts_with(said), verdict);
    CHECK(verdict.find("sh_add") == verdict.rfind("sh_add"));
  }
}

TEST_CASE("the points of a ride's trade-off are told apart beyond the colours that there are") {
  RideStudyOptions options = small_study();
  options.frequencies = {8};
  RideStudy study = study_ride(options);
  while (study.controlled.size() < 14) study.controlled.push_back(study.controlled.front());
  std::set<std::pair<std::string, FigureSeries::Mark>> looks;
  std::size_t points = 0;
  const DocumentFigure figure = trade_off_figure(study);
  for (const FigureSeries& series : figure.panels.front().series)
    if (series.width == 5) {
      looks.emplace(series.colour, series.mark);
      ++points;
    }
  CHECK(points == 15);
  CHECK(looks.size() == points);

  // The sines of the chirp's figure, too.
  looks.clear();
  const DocumentFigure chirp = chirp_figure(study);
  for (const FigureSeries& series : chirp.panels.front().series)
    if (series.mark != FigureSeries::Mark::Line && series.mark != FigureSeries::Mark::Dashes)
      looks.emplace(series.colour, series.mark);
  CHECK(looks.size() == 15);
}

TEST_CASE("a ride on a seat is told of the seat and of who sits on it") {
  RideStudyOptions options = small_study();
  options.vehicle = {.plant = "boileau_rakheja1998", .dampers = {"spencer1997"}};
  options.controllers = {"skyhook"};
  options.frequencies = {8};
  const Document page = ride_document(study_ride(options));
  CHECK(contains(page.verdict, "dynamic seat load than passive"));
  CHECK(page.sections[0].tables[0].columns[3].title == "seat load, %");
  CHECK(page.sections[0].figures[1].panels[1].title == "seat, load");
  const DocumentTable& step = page.sections[2].tables[0];
  CHECK(step.columns[7].title == "thigh acceleration, rms, m/s^2");
  CHECK(step.rows[0][7] != "-");
}

TEST_CASE("with a bound the page shows what is possible, and no controller is beyond it" *
          doctest::test_suite("long")) {
  RideStudyOptions options = small_study();
  options.frequencies = {8};
  options.road_duration = 1;
  options.bound = true;
  std::vector<double> shares;  // of the bound, as they were told
  options.monitor.on_progress = [&](const Progress& now) {
    if (now.stage == "bound what is possible") shares.push_back(now.fraction);
  };
  const RideStudy study = study_ride(options);
  CHECK(shares.size() >= 3 * study.front.size());  // the optimum, the limits, the end
  CHECK(std::ranges::is_sorted(shares));
  CHECK(shares.back() == 1);
  const Plant& plant = study.passive.road.vehicle->set.plant;
  REQUIRE(study.front.size() == 5);
  for (const ClairvoyantBound& best : study.front) {
    CHECK(best.bound <= best.optimum);
    for (const RiddenVehicle& one : study.controlled)
      CHECK(best.optimum <= ride_squares(one.road.trace, plant).of(best.index));
  }
  const Document page = ride_document(study);
  REQUIRE(page.sections.size() == 4);
  CHECK(page.sections[1].tables[0].rows.size() == 5);  // passive, two controllers, optimum, bound
}

TEST_CASE("a ride whose forces leave the range is not among those that its bound speaks of") {
  RideStudyOptions options = small_study();
  options.controllers = {"skyhook"};
  options.frequencies = {20};
  options.gains = {.settling = 0.5, .counted = 0.5, .chirp = 1};
  options.road_duration = 0.05;
  options.bound = true;
  const auto table = [&](const std::string& against) {
    options.against = against;
    const RideStudy study = study_ride(options);
    const Value json = ride_json(study);
    CHECK(json.find("controlled")->items()[0].find("in_range")->as_bool());
    CHECK(json.find("passive")->find("in_range")->as_bool() == study.passive.in_range);
    return ride_document(study).sections[1].tables[0];
  };
  const DocumentTable usual = table("viscous,damping=1500"), soft = table("viscous,damping=200");
  CHECK(usual.rows[0][0] == "viscous, 1500 N*s/m");
  CHECK(usual.note.find("Outside") == std::string::npos);
  CHECK(soft.rows[0][0] == "viscous, 200 N*s/m (outside)");
  CHECK(soft.rows[1][0] == "skyhook");
  CHECK(soft.note.find(" Outside: its forces leave that range") != std::string::npos);
}

TEST_CASE("a bound far below its optimum is said to tell little") {
  RideStudyOptions options = small_study();
  options.controllers = {"skyhook"};
  options.frequencies = {20};
  options.gains = {.settling = 0.5, .counted = 0.5, .chirp = 1};
  options.road_duration = 0.05;
  RideStudy study = study_ride(options);
  ClairvoyantBound best{
      .index = {1, 0}, .bound = 0.3, .optimum = 1, .squares = {1, 1}, .shares = {}};
  best.proven = true;
  study.front = {best, best};
  study.front.back().index = {0, 1};
  study.front.front().bound = 0.2;  // of squares: the root is 0.45 of the optimum's
  const std::string note = ride_document(study).sections[1].tables[0].note;
  CHECK(note.find("The body's bound is less than half of its optimum") != std::string::npos);
  CHECK(note.find("The tyre's bound") == std::string::npos);
}

TEST_CASE("rides that cannot be are refused") {
  const auto refusal = [](auto change) {
    RideStudyOptions options = small_study();
    change(options);
    return message_of([&] { study_ride(options); });
  };
  CHECK(refusal([](auto& o) {
          o.controllers = {"skyhok"};
        }).find("vehicle: unknown controller 'skyhok'; did you mean 'skyhook'?") == 0);
  CHECK(refusal([](auto& o) { o.frequencies = {4, 2}; }) ==
        "vehicle: its frequencies do not rise from above 0");
  CHECK(refusal([](auto& o) { o.frequencies = {2, 2}; }) ==
        "vehicle: its frequencies do not rise from above 0");
  CHECK(refusal([](auto& o) { o.step_height = 0; }) ==
        "vehicle: its step has no height; a step up or down");
  CHECK(refusal([](auto& o) { o.gains.amplitude = 0; }) ==
        "vehicle: its sines have no amplitude; an amplitude above 0");
  const TemporaryFolder folder;
  const std::string shaking =
      "earthquake,file=" +
      folder.write("quake.csv", "time [s],acc [m/s^2]\n0,0\n1,1\n2,0\n").string();
  CHECK(refusal([&](auto& o) { o.road = shaking; }) ==
        "--road: '" + shaking + "' shakes buildings, not the savaresi_spelta; a road, a bump");
  CHECK(refusal([](auto& o) {
          o.vehicle.plant = "dyke_spencer1996";
          o.vehicle.dampers = {"spencer1997"};
        }) == "vehicle: dyke_spencer1996 has no tyres to ride on; a vehicle");
  CHECK(refusal([](auto& o) { o.against = "current=x"; }) ==
        "vehicle: 'current=x' states no current; current=0.5");
  CHECK(refusal([](auto& o) {
          o.bound = true;
          o.vehicle.values = {"tyres_may_lift=1"};
        }).find("savaresi_spelta: is not linear but for its damper") == 0);
}

TEST_CASE("a controller that is named twice rides once") {
  RideStudyOptions options = small_study();
  options.frequencies = {20};
  options.gains = {.settling = 0.5, .counted = 0.5, .chirp = 1};
  options.road_duration = 0.5;
  const auto names = [&](const std::vector<std::string>& controllers) {
    options.controllers = controllers;
    std::vector<std::string> ridden;
    for (const RiddenVehicle& one : study_ride(options).controlled) ridden.push_back(one.name());
    return ridden;
  };
  const std::vector<std::string> both = names({"skyhook", "add"});
  CHECK(both.size() == 2);
  CHECK(names({"skyhook", "add", "skyhook", "add"}) == both);

  // Another setting makes another controller.
  CHECK(names({"mix1", "mix1,crossover=3Hz"}).size() == 2);
}

TEST_CASE("all laws that suit a vehicle are taken, the others named with the reason") {
  RideStudyOptions options = small_study();
  options.controllers = {"all"};
  options.vehicle.sensors.in_car = true;
  options.frequencies = {20};
  options.gains = {.settling = 0.5, .counted = 0.5, .chirp = 1};
  options.road_duration = 0.5;
  const RideStudy study = study_ride(options);
  CHECK(study.controlled.size() >= 9);
  REQUIRE(!study.left_out.empty());
  CHECK(study.left_out[0].find("is left out: vehicle: 'clipped_lqr' feeds back") !=
        std::string::npos);
}
