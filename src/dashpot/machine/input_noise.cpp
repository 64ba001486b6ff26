#include "dashpot/machine/input_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "dashpot/base/parallel.h"
#include "dashpot/machine/between_samples.h"
#include "dashpot/machine/plant_run.h"
#include "dashpot/numerics/constants.h"
#include "dashpot/numerics/linear_algebra.h"
#include "dashpot/numerics/spectrum.h"

namespace dashpot {
namespace {

/// Of the sample rate: above, an input is not known between its samples (between_samples.h).
constexpr double kOfRate = 0.4;

/// The sources in one row: variances of sensors, inputs and the force's errors.
std::vector<double> variances_of(const NoiseSources& sources) {
  std::vector<double> variances;
  for (const auto* list : {&sources.sensors, &sources.inputs, &sources.force})
    for (const double deviation : *list) variances.push_back(deviation * deviation);
  return variances;
}

void set_deviations(const std::vector<double>& variances, NoiseSources& sources) {
  std::size_t j = 0;
  for (auto* list : {&sources.sensors, &sources.inputs, &sources.force})
    for (double& deviation : *list) deviation = std::sqrt(variances[j++]);
}

/// Those that the setup states, and errors of the force where these are known.
std::vector<bool> stated_sources(const InPlantSetup& setup, ForceErrors errors) {
  std::vector<bool> stated;
  for (const PlantSensor& sensor : setup.sensors) stated.push_back(sensor.noise > 0);
  for (const PlantInputChannel& input : setup.inputs)
    stated.push_back(input.noise > 0 || !input.follows.empty());
  stated.resize(stated.size() + force_memories().size(), errors == ForceErrors::Known);
  return stated;
}

}  // namespace

std::span<const double> force_memories() {
  static constexpr std::array kMemories = {0.005, 0.05, 0.5};
  return kMemories;
}

RecordingNoise::RecordingNoise(const InPlantSetup& setup, const StandIn& stand_in,
                               double sample_time, std::size_t samples)
    : sensors_(setup.sensors.size()),
      inputs_(setup.inputs.size()),
      dampers_(setup.dampers()),
      samples_(quick_length(samples)),
      lines_(static_cast<std::size_t>(kOfRate * static_cast<double>(samples_))),
      sample_time_(sample_time) {
  // The plant, with a stand-in for each damper.
  std::vector<PlantInputPlace> places;
  for (const PlantInputChannel& input : setup.inputs) places.push_back(input.place);
  const DrivenPlant plant(make_plant(*setup.model, setup.known), places);
  const std::vector<StandIn> stand_ins(dampers_, stand_in);
  PlantAtLine at(plant, setup, stand_ins);

  // At each line of the spectrum: what every sensor shows of each input, then of each force.
  std::vector<Complex> shows(sensors_);
  const double duration = sample_time * static_cast<double>(samples_);
  for (std::size_t l = 0; l < lines_; ++l) {
    at.move_to(kTurn * static_cast<double>(l + 1) / duration);
    for (std::size_t u = 0; u < inputs_ + dampers_; ++u) {
      if (u < inputs_)
        at.of_input(u, shows);
      else
        at.of_force(u - inputs_, shows);
      gains_.insert(gains_.end(), shows.begin(), shows.end());
    }
    join_followers(setup, at.iw(), l);
  }
}

/// What an axle behind is thought to meet holds the noise of the sensor before it, later: one
/// source with the gains of both.
void RecordingNoise::join_followers(const InPlantSetup& setup, Complex iw, std::size_t line) {
  for (std::size_t u = 0; u < inputs_; ++u) {
    const PlantInputChannel& input = setup.inputs[u];
    if (input.follows.empty()) continue;
    if (line == 0) followers_.push_back({u, followed_by(setup, input), input.later});
    Complex* own = &gains_[line * gains_per_line() + u * sensors_];
    Complex* first = &gains_[line * gains_per_line() + followed_by(setup, input) * sensors_];
    for (std::size_t s = 0; s < sensors_; ++s) {
      first[s] += std::exp(-iw * input.later) * own[s];
      own[s] = 0;
    }
  }
}

void RecordingNoise::set_beyond(const std::vector<std::vector<double>>& beyond) {
  beyond_.resize(lines_ * sensors_);
  const double scale = 1 / std::sqrt(static_cast<double>(samples_));
  for (std::size_t s = 0; s < sensors_; ++s) {
    const std::vector<Complex> lines = half_spectrum(std::span(beyond[s]).first(samples_));
    for (std::size_t l = 0; l < lines_; ++l) beyond_[l * sensors_ + s] = scale * lines[l + 1];
  }
}

void RecordingNoise::set_beyond(std::span<const double> rows) {
  beyond_.resize(lines_ * sensors_);
  for (std::size_t i = 0; i < beyond_.size(); ++i)
    beyond_[i] = Complex(rows[2 * i], rows[2 * i + 1]) / std::numbers::sqrt2;
}

/// The density of a source at a line by that of white samples of the same variance.
double RecordingNoise::shape(std::size_t source, std::size_t line) const {
  if (source < sensors_ + inputs_) return 1;
  const double memory = force_memories()[source - sensors_ - inputs_];
  const double w =
      kTurn * static_cast<double>(line + 1) / (sample_time_ * static_cast<double>(samples_));
  return 2 * memory / sample_time_ / (1 + std::pow(w * memory, 2));
}

/// First and behind the last gain of a source, the unit vectors of the sensors before those of
/// inputs and forces: an error of the force is one of each damper's own.
std::pair<std::size_t, std::size_t> RecordingNoise::gains_of(std::size_t source) const {
  if (source < sensors_ + inputs_) return {source, source + 1};
  return {sensors_ + inputs_, sensors_ + inputs_ + dampers_};
}

void RecordingNoise::weigh_by(const NoiseSources& sources) {
  variances_ = variances_of(sources);
  factors_.assign(lines_ * sensors_ * sensors_, 0);
  std::vector<Complex> shows(sensors_);
  for (std::size_t l = 0; l < lines_; ++l) {
    Complex* covariance = &factors_[l * sensors_ * sensors_];

    // The noise of the sensors themselves, and what they show of that of inputs and force.
    for (std::size_t s = 0; s < sensors_; ++s) covariance[s * sensors_ + s] = variances_[s];
    for (std::size_t j = sensors_; j < variances_.size(); ++j)
      for (auto [g, end] = gains_of(j); g < end; ++g) {
        const Complex* gain = &gains_[l * gains_per_line() + (g - sensors_) * sensors_];
        shows.assign(gain, gain + sensors_);
        add_noise(shows, variances_[j] * shape(j, l), covariance);
      }
    factorise(covariance, sensors_);
  }
}

void RecordingNoise::put_lines(std::span<const double> beyond, std::size_t length,
                               std::span<double> rows) const {
  const double scale = std::numbers::sqrt2 / std::sqrt(static_cast<double>(samples_));
  for (std::size_t s = 0; s < sensors_; ++s) {
    const std::vector<Complex> lines = half_spectrum(beyond.subspan(s * length, samples_));
    for (std::size_t l = 0; l < lines_; ++l) {
      rows[l * rows_per_line() + 2 * s] = scale * lines[l + 1].real();
      rows[l * rows_per_line() + 2 * s + 1] = scale * lines[l + 1].imag();
    }
  }
}

std::vector<std::vector<double>> RecordingNoise::samples_of(std::span<const double> rows) const {
  const double scale = std::sqrt(static_cast<double>(samples_)) / std::numbers::sqrt2;
  std::vector<std::vector<double>> samples;
  for (std::size_t s = 0; s < sensors_; ++s) {
    std::vector<Complex> lines(samples_ / 2 + 1);
    for (std::size_t l = 0; l < lines_; ++l) {
      const double* row = &rows[l * rows_per_line() + 2 * s];
      lines[l + 1] = scale * Complex(row[0], row[1]);
    }
    samples.push_back(from_half_spectrum(lines, samples_));
  }
  return samples;
}

void RecordingNoise::put_forces(std::span<const std::span<const double>> forces,
                                std::span<double> rows) const {
  const double scale = std::numbers::sqrt2 / std::sqrt(static_cast<double>(samples_));
  std::ranges::fill(rows, 0.0);
  for (std::size_t d = 0; d < forces.size(); ++d) {
    const std::vector<Complex> lines = half_spectrum(forces[d].first(samples_));
    for (std::size_t l = 0; l < lines_; ++l)
      for (std::size_t s = 0; s < sensors_; ++s) {
        const Complex shows =
            scale * gains_[l * gains_per_line() + (inputs_ + d) * sensors_ + s] * lines[l + 1];
        rows[l * rows_per_line() + 2 * s] += shows.real();
        rows[l * rows_per_line() + 2 * s + 1] += shows.imag();
      }
  }
}

void RecordingNoise::whiten(std::span<double> rows) const {
  std::vector<Complex> line(sensors_);
  for (std::size_t l = 0; l < lines_; ++l) {
    double* row = &rows[l * rows_per_line()];
    for (std::size_t s = 0; s < sensors_; ++s) line[s] = {row[2 * s], row[2 * s + 1]};
    solve_lower(&factors_[l * sensors_ * sensors_], sensors_, line.data());
    for (std::size_t s = 0; s < sensors_; ++s) {
      row[2 * s] = line[s].real();
      row[2 * s + 1] = line[s].imag();
    }
  }
}

std::vector<std::vector<double>> RecordingNoise::likely_inputs() const {
  std::vector<std::vector<Complex>> lines(inputs_, std::vector<Complex>(samples_ / 2 + 1));
  const double scale = std::sqrt(static_cast<double>(samples_));
  std::vector<Complex> gains, white(sensors_);
  for (std::size_t l = 0; l < lines_; ++l) {
    whitened_gains(l, gains);
    std::copy_n(&beyond_[l * sensors_], sensors_, white.data());
    solve_lower(&factors_[l * sensors_ * sensors_], sensors_, white.data());
    for (std::size_t u = 0; u < inputs_; ++u)
      for (std::size_t s = 0; s < sensors_; ++s)
        lines[u][l + 1] += scale * variances_[sensors_ + u] *
                           std::conj(gains[(sensors_ + u) * sensors_ + s]) * white[s];
  }
  std::vector<std::vector<double>> likely;
  for (const auto& one : lines) likely.push_back(from_half_spectrum(one, samples_));
  for (const Follower& one : followers_)
    likely[one.input] = delayed(likely[one.follows], sample_time_, one.later);
  return likely;
}

/// L^-1 of the sensors' unit vectors, the inputs' gains and the forces': each `sensors_` numbers.
void RecordingNoise::whitened_gains(std::size_t line, std::vector<Complex>& gains) const {
  gains.assign(sensors_ * sensors_ + gains_per_line(), 0);
  for (std::size_t s = 0; s < sensors_; ++s) gains[s * sensors_ + s] = 1;
  std::copy_n(&gains_[line * gains_per_line()], gains_per_line(), &gains[sensors_ * sensors_]);
  for (std::size_t g = 0; g < sensors_ + inputs_ + dampers_; ++g)
    solve_lower(&factors_[line * sensors_ * sensors_], sensors_, &gains[g * sensors_]);
}

RecordingNoise::Shares RecordingNoise::shares() const {
  Shares shares{std::vector<double>(sources()), std::vector<double>(sources())};
  std::vector<Complex> gains, white(sensors_);
  for (std::size_t l = 0; l < lines_; ++l) {
    whitened_gains(l, gains);
    std::copy_n(&beyond_[l * sensors_], sensors_, white.data());
    solve_lower(&factors_[l * sensors_ * sensors_], sensors_, white.data());

    // How much of what the line shows lies along each source, and how much should.
    for (std::size_t j = 0; j < sources(); ++j)
      for (auto [g, end] = gains_of(j); g < end; ++g) {
        Complex along = 0;
        double length = 0;
        for (std::size_t s = 0; s < sensors_; ++s) {
          along += std::conj(gains[g * sensors_ + s]) * white[s];
          length += std::norm(gains[g * sensors_ + s]);
        }
        shares.found[j] += shape(j, l) * std::norm(along);
        shares.expected[j] += shape(j, l) * length;
      }
  }
  return shares;
}

std::vector<double> RecordingNoise::information() const {
  const std::size_t n = sources();
  std::vector<double> information(n * n);
  std::vector<Complex> gains;
  for (std::size_t l = 0; l < lines_; ++l) {
    whitened_gains(l, gains);

    // Of each pair, by the logarithms of their variances.
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        const double weight = variances_[i] * shape(i, l) * variances_[j] * shape(j, l);
        for (auto [a, last_a] = gains_of(i); a < last_a; ++a)
          for (auto [b, last_b] = gains_of(j); b < last_b; ++b) {
            Complex product = 0;
            for (std::size_t s = 0; s < sensors_; ++s)
              product += std::conj(gains[a * sensors_ + s]) * gains[b * sensors_ + s];
            information[i * n + j] += weight * std::norm(product);
          }
      }
  }
  return information;
}

