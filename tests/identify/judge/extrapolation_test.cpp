#include "dashpot/identify/judge/extrapolation.h"

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/registry.h"
#include "dashpot/dataset.h"
#include "support.h"

using namespace dashpot;

namespace {

Dataset dataset_at(double current) {
  constexpr std::size_t kSamples = 100;
  Record record;
  record.name = "run";
  record.sample_time = 0.01;
  for (std::size_t k = 0; k < kSamples; ++k) record.time.push_back(0.01 * static_cast<double>(k));
  for (const auto& [channel, unit, value] : {std::tuple{"displacement", "m", 0.0},
                                             {"velocity", "m/s", 0.0},
                                             {"force", "N", 0.0},
                                             {"current", "A", current}})
    record.channels.push_back({channel, unit, std::vector<double>(kSamples, value), ""});
  Dataset dataset;
  dataset.records = {record};
  dataset.drive_unit = DriveUnit::Ampere;
  return dataset;
}

}  // namespace

TEST_CASE("recordings that lie beyond a model's range altogether have the span that they have") {
  ModelFile file{.model = std::make_unique<LawModel>(
                     LawModel::constant(find_law("bingham"), {1000, 100, 0, 0.001}))};
  file.domain = {.velocity_min = -1, .velocity_max = 1, .current_min = 0, .current_max = 2};

  const std::vector<Extrapolation> above = extrapolations(file, dataset_at(4));
  REQUIRE(above.size() == 1);
  CHECK(above[0].quantity == "current");
  CHECK(above[0].data_low == 4);
  CHECK(above[0].data_high == 4);
  CHECK(describe(above[0]) ==
        "100 % of the samples have a current outside the model's range 0 ... 2 A (the recordings "
        "span 4 ... 4 A): it extrapolates there");
  CHECK(extrapolations(file, dataset_at(1)).empty());
}
