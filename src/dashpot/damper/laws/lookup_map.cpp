#include "dashpot/damper/laws/lookup_map.h"

#include "dashpot/damper/law.h"

namespace dashpot {

extern const Law kLookupMap;
const Law kLookupMap =
    static_law<LookupMap, lookup_map_force>({
        .name = "lookup_map",
        .title = "Look-up map of force over velocity",
        .equation = "F(0) = f0, F(v_max k) = f0 + p1 ... p6, F(-v_max k) = f0 + n1 ... n6, "
                    "straight in between\n"
                    "k = 1/32, 1/16, 1/8, 1/4, 1/2, 1",
        .source = "force-velocity diagrams of damper makers; defaults: an example of our own",
        .remarks =
            "No hysteresis, no assumption on the shape: what any law without memory can reach at "
            "most. Beyond v_max the last slope goes on unless it falls.",
        .states = {},
        .params =
            {
                {&LookupMap::p1, "p1", "N", 150, 0, 1e6, 0.15, Form::Linear,
                 "force at v_max / 32, above f0"},
                {&LookupMap::p2, "p2", "N", 290, 0, 1e6, 0.25, Form::Linear,
                 "force at v_max / 16, above f0"},
                {&LookupMap::p3, "p3", "N", 480, 0, 1e6, 0.35, Form::Linear,
                 "force at v_max / 8, above f0"},
                {&LookupMap::p4, "p4", "N", 680, 0, 1e6, 0.45, Form::Linear,
                 "force at v_max / 4, above f0"},
                {&LookupMap::p5, "p5", "N", 850, 0, 1e6, 0.6, Form::Linear,
                 "force at v_max / 2, above f0"},
                {&LookupMap::p6, "p6", "N", 1100, 0, 1e6, 0.9, Form::Linear,
                 "force at v_max, above f0"},
                {&LookupMap::n1, "n1", "N", -150, -1e6, 0, -0.15, Form::Linear,
                 "force at -v_max / 32, above f0"},
                {&LookupMap::n2, "n2", "N", -290, -1e6, 0, -0.25, Form::Linear,
                 "force at -v_max / 16, above f0"},
                {&LookupMap::n3, "n3", "N", -480, -1e6, 0, -0.35, Form::Linear,
                 "force at -v_max / 8, above f0"},
                {&LookupMap::n4, "n4", "N", -680, -1e6, 0, -0.45, Form::Linear,
                 "force at -v_max / 4, above f0"},
                {&LookupMap::n5, "n5", "N", -850, -1e6, 0, -0.6, Form::Linear,
                 "force at -v_max / 2, above f0"},
                {&LookupMap::n6, "n6", "N", -1100, -1e6, 0, -0.9, Form::Linear,
                 "force at -v_max, above f0"},
                {&LookupMap::v_max, "v_max", "m/s", 0.2, 1e-6, 100, 1, Form::Constant,
                 "speed of the last knot", Fit::Scale},
                {&LookupMap::f0, "f0", "N", 0, -1e6, 1e6, 0, Form::Constant, "force at v = 0",
                 Fit::Bias},
            },
        .needs_displacement = false,
        .dissipates =
            "Where F - f0 has the sign of v at every point of the map, at every drive: the bounds "
            "see to it at some currents only, so that the measured verdict decides.",
    });

}  // namespace dashpot
