#include <xmmintrin.h>

#include <dlib/dnn.h>

#include "peer.h"

using namespace peer;

namespace {

using Network = dlib::loss_mean_squared<dlib::fc<
    1, dlib::relu<dlib::fc<
           15, dlib::relu<dlib::fc<15, dlib::relu<dlib::fc<15, dlib::input<dlib::matrix<float>>>>>>>>>>;

double training(int) {
  static Network net;
  static std::vector<dlib::adam> solvers(net.num_computational_layers, dlib::adam(0.F, 0.9F, 0.999F));
  static std::vector<dlib::matrix<float>> inputs;
  static std::vector<float> targets;
  if (inputs.empty()) {
    const dashpot::TrainingSamples samples = training_samples();
    for (std::size_t s = 0; s < kSamples; ++s) {
      inputs.emplace_back(8, 1);
      for (int k = 0; k < 8; ++k) inputs.back()(k) = static_cast<float>(samples.inputs[8 * s + k]);
      targets.push_back(static_cast<float>(samples.targets[s]));
    }
    net.clean();
  }
  constexpr std::size_t kBatches = 200;
  const double seconds = time_of(1, [&] {
    dlib::resizable_tensor batch;
    for (std::size_t b = 0; b < kBatches; ++b) {
      const std::size_t first = b * kBatch;
      net.to_tensor(inputs.begin() + first, inputs.begin() + first + kBatch, batch);
      net.compute_loss(batch, targets.begin() + first);
      net.back_propagate_error(batch);
      net.update_parameters(dlib::make_sstack(solvers), 1e-3);
    }
  });
  return seconds / (kBatches * kBatch);
}

}  // namespace

int main() {
  _mm_setcsr(_mm_getcsr() | 0x8040);  // flush to zero, as Dashpot does
  return serve({{"training", training}});
}
