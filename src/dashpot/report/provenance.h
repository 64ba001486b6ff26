#pragma once
#include <string>
#include <vector>

#include "dashpot/dataset.h"
#include "dashpot/report/document.h"
#include "dashpot/split.h"

// The parts that every report on recordings shares.
namespace dashpot {

/// "utfsm: 20 records, 4 conditions, 5 currents 0 ... 1 A, 812 s".
std::string summary(const Dataset& dataset);

using Terms = std::vector<std::pair<std::string, std::string>>;

/// Free run, left out, offset, ESR and so on, each with its definition.
Terms judged_terms();

/// How records were left out, the terms, and the folds.
DocumentSection judged_section(std::string protocol, const std::vector<std::string>& folds,
                               Terms terms);

/// The dataset, its citation, files and notes; `display`: what the page's curves leave out.
DocumentSection provenance_section(const Dataset& dataset, const std::string& display);

}  // namespace dashpot
