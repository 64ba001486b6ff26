"""Models in scikit-learn's manners: python3 learn.py RECORDINGS

The last figures are those of `dashpot evaluate learnt.json RECORDINGS`.
"""

import sys

import numpy as np

import dashpot

if len(sys.argv) != 2:
    sys.exit("usage: python3 learn.py RECORDINGS, a folder or a file")

recordings = dashpot.Recordings(sys.argv[1])

# %% One array of samples per recording: time, displacement, velocity, current or voltage; and the force beside it
drive = next(name for name in recordings[0]["columns"] if name in ("current [A]", "voltage [V]"))
X, y = [], []
for k in range(len(recordings)):
    columns = recordings[k]["columns"]
    names = ["time [s]", "displacement [m]", "velocity [m/s]", drive]
    X.append(np.column_stack([columns[name] for name in names]))
    y.append(columns["force [N]"])

# %% Fitted on all motions but one, judged on that one; scikit-learn's GridSearchCV does the same
left_out = recordings[0]["condition"]
seen = [k for k in range(len(X)) if recordings[k]["condition"] != left_out]
unseen = [k for k in range(len(X)) if recordings[k]["condition"] == left_out]
estimators = []
for name in ["bingham", "tanh_kwok"]:
    estimator = dashpot.Identifier(model=name, drive_unit=drive[-2], starts=2)
    estimator.fit([X[k] for k in seen], [y[k] for k in seen])
    score = estimator.score([X[k] for k in unseen], [y[k] for k in unseen])
    print(f"{name}: R2 {score:.4f} on {left_out}, which it has not seen")
    estimators.append((score, estimator))

# %% What it predicts, sample by sample; and step by step, as a simulation would ask
model = max(estimators, key=lambda judged: judged[0])[1].model_
force = model.predict(X[0])
state = model.rest(displacement=X[0][0, 1], current=X[0][0, 3])
for before, now in zip(X[0][:10], X[0][1:11]):
    model.advance(state, before[1:], now[1:], now[0] - before[0])
print(f"after 10 steps {model.force(state, X[0][10, 1:])} N, in the whole run {force[10]} N")

# %% Judged as `dashpot evaluate` does, each recording with a free force zero
model.save("learnt.json")
pooled = model.evaluate(recordings)["pooled"]
print(f"evaluate: ESR {pooled['esr_percent']} %, RMSE {pooled['rmse_N']} N")
