#pragma once
#include <string>
#include <utility>
#include <vector>

#include "dashpot/damper/model.h"

namespace dashpot {

/// A kind of model as C code in double precision that defines, static,
///   void   <stem>_rest(const DamperInput* input, double* state)
///   void   <stem>_advance(const DamperInput* from, const DamperInput* to, double dt, double* state)
///   double <stem>_force(const DamperInput* input, const double* state)
struct CModel {
  std::string code;
  bool has_derivatives = false;  ///< also void <stem>_derivatives(input, state, double* derivatives)
};

/// Throws Error for a model of which no C code is known.
CModel c_model(const DamperModel& model);

class LawModel;
/// `stem` is "model" in c_model; a hybrid has a law under another name.
CModel c_law(const LawModel& model, const std::string& stem);

/// `text` with each @name@ replaced. Throws Error where one is left.
std::string filled(std::string text, const std::vector<std::pair<std::string, std::string>>& values);

}  // namespace dashpot
