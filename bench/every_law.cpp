// simulate() beside general integrators with every law that ships, at equal error;
// docs/performance.md prints it.
//
//   every_law [--rounds N] [--odeint | --fixed] [--curves] [NAME ...]
//
// NAME: a law, at the example of its table, or a published set; all laws and sets where there is
// none. --odeint: beside odeint alone, in a seventh of the time. --fixed: beside equal steps, whose
// error nobody watches.
#include <algorithm>
#include <cstring>
#include <span>

#include "dashpot/damper/law_list.h"
#include "dashpot/numerics/median.h"
#include "peers/arkode_ride.h"
#include "peers/law_ride.h"
#include "peers/odeint_ride.h"
#include "peers/rides.h"

using namespace peer;
namespace odeint = boost::numeric::odeint;

namespace {

constexpr std::size_t kSamples = 4000;  // 4 s

template <std::size_t kSize>
double by_odeint(LawEquations& equations, double relative, RideTrace* trace) {
  using State = std::array<double, kSize>;
  State y{};
  std::copy_n(equations.start.begin(), kSize, y.begin());
  const auto system = [&](const State& at, State& dy, double t) {
    equations.derivative(t, at.data(), dy.data());
  };
  const auto on_sample = [&](const State& at, const State& slope) {
    if (trace) trace->push_back({at[0], at[1], at[2], at[3]});
    return equations.control(at.data(), slope.data());
  };
  return ride_by(
      odeint::make_controlled(relative * 1e-3, relative, odeint::runge_kutta_dopri5<State>()),
      system, y, kSamples, kSample, on_sample);
}
/// The classical method in equal steps, 1 per sample at 1e-2, 2 at 1e-3, 4, 8 and so on: nothing
/// watches its error.
template <std::size_t kSize>
double by_fixed_steps(LawEquations& equations, double relative, RideTrace* trace) {
  using State = std::array<double, kSize>;
  State y{}, slope{};
  std::copy_n(equations.start.begin(), kSize, y.begin());
  const int steps = 1 << std::lround(-2 - std::log10(relative));
  const double h = kSample / steps;
  const auto system = [&](const State& at, State& dy, double t) {
    equations.derivative(t, at.data(), dy.data());
  };
  odeint::runge_kutta4<State> stepper;
  const double start = cpu_seconds();
  for (std::size_t k = 0;; ++k) {
    const double t = static_cast<double>(k) * kSample;
    system(y, slope, t);
    if (trace) trace->push_back({y[0], y[1], y[2], y[3]});
    if (k == kSamples) break;
    if (equations.control(y.data(), slope.data())) system(y, slope, t);
    stepper.do_step(system, y, slope, t, h);
    for (int step = 1; step < steps; ++step) stepper.do_step(system, y, t + step * h, h);
  }
  return cpu_seconds() - start;
}

/// run<kSize>() of these equations' size.
double of_size(const LawEquations& equations, auto run) {
  switch (equations.size()) {
    case 4:
      return run.template operator()<4>();
    case 5:
      return run.template operator()<5>();
    case 6:
      return run.template operator()<6>();
    default:
      return run.template operator()<7>();
  }
}
double by_odeint_of_size(LawEquations& equations, double relative, RideTrace* trace) {
  return of_size(equations,
                 [&]<std::size_t kSize>() { return by_odeint<kSize>(equations, relative, trace); });
}
double by_fixed_steps_of_size(LawEquations& equations, double relative, RideTrace* trace) {
  return of_size(equations, [&]<std::size_t kSize>() {
    return by_fixed_steps<kSize>(equations, relative, trace);
  });
}
template <class Solver>
double by_arkode(LawEquations& equations, double relative, RideTrace* trace) {
  return ride_by_arkode<Solver>(equations, equations.start, kSamples, relative, relative * 1e-3,
                                trace);
}

using Run = double(LawEquations& equations, double relative, RideTrace* trace);
struct Peer {
  const char* name;
  Run* run;
  std::size_t tolerances;  ///< how many of kPeerTolerances it is tried at
};
constexpr double kOwnTolerances[] = {1e-4, 1e-6, 1e-8};
constexpr double kPeerTolerances[] = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9};
constexpr Peer kPeers[] = {
    {"odeint dopri5", by_odeint_of_size, 8},
    {"ARKODE DP5(4)", by_arkode<ExplicitArkode<>>, 8},
    {"ARKODE 4(3)", by_arkode<ExplicitArkode<ARKODE_ZONNEVELD_5_3_4>>, 6},
    {"ARKODE 3(2)", by_arkode<ExplicitArkode<ARKODE_BOGACKI_SHAMPINE_4_2_3>>, 6},
    {"ARKODE ESDIRK4(3)", by_arkode<ImplicitArkode<ARKODE_ESDIRK436L2SA_6_3_4>>, 5},
    {"ARKODE ESDIRK5(4)", by_arkode<ImplicitArkode<ARKODE_ESDIRK547L2SA_7_4_5>>, 5}};
