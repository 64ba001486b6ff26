#pragma once
#include <complex>
#include <span>
#include <utility>
#include <vector>

#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/machine/plant_at_line.h"

namespace dashpot {

// Where the sensors of a plant's inputs are noisy. Their noise moves the model and not the plant,
// so that the model shows beyond the sensors, at each frequency,
//
//   E = G_N N + G_D D + M,
//
// N the noise of the inputs' sensors, D errors of the law's force in each damper, M the noise of
// the plant's sensors: normal, with the gains G of the plant with a spring and a dashpot in the
// damper's place. Least squares of E are biased, since N is in the sensitivities as well (errors in
// variables: T. Soderstrom, Automatica 43 (2007) 939-958). So sensitivities are taken under inputs
// without their most likely noise, S_N G_N* S^-1 E with S the covariance of E: what is then left of
// N in them does not depend on E, however E is weighed.

/// Standard deviations of what E consists of, SI.
struct NoiseSources {
  std::vector<double> sensors, inputs;  ///< per sensor and input, white
  std::vector<double> force;            ///< N, of errors that are forgotten after force_memories()
};
/// s: what a force's error may come and go with.
std::span<const double> force_memories();

struct NoiseFound {
  NoiseSources sources;
  /// Standard deviations of their logarithms, in the order above; 0 where one was known.
  std::vector<double> uncertainty;
};

/// One recording's E at each frequency above 0, up to where its inputs are known between samples.
class RecordingNoise {
 public:
  /// The setup's numbers are known and its delays hold; `samples` at hand, of which the most are
  /// used whose count has small factors.
  RecordingNoise(const InPlantSetup& setup, const StandIn& stand_in, double sample_time,
                 std::size_t samples);

  std::size_t samples() const { return samples_; }
  std::size_t lines() const { return lines_; }
  std::size_t rows_per_line() const { return 2 * sensors_; }

  /// E, as samples of each sensor.
  void set_beyond(const std::vector<std::vector<double>>& beyond);
  /// E as such rows as put_lines() makes.
  void set_beyond(std::span<const double> rows);
  /// Weighs by these sources from now on.
  void weigh_by(const NoiseSources& sources);
  /// E of at least so many samples, sensor by sensor, each `length` long, as real numbers, line by
  /// line; white samples keep their variance.
  void put_lines(std::span<const double> beyond, std::size_t length, std::span<double> rows) const;
  /// The samples of each sensor of which rows say all up to the last line, and nothing above it;
  /// their products add up to those of the rows.
  std::vector<std::vector<double>> samples_of(std::span<const double> rows) const;
  /// What the sensors show of forces of the dampers, as such rows.
  void put_forces(std::span<const std::span<const double>> forces, std::span<double> rows) const;
  /// Brings such rows, in the units of the sensors, to rows whose noise is white, of variance 1.
  void whiten(std::span<double> rows) const;
  /// The most likely noise of each input's sensor.
  std::vector<std::vector<double>> likely_inputs() const;

  /// Per source: the sum over all lines of what E holds of it, and of what it would hold on the
  /// mean, each over its variance.
  struct Shares {
    std::vector<double> found, expected;
  };
  Shares shares() const;
  /// The expected information about the logarithms of the sources' variances, sources x sources.
  std::vector<double> information() const;

 private:
  using Complex = std::complex<double>;
  std::size_t sources() const { return sensors_ + inputs_ + force_memories().size(); }
  void join_followers(const InPlantSetup& setup, Complex iw, std::size_t line);
  double shape(std::size_t source, std::size_t line) const;
  void whitened_gains(std::size_t line, std::vector<Complex>& gains) const;
  std::pair<std::size_t, std::size_t> gains_of(std::size_t source) const;
  /// The gains at a line, of inputs and then of the dampers' forces: `sensors_` numbers each.
  std::size_t gains_per_line() const { return (inputs_ + dampers_) * sensors_; }

  std::size_t sensors_, inputs_, dampers_, samples_, lines_;
  double sample_time_;
  std::vector<Complex> gains_;    ///< lines x (inputs, then forces) x sensors
  std::vector<Complex> beyond_;   ///< lines x sensors, scaled to the variance of a sample
  std::vector<Complex> factors_;  ///< lines x sensors x sensors: of S
  std::vector<double> variances_;
  /// An input that is another one, later: both by their places.
  struct Follower {
    std::size_t input, follows;
    double later;
  };
  std::vector<Follower> followers_;
};

/// Whether errors of the law's force are found, or are as large as is said.
enum class ForceErrors { Found, Known };

/// The sources under which all recordings are most likely, from `first` on; what a setup states is
/// known. Afterwards the recordings are weighed by them.
NoiseFound find_noise(std::vector<RecordingNoise>& recordings, const InPlantSetup& setup,
                      const NoiseSources& first, int threads,
                      ForceErrors errors = ForceErrors::Found);

}  // namespace dashpot
