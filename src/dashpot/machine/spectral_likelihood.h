#pragma once
#include <complex>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dashpot/machine/damper_unknowns.h"
#include "dashpot/machine/in_plant_report.h"
#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/machine/observer_tables.h"
#include "dashpot/machine/plant_at_line.h"
#include "dashpot/machine/plant_recording.h"
#include "dashpot/machine/road_pairs.h"
#include "dashpot/monitor.h"

namespace dashpot {

/// A recording of a plant on a road that nothing measures, with the dampers' motions as sensors
/// tell them (extension, its rate, the drive) at each sample.
struct RiddenRecording {
  const PlantRecording* recording = nullptr;
  std::size_t samples = 0;                        ///< that are fitted, from the first on
  std::vector<std::vector<DamperInput>> motions;  ///< per damper
};

/// How likely recordings are, as a function of all unknowns of plant, damper and noise, at the
/// frequencies at which the road's prior holds. The law runs along each damper's motion; its force
/// is a spring and a dashpot that stand for it best (least squares), which are made part of the
/// plant, and a remainder, which is an input; so that at each frequency what the sensors show is
///
///   Y = sum of G_F (F - k d - c v) + sum of G_w W + end terms + N,
///
/// normal, with the spectra of the road under each tyre, of sensor noise and of the law's own error
/// in each damper, none of which knows another (P. Whittle 1953), but for roads side by side: these
/// share what tracks of an isotropic surface do, so far apart as is found. (With all of the force
/// as an input it would count as if it did not follow from the road.) The
/// end terms, polynomials in i w over the plant's denominator (Pintelon and Schoukens, System
/// Identification, 2012, chapter 6), stand for the states at both ends; they are eliminated.
/// Delays are exact.
///
/// The unknowns: the plant's numbers, each in the size at which it starts; the law's; delays of
/// sensors, in samples; logarithms of what is uncertain and was not stated; where they are asked
/// for, a spring and a dashpot beside the law. All that it is made from must outlive it.
class SpectralLikelihood final : public InPlantUnknowns {
 public:
  /// force: half span of the damper's, N, for the limits of the law's error.
  SpectralLikelihood(const InPlantSetup& setup, const std::vector<RiddenRecording>& rides,
                     const DamperUnknowns& law, const std::vector<double>& plant,
                     const ObserverNoise& first, double force, bool has_more = false);

  /// The unknowns of these numbers of the plant, SI, of the law, and of the first noise.
  std::vector<double> start(const std::vector<double>& plant, const std::vector<double>& law) const;

  /// What the sensors show beyond the model at each frequency, and its covariance.
  struct Spectra {
    std::vector<std::complex<double>> beyond;      ///< lines x sensors
    std::vector<std::complex<double>> covariance;  ///< lines x sensors x sensors
  };
  using Lines = std::vector<std::complex<double>>;
  /// The law's force along the motion of each damper: the spring and the dashpot that stand for it
  /// best, and the lines of what is left.
  struct Force {
    std::vector<StandIn> stand_ins;
    std::vector<Lines> rests;  ///< empty where the law diverges
  };
  Force force_of(std::span<const double> x, std::size_t ride) const;
  /// False where a number is not finite.
  bool evaluate(std::span<const double> x, std::size_t ride, const Force& force,
                Spectra& spectra) const;

  std::size_t size() const { return lower_.size(); }
  const std::vector<double>& lower() const { return lower_; }
  const std::vector<double>& upper() const { return upper_; }
  std::size_t rides() const { return rides_->size(); }
  std::size_t sensors() const { return setup_->sensors.size(); }

  /// The law of each kind of damper.
  std::vector<LawModel> laws(std::span<const double> x) const;
  ObserverNoise noise(std::span<const double> x) const;
  /// The setup with all that x says: the plant's numbers, noise, road and what is found of sensors.
  InPlantSetup setup_at(std::span<const double> x) const;
  bool is_noise(std::size_t k) const { return k >= first_noise_ && k < first_more_; }
  /// A spring or a dashpot beside the law, which start at 0; from here on it stays there.
  std::size_t first_more() const { return first_more_; }
  void hold_at_zero(std::size_t k) { lower_[k] = upper_[k] = 0; }
  bool is_held(std::size_t k) const { return lower_[k] == upper_[k]; }

  std::size_t plant_unknowns() const override { return setup_->unknown.size(); }
  bool is_of_law(std::size_t k) const override;
  const SensorUnknown* of_sensor(std::size_t k) const override;
  std::string name(std::size_t k) const override;
  FittedParameter described(std::size_t k, std::span<const double> x) const override;
  double size_at(std::size_t k, std::span<const double> x) const override;
  std::vector<LawUnknowns::Coefficient> law_coefficients(std::span<const double> x) const override;

 private:
  /// What is uncertain and sought: its name and unit, and its place.
  struct Sought {
    std::string name, unit;
    std::function<double*(ObserverNoise&)> place;
  };
  /// What the law does along one motion; false where it diverges.
  bool add_force(const LawModel& model, std::span<const DamperInput> motion, Force& force) const;
  struct Ride {
    std::size_t samples = 0;  ///< without the last few, so that their count has small factors
    double duration = 0;      ///< s
    std::size_t first = 0, end = 0;                  ///< lines
    std::vector<std::optional<double>> levels = {};  ///< of the drive (held_levels)
    std::vector<Lines> shown, inputs;                ///< per sensor; per input, of a road empty
  };
  void seek(std::string name, std::string unit, std::function<double*(ObserverNoise&)> place,
            double low, double high);
  void seek_noise(double force);
  Ride ride_of(const RiddenRecording& ridden) const;

  const InPlantSetup* setup_;
  const std::vector<RiddenRecording>* rides_;
  const DamperUnknowns* law_;
  ObserverNoise first_;
  std::vector<double> plant_;  ///< sizes
  double sample_time_, highest_;
  std::vector<PlantInputPlace> inputs_;
  std::vector<RoadPair> pairs_;
  std::vector<SensorUnknown> of_sensors_;
  std::size_t first_of_sensors_, first_noise_, first_more_;  ///< places among the unknowns
  StandIn more_ = {};  ///< sizes of what stands beside the law
  std::vector<Sought> sought_;
  std::vector<double> lower_, upper_;
  std::vector<Ride> prepared_;
};

/// The curvature of -log L and what is left over, about one point: J'J of normalised residuals r is
/// the expected information (R. A. Fisher), J'r the gradient.
struct LikelihoodSlopes {
  bool finite = false;
  double value = 0;                           ///< -log L
  std::vector<double> gradient, information;  ///< n; n x n
  /// n each: sums of r J over up to 20 frequencies, or so few that there are enough blocks.
  std::vector<std::vector<double>> block_scores;
};

/// So many blocks for each unknown say how the scores scatter.
inline constexpr std::size_t kBlocksPerUnknown = 3;

struct MostLikely {
  bool converged = false;
  std::vector<double> x;
  LikelihoodSlopes slopes;  ///< there
  int iterations = 0;
};

/// The most likely unknowns by Fisher's scoring, held back as Levenberg and Marquardt do, within
/// the bounds; derivatives by differences, a column and a ride per core. Not converging is a
/// status; the slopes are not finite where the law diverges at the start.
MostLikely most_likely(const SpectralLikelihood& likelihood, std::vector<double> x, int iterations,
                       int threads, const Monitor& monitor);

}  // namespace dashpot
