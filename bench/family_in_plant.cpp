// Prints what docs/in-plant-measured.md says of family members in a plant.
//
//   bench_family_in_plant leans|bingham BUILDS AMPERE [FOLDER]
//
// A virtual family of other structure than the model (tests/design/drawn_family.h: Herschel-Bulkley
// flow and valves that lean, or Bingham flow; builds differ by 6 %) is recorded on a bench and
// fitted. Builds of a drawing that it has not seen then work in a light quarter car, which drives
// over one road at one current. The force of each is told on another road at several currents,
// along the damper's true motion, by the drawing's mean build, by the build that the drive tells,
// and by a law that is identified in the same drive. FOLDER gets the family, the drawing, the car
// and the first build's drive, for 'dashpot member --in'.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "dashpot/base/file.h"
#include "dashpot/base/text.h"
#include "dashpot/damper/law_list.h"
#include "dashpot/evaluate.h"
#include "dashpot/machine/build_in_plant.h"
#include "dashpot/machine/in_plant.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/virtual_campaign.h"
#include "dashpot/model_file.h"
#include "dashpot/record/record_file.h"
#include "design/drawn_family.h"

using namespace dashpot;

namespace {

constexpr const char* kCar = R"(
plant: quarter_car
parameters:
  sprung_mass: {about: 70 kg, from: 40 kg, to: 150 kg}
  unsprung_mass: 10 kg
  spring_stiffness: 6 N/mm
  tyre_stiffness: {about: 45 N/mm, from: 20 N/mm, to: 120 N/mm}
inputs:
  - {channel: road, kind: ground}
sensors:
  - {channel: az_body, quantity: acceleration, at: body}
  - {channel: az_wheel, quantity: acceleration, at: wheel}
  - {channel: level, quantity: deflection}
current: coil
)";
constexpr const char* kNames[] = {"mean build", "this build", "tanh_kwok"};
constexpr double kSprung = 80, kTyre = 52e3;  // truly

/// The car as it is, with sensors of the grade for cars.
InPlantSetup true_car(const InPlantSetup& asked) {
  InPlantSetup setup = with_grade(asked, find_sensor_grade("car", "car"));
  setup.known.emplace_back("sprung_mass", kSprung);
  setup.known.emplace_back("tyre_stiffness", kTyre);
  setup.unknown.clear();
  return setup;
}

std::vector<VirtualRide> drive(const InPlantSetup& car, const DamperModel& damper,
                               std::vector<double> currents, std::uint64_t seed) {
  return virtual_campaign(car, damper,
                          {.duration = 20,
                           .sample_rate = 500,
                           .levels = std::move(currents),
                           .road = "iso8608,class=C,speed=10m/s",
                           .seed = seed});
}

/// rms error of a model's force along the true motion of a ride, without its mean, which the
/// springs bear, as a share of the force's span.
double force_error(const DamperModel& model, const VirtualRide& ride, double current) {
  const std::vector<double>&x = ride.truth.channel("suspension_deflection").samples,
        &v = ride.truth.channel("suspension_velocity").samples,
        &force = ride.truth.channel("damper_force").samples;
  std::vector<double> state(model.state_size()), error;
  DamperInput before{x[0], v[0], current};
  model.rest(before, state);
  for (std::size_t k = 0; k < x.size(); ++k) {
    const DamperInput now{x[k], v[k], current};
    if (k > 0) model.advance(before, now, ride.truth.sample_time, state);
    error.push_back(model.force(now, state) - force[k]);
    before = now;
  }
  const double count = static_cast<double>(error.size()),
               mean = std::accumulate(error.begin(), error.end(), 0.) / count;
  double squares = 0;
  for (const double one : error) squares += (one - mean) * (one - mean) / count;
  const auto [low, high] = std::ranges::minmax(force);
  return std::sqrt(squares) / (high - low);
}

/// How the plant came out, and what is left at the worst sensor on the time held back.
void print_plant(const char* what, const InPlantReport& report) {
  fmt::print("  {:<11}", what);
  for (const FittedParameter& p : report.plant)
    fmt::print("{} {} ({} ... {}) {}, ", p.name, format_number(p.value, 5), format_number(p.low, 5),
               format_number(p.high, 5), p.unit);
  double worst = 0;
  for (const SensorFigures& s : report.sensors) worst = std::max(worst, s.held_back / s.rms);
  fmt::print("worst sensor held back {:.1f} %, {:.0f} CPU s\n", 100 * worst, report.seconds);
  for (const std::string& warning : report.warnings) fmt::print("    {}\n", warning);
}

void write_files(const std::filesystem::path& folder, const FamilyModel& family,
                 const std::vector<Record>& records, const DamperDescription& drawing,
                 const Record& drive) {
  ModelFile file;
  file.model = family.with_offset(0);
  file.domain = domain_of(records, DriveUnit::Ampere);
  save_model(file, folder / "family_physics.json");
  write_file(folder / "my_damper.yaml", format_description(drawing));
  write_file(folder / "car.yaml", kCar);
  save_csv(drive, folder / "drive.csv");
}

