// Boost.odeint with several vehicles in one state: each of its numbers is a vector with one number
// per vehicle. All vehicles of a state share the length of a step, which the worst of them gives.
#include "odeint_ride.h"
#include "ride_case.h"

using namespace peer;
namespace odeint = boost::numeric::odeint;

namespace {

constexpr int kVehicles = 32;
#ifdef __AVX512F__
constexpr int kWidth = 8;
#else
constexpr int kWidth = 4;
#endif
typedef double Lane __attribute__((vector_size(kWidth * sizeof(double))));
typedef std::int64_t LaneBits __attribute__((vector_size(kWidth * sizeof(double))));

Lane absolute(Lane x) { return x < 0 ? -x : x; }
Lane larger(Lane a, Lane b) { return a > b ? a : b; }
double greatest(Lane x) {
  double most = x[0];
  for (int lane = 1; lane < kWidth; ++lane) most = std::max(most, x[lane]);
  return most;
}

/// 2^y for |y| < 1000: of the fraction, |r| <= 1/2, by the polynomial that meets it at the nine
/// zeros of Chebyshev's, true to 1.1e-12; the whole part goes into the exponent's bits.
Lane power_of_two(Lane y) {
  constexpr double kRound = 0x1.8p52 + 1023;
  const Lane shifted = y + kRound, r = y - (shifted - kRound), square = r * r;
  const Lane even = (((1.3255224878668817e-06 * square + 0.00015403455852453838) * square +
                      0.009618129159402558) *
                         square +
                     0.2402265069581299) *
                        square +
                    1;
  const Lane odd =
      ((1.5310079402249296e-05 * square + 0.0013333450568000645) * square + 0.05550410941205933) *
          square +
      0.6931471805459335;
  return (odd * r + even) * __builtin_bit_cast(Lane, __builtin_bit_cast(LaneBits, shifted) << 52);
}

/// tanh x = 1 - 2 / (e^2x + 1), true to 1e-12: a polynomial and a division for all lanes at once.
Lane tanh(Lane x) {
  constexpr double kTwoLog2E = 2.88539008177792681472, kOne = 20;
  const Lane held = x > kOne ? Lane{} + kOne : x < -kOne ? Lane{} - kOne : x;
  return 1 - 2 / (power_of_two(kTwoLog2E * held) + 1);
}

/// RideEquations for a state of lanes, from the same numbers.
template <std::size_t kSize>
class LaneEquations {
 public:
  using State = std::array<Lane, kSize>;

  LaneEquations(Ride ride, int first_vehicle) : highest_(row_of(ride).drive_max) {
    for (int lane = 0; lane < kWidth; ++lane) {
      const RideEquations one(ride, first_vehicle + lane);
      numbers_ = one.numbers();
      heights_.resize(one.heights().size());
      for (std::size_t k = 0; k < heights_.size(); ++k) heights_[k][lane] = one.heights()[k];
    }
    if (kSize == 7 && numbers_[9] != 2) throw std::invalid_argument("only loops with n = 2");
  }

  void operator()(const State& y, State& dy, double t) const {
    const Lane x = y[0] - y[1], v = y[2] - y[3];
    Lane force;
    if constexpr (kSize == 4)
      force = network(v);
    else
      force = bouc_wen(x, v, y, dy);
    const Lane spring = kSpring * x + force;
    dy[0] = y[2];
    dy[1] = y[3];
    dy[2] = -spring * (1 / kBody);
    dy[3] = (spring - kTyre * (y[1] - road_at(heights_, t))) * (1 / kWheel);
  }

  /// Mix-1, lane by lane; whether a command has changed.
  bool control(const State& y, const State& slope) {
    const Lane rate = 2 * std::numbers::pi * kCrossover * y[2], before = command_;
    command_ = slope[2] * slope[2] - rate * rate <= 0 ? Lane{} + highest_ : Lane{};
    return greatest(absolute(command_ - before)) > 0;
  }

 private:
  Lane network(Lane v) const {
    const double* n = numbers_.data();
    Lane force = Lane{} + n[40];
    for (int k = 0; k < 10; ++k, n += 4) force += n[3] * tanh(n[0] * v + (n[1] * command_ + n[2]));
    return force;
  }
  /// The law of laws/modified_bouc_wen.h with n = 2, whose states are y[4], y[5] and the coil's
  /// voltage.
  Lane bouc_wen(Lane x, Lane v, const State& y, State& dy) const {
    const double *p = numbers_.data(), k0 = p[3], k1 = p[4], x0 = p[5], gamma = p[6], beta = p[7],
                 A = p[8], f0 = p[10], lag_rate = p[14];
    const Lane u = y[6], z = y[5], alpha = p[0] + p[11] * u, c0 = p[1] + p[12] * u,
               c1 = p[2] + p[13] * u;
    const Lane creep = (alpha * z + c0 * v + k0 * (x - y[4])) / (c0 + c1), w = v - creep;
    dy[4] = creep;
    dy[5] = A * w - absolute(z) * (gamma * absolute(w) * z + beta * w * absolute(z));
    dy[6] = lag_rate * (command_ - u);
    return c1 * creep + k1 * (x - x0) + f0;
  }

  double highest_;
  std::vector<double> numbers_;
  std::vector<Lane> heights_;
  Lane command_{};
};

/// odeint's own measure of a step's error, of the worst vehicle.
template <class State>
struct LaneErrors {
  using value_type = double;
  using algebra_type = odeint::array_algebra;
  using operations_type = odeint::default_operations;

  double error(algebra_type&, const State& y, const State& dy, State& off, double dt) const {
    Lane worst{};
    for (std::size_t k = 0; k < y.size(); ++k)
      worst = larger(worst, absolute(off[k]) /
                                (kAbsolute + kRelative * (absolute(y[k]) + dt * absolute(dy[k]))));
    return greatest(worst);
  }
};

/// All vehicles, one state after the other; seconds of one.
template <std::size_t kSize>
double run_sized(Ride ride, RideTrace* trace) {
  using State = typename LaneEquations<kSize>::State;
  using Method = odeint::runge_kutta_dopri5<State, double, State, double, odeint::array_algebra>;
  static std::map<Ride, std::vector<LaneEquations<kSize>>> made;
  auto& batches = made[ride];
  for (int first = 0; batches.size() < kVehicles / kWidth; first += kWidth)
    batches.emplace_back(ride, first);

  double seconds = 0;
  for (const LaneEquations<kSize>& batch : batches) {
    LaneEquations<kSize> equations = batch;
    const bool keeps = trace && &batch == &batches.front();
    const auto on_sample = [&](const State& y, const State& slope) {
      if (keeps) trace->push_back({y[0][0], y[1][0], y[2][0], y[3][0]});
      return equations.control(y, slope);
    };
    seconds += ride_by(odeint::controlled_runge_kutta<Method, LaneErrors<State>>(),
                       std::cref(equations), State{}, kSamples10s, kSample, on_sample);
  }
  return seconds / kVehicles;
}

}  // namespace

int main() {
  std::map<std::string, Task> tasks;
  add_ride_tasks(tasks, [](Ride ride, RideTrace* trace) {
    return ride == Ride::Network ? run_sized<4>(ride, trace) : run_sized<7>(ride, trace);
  });
  // Batches of quarter cars are all that it has.
  for (const RideRow& row : kRides) {
    const std::string alone = row.task, batch = alone + "_batch";
    for (const std::string& name : {alone, batch}) {
      if (name == batch && row.struts == 1) continue;
      tasks.erase(name);
      tasks.erase(name + ".error");
    }
  }
  return serve(tasks);
}
