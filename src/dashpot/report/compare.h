#pragma once
#include <functional>
#include <string>
#include <vector>

#include "dashpot/model_file.h"
#include "dashpot/report/comparison_document.h"

namespace dashpot {

/// One of the things that a caller wants compared: a model or recordings, the other one null.
struct ThingToCompare {
  std::string name;  ///< in messages and on the page
  const ModelFile* model = nullptr;
  const Dataset* dataset = nullptr;
};

/// Everything, characterised: recordings as they are, models run over the first recordings or,
/// where there are none, over sines within the data of the first model; in the order given.
/// `speeds`: m/s, empty: those that were measured. `check` is called between the things and may
/// throw. Throws Error on fewer than two things, on different drives and on a model that diverges.
std::vector<ComparedThing> compared_things(const std::vector<ThingToCompare>& things,
                                           const std::vector<double>& speeds, int threads,
                                           const std::function<void()>& check = {});

}  // namespace dashpot
