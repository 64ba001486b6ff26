#include "studies/one_sensor/one_sensor_models.h"

namespace dashpot {
namespace {

/// The paper's table 3: the force one sample ago beside the present inputs.
NetworkDesign feedback_design(FeedbackTraining training) {
  NetworkDesign design;
  design.delays = 0;
  design.feedback = 1;
  design.training = training;
  return design;
}

/// The paper's table 5: as many delayed samples of the velocity as of the current, so many samples
/// apart, no force fed back.
NetworkDesign regressors_design(std::size_t delays, std::size_t spacing) {
  NetworkDesign design;
  design.delays = delays;
  design.spacing = spacing;
  design.feedback = 0;
  return design;
}

/// Two members predict as well as eight, in a quarter of the time.
NetworkDesign small_ensemble() {
  NetworkDesign design;
  design.members = 2;
  return design;
}

}  // namespace

std::vector<StudiedModel> one_sensor_models() {
  // The paper's networks with their rivals, then laws.
  constexpr auto kFree = FeedbackTraining::FreeRun, kSeries = FeedbackTraining::SeriesParallel;
  std::vector<StudiedModel> models{
      {kStatic, "static network, v and i", "mlp_one_sensor", {}},
      {"two-sensors", "static network, x, v and i", "mlp_two_sensors", {}},
      {"recurrent", "recurrent network, x, v, i and F(t-1), trained in free run",
       "narx_two_sensors", feedback_design(kFree)},
      {"recurrent-series", "recurrent network, x, v, i and F(t-1), trained series-parallel",
       "narx_two_sensors", feedback_design(kSeries), true},
      {"recurrent-one", "recurrent network, v, i and F(t-1), trained in free run",
       "narx_one_sensor", feedback_design(kFree), true},
      {kHysteresis, "hysteresis network, v and i", "hysteresis_network", small_ensemble()},
      {"bingham", "Bingham", "bingham", {}},
      {"semi-phenomenological", "semi-phenomenological", "semi_phenomenological", {}},
      {"modified-bouc-wen", "phenomenological (modified Bouc-Wen)", "modified_bouc_wen", {}},
  };

  // Table 5: one to three delays, neighbouring samples and ten apart.
  constexpr std::size_t kApart = 10;
  for (std::size_t delays = 1; delays <= 3; ++delays) {
    const std::string key = "regressors-" + std::to_string(delays),
                      title = "static network, v and i with " + std::to_string(delays) +
                              " delayed samples of each";
    models.push_back({key, title, "narx_one_sensor", regressors_design(delays, 1), true});
    models.push_back({key + "-apart", title + ", " + std::to_string(kApart) + " samples apart",
                      "narx_one_sensor", regressors_design(delays, kApart), true});
  }
  return models;
}

}  // namespace dashpot
