#if defined(DASHPOT_SUNDIALS)
#include <array>
#include <functional>

#include <arkode/arkode_erkstep.h>
#include <nvector/nvector_serial.h>
#endif

#include "damper/kinds/hysteresis_network/hysteresis_network_example.h"
#include "dashpot/damper/kinds/hysteresis_network/hysteresis_network_model.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/damper/kinds/network/network_model.h"
#include "dashpot/damper/parameter_set.h"
#include "dashpot/plant.h"
#include "dashpot/suspension/ground/ground_sequences.h"
#include "dashpot/suspension/lanes/batch.h"
#include "support.h"

using namespace dashpot;

// simulate() and simulate_batch() against ARKODE's DP5(4) at a relative tolerance of 1e-10, which
// knows neither their integrators nor their damper code: it takes the textbook's quarter car, and a
// damper's derivative written out here.
#if defined(DASHPOT_SUNDIALS)
namespace {

/// A damper as equations: its states' derivatives and its force.
struct Equations {
  std::size_t states = 0;
  std::function<double(double x, double v, double current, const double* z, double* dz)> force;
};

struct Problem {
  const Plant& plant;
  const GroundMotion& road;
  const Equations& damper;
  const Controller* controller = nullptr;
  ControlLimits limits;
  double current = 0;

  int derivative(double t, const double* y, double* dy) const {
    const double mass = plant.mass[0], wheel = plant.mass[3], spring = plant.stiffness[0],
                 tyre = plant.tyres[0].stiffness;
    const double x = y[0] - y[1], v = y[2] - y[3];
    const double strut = spring * x + damper.force(x, v, current, y + 4, dy + 4);
    dy[0] = y[2];
    dy[1] = y[3];
    dy[2] = -strut / mass;
    dy[3] = (strut + tyre * (road.foot(t, 0, 0).height - y[1])) / wheel;
    return 0;
  }
};

int right_hand_side(double t, N_Vector y, N_Vector dy, void* problem) {
  return static_cast<const Problem*>(problem)->derivative(t, NV_DATA_S(y), NV_DATA_S(dy));
}

/// Body and wheel at each millisecond.
std::vector<std::array<double, 2>> reference(Problem problem, double duration) {
  sundials::Context context;
  N_Vector y = N_VNew_Serial(static_cast<sunindextype>(4 + problem.damper.states), context),
           slope = N_VClone(y);
  N_VConst(0, y);
  void* solver = ERKStepCreate(right_hand_side, 0, y, context);
  ERKStepSetTableNum(solver, ARKODE_DORMAND_PRINCE_7_4_5);
  ERKStepSStolerances(solver, 1e-10, 1e-13);
  ERKStepSetUserData(solver, &problem);
  ERKStepSetMaxNumSteps(solver, 1000000);
  std::vector<std::array<double, 2>> trace;
  const double* const at = NV_DATA_S(y);
  const auto count = static_cast<std::size_t>(std::lround(duration * 1e3));
  for (std::size_t k = 0;; ++k) {
    trace.push_back({at[0], at[1]});
    if (k == count) break;
    double t = 1e-3 * static_cast<double>(k);
    if (problem.controller) {
      problem.derivative(t, at, NV_DATA_S(slope));
      const StrutSignals signals{.body_velocity = at[2],
                                 .body_acceleration = NV_DATA_S(slope)[2],
                                 .wheel_velocity = at[3],
                                 .deflection = at[0] - at[1],
                                 .deflection_velocity = at[2] - at[3]};
      DamperDemand demand;
      problem.controller->step({&signals, 1}, {}, {}, {&demand, 1});
      const double share = (demand.value - problem.limits.damping_min) /
                           (problem.limits.damping_max - problem.limits.damping_min);
      problem.current = share * problem.limits.current_max;
    }
    ERKStepReset(solver, t, y);
    ERKStepSetStopTime(solver, 1e-3 * static_cast<double>(k + 1));
    ERKStepEvolve(solver, 1e-3 * static_cast<double>(k + 1), y, &t, ARK_NORMAL);
  }
  ERKStepFree(&solver);
  N_VDestroy(slope);
  N_VDestroy(y);
  return trace;
}

double apart(const std::vector<std::array<double, 2>>& truth, const Record& record) {
  double worst = 0;
  for (std::size_t c = 0; c < 2; ++c) {
    const std::vector<double>& samples = record.channel(c == 0 ? "body" : "wheel").samples;
    REQUIRE(samples.size() == truth.size());
    double top = 0, off = 0;
    for (std::size_t k = 0; k < truth.size(); ++k) {
      top = std::max(top, std::abs(truth[k][c]));
      off = std::max(off, std::abs(truth[k][c] - samples[k]));
    }
    worst = std::max(worst, off / top);
  }
  return worst;
}

struct Errors {
  double alone, in_lanes;
};
/// Both engines' results, with a controller where `law` names one.
Errors errors_of(std::shared_ptr<const DamperModel> model, const Equations& equations,
                 const char* law, double highest) {
  const Plant plant = load_plant_set("tudon_martinez2012").plant;
  const GroundPointer road =
      make_ground("iso8608,class=C,length=60,wave_number_max=1,waves=200", 5);
  const ControlLimits limits{.current_max = highest};
  const ControllerPointer controller = law ? make_controller(law, {limits, plant}) : nullptr;
  const std::vector<MountedDamper> dampers{{.model = std::move(model),
                                            .driver = {.current_max = highest},
                                            .current = law ? 0 : 0.4 * highest}};
  constexpr double kDuration = 1.5;
  const auto truth =
      reference({plant, *road, equations, controller.get(), limits, dampers[0].current}, kDuration);
  const Setting setting{plant, dampers, *road, controller.get()};
  const BatchVehicle vehicle{setting, limits, {}};
  const std::vector<BatchVehicle> three(3, vehicle);
  return {apart(truth, simulate(setting, {.duration = kDuration, .limits = limits}).record),
          apart(truth, simulate_batch(three, {.duration = kDuration, .traces = true})[1].trace)};
}

}  // namespace