NoiseFound find_noise(std::vector<RecordingNoise>& recordings, const InPlantSetup& setup,
                      const NoiseSources& first, int threads, ForceErrors errors) {
  constexpr int kMost = 200;
  constexpr double kSame = 1e-3, kOfNoWeight = 1e-4, kLeastShare = 1e-9;
  const std::vector<bool> stated = stated_sources(setup, errors);
  NoiseFound found{.sources = first, .uncertainty = {}};
  std::vector<double> variances = variances_of(first);
  const std::vector<double> least = variances;
  std::size_t rows = 0;
  for (const RecordingNoise& one : recordings) rows += one.lines() * setup.sensors.size();

  // Each variance times what was found of it over what was expected, until they agree.
  std::vector<RecordingNoise::Shares> shares(recordings.size());
  bool settled = false;
  for (int k = 0; k < kMost && !settled; ++k) {
    set_deviations(variances, found.sources);
    parallel_for(recordings.size(), threads, [&](std::size_t r) {
      recordings[r].weigh_by(found.sources);
      shares[r] = recordings[r].shares();
    });
    settled = true;
    for (std::size_t j = 0; j < variances.size(); ++j) {
      double of = 0, expected = 0;
      for (const RecordingNoise::Shares& one : shares) {
        of += one.found[j];
        expected += one.expected[j];
      }
      if (stated[j] || !(expected > 0)) continue;
      const double weight = variances[j] * expected / static_cast<double>(rows);
      settled = settled && (weight < kOfNoWeight || std::abs(of / expected - 1) < kSame);
      variances[j] = std::max(variances[j] * of / expected, kLeastShare * least[j]);
    }
  }

  // How well they are known.
  const std::size_t n = variances.size();
  std::vector<double> information(n * n);
  for (const RecordingNoise& one : recordings) {
    const std::vector<double> own = one.information();
    for (std::size_t i = 0; i < n * n; ++i) information[i] += own[i];
  }
  constexpr double kLeast = 1e-3;  // so that what plays no part does not spoil the others
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i < n && stated[j]; ++i)
      information[i * n + j] = information[j * n + i] = 0;
    information[j * n + j] += kLeast;
  }
  const std::vector<double> spread = inverse(information, n);
  for (std::size_t j = 0; j < n; ++j)
    found.uncertainty.push_back(stated[j] ? 0 : 0.5 * std::sqrt(spread[j * n + j]));
  return found;
}

}  // namespace dashpot
