#pragma once
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/plant.h"
#include "dashpot/value.h"

namespace dashpot {

// A plant that is none of the shipped kinds: coordinates with a matrix each of mass, damping and
// stiffness, and the places where dampers, ground and forces meet them.
//
//   M q'' + C q' + K q = C_g w' + K_g w + force - sum of row F
//
// An entry is a sum of numbers and of names, "k1 + 20 N/mm" or "-0.5*k2". The names are the
// parameters of the plant, so that what is unknown of the matrices is found as of any other plant.

/// The word for it, where the kind of a plant stands.
constexpr std::string_view kOfMatrices = "matrices";

/// What a file says of such a plant.
struct PlantOfMatrices {
  PlantModel model;                 ///< a row for each name; its texts point into `names`
  std::deque<std::string> names;    ///< of the parameters
  std::vector<Value::Member> file;  ///< coordinates, matrices and places, as they were written
  bool states_a_number = false;     ///< an entry says how large a mass, damping or stiffness is
};

/// Reads coordinates, matrices, damper(s) and what stands on the ground. `parameters` are the names
/// that may stand in entries; `source` stands in messages. Throws Error at a matrix of another
/// size, at one that is not symmetric, at an unknown name, and at a unit that an entry cannot have.
std::shared_ptr<PlantOfMatrices> read_plant_of_matrices(ObjectReader& reader,
                                                        const std::vector<std::string>& parameters,
                                                        const std::string& source);

/// Says where the search for what is unknown begins and how far it goes: a thousand times less and
/// more than 'about' where no range is stated, the middle of a range where no 'about' is. Then
/// throws Error where the matrices are none of a mechanical system anywhere within these ranges:
/// the mass must be positive definite, damping and stiffness positive semi-definite, also without
/// what stands on the ground.
void settle_unknowns(PlantOfMatrices& plant, InPlantSetup& setup, const std::string& where);

}  // namespace dashpot