constexpr Peer kFixed[] = {{"odeint rk4, equal steps", by_fixed_steps_of_size, 6}};

double by_simulate(const LawRide& ride, double relative, RideTrace* trace) {
  using namespace dashpot;
  const ControlLimits limits{.current_min = ride.mounted.driver.current_min,
                             .current_max = ride.mounted.driver.current_max,
                             .sample_time = kSample};
  const std::vector<MountedDamper> dampers{ride.mounted};
  static const GroundPointer road = drive_over(ride_road(0), kSpeed);
  static const Plant plant = ride_plant(Ride::Network);
  const ControllerPointer mix1 = make_controller("mix1,crossover=1.9Hz", {limits, plant});
  const double start = cpu_seconds();
  const Trace result =
      simulate({plant, dampers, *road, mix1.get()}, {.duration = kSamples * kSample,
                                                     .relative_tolerance = relative,
                                                     .absolute_tolerance = relative * 1e-3,
                                                     .limits = limits});
  const double seconds = cpu_seconds() - start;
  if (trace) *trace = trace_of(result.record);
  return seconds;
}

/// What one program takes at one tolerance.
struct Point {
  double relative, error, seconds;
};
using Curve = std::vector<Point>;

/// The least time at which a program reaches an error: of its points that do, and, on a straight
/// line of the logarithms, between one that does not and the next tighter one that does.
double seconds_at(const Curve& curve, double error) {
  double best = HUGE_VAL;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const Point& at = curve[k];
    if (!(at.error <= error)) continue;
    best = std::min(best, at.seconds);
    if (k == 0 || !(curve[k - 1].error > error)) continue;
    const Point& before = curve[k - 1];
    const double share = std::log(before.error / error) / std::log(before.error / at.error);
    best = std::min(best, before.seconds * std::pow(at.seconds / before.seconds, share));
  }
  return best;
}

struct Row {
  LawRide ride;
  double doubt = 0;  ///< how far two references lie apart
  Curve own;
  std::vector<Curve> peers;
};

/// All programs take turns, at all tolerances.
Row measure(const std::string& name, std::span<const Peer> peers, int rounds) {
  Row row{.ride = law_ride(name)};
  RideTrace reference, other;
  const auto with = [&](Run* run, double relative, RideTrace* trace) {
    LawEquations equations(row.ride);
    return run(equations, relative, trace);
  };
  with(by_odeint_of_size, 1e-11, &reference);
  with(by_arkode<ExplicitArkode<>>, 1e-11, &other);
  row.doubt = distance(reference, other);

  const auto point = [&](double relative, auto run) {
    RideTrace trace;
    run(relative, &trace);
    return Point{relative, distance(reference, trace), 0};
  };
  for (const double relative : kOwnTolerances)
    row.own.push_back(point(
        relative, [&](double r, RideTrace* trace) { return by_simulate(row.ride, r, trace); }));
  for (const Peer& peer : peers) {
    row.peers.emplace_back();
    for (std::size_t k = 0; k < peer.tolerances; ++k)
      row.peers.back().push_back(point(kPeerTolerances[k], [&](double r, RideTrace* trace) {
        return with(peer.run, r, trace);
      }));
  }

  std::vector<std::vector<double>> own(row.own.size());
  std::vector<std::vector<std::vector<double>>> theirs;
  for (const Curve& curve : row.peers) theirs.emplace_back(curve.size());
  for (int round = 0; round < rounds; ++round) {
    RideTrace kept;  // as simulate() keeps its own
    kept.reserve(kSamples + 1);
    for (std::size_t k = 0; k < own.size(); ++k)
      own[k].push_back(by_simulate(row.ride, row.own[k].relative, nullptr));
    for (std::size_t p = 0; p < theirs.size(); ++p)
      for (std::size_t k = 0; k < theirs[p].size(); ++k) {
        kept.clear();
        theirs[p][k].push_back(with(peers[p].run, row.peers[p][k].relative, &kept));
      }
  }
  for (std::size_t k = 0; k < own.size(); ++k) row.own[k].seconds = dashpot::median(own[k]);
  for (std::size_t p = 0; p < theirs.size(); ++p)
    for (std::size_t k = 0; k < theirs[p].size(); ++k)
      row.peers[p][k].seconds = dashpot::median(theirs[p][k]);
  return row;
}

