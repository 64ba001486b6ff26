#include "dashpot/suspension/ground/deterministic.h"

#include <cmath>

#include "dashpot/base/text.h"
#include "dashpot/numerics/constants.h"

namespace dashpot {
namespace {

std::string with_unit(double value, const char* unit) { return format_number(value) + " " + unit; }

class Step final : public GroundMotion {
 public:
  Step(double height, double at) : height_(height), at_(at) {}
  std::string description() const override { return "step of " + with_unit(height_, "m"); }
  FootMotion foot(double t, std::size_t, double) const noexcept override {
    return {t >= at_ ? height_ : 0, 0};
  }
  std::vector<double> jumps(double) const override { return {at_}; }

 private:
  double height_, at_;
};

class Sine final : public GroundMotion {
 public:
  Sine(double amplitude, double frequency) : amplitude_(amplitude), rate_(kTurn * frequency) {}
  bool is_steady() const noexcept override { return true; }
  std::string description() const override {
    return "sine of " + with_unit(amplitude_, "m") + ", " + with_unit(rate_ / kTurn, "Hz");
  }
  FootMotion foot(double t, std::size_t, double) const noexcept override {
    return {amplitude_ * std::sin(rate_ * t), amplitude_ * rate_ * std::cos(rate_ * t)};
  }

 private:
  double amplitude_, rate_;
};

class Chirp final : public GroundMotion {
 public:
  Chirp(double amplitude, double f0, double f1, double duration, bool exponential)
      : amplitude_(amplitude), f0_(f0), f1_(f1), duration_(duration), exponential_(exponential) {}
  std::string description() const override {
    return std::string(exponential_ ? "exponential" : "linear") + " chirp of " +
           with_unit(amplitude_, "m") + ", " + format_number(f0_) + " ... " + with_unit(f1_, "Hz") +
           " in " + with_unit(duration_, "s");
  }
  double duration() const noexcept override { return duration_; }
  FootMotion foot(double t, std::size_t, double) const noexcept override {
    if (t < 0 || t > duration_) return {};
    const ChirpPoint now = exponential_ ? exponential_chirp(f0_, f1_, duration_, t)
                                        : linear_chirp(f0_, f1_, duration_, t);
    return {amplitude_ * std::sin(now.phase),
            amplitude_ * kTurn * now.frequency * std::cos(now.phase)};
  }
  std::vector<double> jumps(double) const override { return {duration_}; }

 private:
  double amplitude_, f0_, f1_, duration_;
  bool exponential_;
};

class Bump final : public GroundMotion {
 public:
  Bump(double height, double length, double speed, double at)
      : height_(height), length_(length), speed_(speed), at_(at) {}
  std::string description() const override {
    return "bump of " + with_unit(height_, "m") + ", " + with_unit(length_, "m") + " long, at " +
           with_unit(speed_, "m/s");
  }
  double duration() const noexcept override { return (at_ + length_) / speed_; }
  double speed() const noexcept override { return speed_; }
  FootMotion foot(double t, std::size_t, double behind) const noexcept override {
    const double s = speed_ * t - behind - at_, rate = kTurn / length_;
    if (s <= 0 || s >= length_) return {};
    return {0.5 * height_ * (1 - std::cos(rate * s)),
            0.5 * height_ * rate * speed_ * std::sin(rate * s)};
  }

 private:
  double height_, length_, speed_, at_;
};

class Shaking final : public GroundMotion {
 public:
  Shaking(std::string description, double sample_time, std::vector<double> acceleration)
      : description_(std::move(description)), step_(sample_time), a_(std::move(acceleration)) {}
  std::string description() const override { return description_; }
  double duration() const noexcept override { return step_ * static_cast<double>(a_.size() - 1); }
  FootMotion foot(double, std::size_t, double) const noexcept override { return {}; }
  bool shakes() const noexcept override { return true; }
  double acceleration(double t) const noexcept override {
    const double place = t / step_;
    if (!(place >= 0) || place >= static_cast<double>(a_.size() - 1)) return 0;
    const auto k = static_cast<std::size_t>(place);
    return a_[k] + (place - static_cast<double>(k)) * (a_[k + 1] - a_[k]);
  }

 private:
  std::string description_;
  double step_;
  std::vector<double> a_;
};

}  // namespace

ChirpPoint linear_chirp(double f0, double f1, double duration, double t) noexcept {
  const double rise = (f1 - f0) / duration;
  return {kTurn * t * (f0 + 0.5 * rise * t), f0 + rise * t};
}

ChirpPoint exponential_chirp(double f0, double f1, double duration, double t) noexcept {
  const double rate = std::log(f1 / f0) / duration;
  return {kTurn * f0 * std::expm1(rate * t) / rate, f0 * std::exp(rate * t)};
}

GroundPointer step_ground(double height, double at) { return std::make_unique<Step>(height, at); }

GroundPointer sine_ground(double amplitude, double frequency) {
  return std::make_unique<Sine>(amplitude, frequency);
}

GroundPointer chirp_ground(double amplitude, double f0, double f1, double duration,
                           bool exponential) {
  return std::make_unique<Chirp>(amplitude, f0, f1, duration, exponential);
}

GroundPointer bump_ground(double height, double length, double speed, double at) {
  return std::make_unique<Bump>(height, length, speed, at);
}

GroundPointer shaking_ground(std::string description, double sample_time,
                             std::vector<double> acceleration) {
  return std::make_unique<Shaking>(std::move(description), sample_time, std::move(acceleration));
}

}  // namespace dashpot
