"""From recordings to ranked models: python3 identify.py RECORDINGS

Its figures are those of `dashpot identify RECORDINGS --models bingham,tanh_kwok --leave-out current`.
"""

import sys

import dashpot

if len(sys.argv) != 2:
    sys.exit("usage: python3 identify.py RECORDINGS, a folder or a file")

# %% What is there, and how every column was understood
recordings = dashpot.Recordings(sys.argv[1])
print(recordings.describe())

# %% Two models, each judged on currents that it has not seen
ranking = dashpot.identify(recordings, models=["bingham", "tanh_kwok"], leave_out="current")
print(ranking)
for model in ranking.report["models"]:
    figures = model["left_out"]["pooled"]
    print(f"{model['name']}: ESR {figures['esr_percent']} %, RMSE {figures['rmse_N']} N")

# %% The best one's parameters, with their 95 % intervals
for p in ranking.report["models"][0]["fit"]["parameters"]:
    print(f"  {p['name']:8} {p['value']:12.5g} ({p['low']:.5g} ... {p['high']:.5g}) {p['unit']}")

# %% It goes on as a file
ranking.best.save("best.json")
