#include "dashpot/damper/nets/stopping.h"

#include <algorithm>
#include <cmath>

namespace dashpot {

EarlyStopping::EarlyStopping(const Mlp& mlp, const Stopping& stopping, double offset_decay)
    : mlp_(mlp), patience_(stopping.patience) {
  if (!stopping.left_out) return;
  blocks_ = make_blocks(mlp, *stopping.left_out, offset_decay);
  errors_.emplace(mlp, blocks_, 1);
}

bool EarlyStopping::judge(std::span<const double> parameters) {
  if (!errors_) return false;
  const double mean = errors_->squared_error(parameters) / static_cast<double>(blocks_.samples);
  const double rmse = mlp_.output_scale * std::sqrt(mean < 0 ? 0 : mean);
  if (best_.empty() || rmse < rmse_) {
    best_.assign(parameters.begin(), parameters.end());
    rmse_ = rmse;
    since_best_ = 0;
    return false;
  }
  return ++since_best_ >= patience_;
}

bool EarlyStopping::finish(Mlp& mlp, TrainReport& report) const {
  if (best_.empty()) return false;
  mlp.parameters = best_;
  report.left_out_rmse = rmse_;
  return true;
}

}  // namespace dashpot
