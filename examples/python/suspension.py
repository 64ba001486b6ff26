"""A damper in a car: python3 suspension.py RECORDINGS

The model of recordings drives over a rough road, at a constant current and under control. Its figures are those of
`dashpot simulate --damper damper.json --road iso8608,class=C,speed=72km/h --duration 3 ...`
"""

import sys

import dashpot

if len(sys.argv) != 2:
    sys.exit("usage: python3 suspension.py RECORDINGS, a folder or a file")

# %% A model of the damper
damper = dashpot.identify(sys.argv[1], models=["tanh_kwok"], starts=1).best
damper.save("damper.json")
print(damper, "currents", damper.domain["current"])

# %% Three seconds of a road of class C at 72 km/h: what the passengers feel, what the tyres lose
low, high = damper.domain["current"]
settings: dict = {
    "least current": {"current": low},
    "most current": {"current": high},
    "controlled (SH-ADD)": {"controller": "sh_add"},
}
for name, setting in settings.items():
    trace = dashpot.simulate(
        "savaresi_spelta", damper, road="iso8608,class=C,speed=72km/h", duration=3, current_max=high, **setting
    )
    body, load = trace.measures["body_acceleration"], trace.measures["tyre_load"]
    print(f"{name}: body {body} m/s^2 rms, tyre load {load} % of the static one rms")