TEST_CASE("network damper against SUNDIALS, with and without a controller") {
  Mlp mlp;
  mlp.layers = {2, 10, 1};
  mlp.input_mean = {0, 0.5};
  mlp.input_scale = {0.3, 0.3};
  mlp.output_scale = 700;
  initialise(mlp, 3);
  for (double& weight : mlp.parameters) weight = std::abs(weight);  // so that it takes energy
  const Equations equations{0, [&](double, double v, double i, const double*, double*) {
                              const double input[] = {v, i};
                              return mlp.evaluate(input);
                            }};
  const auto model = std::make_shared<NetworkModel>(
      "network", std::vector<std::string>{"velocity", "current"}, std::vector{mlp});
  for (const char* law : {static_cast<const char*>(nullptr), "mix1"}) {
    const Errors errors = errors_of(model, equations, law, 1);
    CHECK_CLOSE(errors.alone, 0, 0, 1e-6);
    CHECK_CLOSE(errors.in_lanes, 0, 0, 1e-6);
  }
}

namespace {

std::shared_ptr<const DamperModel> spencer_model() {
  const LawModel published = load_parameters("spencer1997");
  Dependence parameters = published.parameters();
  parameters.coefficients[published.law().index_of("x0")] = {0};
  return std::make_shared<LawModel>(published.law(), parameters, DriveUnit::Volt,
                                    published.lag_rate());
}

/// Spencer et al. 1997 with Dyke et al.'s voltage laws, in SI: states y, z and the coil's voltage,
/// from that voltage on.
Equations spencer_equations(double voltage) {
  return Equations{
      3, [voltage](double x, double v, double command, const double* z, double* dz) {
        const double u = z[2] + voltage;
        const double alpha = 14000 + 69500 * u, c0 = 2100 + 350 * u, c1 = 28300 + 295 * u;
        dz[0] = (alpha * z[1] + c0 * v + 4690 * (x - z[0])) / (c0 + c1);
        const double w = v - dz[0];
        dz[1] = 301 * w - 3.63e6 * (std::abs(w) * z[1] * std::abs(z[1]) + w * z[1] * z[1]);
        dz[2] = 190 * (command - u);
        return c1 * dz[0] + 500 * x;
      }};
}

}  // namespace

