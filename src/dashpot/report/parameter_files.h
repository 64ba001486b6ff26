#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "dashpot/identify.h"
#include "dashpot/model_file.h"

namespace dashpot {

/// The fitted numbers of a law with their 95 % intervals and covariance matrix, in SI, for other
/// programs. `format`:
/// csv: a line per parameter, its row of the matrix behind it;
/// mat: the vectors value, low, high, fixed and the matrix covariance, with names and units as
///      texts;
/// json: "parameters" and "covariance" as in the report.
/// The file's text or bytes; the fit must have a covariance.
std::string parameter_file(const FitReport& fit, std::string_view format);

/// The numbers of a law's file: {"parameters": [{"name", "unit", "meaning", "value", "low",
/// "high"}], "covariance": [[...]]}. Intervals and covariance are null where the file knows none:
/// they are those of its fit. Without parameters where the model is no law.
Value parameters_json(const ModelFile& file);

}  // namespace dashpot
