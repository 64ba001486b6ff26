#pragma once
#include <string>

#include "dashpot/value.h"
#include "project.h"

namespace dashpot::studio {

/// The law from which a fit goes on where a hand has moved it, as the text of a model file: `from`
/// is {"model": "fits/NAME/models/x.json", "parameters": {"alpha": 900, ...}}, of which those that
/// are missing stay. Throws Error where the model is none of `law`, or a parameter is not its own
/// or beyond its bounds.
std::string start_model(const Project& project, const Value& from, const std::string& law);

}  // namespace dashpot::studio
