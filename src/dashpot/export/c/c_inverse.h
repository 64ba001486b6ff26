#pragma once
#include "dashpot/damper/inverse/inverse_file.h"
#include "dashpot/damper/inverse/observer.h"
#include "dashpot/drive.h"
#include "dashpot/export/c/c_block.h"

namespace dashpot {

/// An inverse as C code in double precision that defines, static, with DamperInput and InverseInput
/// declared before,
///   kInverse with its limits, inverse_least(&kInverse)
///   void   inverse_rest(const DamperInput* input, double* state)
///   double inverse_command(&kInverse, const InverseInput* input, double* state)
struct CInverse {
  std::string code;
  std::size_t state_size = 0;
};
/// Throws Error for one of which no C code is known.
CInverse c_inverse(const InverseModel& inverse);
/// The observer of an inverse, which runs a model beside the damper; null where it has none.
const Observer* observer_of(const InverseModel& inverse);

/// An inverse with what an export says of it.
struct ExportedInverse {
  const InverseModel& model;
  std::string title;
  DriveUnit drive_unit = DriveUnit::Ampere;
  Domain domain;       ///< of the motions along which it is checked
  std::string origin;  ///< sentences on where it comes from and what it is known for
};

/// The inverse as a block, with a run that checks it. Throws Error where it has no C code.
CBlock c_inverse_block(const ExportedInverse& inverse, const ExportOptions& options);
/// The same for an inverse network, which leaves the coil's lag to the driver. Throws Error where
/// its delays are no multiples of the sample time.
CBlock c_inverse_block(const InverseFile& inverse, const ExportOptions& options);

}  // namespace dashpot
