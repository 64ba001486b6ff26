// A full car whose roads nothing measures, along the true motions of its dampers.

#include "dashpot/machine/spectral_likelihood.h"

#include "dashpot/damper/law_list.h"
#include "dashpot/machine/in_plant_words.h"
#include "dashpot/machine/virtual_campaign.h"
#include "support.h"

using namespace dashpot;

namespace {

const std::vector<std::string> kCorners = {"front_left", "front_right", "rear_left", "rear_right"};
constexpr double kTrueMass = 1500, kTrueTyre = 190e3;  // kg, N/m

InPlantSetup four_wheels() {
  std::string text =
      "plant: full_car\n"
      "parameters: {mass: {about: 1300 kg}, pitch_inertia: 2160 kg*m^2, roll_inertia: 460 kg*m^2,\n"
      "  wheel_mass: 59 kg, front_stiffness: 35 kN/m, rear_stiffness: 38 kN/m,\n"
      "  tyre_stiffness: {about: 150 kN/m}, front_distance: 1.4 m, rear_distance: 1.7 m,\n"
      "  front_track: 1.5 m, rear_track: 1.5 m}\n"
      "voltage: 1 V\ninputs:\n";
  for (const std::string& corner : kCorners)
    text += "  - {kind: ground, class: C, speed: 20 m/s, at: " + corner + "}\n";
  text += "sensors:\n  - {channel: az, quantity: acceleration, at: body, noise: 0.05}\n";
  for (const std::string& corner : kCorners)
    text += "  - {channel: az_" + corner + ", quantity: acceleration, at: " + corner +
            "_wheel, noise: 0.05}\n";
  return parse_in_plant_setup(text, "full.yaml");
}

/// Mass, tyre and width that are most likely on tracks so far apart, m; 0: one and the same.
struct FoundOnTracks {
  double mass = 0, tyre = 0;
  FittedParameter width;
};
FoundOnTracks found_on_tracks(double width) {
  const InPlantSetup setup = four_wheels();
  InPlantSetup truth = setup;
  truth.unknown.clear();
  truth.known.insert(truth.known.end(), {{"mass", kTrueMass}, {"tyre_stiffness", kTrueTyre}});
  const LawModel damper =
      LawModel::constant(find_law("tanh_guo"), std::vector<double>{400, 1500, 20, 0.05, 0.02, 0});
  const VirtualRide ride =
      virtual_campaign(truth, damper,
                       {.duration = 20,
                        .sample_rate = 250,
                        .levels = {1},
                        .road = "iso8608,class=C,speed=20m/s,track_width=" + std::to_string(width)})
          .front();
  const PlantRecording recording{.name = "ride",
                                 .sample_time = ride.recorded.sample_time,
                                 .samples = ride.recorded.size(),
                                 .channels = ride.recorded.channels};

  // The motions as they truly were.
  RiddenRecording ridden{&recording, recording.samples, {}};
  for (const std::string& corner : kCorners) {
    const auto& way = ride.truth.channel(corner + "_deflection").samples;
    const auto& speed = ride.truth.channel(corner + "_velocity").samples;
    std::vector<DamperInput>& motion = ridden.motions.emplace_back();
    for (std::size_t k = 0; k < way.size(); ++k) motion.push_back({way[k], speed[k], 1});
  }
  const DamperUnknowns law(
      {damper.law(),
       {.force = 1000, .stroke = 0.01, .speed = 0.2, .drive = {1, 1, false, 1}},
       DriveUnit::Volt,
       OffsetMode::Record},
      setup.kinds);
  const ObserverNoise noise{.force = {{50, 0.01}, {50, 0.3}},
                            .sensors = std::vector<double>(5, 0.05),
                            .roughness = 256e-6};
  const std::vector<double> plant = {1300, 150e3};
  const std::vector<RiddenRecording> rides = {ridden};
  const SpectralLikelihood likelihood(setup, rides, law, plant, noise, 1000);
  const MostLikely found =
      most_likely(likelihood, likelihood.start(plant, law.of({&damper, 1})), 100, 2, {});
  REQUIRE(found.slopes.finite);
  CHECK(found.converged);
  FoundOnTracks told{
      likelihood.described(0, found.x).value, likelihood.described(1, found.x).value, {}};
  for (std::size_t k = 0; k < likelihood.size(); ++k)
    if (likelihood.name(k) == "track width of the road")
      told.width = likelihood.described(k, found.x);
  return told;
}

}  // namespace

TEST_CASE("spectral likelihood: what left and right roads share is found, however much it is") {
  const FoundOnTracks usual = found_on_tracks(1.5), same = found_on_tracks(0),
                      wide = found_on_tracks(10);
  CHECK(usual.width.unit == "m");
  CHECK_CLOSE(usual.width.value, 1.5, 0.25, 0);
  CHECK(same.width.value < 0.1);
  CHECK(wide.width.value > 5);
  for (const FoundOnTracks& found : {usual, same, wide}) {
    CHECK_CLOSE(found.mass, kTrueMass, 0.02, 0);
    CHECK_CLOSE(found.tyre, kTrueTyre, 0.02, 0);
  }
}
