"""A damper in a car: python3 suspension.py RECORDINGS

The model of recordings drives over a rough road, at a constant current and under control.
"""

import sys

import numpy as np

import dashpot

# %% A model of the damper
damper = dashpot.identify(sys.argv[1], models=["tanh_kwok"], starts=1).best
print(damper, "currents", damper.domain["current"])

# %% Three seconds of a road of class C at 72 km/h: what the passengers feel, what the tyres lose
low, high = damper.domain["current"]
settings = {
    "least current": {"current": low},
    "most current": {"current": high},
    "controlled (SH-ADD)": {"controller": "sh_add"},
}
for name, setting in settings.items():
    trace = dashpot.simulate(
        "savaresi_spelta", damper, road="iso8608,class=C,speed=72km/h", duration=3, current_max=high, **setting
    )
    comfort = np.sqrt(np.mean(trace["body_acceleration"] ** 2))
    load = np.std(trace["tyre_load"])
    print(f"{name}: body {comfort:.3f} m/s^2 rms, tyre load {load:.0f} N rms")
