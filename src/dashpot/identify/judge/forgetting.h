#pragma once
#include <vector>

#include "dashpot/damper_model.h"
#include "dashpot/drive.h"
#include "dashpot/evaluate.h"
#include "dashpot/record.h"

// Whether a model forgets how it began. A run of a model with states starts from some state, in a
// recording, in a vehicle, after a restart; a model is a damper only if the force that follows is
// that of the motion and the drive, and the start dies out. A network that feeds back its own force
// or its own states may instead settle on one of several forces for the same motion, and nobody
// sees it where all runs start from rest.
namespace dashpot {

inline constexpr double kForgottenShare = 0.01;  ///< of the force span: runs this near have met
/// s, the time allowed, and that of what is slow to forget. The spring between two dashpots of
/// Spencer's law, as published, relaxes with 6.5 s, and with some 40 s where its hysteresis holds
/// it, at 2.25 V under strokes of 25 mm at 0.25 Hz: seven times that. What settles on one of
/// several answers never forgets.
inline constexpr double kForgettingSeconds = 20, kSlowForgettingSeconds = 300;
inline constexpr double kForgottenFor = 10;  ///< s, how long a motion is run beyond that

/// Runs the model along the motion and the drive of each record from rest; from the states in which
/// it is where its force is greatest and least on the record whose measured force spans most; and
/// from its state at the end of the record before, the last one before the first. A record that is
/// shorter than a run is repeated. All runs must have met after the time allowed, and from there on
/// stay together; those that have not are run once more, with the longer time, and where that is
/// too little told as they were.
///
/// A model that feeds back its force at steps of its own is taken over at one of these, so that all
/// runs step at the same instants of the motion.
///
/// The force is compared as it is: a constant difference between two runs is not taken out,
/// although a record's offset is free where models are judged, since a vehicle has no such freedom.
/// Friction and hysteresis keep a force while nothing moves, so that the test is under motion only:
/// what a Bouc-Wen element remembers of its last displacement is wiped out by the first stroke that
/// is longer than its loop. One that is not, on strokes that stay within the loop, is said to
/// remember.
///
/// The records have force, velocity and drive. force_span: max - min of their forces, N.
Forgetting forgetting(const DamperModel& model, const std::vector<Record>& records,
                      DriveUnit drive_unit, double force_span, int threads = 0);

}  // namespace dashpot
