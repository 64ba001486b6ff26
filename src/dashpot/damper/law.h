#pragma once
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "dashpot/damper/dependence.h"
#include "dashpot/damper_input.h"

namespace dashpot {

struct StateInfo {
  std::string_view name, unit;
};

/// Room that a model keeps for a law's numbers while it steps, so that stepping allocates nothing.
constexpr std::size_t kMaxStates = 8, kMaxParams = 24;

/// The role that a parameter has in a fit.
enum class Fit {
  Free,
  Rises,  ///< free, but never falls over the drive: beyond the data a fall would end in nothing
  Fixed,  ///< keeps its value unless asked for
  Scale,  ///< not fitted: takes the size of the data (start times their half force span, half
          ///< stroke ...)
  Drive,  ///< the coil current itself, for laws that need it: always p = i
  Bias    ///< a constant force: replaced by the record offsets during a fit
};

constexpr bool is_estimated(Fit fit) {
  return fit == Fit::Free || fit == Fit::Rises || fit == Fit::Bias;
}

/// One row of a law's parameter table. Bounds hold for the parameter at every current in the
/// domain.
struct ParamInfo {
  std::string_view name, unit;
  double value = 0;  ///< default: an example damper of the 3 kN class
  double lower = 0, upper = 0;
  double start =
      0;  ///< where a fit starts, in the data's own half force span, half stroke and top speed
  Form form = Form::Constant;  ///< how it depends on current unless the user says otherwise
  Fit fit = Fit::Free;
  std::string_view meaning;
};

/// A function of a law: plain code, or code that works on something, as on the equations of a law
/// from a file. Allocates nothing, so that it may be called while a model steps.
template <class Signature>
class LawFunction;
template <class Result, class... Arguments>
class LawFunction<Result(Arguments...)> {
 public:
  LawFunction(std::nullptr_t = nullptr) {}  // NOLINT(google-explicit-constructor)
  /// Written like a pointer to a function, so converting.
  template <class Code>
    requires std::is_empty_v<Code>
  LawFunction(Code)  // NOLINT(google-explicit-constructor)
      : call_([](const void*, Arguments... arguments) -> Result { return Code{}(arguments...); }) {}
  /// Code that gets `with` before its arguments; `with` outlives the function.
  LawFunction(const void* with, Result (*code)(const void*, Arguments...))
      : with_(with), call_(code) {}

  Result operator()(Arguments... arguments) const { return call_(with_, arguments...); }
  explicit operator bool() const { return call_ != nullptr; }

 private:
  const void* with_ = nullptr;
  Result (*call_)(const void*, Arguments...) = nullptr;
};

class LawText;

/// A force law as the rest of Dashpot sees it: a table and functions of
/// (parameters at the present current, displacement m, velocity m/s, internal state).
struct Law {
  std::string_view name, title;
  std::string_view equation;  ///< plain text, one relation per line
  std::string_view source;
  std::string_view remarks;  ///< validity, and what differs from the source
  std::vector<StateInfo> states;
  std::vector<ParamInfo> params;
  double lag_rate = 0;             ///< 1/s, default rate of the coil's first-order lag; 0: none
  bool needs_displacement = true;  ///< false: neither force nor states depend on x
  /// Internal state of a damper that starts at x, v without a memory; that of a long rest when v =
  /// 0.
  LawFunction<void(const double* p, double x, double v, double* z)> rest;
  LawFunction<void(const double* p, double x, double v, const double* z, double* dz)> derivative;
  LawFunction<double(const double* p, double x, double v, const double* z)> force;
  /// The forces of many samples with the same parameters; null with states.
  LawFunction<void(const double* p, std::span<const DamperInput> inputs, double* force)> forces;
  /// Force and derivative at once; null without states.
  LawFunction<double(const double* p, double x, double v, const double* z, double* dz)> flow;
  /// One classical Runge-Kutta step of length h of `count` states, with p, x and v at its start,
  /// middle and end.
  LawFunction<void(const double* const* p, const double* x, const double* v, double h,
                   std::size_t count, double* z)>
      runge_kutta;
  /// Bound of the fastest internal rate, 1/s: an explicit integrator keeps rate * step below its
  /// limit.
  LawFunction<double(const double* p, double v)> rate;
  /// Optional: one step of the law's own integrator, stable at any length h, with x[0], v[0] at its
  /// start and x[1], v[1] at its end. Returns 0 where it does not apply. Taken where the explicit
  /// one would need many steps.
  LawFunction<int(const double* p, const double* x, const double* v, double h, double* z)> step;
  /// One `step` of any length is as good as many while the parameters stay: taken wherever they do.
  bool exact_step = false;
  /// Which of its parameters take energy out of every motion at constant drive, and why, in plain
  /// text; beyond the table's bounds.
  std::string_view dissipates;
  /// For a law with a filter: the fastest rate, 1/s, with which it dissipates beside its other
  /// parameters; infinity where any does, 0 where none. Null: the rate is not what decides.
  LawFunction<double(const double* p)> fastest_rate;
  std::size_t rate_parameter = 0;  ///< the row of that rate
  /// First row of the valve that makes rebound and compression differ (law_side.h), which the
  /// functions above know nothing of; 0: the law is as its table has it.
  std::size_t side_row = 0;
  /// The equations of a law from a file (law_text.h); null for a law of Dashpot's own.
  const LawText* text = nullptr;
  const Law* sided = nullptr;  ///< with_side() of a law from a file; null for others

