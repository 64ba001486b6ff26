#include "dashpot/machine/plant_smoother.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace dashpot {
namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using MatrixMap = Eigen::Map<RowMatrix>;
using ConstMatrixMap = Eigen::Map<const RowMatrix>;
using VectorMap = Eigen::Map<Eigen::VectorXd>;
using ConstVectorMap = Eigen::Map<const Eigen::VectorXd>;

/// Calls see(k, estimate, covariance, sample) at every sample of the filter's run; stops where it
/// returns false. along: a run at whose estimates tangents are taken; null: at the filter's own.
template <class See>
void run_filter(const PlantObserver& observer, const ObservedSamples& samples, std::size_t end,
                const ObservedRun* along, const See& see) {
  const ObserverTables& t = observer.tables();
  std::vector<double> estimate(t.kept()), covariance(t.all() * t.all());
  ObservedSample sample;
  for (std::size_t k = 0; k < end; ++k) {
    const auto now = samples.driven_at(k), measured = samples.measured_at(k);
    if (k == 0 && along)
      observer.start_along(along->at(0, t), now, measured, samples.about, estimate, covariance,
                           sample);
    else if (k == 0)
      observer.start(now, measured, samples.about, estimate, covariance, sample);
    else if (along)
      observer.step_along(along->at(k - 1, t), along->at(k, t), samples.driven_at(k - 1), now,
                          measured, estimate, covariance, sample);
    else
      observer.step(samples.driven_at(k - 1), now, measured, estimate, covariance, sample);
    if (!see(k, estimate, covariance, sample)) return;
  }
}

/// All of a run.
ObservedRun kept_run(const PlantObserver& observer, const ObservedSamples& samples,
                     const ObservedRun* along) {
  ObservedRun run;
  run_filter(observer, samples, samples.count, along,
             [&](std::size_t, const std::vector<double>& estimate,
                 const std::vector<double>& covariance, const ObservedSample& sample) {
               run.estimates.insert(run.estimates.end(), estimate.begin(), estimate.end());
               run.covariances.insert(run.covariances.end(), covariance.begin(), covariance.end());
               run.samples.push_back(sample);
               return true;
             });
  return run;
}

/// The memories of a run along the motion that it tells.
void remember_all(const PlantObserver& observer, const ObservedSamples& samples, ObservedRun& run) {
  const ObserverTables& t = observer.tables();
  const std::span estimates(run.estimates);
  observer.remember_first(samples.driven_at(0), estimates.first(t.kept()));
  for (std::size_t k = 1; k < samples.count; ++k)
    observer.remember(samples.driven_at(k - 1), samples.driven_at(k), run.at(k - 1, t).estimate,
                      run.at(k, t).covariance, estimates.subspan(k * t.kept(), t.kept()));
}

}  // namespace

ObservedRun filtered(const PlantObserver& observer, const ObservedSamples& samples) {
  return kept_run(observer, samples, nullptr);
}

Innovations innovations(const PlantObserver& observer, const ObservedSamples& samples) {
  Innovations told;
  bool finite = true;
  run_filter(
      observer, samples, samples.count, nullptr,
      [&](std::size_t, const std::vector<double>& estimate, const std::vector<double>&,
          const ObservedSample& sample) {
        told.beyond.insert(told.beyond.end(), sample.innovation.begin(), sample.innovation.end());
        told.variance.insert(told.variance.end(), sample.variance.begin(), sample.variance.end());
        finite = std::ranges::all_of(estimate, [](double x) { return std::isfinite(x); });
        return finite;
      });
  return finite ? told : Innovations{};
}

double misfit(const PlantObserver& observer, const ObservedSamples& samples, std::size_t first,
              std::size_t end) {
  double sum = 0;
  run_filter(observer, samples, end, nullptr,
             [&](std::size_t k, const std::vector<double>& estimate, const std::vector<double>&,
                 const ObservedSample& sample) {
               for (std::size_t s = 0; k >= first && s < sample.variance.size(); ++s)
                 if (sample.variance[s] > 0)
                   sum += std::log(sample.variance[s]) +
                          sample.innovation[s] * sample.innovation[s] / sample.variance[s];
               if (!std::ranges::all_of(estimate, [](double x) { return std::isfinite(x); }))
                 sum = INFINITY;
               return std::isfinite(sum);
             });
  return std::isfinite(sum) ? sum : static_cast<double>(INFINITY);
}

void smooth(const PlantObserver& observer, const ObservedSamples& samples, ObservedRun& run) {
  const ObserverTables& t = observer.tables();
  const auto all = static_cast<Eigen::Index>(t.all()),
             moving = static_cast<Eigen::Index>(t.moving());
  const auto sensors = static_cast<std::size_t>(t.sensors);
  Eigen::VectorXd adjoint = Eigen::VectorXd::Zero(all);
  RowMatrix information = RowMatrix::Zero(all, all);
  for (std::size_t k = run.samples.size(); k-- > 0;) {
    const ObservedSample& sample = run.samples[k];
    VectorMap estimate(&run.estimates[k * t.kept()], all);
    MatrixMap covariance(&run.covariances[k * t.all() * t.all()], all, all);
    RowMatrix before = covariance;  // with fewer and fewer of the sensors taken in

    // What the samples behind this one say of it.
    estimate -= covariance * adjoint;
    covariance -= (before * information * before).eval();

    // Back over this sample's sensors, the last one first.
    for (std::size_t s = sensors; s-- > 0;) {
      if (!(sample.variance[s] > 0)) continue;
      const ConstVectorMap row(&sample.rows[s * t.all()], all);
      const Eigen::VectorXd gain = before * row / t.sensor_variance[s];
      adjoint -= row * (gain.dot(adjoint) + sample.innovation[s] / sample.variance[s]);
      const Eigen::VectorXd seen = information * gain;
      const double twice = gain.dot(seen) + 1 / sample.variance[s];
      const Eigen::VectorXd lean = 0.5 * twice * row - seen;
      information += row * lean.transpose() + lean * row.transpose();
      before += sample.variance[s] * gain * gain.transpose();
    }

    // Back over the step that led here: the offsets stay as they are.
    if (k == 0) break;
    const ConstMatrixMap transition(sample.transition.data(), moving, moving);
    adjoint.head(moving) = (transition.transpose() * adjoint.head(moving)).eval();
    information.topRows(moving) = (transition.transpose() * information.topRows(moving)).eval();
    information.leftCols(moving) = (information.leftCols(moving) * transition).eval();
  }
  remember_all(observer, samples, run);
}

void smooth_again(const PlantObserver& observer, const ObservedSamples& samples, ObservedRun& run) {
  constexpr int kPasses = 3;
  for (int pass = 0; pass < kPasses; ++pass) {
    ObservedRun next = kept_run(observer, samples, &run);
    smooth(observer, samples, next);
    if (!std::ranges::all_of(next.estimates, [](double x) { return std::isfinite(x); })) return;
    run = std::move(next);
  }
}

std::vector<double> smoothed_start(const PlantObserver& observer, const ObservedSamples& samples,
                                   std::size_t count) {
  ObservedSamples some = samples;
  some.count = std::min(samples.count, count);
  ObservedRun run = filtered(observer, some);
  smooth(observer, some, run);
  const ObserverTables& t = observer.tables();
  run.estimates.resize(static_cast<std::size_t>(t.plant + t.roads));
  return run.estimates;
}

}  // namespace dashpot