/// A row of Markdown: simulate() at a tolerance of 1e-6 beside the best of the others at the same
/// error, then how it stands at 1e-4 and at 1e-8.
void print(const Row& row, std::span<const Peer> peers) {
  std::array<double, 3> ratios{}, seconds{};
  std::array<std::size_t, 3> best{};
  for (std::size_t k = 0; k < ratios.size(); ++k) {
    seconds[k] = HUGE_VAL;
    for (std::size_t p = 0; p < row.peers.size(); ++p) {
      const double here = seconds_at(row.peers[p], row.own[k].error);
      if (here < seconds[k]) best[k] = p, seconds[k] = here;
    }
    ratios[k] = row.own[k].seconds / seconds[k];
  }
  std::printf("| %s | %s | %.3g | %.1e | %.3g | %s | %.2f | %.2f | %.2f | %.0e |\n",
              row.ride.name.c_str(), std::string(row.ride.law->law().name).c_str(),
              1e3 * row.own[1].seconds, row.own[1].error, 1e3 * seconds[1], peers[best[1]].name,
              ratios[1], ratios[0], ratios[2], row.doubt);
  std::fflush(stdout);
}

void print_curves(const Row& row, std::span<const Peer> peers) {
  const auto line = [](const char* name, const Curve& curve) {
    for (const Point& at : curve)
      std::printf("  %-20s %.0e  %8.3f ms  %.1e\n", name, at.relative, 1e3 * at.seconds, at.error);
  };
  line("simulate()", row.own);
  for (std::size_t p = 0; p < row.peers.size(); ++p) line(peers[p].name, row.peers[p]);
}

}  // namespace

int main(int count, char** arguments) {
  keep_memory();
  int rounds = 3;
  bool curves = false;
  std::span<const Peer> peers = kPeers;
  std::vector<std::string> names;
  for (int k = 1; k < count; ++k) {
    if (!std::strcmp(arguments[k], "--rounds") && k + 1 < count)
      rounds = std::atoi(arguments[++k]);
    else if (!std::strcmp(arguments[k], "--curves"))
      curves = true;
    else if (!std::strcmp(arguments[k], "--odeint"))
      peers = peers.first(1);
    else if (!std::strcmp(arguments[k], "--fixed"))
      peers = kFixed;
    else
      names.emplace_back(arguments[k]);
  }
  if (names.empty()) {
    for (const dashpot::Law* law : dashpot::laws()) names.emplace_back(law->name);
    for (const std::string& set : dashpot::parameter_set_names()) names.push_back(set);
  }
  std::printf(
      "| damper | law | simulate(), ms | error | best other, ms | which | ratio | at 1e-4 | at "
      "1e-8 | doubt |\n"
      "|---|---|---:|---:|---:|---|---:|---:|---:|---:|\n");
  for (const std::string& name : names) {
    const Row row = measure(name, peers, rounds);
    print(row, peers);
    if (curves) print_curves(row, peers);
  }
}
