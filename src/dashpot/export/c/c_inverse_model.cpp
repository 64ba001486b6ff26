#include <algorithm>
#include <cmath>

#include "dashpot/base/escape.h"
#include "dashpot/damper/inverse/history_network.h"
#include "dashpot/damper/inverse/numeric.h"
#include "dashpot/damper/inverse/polynomial.h"
#include "dashpot/damper/inverse/switching.h"
#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/error.h"
#include "dashpot/export/c/c_inverse.h"
#include "dashpot/export/c/c_model.h"
#include "dashpot/export/c/c_text.h"

namespace dashpot {
namespace {

std::string constant(const std::string& name, double value) {
  return "static const double " + name + " = " + c_number(value) + ";\n";
}

std::string limits_of(const InverseModel& inverse) {
  const InverseLimits& limits = inverse.limits();
  return filled(R"(#include "inverse_limits.h"
static const InverseModel kInverse = {@least@, @most@, @lead@, @has_feedback@};

)",
                {{"least", CText::own(c_number(limits.current_min))},
                 {"most", CText::own(c_number(limits.current_max))},
                 {"lead", CText::own(c_number(inverse.lead()))},
                 {"has_feedback", CText::own(inverse.has_feedback() ? "1" : "0")}});
}

CInverse network_code(const HistoryNetwork& model) {
  const double change = std::min(model.most_change(), model.most() - model.least());
  return {"#include \"held.h\"\n" + c_mlps({&model.network().mlp, 1}) + "#define INVERSE_TAPS " +
              std::to_string(model.places().size()) + "\n#define INVERSE_STATES " +
              std::to_string(model.state_size()) + "\n\n" +
              c_table("kPlaces", std::vector<int>(model.places().begin(), model.places().end())) +
              constant("kLeast", model.least()) + constant("kMost", model.most()) +
              constant("kMostChange", change) + "#include \"inverse_network.h\"\n",
          model.state_size()};
}

CInverse switching_code(const SwitchingInverse& model) {
  return {filled(R"(#include "inverse_@name@.h"

static void inverse_rest(const DamperInput* input, double* state) {
  (void)input;
  (void)state;
}

static inline double inverse_wanted(const InverseModel* m, const InverseInput* input,
                                    double* state) {
  const double share = fmin(fmax(@name@_share(input, @force_max@), 0), 1);
  (void)state;
  return m->least + (share * (m->most - m->least));
}

)",
                 {{"name", CText::own(model.name())},
                  {"force_max", CText::own(c_number(model.force_max()))}}),
          0};
}

/// The model that runs beside the damper, and its observer.
std::string observer_code(const Observer& observer) {
  const auto* law = model_as<LawModel>(observer.model());
  const std::string stem = law ? "damped" : "model";
  return (law ? c_law(*law, stem) : c_model(observer.model())).code +
         filled(R"(#define OBSERVED_STATES @states@
#define OBSERVED_REST @stem@_rest
#define OBSERVED_ADVANCE @stem@_advance
#define OBSERVED_FORCE @stem@_force
#define OBSERVER_STEP @step@
#define OBSERVER_LAGS @lags@
#define OBSERVER_HORIZON @horizon@

#include "observed.h"
#include "inverse_observer.h"
)",
                {{"stem", CText::own(stem)},
                 {"states", CText::own(std::to_string(observer.model().state_size()))},
                 {"step", CText::own(c_number(observer.limits().sample_time))},
                 {"lags", CText::own(observer.limits().lag_rate > 0 ? "1" : "0")},
                 {"horizon", CText::own(std::to_string(observer.steps()))}});
}

CInverse polynomial_code(const PolynomialInverse& model) {
  return {observer_code(model.observer()) +
              filled(R"(#define ROOT_NARROW 1e-12 /* single precision: 2e-7 */
#define ROOT_TOLERANCE 1e-15 /* single precision: 2e-7 */

typedef struct PolynomialError {
  double c[4], wanted;
} PolynomialError;
typedef PolynomialError RootError;

#include "polynomial_pieces.h"
static inline double root_error(const RootError* e, double s) {
  return polynomial_at(e->c, s) - e->wanted;
}

#include "root_search.h"
#include "inverse_polynomial.h"
static const PolynomialNumbers kNumbers = {@degree@, @least@, @most@, @negligible@};

static void inverse_rest(const DamperInput* input, double* state) {
  observer_rest(&kInverse, input, state);
}

static inline double inverse_wanted(const InverseModel* m, const InverseInput* input,
                                    double* state) {
  return polynomial_wanted(m, &kNumbers, input, state);
}

)",
                     {{"degree", CText::own(std::to_string(model.degree()))},
                      {"least", CText::own(c_number(model.limits().current_min))},
                      {"most", CText::own(c_number(model.limits().current_max))},
                      {"negligible", CText::own(c_number(model.negligible()))}}),
          model.state_size()};
}

CInverse search_code(const NumericInverse& model) {
  return {observer_code(model.observer()) +
              filled(R"(#define ROOT_NARROW 1e-12 /* single precision: 2e-7 */

typedef struct SearchError {
  const Observer* observer;
  const InverseInput* input;
  double* state;
} SearchError;
typedef SearchError RootError;

static inline double root_error(const RootError* e, double current) {
  return observer_force(e->observer, current, e->input, e->state) - e->input->wanted;
}

#include "root_search.h"
#include "inverse_search.h"
static const SearchNumbers kNumbers = {@least@, @most@, @negligible@};

static void inverse_rest(const DamperInput* input, double* state) {
  observer_rest(&kInverse, input, state);
  state[@own@] = input->current;
  state[@trend@] = 0;
}

static inline double inverse_wanted(const InverseModel* m, const InverseInput* input,
                                    double* state) {
  return search_wanted(m, &kNumbers, input, state, &state[@own@]);
}

)",
                     {{"least", CText::own(c_number(model.limits().current_min))},
                      {"most", CText::own(c_number(model.limits().current_max))},
                      {"negligible", CText::own(c_number(model.negligible()))},
                      {"own", CText::own(std::to_string(model.observer().state_size()))},
                      {"trend", CText::own(std::to_string(model.observer().state_size() + 1))}}),
          model.state_size()};
}

CInverse code_of(const InverseModel& inverse) {
  if (const auto* network = dynamic_cast<const HistoryNetwork*>(&inverse))
    return network_code(*network);
  if (const auto* rule = dynamic_cast<const SwitchingInverse*>(&inverse))
    return switching_code(*rule);
  if (const auto* closed = dynamic_cast<const PolynomialInverse*>(&inverse))
    return polynomial_code(*closed);
  if (const auto* search = dynamic_cast<const NumericInverse*>(&inverse))
    return search_code(*search);
  throw Error(inverse.name(), "has no C code");
}

}  // namespace

const Observer* observer_of(const InverseModel& inverse) {
  if (const auto* closed = dynamic_cast<const PolynomialInverse*>(&inverse))
    return &closed->observer();
  if (const auto* search = dynamic_cast<const NumericInverse*>(&inverse))
    return &search->observer();
  return nullptr;
}

CInverse c_inverse(const InverseModel& inverse) {
  CInverse code = code_of(inverse);
  code.code = limits_of(inverse) + code.code + "#include \"inverse_command.h\"\n";
  return code;
}

}  // namespace dashpot