void run(bool leans, std::size_t builds, double driven, const std::string& folder) {
  const std::vector<double> currents = {0, 0.5, 1, 1.5};

  // The family, on a bench.
  DrawnFamily family{.leans = leans, .scatter = 0.06, .tests = {}};
  for (const SineMotion motion : {SineMotion{20e-3, 0.6}, SineMotion{8e-3, 2}, SineMotion{8e-3, 8}})
    for (const double current : currents) family.tests.push_back({motion, current});
  Random random(5);
  std::vector<Record> records;
  for (const DamperDescription& drawing : random_drawings(drawn_family_request(), 12, 5))
    for (Record& one : recorded_drawing(family, drawing, random)) records.push_back(std::move(one));
  const auto fitted = fitted_drawings(records);
  fmt::print("family_physics of {} recordings: builds and drawings differ by {:.1f} %\n",
             records.size(), 100 * fitted->family().build_spread);

  // Builds of a new drawing, each in the car.
  DamperDescription drawing = drawn_family_request().damper;
  drawing.gap = 1.3e-3;
  drawing.pole_length = 9e-3;
  drawing.bore_diameter = 33e-3;
  drawing.fluid = find_fluid("140CG", "drawing");
  const auto mean = fitted->with_member(member_of(drawing, currents.back()));
  const InPlantSetup asked = parse_in_plant_setup(kCar, "car.yaml"), car = true_car(asked);
  std::vector<std::vector<double>> sums(3, std::vector<double>(currents.size()));
  for (std::size_t build = 0; build < builds; ++build) {
    const DrawnDamper damper = built_drawing(family, drawing, random);
    const VirtualRide ride = drive(car, damper, {driven}, 10 + build).front();
    if (build == 0 && !folder.empty())
      write_files(folder, *fitted, records, drawing, ride.recorded);
    const PlantRecording recording{.name = "drive",
                                   .sample_time = ride.recorded.sample_time,
                                   .samples = ride.recorded.time.size(),
                                   .channels = ride.recorded.channels};

    // What the drive tells.
    const InPlantOptions options{.grade = ""};
    const BuildInPlant told = identify_build_in_plant(*mean, asked, {recording}, options);
    const InPlantReport law = identify_in_plant(find_law("tanh_kwok"), asked, {recording}, options);
    fmt::print("\nbuild {}, {:.3f} times as strong as drawn, driven at {} A\n", build + 1,
               damper.to_json().find("strength")->as_number(), driven);
    for (const BuildReport::Deviation& one : told.build.deviations)
      fmt::print("  {} {:.3f}, builds differ by {:.3f}, known to {:.3f}\n", one.name, one.value,
                 one.spread, one.left);
    for (const FittedParameter& p : told.free.damper)
      fmt::print("  {} by the drive alone {:.3f} ({:.3f} ... {:.3f})\n", p.name, p.value, p.low,
                 p.high);
    fmt::print("  {:.2f} % of the force's power left by the mean build, {:.2f} % by this one{}{}\n",
               told.build.esr_before, told.build.esr_after,
               told.build.is_likely() ? "" : ", unlikely", told.build.is_told() ? "" : ", untold");
    print_plant("mean build", told.mean);
    print_plant("this build", told.found);
    print_plant("tanh_kwok", law);

    // On another road.
    const std::vector<VirtualRide> others = drive(car, damper, currents, 7000 + build);
    const DamperModel* const models[] = {mean.get(), told.build.model.get(),
                                         law.kinds.front().model.get()};
    for (std::size_t m = 0; m < std::size(models); ++m) {
      fmt::print("  force on another road, % of its span, at {} A:", fmt::join(currents, ", "));
      for (std::size_t k = 0; k < currents.size(); ++k) {
        const double error = 100 * force_error(*models[m], others[k], currents[k]);
        sums[m][k] += error / static_cast<double>(builds);
        fmt::print(" {:6.2f}", error);
      }
      fmt::print("  {}\n", kNames[m]);
    }
    std::fflush(stdout);
  }
  fmt::print("\nmean over {} builds, force on another road, % of its span, at {} A\n", builds,
             fmt::join(currents, ", "));
  for (std::size_t m = 0; m < sums.size(); ++m) {
    for (const double one : sums[m]) fmt::print(" {:6.2f}", one);
    fmt::print("  {}\n", kNames[m]);
  }
}

}  // namespace

int main(int count, char** arguments) {
  const std::vector<std::string> words(arguments + 1, arguments + count);
  if (words.size() < 3 || (words[0] != "leans" && words[0] != "bingham")) {
    fmt::print(stderr, "usage: the head of bench/family_in_plant.cpp\n");
    return 2;
  }
  try {
    run(words[0] == "leans", std::stoul(words[1]), std::stod(words[2]),
        words.size() > 3 ? words[3] : "");
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
