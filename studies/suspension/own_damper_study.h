#pragma once
#include "dashpot/report/document.h"
#include "dashpot/suspension/ride/ride_study.h"

// What the one-sensor paper asks of its suspension, asked of another damper, car and controllers.
namespace dashpot {

/// The hardware, in the words of the command line.
struct OwnDamper {
  std::string damper;                        ///< a model file or a set
  std::string passive;                       ///< as passive_words() has it
  std::string plant = "tudon_martinez2012";  ///< the paper's car
  std::vector<std::string> controllers;      ///< one at least
  double road_duration = 10;                 ///< s
  std::uint64_t seed = 1;
  int threads = 0;
  Monitor monitor;
};

struct OwnDamperStudy {
  RideStudy ride;
  std::string unbounded;  ///< why no bound is known; empty: there is one
};

/// Drives the hardware by the paper's protocol: gains on a sine and a chirp of 2 cm, a step of 3
/// cm, a class C road; with what is possible on that road, where it can be bounded. Throws Error as
/// study_ride() does.
OwnDamperStudy study_own_damper(const OwnDamper& own);

/// The page of the ride, with the paper's claims in front, each held against every controller.
Document own_damper_document(const OwnDamperStudy& study);

}  // namespace dashpot
