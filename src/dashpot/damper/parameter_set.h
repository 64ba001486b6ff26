#pragma once
#include <string>
#include <vector>

#include "dashpot/damper/kinds/law/law_model.h"
#include "dashpot/model_file.h"

namespace dashpot {

/// A published set of parameters: a file of data/parameters, converted to SI.
struct ParameterSet {
  std::string name;    ///< "spencer1997"
  std::string damper;  ///< what was measured
  std::string source;
  bool verified = false;                ///< false: an example, not to be called published
  std::string reason;                   ///< how it was verified, or why it is not
  double drive_min = 0, drive_max = 0;  ///< A or V, where it holds
  LawModel model;
  std::vector<double> drive_levels =
      {};                        ///< those that its driver can give; empty: all in that range
  Dissipation dissipation = {};  ///< stated where it feeds energy in; else not tested
};

/// Names of the sets that come with Dashpot, in alphabetical order.
std::vector<std::string> parameter_set_names();

/// Throws Error "unknown parameter set 'spencer'; did you mean ..." or on what is wrong in the
/// file.
ParameterSet load_parameter_set(const std::string& name);
/// Does what load_parameter_set() does, and gives the model alone.
LawModel load_parameters(const std::string& name);

/// The set as a model file, which says where its numbers come from and whether they are an example.
ModelFile to_model_file(const ParameterSet& set);

/// The text of such a file. `source` stands in messages.
ParameterSet parse_parameter_set(std::string_view text, const std::string& source,
                                 const std::string& name);

}  // namespace dashpot