TEST_CASE("a stated tolerance is kept where hysteresis is stiff, and without short steps") {
  // A point of the road at each ms: where its third derivative jumps within a step, none of these
  // methods keeps 1e-8, with a linear damper neither.
  const Plant plant = load_plant_set("savaresi_spelta").plant;
  const GroundPointer road =
      make_ground("iso8608,class=F,length=60,speed=20,wave_number_max=1,waves=200", 5);
  const ControlLimits limits{.current_max = 2.25};
  const std::vector<MountedDamper> dampers{
      {.model = spencer_model(), .driver = {.current_max = 2.25}, .current = 0.9}};
  const auto truth = reference({plant, *road, spencer_equations(0.9), nullptr, limits, 0.9}, 1);
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    CAPTURE(tolerance);
    const Trace trace = simulate({plant, dampers, *road}, {.duration = 1,
                                                           .relative_tolerance = tolerance,
                                                           .absolute_tolerance = 1e-3 * tolerance,
                                                           .limits = limits});
    CHECK_CLOSE(apart(truth, trace.record), 0, 0, tolerance);
    CHECK(trace.steps < 4000);  // of 250 us at least in the mean; z settles in 20 us
  }
}

TEST_CASE("modified Bouc-Wen damper against SUNDIALS, with and without a controller") {
  for (const char* law : {static_cast<const char*>(nullptr), "mix1"}) {
    const Errors errors = errors_of(spencer_model(), spencer_equations(law ? 0 : 0.9), law, 2.25);
    CHECK_CLOSE(errors.alone, 0, 0, 1e-5);
    CHECK_CLOSE(errors.in_lanes, 0, 0, 1e-5);
  }
}

TEST_CASE("hysteresis network against SUNDIALS, with and without a controller") {
  HysteresisNetwork member = example_hysteresis_network();
  // Its own numbers are random: made weak enough beside a dashpot's for the vehicle to come to
  // rest.
  for (double& gate : member.network.gates) gate *= 0.2;
  member.network.gates[member.network.gate_count()] = 1;
  const auto model = std::make_shared<HysteresisNetworkModel>("hysteresis", std::vector{member});
  const HysteresisBank& bank = member.bank;
  // w' = rho (v - |v| w), y' = lambda (v - y), u' = mu (i - u); at rest u = i.
  const auto equations_from = [&](double current) {
    return Equations{bank.size(),
                     [&, current](double, double v, double i, const double* z, double* dz) {
                       std::vector<double> state(z, z + bank.size());
                       state.back() += current;
                       std::size_t k = 0;
                       for (const double rate : bank.path_rates) {
                         dz[k] = rate * (v - std::abs(v) * z[k]);
                         ++k;
                       }
                       for (const double rate : bank.velocity_rates) {
                         dz[k] = rate * (v - z[k]);
                         ++k;
                       }
                       dz[k] = bank.current_rates[0] * (i - state.back());
                       std::vector<double> signals(bank.signal_count());
                       bank.read({0, v, i}, state, signals.data());
                       return member.network.evaluate(signals.data());
                     }};
  };
  for (const char* law : {static_cast<const char*>(nullptr), "mix1"}) {
    const Errors errors = errors_of(model, equations_from(law ? 0 : 0.4), law, 1);
    CHECK_CLOSE(errors.alone, 0, 0, 2e-5);
    CHECK_CLOSE(errors.in_lanes, 0, 0, 2e-5);
  }
}
#else
TEST_CASE("integrators against SUNDIALS") { MESSAGE("skipped: libsundials-dev is not installed"); }
#endif
