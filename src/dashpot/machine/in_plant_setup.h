#pragma once
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dashpot/drive.h"
#include "dashpot/fit_choices.h"
#include "dashpot/machine/plant_run.h"
#include "dashpot/machine/sensor_filter.h"
#include "dashpot/monitor.h"
#include "dashpot/plant.h"

namespace dashpot {

// A plant with a damper that is to be identified in it, one in each of its struts: what is known of
// the plant, what moves it, what was measured on it, and what is said of a fit in the end.

/// A single mass on a spring and a dashpot, beside which the damper stands on ground that may move:
///   m q'' + c (q' - w') + k (q - w) = force - F(q - w, q' - w')
/// Beside the plants of find_plant_model(), "oscillator" is one.
const PlantModel& find_machine(const std::string& name, const std::string& where);
std::vector<std::string> machine_names();

/// One number of the plant that is to be found, by its row in the plant's table.
struct PlantUnknown {
  std::string name;
  double lower = 0, upper = 0;  ///< SI
  std::optional<double> about;  ///< where the search starts; nothing: from the data or the table
};

/// A road that nothing measures, as ISO 8608 has it.
struct RoadPrior {
  double roughness = 0;  ///< m^3, G_d(n0); 0: unknown
  double speed = 0;      ///< m/s

  bool operator==(const RoadPrior&) const = default;
};

/// What an identification found of a sensor that said nothing of its noise. Observers may take it
/// (found_noise.h); all else finds it anew.
struct IdentifiedNoise {
  double deviation = 0;   ///< SI; 0: nothing was found
  double zero = 0;        ///< how far its zero may be off, likewise; 0: as far as its noise
  std::string from = {};  ///< who says so, where it stands in the place of a noise that is stated
};

struct PlantInputChannel {
  std::string channel;  ///< empty: nothing measures it, and `road` says what is known of it
  PlantInputPlace place;
  double noise = 0;  ///< standard deviation of what it measures, SI; 0: unknown (beside_noise.h)
  std::optional<RoadPrior> road = {};
  /// Of a road that another axle met before: the channel of that, and how much later it comes, s.
  /// Its own channel is then one that with_followers() makes.
  std::string follows = {};
  double later = 0;
  bool finds_later = false;  ///< `later` is where the search for it starts
  IdentifiedNoise identified = {};
};

/// Where the cut-off of a filter is looked for, Hz.
struct CutoffRange {
  double lower = 0;         ///< 0: nothing is stated (sensor_unknowns.h)
  double upper = INFINITY;  ///< infinite: there may be no filter
};

struct PlantSensor {
  std::string channel;
  PlantSensorPlace place;
  double noise = 0;          ///< its standard deviation, SI; 0: unknown
  double zero = 0;           ///< how far its zero may be off, likewise; 0: as far as its noise
  bool finds_delay = false;  ///< its delay is an unknown
  double delay = 0;          ///< s, known or where the search starts
  SensorFilter filter = {};  ///< before its delay
  /// The cut-off of its filter is an unknown, and that of `filter` where the search starts (0: at
  /// no filter).
  std::optional<CutoffRange> finds_cutoff = {};
  IdentifiedNoise identified = {};
};

/// A number of the plant that a fit found, with its 95 % interval, SI.
struct FoundNumber {
  std::string name;
  double low = 0, high = 0;
};

/// Which of the dampers in a plant are alike.
struct DamperKinds {
  std::vector<std::string> names = {""};  ///< the only kind has none
  std::vector<std::size_t> of = {};       ///< per strut the place of its name; empty: the only one
  bool are_stated = false;                ///< else they are alike until the sensors tell otherwise

  std::size_t size() const { return names.size(); }
  std::size_t at(std::size_t strut) const { return of.empty() ? 0 : of[strut]; }
  /// Those of a kind, of so many.
  std::vector<std::size_t> struts(std::size_t kind, std::size_t count) const;
  /// What belongs to a kind: "front.alpha", of the only one "alpha".
  std::string named(std::size_t kind, const std::string& name) const {
    return names[kind].empty() ? name : names[kind] + "." + name;
  }
};

/// Left and right alike, front and rear not: of a kind are the dampers whose struts differ in
/// "_left" and "_right" alone.
DamperKinds kinds_by_axle(const Plant& plant);

/// What drives a damper, as it is recorded.
struct DamperDrive {
  std::string channel;  ///< of the current or voltage; empty: `level` all along
  double level = 0;     ///< A or V
};

struct PlantOfMatrices;
struct PlantRecording;

/// What is known of a plant, and what was measured on it.
struct InPlantSetup {
  const PlantModel* model = nullptr;
  /// Where the plant is none of the shipped kinds: what holds its model (plant_of_matrices.h).
  std::shared_ptr<const PlantOfMatrices> matrices = nullptr;
  NamedValues known;               ///< SI; what is neither known nor unknown is as in the table
  std::vector<FoundNumber> found;  ///< those of the known ones that a fit found
  std::vector<PlantUnknown> unknown;
  std::vector<PlantInputChannel> inputs;
  std::vector<PlantSensor> sensors;
  DamperKinds kinds;                       ///< of the dampers
  std::vector<DamperDrive> drives = {{}};  ///< one of all dampers, or one for each strut
  DriveUnit drive_unit = DriveUnit::None;
  bool from_rest = false;   ///< each recording begins at rest
  double held_back = 0.25;  ///< share of each recording, its end, that judges the result
  double skip = 0;          ///< s at the beginning that are run and not compared

