#pragma once
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dashpot/damper_model.h"

namespace dashpot {

class FamilyModel;
class FuzzyModel;
class HybridModel;
class HysteresisNetworkModel;
class LawModel;
class MeanModel;
class NarxModel;
class NetworkModel;
class PassiveHybridModel;
class PassiveNetworkModel;
class StateSpaceModel;
struct GatedNetwork;
struct HysteresisBank;
struct Mlp;

/// A kind of model as C code in double precision that defines, static,
///   void   model_rest(const DamperInput* input, double* state)
///   void   model_advance(const DamperInput* from, const DamperInput* to, double dt, double* state)
///   double model_force(const DamperInput* input, const double* state)
struct CModel {
  std::string code;
  bool has_derivatives = false;  ///< also void model_derivatives(input, state, double* derivatives)
};

/// A number of a model that whoever runs its C code may set.
struct CParameter {
  std::string name, unit, meaning;
  double value = 0;
  double lower = -HUGE_VAL, upper = HUGE_VAL;
};
std::vector<CParameter> c_parameters(const LawModel& model);
/// Of a family by physics: the numbers of its member, with ranges as wide as the family and half as
/// much again; none of another family, whose code is of one damper.
std::vector<CParameter> c_parameters(const FamilyModel& model);
/// Of whichever it is; none of another kind.
std::vector<CParameter> c_parameters(const DamperModel& model);
/// Whether the model has parameters that can be set at all.
bool has_settable(const DamperModel& model);

/// Throws Error for a model that no model file has. `settable`: the parameters of a law stand
/// behind its state, in the order of c_parameters() and then a lag rate also where it is 0, those
/// of a family in that order; model_defaults(state) writes them.
CModel c_model(const DamperModel& model, bool settable = false);

// One per kind, each in the file of its name; `stem` in place of "model" where a model is a part of
// something.
CModel c_law(const LawModel& model, const std::string& stem = "model", bool settable = false);
CModel c_network(const NetworkModel& model);
CModel c_narx(const NarxModel& model);
CModel c_hysteresis_network(const HysteresisNetworkModel& model);
CModel c_state_space(const StateSpaceModel& model);
CModel c_passive_network(const PassiveNetworkModel& model, const std::string& stem = "model");
CModel c_fuzzy(const FuzzyModel& model);
CModel c_hybrid(const HybridModel& model);
CModel c_passive_hybrid(const PassiveHybridModel& model);
CModel c_family(const FamilyModel& model, bool settable = false);
CModel c_mean(const MeanModel& model);
/// Behind a settable c_family() by physics: double family_plate_flow(const DamperInput* input,
/// const double* state), the force of the plate flow alone, N, without what the fit has learnt.
std::string c_family_plate_flow(const FamilyModel& model);

// Parts that several kinds have: C definitions whose names begin with `name`.

/// Tables of numbers, which must not be empty for C: then one 0 stands there.
std::string c_table(const std::string& name, std::span<const double> values);
std::string c_table(const std::string& name, const std::vector<int>& values);
/// The text of perceptrons as wide as the widest of these, their tables and an array `kMlps`.
std::string c_mlps(std::span<const Mlp> members);
/// The text of such networks and their tables, and an array `kNetworks`.
std::string c_gated_networks(const std::vector<const GatedNetwork*>& networks);
/// The text of banks and their tables, and an array `kBanks`.
std::string c_banks(const std::vector<const HysteresisBank*>& banks);

/// The end of a header that begins with a guard and extern "C".
constexpr const char* kCHeaderEnd = R"(
#ifdef __cplusplus
}
#endif

#endif
)";

/// The functions of a mean of `count` members, each a source of signals (`part`, in the C array
/// `array`) and a network of kNetworks that reads them.
std::string c_members(const std::string& part, const std::string& array, std::size_t count,
                      double offset);

/// The functions of a model without a state.
std::string c_stateless(const std::string& stem);

}  // namespace dashpot
