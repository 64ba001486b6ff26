#pragma once
#include <span>
#include <string>
#include <vector>

#include "dashpot.h"
#include "dashpot/identify.h"
#include "dashpot/rank.h"
#include "dashpot/record/readers/table.h"
#include "status.h"

// The objects behind the pointers of dashpot.h.

struct dashpot_model {
  explicit dashpot_model(dashpot::ModelFile model_file);

  dashpot::ModelFile file;
  const dashpot::DamperModel* damper;  ///< of the file
  std::size_t state_size;
  std::string name, kind, title;
};

struct dashpot_recordings {
  dashpot::Dataset dataset;
  bool takes_arrays = false;
  std::vector<std::string> name_rests = {};  ///< of the arrays' records, for their conditions
};

struct dashpot_ranking {
  dashpot::Dataset dataset;  ///< the report shows it
  dashpot::Ranking ranking;
  std::string command, date;
};

struct dashpot_rides {
  std::vector<dashpot::RawTable> tables;
  std::vector<std::string> names = {};  ///< of the tables, as the caller gave them; empty: not
};

namespace dashpot::capi {

/// The caller's state array. Throws Error where its size is not the model's.
template <class Number>
std::span<Number> state_of(const dashpot_model& model, Number* state, std::size_t size) {
  if (size != model.state_size)
    throw Error("state_size", "is " + std::to_string(size),
                model.name + " has " + std::to_string(model.state_size) + " states");
  if (size > 0) require(state, "state");
  return {state, size};
}

/// Deletes what a handle points to, and clears the handle.
template <class Handle>
void give_back(Handle** handle) noexcept {
  if (!handle) return;
  delete *handle;
  *handle = nullptr;
}

}  // namespace dashpot::capi
