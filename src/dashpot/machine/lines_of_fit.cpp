#include "dashpot/machine/lines_of_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dashpot/base/parallel.h"
#include "dashpot/machine/between_samples.h"
#include "dashpot/machine/plant_at_line.h"

namespace dashpot {

std::vector<InPlantTrace> traces_at(const PlantResiduals& residuals, std::span<const double> x,
                                    int threads) {
  std::vector<SensorFigures> figures;
  std::vector<InPlantTrace> traces;
  residuals.describe(x, figures, traces, threads);
  return traces;
}

std::vector<RecordingNoise> noise_about(const InPlantSetup& setup, const PlantCases& cases,
                                        const std::vector<InPlantTrace>& traces, int threads) {
  std::vector<std::optional<RecordingNoise>> found(traces.size());
  parallel_for(traces.size(), threads, [&](std::size_t c) {
    const InPlantTrace& trace = traces[c];
    const std::size_t first = cases.all[c].first, count = trace.training - first;

    // The spring and the dashpot along this motion, of all dampers together.
    std::vector<DamperInput> motion;
    std::vector<double> force;
    for (const DamperTrace& damper : trace.dampers)
      for (std::size_t k = first; k < trace.training; ++k) {
        motion.push_back({damper.deflection[k], damper.velocity[k], damper.current[k]});
        force.push_back(damper.force[k]);
      }
    const auto stand_in = stand_in_of(motion, force);
    if (!stand_in) return;
    found[c].emplace(setup, *stand_in, trace.sample_time, count);

    // What is shown beyond the sensors.
    std::vector<std::vector<double>> beyond(setup.sensors.size(), std::vector<double>(count));
    for (std::size_t s = 0; s < beyond.size(); ++s)
      for (std::size_t k = 0; k < count; ++k)
        beyond[s][k] = trace.modelled[s][first + k] - trace.measured[s][first + k];
    found[c]->set_beyond(beyond);
  });
  std::vector<RecordingNoise> all;
  for (std::optional<RecordingNoise>& one : found) {
    if (!one) return {};
    all.push_back(std::move(*one));
  }
  return all;
}

PlantCases without_noise(const PlantCases& as_measured, const InPlantSetup& setup,
                         const std::vector<PlantRecording>& recordings,
                         const std::vector<RecordingNoise>& noise, int threads) {
  PlantCases cases = as_measured;
  parallel_for(cases.all.size(), threads, [&](std::size_t c) {
    PlantCase& one = cases.all[c];
    const std::vector<std::vector<double>> likely = noise[c].likely_inputs();
    for (std::size_t u = 0; u < setup.inputs.size(); ++u) {
      std::vector<double> input = recordings[c].channel(setup.inputs[u].channel).samples;
      for (std::size_t k = 0; k < likely[u].size(); ++k) input[one.first + k] -= likely[u][k];
      FinerSignal finer = band_limited(input, one.driving.sample_time, one.driving.stride());
      one.driving.value[u] = std::move(finer.value);
      one.driving.rate[u] = std::move(finer.rate);
    }
  });
  return cases;
}

void keep_residuals(const std::vector<InPlantTrace>& as_measured,
                    const std::vector<InPlantTrace>& without, PlantCases& cases) {
  for (std::size_t c = 0; c < cases.all.size(); ++c)
    for (std::size_t s = 0; s < cases.all[c].measured.size(); ++s)
      for (std::size_t k = 0; k < cases.all[c].measured[s].size(); ++k)
        cases.all[c].measured[s][k] -= as_measured[c].modelled[s][k] - without[c].modelled[s][k];
}

std::optional<EndOfSearch> end_of(const LeastSquaresProblem& problem, std::span<const double> x) {
  EndOfSearch end{std::vector<double>(problem.residuals), {}};
  std::vector<double*> places;
  end.columns.resize(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (problem.lower[k] < problem.upper[k]) end.columns[k].resize(problem.residuals);
    places.push_back(end.columns[k].empty() ? nullptr : end.columns[k].data());
  }
  if (!problem.jacobian(x, end.residuals, places)) return {};
  return end;
}

std::vector<BlockOfData> pieces_of(const EndOfSearch& end, const std::vector<RecordingNoise>& noise,
                                   int threads) {
  constexpr double kPieces = 24;
  double length = 0;  // samples
  for (const RecordingNoise& one : noise) length += static_cast<double>(one.samples()) / kPieces;
  const std::size_t n = end.columns.size();
  std::vector<BlockOfData> pieces;
  for (std::size_t c = 0, at = 0; c < noise.size(); ++c) {
    // Columns and residuals as samples.
    const std::size_t count = noise[c].lines() * noise[c].rows_per_line();
    const auto samples_of = [&](const std::vector<double>& rows) {
      return noise[c].samples_of(std::span(rows).subspan(at, count));
    };
    std::vector<std::vector<std::vector<double>>> columns(n);
    parallel_for(n, threads, [&](std::size_t k) {
      if (!end.columns[k].empty()) columns[k] = samples_of(end.columns[k]);
    });
    const std::vector<std::vector<double>> left = samples_of(end.residuals);
    at += count;

    // Their products in each piece.
    const auto samples = static_cast<double>(noise[c].samples());
    const auto own = static_cast<std::size_t>(std::max(2.0, std::round(samples / length)));
    const std::size_t before = pieces.size();
    pieces.resize(before + own);
    parallel_for(own, threads, [&](std::size_t piece) {
      const std::size_t first = piece * noise[c].samples() / own,
                        behind = (piece + 1) * noise[c].samples() / own;
      const auto along = [&](const auto& a, const auto& b) {
        double sum = 0;
        for (std::size_t s = 0; s < a.size() && s < b.size(); ++s)
          for (std::size_t i = first; i < behind; ++i) sum += a[s][i] * b[s][i];
        return sum;
      };
      BlockOfData one{std::vector<double>(n * n), std::vector<double>(n)};
      for (std::size_t k = 0; k < n; ++k) {
        one.score[k] = along(columns[k], left);
        for (std::size_t m = 0; m <= k; ++m)
          one.information[k * n + m] = one.information[m * n + k] = along(columns[k], columns[m]);
      }
      pieces[before + piece] = std::move(one);
    });
  }
  return pieces;
}

}  // namespace dashpot
