#include <torch/torch.h>

#include "peer.h"

using namespace peer;

namespace {

double training(int) {
  namespace nn = torch::nn;
  static nn::Sequential net(nn::Linear(8, 15), nn::ReLU(), nn::Linear(15, 15), nn::ReLU(), nn::Linear(15, 15),
                            nn::ReLU(), nn::Linear(15, 1));
  static torch::optim::Adam adam(net->parameters(), torch::optim::AdamOptions(1e-3));
  static const torch::Tensor inputs = torch::rand({kSamples, 8}), targets = torch::rand({kSamples, 1});
  constexpr int kBatches = 100;
  const double seconds = time_of(1, [&] {
    for (int b = 0; b < kBatches; ++b) {
      const int first = b * static_cast<int>(kBatch), last = first + static_cast<int>(kBatch);
      adam.zero_grad();
      torch::mse_loss(net->forward(inputs.slice(0, first, last)), targets.slice(0, first, last)).backward();
      adam.step();
    }
  });
  return seconds / (kBatches * kBatch);
}

}  // namespace

int main() {
  torch::set_num_threads(1);
  at::globalContext().setFlushDenormal(true);
  return serve({{"training", training}});
}