  std::size_t index_of(std::string_view param) const;  ///< throws Error naming the known ones
};

/// A row as a law's .cpp writes it. The field decides which place in the parameter array it names.
template <class P>
struct Param {
  double P::* field;
  std::string_view name, unit;
  double value, lower, upper, start;
  Form form = Form::Constant;
  std::string_view meaning;
  Fit fit = Fit::Free;
};

template <class P>
struct LawTable {
  std::string_view name, title, equation, source, remarks;
  std::vector<StateInfo> states;
  std::vector<Param<P>> params;
  double lag_rate = 0;
  bool needs_displacement = true;
  std::string_view dissipates;
};

namespace detail {
template <class P>
P from_array(const double* p) {
  P own;
  std::memcpy(&own, p, sizeof own);
  return own;
}

/// Position of a field in a struct of doubles.
template <class P>
std::size_t position_of(double P::* field) {
  const P own{};
  const auto distance =
      reinterpret_cast<const char*>(&(own.*field)) - reinterpret_cast<const char*>(&own);
  return static_cast<std::size_t>(distance) / sizeof(double);
}

/// The steps of the C text for one law, so that its functions are compiled into them.
template <class P, auto Derivative>
struct ExplicitStep {
  using LawParameters = P;
  static constexpr auto law_derivative = Derivative;
  enum { LAW_MOST_STATES = kMaxStates };
#include "dashpot/damper/c_text/law_runge_kutta.h"
  static void step(const double* const* p, const double* x, const double* v, double h,
                   std::size_t count, double* z) {
    const P stages[] = {from_array<P>(p[0]), from_array<P>(p[1]), from_array<P>(p[2])};
    const P* const at[] = {&stages[0], &stages[1], &stages[2]};
    law_runge_kutta(at, x, v, h, static_cast<int>(count), z);
  }
};

template <class P, auto Travel>
struct TravelStep {
  using LawParameters = P;
  static constexpr auto law_travel = Travel;
#include "dashpot/damper/c_text/law_travel.h"
};
}  // namespace detail

/// Turns a C law (a struct of doubles and its functions) into a Law. A field that the table leaves
/// out shows as a row without a name; the conformance test looks for one.
template <class P, auto Force>
Law static_law(const LawTable<P>& table) {
  static_assert(sizeof(P) % sizeof(double) == 0);
  Law law{.name = table.name,
          .title = table.title,
          .equation = table.equation,
          .source = table.source,
          .remarks = table.remarks,
          .states = table.states,
          .params = std::vector<ParamInfo>(sizeof(P) / sizeof(double)),
          .lag_rate = table.lag_rate,
          .needs_displacement = table.needs_displacement,
          .dissipates = table.dissipates};
  for (const Param<P>& p : table.params)
    law.params[detail::position_of(p.field)] = {p.name,  p.unit, p.value, p.lower,  p.upper,
                                                p.start, p.form, p.fit,   p.meaning};
  law.force = [](const double* p, double x, double v, const double* z) {
    const P own = detail::from_array<P>(p);
    return Force(&own, x, v, z);
  };
  law.forces = [](const double* p, std::span<const DamperInput> inputs, double* force) {
    const P own = detail::from_array<P>(p);
    for (const DamperInput& at : inputs)
      *force++ = Force(&own, at.displacement, at.velocity, nullptr);
  };
  return law;
}

template <class P, auto Force, auto Derivative, auto Rest, auto Rate>
Law state_law(const LawTable<P>& table) {
  Law law = static_law<P, Force>(table);
  law.forces = nullptr;
  law.derivative = [](const double* p, double x, double v, const double* z, double* dz) {
    const P own = detail::from_array<P>(p);
    Derivative(&own, x, v, z, dz);
  };
  law.flow = [](const double* p, double x, double v, const double* z, double* dz) {
    const P own = detail::from_array<P>(p);
    Derivative(&own, x, v, z, dz);
    return Force(&own, x, v, z);
  };
  law.rest = [](const double* p, double x, double v, double* z) {
    const P own = detail::from_array<P>(p);
    Rest(&own, x, v, z);
  };
  law.runge_kutta = [](const double* const* p, const double* x, const double* v, double h,
                       std::size_t count, double* z) {
    detail::ExplicitStep<P, Derivative>::step(p, x, v, h, count, z);
  };
  law.rate = [](const double* p, double v) {
    const P own = detail::from_array<P>(p);
    return Rate(&own, v);
  };
  return law;
}

template <class P, auto Step>
Law with_step(Law law) {
  law.step = [](const double* p, const double* x, const double* v, double h, double* z) {
    const P own = detail::from_array<P>(p);
    return Step(&own, x, v, h, z);
  };
  return law;
}

/// For a law that looks at a filtered velocity: Fastest says how quick that filter may be.
template <class P, auto Fastest>
Law with_fastest_rate(Law law) {
  law.rate_parameter = detail::position_of(&P::r);
  law.fastest_rate = [](const double* p) { return Fastest(detail::from_array<P>(p)); };
  return law;
}

/// For a law whose first state moves with the displacement, however long that takes: Travel brings
/// z over a displacement s (either sign) in closed form. Between samples v is a straight line, so
/// that a step is one such travel, or two where v changes its sign. Filter, if any, brings the
/// other states over the step.
template <class P, auto Travel, auto... Filter>
Law with_travel(Law law) {
  law.exact_step = true;
  law.step = [](const double* p, const double*, const double* v, double h, double* z) {
    const P own = detail::from_array<P>(p);
    z[0] = detail::TravelStep<P, Travel>::law_travel_step(&own, v, h, z[0]);
    (Filter(&own, v, h, z), ...);
    return 1;
  };
  return law;
}

}  // namespace dashpot
