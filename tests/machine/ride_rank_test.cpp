#include "dashpot/machine/ride_rank.h"

#include "dashpot/damper/parameter_set.h"
#include "dashpot/damper/virtual_bench.h"
#include "dashpot/suspension/dampers/damper_words.h"
#include "support.h"

using namespace dashpot;

namespace {

/// Records of a damper whose hysteresis and knee the models below lack.
Dataset recorded() {
  BenchOptions bench;
  bench.motions = {{0.02, 1}, {0.01, 3}, {0.004, 8}};
  bench.drive_levels = {0, 1, 2};
  bench.cycles = 2;
  return run_virtual_bench(load_parameters("spencer1997"), DriveUnit::Volt, bench);
}

RideRankOptions short_ride() { return {.vehicle = {.current = 1}, .duration = 3, .draws = 3}; }

struct Example {
  Dataset dataset = recorded();
  Ranking ranking = rank({"bingham", "tanh_kwok", "tanh_acceleration"}, dataset,
                         {.by = LeaveOut::By::Condition}, {.starts = 1});
};
const Example& example() {
  static const Example kExample;
  return kExample;
}

const RankedModel& model_named(const Ranking& ranking, const std::string& name) {
  return *std::ranges::find(ranking.models, name, &RankedModel::name);
}

RideSignals signals(double comfort, double tyre, double travel) {
  RideSignals signals;
  signals[kComfort] = {{comfort, -comfort}};
  signals[kTyreLoad] = {{tyre, -tyre}, {0, 0}};
  signals[kTravel] = {{travel, -travel}};
  return signals;
}

}  // namespace

TEST_CASE("difference of rides: each quantity by its worst signal, over the reference") {
  const RideDifference same = ride_difference(signals(1, 2, 3), signals(1, 2, 3));
  CHECK(same.share == 0);
  const RideDifference other = ride_difference(signals(1.5, 2, 3), signals(1, 2, 3));
  CHECK(other.trace[kComfort] == doctest::Approx(0.5));
  CHECK(other.excess[kComfort] == doctest::Approx(0.5));
  CHECK(other.share == doctest::Approx(50 / std::sqrt(3)));
  RideSignals turned = signals(1, 2, 3);
  turned[kTyreLoad][1] = {4, -4};
  CHECK(ride_difference(turned, signals(1, 2, 3)).trace[kTyreLoad] == doctest::Approx(4));
}

TEST_CASE("a model rides like itself, and unlike a stronger damper, in equilibrium at rest") {
  const RankedModel& bingham = model_named(example().ranking, "bingham");
  const ModelFile file = to_model_file(bingham, example().dataset, "");
  const RideRankOptions options = short_ride();
  const GroundPointer ground = make_ground(options.road, 1);
  const RiddenModel ridden(file, *ground, options);

  // A static force changes nothing, since the springs bear it.
  const auto itself =
      std::shared_ptr<const DamperModel>(choose_damper(file).model->with_offset(200));
  CHECK(ridden.against({itself})->share < 0.1);
  const LawModel stronger = load_parameters("spencer1997");
  CHECK(ridden.against({std::make_shared<LawModel>(stronger)})->share > 3);
}

TEST_CASE("rides are predicted for what may be recommended; the rest says why not") {
  Ranking ranking = example().ranking;
  RankedModel& active = ranking.models.back();
  active.dissipation = {.is_tested = true, .damping = -1, .share = -1};
  predict_rides(ranking, example().dataset, short_ride());
  REQUIRE(ranking.ridden);
  CHECK(ranking.ridden->draws == 3);
  CHECK(active.ride->refusal ==
        "it feeds energy into what moves it: its ride would be its own shaking");
  const std::vector<const RankedModel*> order = ranking.by_ride();
  REQUIRE(order.size() == 2);
  CHECK(order[0]->ride->error.value <= order[1]->ride->error.value);
  for (const RankedModel* model : order) {
    const PredictedRide& ride = *model->ride;
    for (const Estimate& figure :
         {ride.error, ride.acceleration, ride.tyre_load, ride.travel, ride.travel_excess}) {
      CHECK(figure.low <= figure.value);
      CHECK(figure.value <= figure.high);
    }
    CHECK(ride.error.value > 0);
  }

  // Another number of threads, the same bits.
  Ranking again = example().ranking;
  again.models.back().dissipation = active.dissipation;
  RideRankOptions options = short_ride();
  options.threads = 1;
  predict_rides(again, example().dataset, options);
  CHECK(again.by_ride()[0]->ride->error.value == order[0]->ride->error.value);
}

TEST_CASE("where every model feeds energy in, nothing is ridden and each says why") {
  Ranking ranking = example().ranking;
  for (RankedModel& model : ranking.models)
    model.dissipation = {.is_tested = true, .damping = -1, .share = -1};
  predict_rides(ranking, example().dataset, short_ride());
  CHECK(!ranking.ridden);
  CHECK(ranking.by_ride().empty());
  for (const RankedModel& model : ranking.models)
    CHECK(contains(model.ride->refusal, "feeds energy"));
}

TEST_CASE("what cannot be ridden is refused before the fits") {
  const auto refusal = [](const RideRankOptions& options) {
    return message_of([&] { require_ridable(options); });
  };
  CHECK(refusal(short_ride()).empty());
  RideRankOptions options = short_ride();
  options.vehicle.plant = "dyke_spencer1996";
  CHECK(contains(refusal(options), "has no tyres, so that it does not ride; a car or a bus"));
  options = short_ride();
  options.draws = 1;
  CHECK(refusal(options) == "--draws: 1 gives no interval; 20");
  options = short_ride();
  options.vehicle.controller = "skyhok";
  CHECK(contains(refusal(options), "skyhook"));
  options = short_ride();
  options.road = "earthquake,file=" + project_file("data/none.dat");
  CHECK(!refusal(options).empty());
}
