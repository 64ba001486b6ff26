#pragma once
#include <memory>
#include <vector>

#include "dashpot/machine/in_plant_setup.h"
#include "dashpot/machine/observe.h"
#include "dashpot/machine/recording_parts.h"
#include "dashpot/record.h"

namespace dashpot {

struct Law;

// Where the fit of a law inside a plant begins: what the sensors tell of the damper's motion and
// force without any law, and the law as a bench would find it from that.

/// A filter's time until it has forgotten where it began, s.
inline constexpr double kFilterSettles = 0.2;

/// The plant with these numbers as its unknowns (SI), and a dashpot and large errors of its force
/// in the damper's place. Throws Error as observe() does.
ObserveReport observe_without_law(InPlantSetup setup, const std::vector<double>& plant,
                                  const std::vector<PlantRecording>& fitted,
                                  const InPlantOptions& options);

/// The same in a plant whose numbers are known, beside the forces that some models of the dampers
/// have in free run (`along`, whole recordings): their errors come and go, and how large they are
/// is that under which the sensors are most likely. The forces that are told hold the models'.
ObserveReport observe_beside_force(InPlantSetup setup, std::vector<PlantRecording> fitted,
                                   const std::vector<InPlantTrace>& along,
                                   const InPlantOptions& options);

/// Motion and force of the dampers, as observed, as a bench would have recorded them: those of one
/// recording after the other.
std::vector<Record> as_bench_records(const InPlantSetup& setup,
                                     const std::vector<PlantRecording>& fitted,
                                     const ObserveReport& observed);

/// The motion of each damper, as observed, with what drives it, at each sample.
std::vector<std::vector<DamperInput>> observed_motions(const InPlantSetup& setup,
                                                       const PlantRecording& recording,
                                                       const ObservedRecording& observed);

/// The law as a bench would find it from these, its sides apart where that is asked for and pays;
/// null where no fit gets on, and for a law that is in no list.
std::shared_ptr<const DamperModel> fit_as_on_bench(const Law& law, const InPlantSetup& setup,
                                                   const std::vector<Record>& records,
                                                   const InPlantOptions& options);

}  // namespace dashpot
