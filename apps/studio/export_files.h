#pragma once
#include <string>

#include "dashpot/value.h"
#include "project.h"

namespace dashpot::studio {

/// Has `dashpot export` write a model of the project to exports/NAME, NAME being made of the
/// model's path. `asked`: {"model": "fits/x/models/y.json", "formats": ["c", "fmu3"], "name": "",
/// "precision": "", "sample_time": ""}. Returns {"folder": NAME, "model", "files": [{"name",
/// "bytes"}], "arguments"}. The report of the fit or the design goes beside the files. Throws Error
/// where the model cannot become that.
Value export_model(const Project& project, const Value& asked);

/// Every export of the project, the newest first, each as export_model() returned it.
Value exports(const Project& project);

/// A file to be downloaded.
struct Download {
  std::string name, type, content;
};
/// One file of an export; `file` empty: all of them as a zip archive. Throws Error on a name that
/// is none of them.
Download exported(const Project& project, const std::string& folder, const std::string& file);

}  // namespace dashpot::studio
