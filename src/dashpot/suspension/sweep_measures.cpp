#include "dashpot/suspension/sweep_measures.h"

#include <array>

namespace dashpot {
namespace {

using M = RideMeasures;

constexpr std::array kMeasures{
    SweepMeasure{"body_acceleration", "m/s^2", "Body acceleration", "root mean square",
                 &M::body_acceleration},
    SweepMeasure{"weighted_acceleration", "m/s^2", "Weighted acceleration",
                 "root mean square by Wk of ISO 2631-1", &M::weighted_acceleration},
    SweepMeasure{"vibration_dose", "m/s^1.75", "Vibration dose", "VDV: fourth-power dose, by Wk",
                 &M::vibration_dose},
    SweepMeasure{"tyre_load_index", "1", "Tyre load index",
                 "root mean square of the load that moves over the load at rest", &M::tyre_load_index},
    SweepMeasure{"contact_lost", "1", "Contact lost", "share of the time in which some tyre has no load",
                 &M::contact_lost},
    SweepMeasure{"travel", "m", "Travel", "root mean square of the suspension's", &M::travel},
    SweepMeasure{"greatest_travel", "m", "Greatest travel", "greatest magnitude of the suspension's",
                 &M::greatest_travel},
    SweepMeasure{"stops_met", "1", "Stops met", "share of the time in which a stop is met", &M::stops_met},
    SweepMeasure{"energy", "J", "Energy", "taken by the dampers", &M::energy},
    SweepMeasure{"current", "A", "Current", "mean over time and dampers", &M::current},
    SweepMeasure{"outside_data", "1", "Outside the data",
                 "share of the time in which a damper is asked beyond its data", &M::outside_data},
    SweepMeasure{"diverged_at", "s", "Diverged at", "from when on nothing is finite; empty: never",
                 &M::diverged_at}};

}  // namespace

std::span<const SweepMeasure> sweep_measures() { return kMeasures; }

std::span<const SweepMeasure> judged_measures() { return std::span(kMeasures).first(kMeasures.size() - 1); }

}  // namespace dashpot