  /// Names of the channels that it speaks of.
  std::vector<std::string> channels() const;
  /// How many dampers stand in the plant.
  std::size_t dampers() const;
  const DamperDrive& drive_of(std::size_t damper) const {
    return drives[drives.size() > 1 ? damper : 0];
  }
  /// The channels of the drives, each once.
  std::vector<std::string> drive_channels() const;
};

/// Throws Error where a setup contradicts itself or its plant: a name that is not there, an input
/// or a sensor that is missing.
void require_setup(const InPlantSetup& setup);
/// Throws Error where a channel of the recording counts something else than the setup says of it: a
/// speed for an acceleration, a voltage for a current. A channel that states no unit is taken as
/// SI.
void require_units(const InPlantSetup& setup, const PlantRecording& recording);
/// For what knows a single damper, and no road that follows another one. Throws Error "has 2
/// dampers, and `who` knows one".
void require_one_damper(const InPlantSetup& setup, const std::string& who);
/// For what cannot find a sensor's delay or the cut-off of its filter. Throws Error "its delay is
/// unknown".
void require_known_lags(const InPlantSetup& setup);
/// For what finds nothing of the plant and its sensors. Throws Error where a number, a delay or a
/// cut-off is unknown.
void require_known(const InPlantSetup& setup);
/// For what knows dampers that are all alike. Throws Error "has dampers of 2 kinds, ...".
void require_alike(const InPlantSetup& setup, const std::string& who);
/// The dampers of this name: that in a strut, or those of a kind; none where there is none.
std::vector<std::size_t> dampers_named(const InPlantSetup& setup, const std::string& name);
/// Every name that a damper goes by: the struts, then the kinds where there are several.
std::vector<std::string> damper_names(const InPlantSetup& setup);
/// The setup with dampers that are of a kind on each axle (kinds_by_axle), where the plant does not
/// say what they are. Nothing where it does, or has one.
std::optional<InPlantSetup> with_unlike_dampers(InPlantSetup setup);
/// For what knows no road that follows another one. Throws Error likewise.
void require_no_follower(const InPlantSetup& setup, const std::string& who);
/// Which input a road follows: the place in the setup of the one whose channel it names; behind
/// the last where there is none.
std::size_t followed_by(const InPlantSetup& setup, const PlantInputChannel& follower);
/// What is known of the roads that nothing measures, which are all alike; null where there is none.
const RoadPrior* unmeasured_road(const InPlantSetup& setup);

struct InPlantOptions {
  std::vector<ParameterChoice> choices;  ///< of the law, as on the bench
  NetworkDesign network;                 ///< of models that are no laws, likewise
  bool asymmetric = false;  ///< without a road: rebound and compression apart where that pays
  int starts = 12;
  int iterations = 100;
  std::uint64_t seed = 1;
  int threads = 0;
  std::size_t steps = 0;      ///< of the integrator per sample; 0: as many as its error asks for
  std::string grade = "car";  ///< of sensors that are not there and may be advised; none: ""
  /// Numbers whose profile is wanted, beside those that no sensor tells.
  std::vector<std::string> profiles = {};
  Monitor monitor;
};

/// How well a sensor was met, in free run from the first sample on.
struct SensorFigures {
  std::string recording, channel, unit;
  double rms = 0;       ///< of what it showed, without its mean
  double training = 0;  ///< rms error
  /// rms error over the time that no setting has seen; NaN: none was; infinite: diverged there.
  double held_back = 0;
  double offset = 0;  ///< found, and taken off
};

/// A damper over a recording, modelled.
struct DamperTrace {
  std::string strut;  ///< in which it stands
  std::vector<double> deflection, velocity, force;
  std::vector<double> current = {};  ///< A or V
};

/// The sensors over one recording, as measured and in free run.
struct InPlantTrace {
  std::string recording;
  double sample_time = 0;
  std::size_t first = 0;     ///< sample that was compared first
  std::size_t training = 0;  ///< samples up to the end of what was fitted
  std::vector<std::vector<double>> measured, modelled;  ///< per sensor; offsets put on
  std::vector<DamperTrace> dampers = {};
};

}  // namespace dashpot
