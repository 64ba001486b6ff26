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
  bool needs_force = false;  ///< looks at the measured one
};
/// Throws Error for one of which no C code is known. The precision that it will get decides where
/// searches stop.
CInverse c_inverse(const InverseModel& inverse, CPrecision precision);
/// What runs a model beside the damper; null where nothing does.
const Observer* observer_of(const InverseModel& inverse);

/// An inverse with what an export says of it.
struct ExportedInverse {
  const InverseModel& model;
  std::string title;
  DriveUnit drive_unit = DriveUnit::Ampere;
  Domain domain;  ///< of the motions along which it is checked
};

CBlock c_inverse_block(const ExportedInverse& inverse, const ExportOptions& options);
/// The same for an inverse network; the coil's lag is the driver's affair. Throws Error where the
/// sample time cannot serve its delays.
CBlock c_inverse_block(const InverseFile& inverse, const ExportOptions& options);

}  // namespace dashpot
