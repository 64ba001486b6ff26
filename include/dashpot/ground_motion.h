// Layer: suspension
#pragma once

// The ground under a plant: a road as the tyres meet it, or ground that shakes. simulate() asks it
// for heights; make_ground() makes it from a text. SI, z up.

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace dashpot {

/// Height under a tyre and its rate.
struct FootMotion {
  double height = 0, velocity = 0;  ///< m, m/s
};

/// The motion under the feet of a plant: the road under each track as it passes, or ground that
/// shakes. Immutable.
class GroundMotion {
 public:
  virtual ~GroundMotion() = default;
  virtual std::string description() const = 0;  ///< "iso8608: class C, speed 20 m/s, ..."
  /// The time, s, from which on it only repeats or stays.
  virtual double duration() const noexcept { return std::numeric_limits<double>::infinity(); }
  /// The motion under a tyre on `track` (0 left or only, 1 right), `behind` metres behind the first
  /// axle, at t seconds.
  virtual FootMotion foot(double t, std::size_t track, double behind) const noexcept = 0;
  /// The same at t, t + step, ... `out` holds how many.
  virtual void feet(double t, double step, std::size_t track, double behind,
                    std::span<FootMotion> out) const noexcept {
    for (std::size_t k = 0; k < out.size(); ++k)
      out[k] = foot(t + step * static_cast<double>(k), track, behind);
  }
  /// The same at each of these instants, s.
  virtual void feet_at(std::span<const double> t, std::size_t track, double behind,
                       std::span<FootMotion> out) const noexcept {
    for (std::size_t k = 0; k < t.size(); ++k) out[k] = foot(t[k], track, behind);
  }
  /// The acceleration of the ground, m/s^2, at t seconds.
  virtual double acceleration(double) const noexcept { return 0; }
  /// Whether it is an acceleration, which plants without tyres ask for, and not a height.
  virtual bool shakes() const noexcept { return false; }
  /// Whether it is alike all along, a road or a sine: its start may be left out of measures.
  virtual bool is_steady() const noexcept { return false; }
  /// The speed along the road, m/s; 0: its height is one of time, and all tyres meet it at once.
  virtual double speed() const noexcept { return 0; }
  /// Instants at which a height under a tyre that far behind jumps; foot() gives what is after it.
  virtual std::vector<double> jumps(double) const { return {}; }
};

using GroundPointer = std::unique_ptr<const GroundMotion>;

/// From a text like "iso8608,class=C,speed=72km/h" or "step,height=3cm"; "class=C" stands for the
/// roughness of that class. A file's: "measured,file=road.txt,speed=72km/h" or
/// "earthquake,file=el_centro.dat,unit=g0", as recorded_grounds() has them. Throws Error(where,
/// ...) on an unknown name or parameter and on a value that is out of bounds.
GroundPointer make_ground(const std::string& text, std::uint64_t seed,
                          const std::string& where = "road");

}  // namespace dashpot
