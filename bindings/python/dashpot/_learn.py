"""Models in the manners of scikit-learn, which need not be installed."""

import inspect
import json

import numpy as np

from . import _core, _frames
from ._arrays import as_json
from ._identify import fit_options
from ._recordings import Recordings

_CHANNELS = ("time", "displacement", "velocity", "current")


def is_list(X) -> bool:
    """Whether X holds several recordings instead of the samples of one."""
    return isinstance(X, (list, tuple)) and len(X) > 0 and np.ndim(X[0]) == 2


def parts(X, y):
    """(X, y) of each recording."""
    if not is_list(X):
        return [(X, y)]
    if len(X) != len(y):
        raise _core.Error(f"X holds {len(X)} recordings, y {len(y)}")
    return list(zip(X, y))


def score(model, X, y, sample_time=None) -> float:
    """R2 over all samples of all recordings; of a constant force 1 where the model has it exactly, else 0.

    That rule is r2_score's of scikit-learn, force_finite=True: an infinite score would spoil the mean over folds.
    """
    recordings = parts(X, y)
    measured = np.concatenate([np.asarray(force, float) for _, force in recordings])
    if measured.ndim != 1:
        raise _core.Error(f"y has {measured.ndim} dimensions; one force per sample")
    modelled = np.concatenate([np.asarray(model.predict(x, sample_time)) for x, _ in recordings])
    if measured.shape != modelled.shape:
        raise _core.Error(f"y has {len(measured)} samples, X {len(modelled)}")
    if np.ptp(measured) == 0:
        return float(np.array_equal(measured, modelled))
    return 1 - float(np.sum((measured - modelled) ** 2) / np.sum((measured - np.mean(measured)) ** 2))


def _table(x, unit: str) -> dict:
    """Channel -> samples, SI."""
    if unit not in ("A", "V"):
        raise _core.Error(f"drive_unit: is {unit!r}; 'A' or 'V'")
    if _frames.is_frame(x):
        return _frames.columns(x)
    x = np.asarray(x)
    if x.ndim != 2 or not 2 <= x.shape[1] <= 4:
        raise _core.Error("X: one row per sample, its columns velocity, current; displacement, velocity, current; or "
                          "time, displacement, velocity, current")
    names = _CHANNELS[-x.shape[1]:-1] + ("voltage" if unit == "V" else "current",)
    return {name: x[:, k] for k, name in enumerate(names)}


def _stretches(time) -> list:
    """Slices without a gap: rows that cross-validation took out of the middle must not be bridged."""
    steps = np.diff(time)
    breaks = np.flatnonzero((steps <= 0) | (steps > 1.5 * np.median(steps))) + 1
    ends = [0, *breaks.tolist(), len(time)]
    return [slice(first, last) for first, last in zip(ends, ends[1:])]


class Identifier:
    """A regressor: the force of a damper from its motion and current, by one kind of model.

    X: one recording, or a list of them; each a DataFrame whose columns tell by their names what they are, or an
    array with columns velocity m/s, current A; displacement m before them; time s before that. y: force, N, of
    each. Cross-validation should leave out whole recordings: give lists. Where one array with a time column has
    a gap, a new recording begins (each from rest); an array without time is taken as one recording.

    model: a name as `dashpot models` lists them. sample_time: s between rows without a time. drive_unit: "A", or
    "V" where arrays hold a voltage. The other parameters are those of dashpot.identify().

    After fit(): model_ (a DamperModel) and report_ (a dict: parameters with 95 % intervals, warnings, offsets).
    """

    _estimator_type = "regressor"

    def __init__(
        self,
        model="bingham",
        *,
        sample_time=None,
        drive_unit="A",
        force_offset="record",
        form=(),
        fix=(),
        free=(),
        bounds=(),
        prior=(),
        allow_active=False,
        asymmetric=False,
        network=(),
        start_from=(),
        starts=4,
        search=0,
        seed=1,
        threads=0,
    ):
        self.model = model
        self.sample_time = sample_time
        self.drive_unit = drive_unit
        self.force_offset = force_offset
        self.form = form
        self.fix = fix
        self.free = free
        self.bounds = bounds
        self.prior = prior
        self.allow_active = allow_active
        self.asymmetric = asymmetric
        self.network = network
        self.start_from = start_from
        self.starts = starts
        self.search = search
        self.seed = seed
        self.threads = threads

    @classmethod
    def _names(cls) -> list:
        return [name for name in inspect.signature(cls.__init__).parameters if name != "self"]

    def get_params(self, deep: bool = True) -> dict:
        """Every parameter by its name."""
        return {name: getattr(self, name) for name in self._names()}

    def set_params(self, **params) -> "Identifier":
        """Sets some of them; raises ValueError at a name that is none."""
        for name, value in params.items():
            if name not in self._names():
                raise ValueError(f"{name!r} is no parameter; known: {', '.join(self._names())}")
            setattr(self, name, value)
        return self

    def recordings(self, X, y) -> Recordings:
        """X and y as fit() understands them."""
        data = Recordings()
        for x, force in parts(X, y):
            if np.ndim(force) != 1:
                raise _core.Error(f"y has {np.ndim(force)} dimensions; one force per sample")
            table = {**_table(x, self.drive_unit), "force": np.asarray(force)}
            if len(table["force"]) != len(table["velocity" if "velocity" in table else "displacement"]):
                raise _core.Error(f"y has {len(table['force'])} samples, X {len(x)}")
            time = table.get("time")
            for stretch in [slice(None)] if time is None else _stretches(np.asarray(time)):
                part = {name: np.asarray(samples)[stretch] for name, samples in table.items()}
                data.add(part, sample_time=None if time is not None else self.sample_time)
        return data

    def fit(self, X, y, progress=None) -> "Identifier":
        """Fits to all recordings together, in free run. Ctrl-C stops it. Raises NotUsable where it fails."""
        params = self.get_params()
        options = {name: params[name] for name in inspect.signature(fit_options).parameters}
        asked = {"models": [self.model], "command": "dashpot.Identifier (Python)", **fit_options(**options)}
        self.model_, report = _core.fit(self.recordings(X, y)._core, as_json(asked), progress)
        self.report_ = json.loads(report)
        return self

    def _fitted(self) -> _core.DamperModel:
        if not self.__sklearn_is_fitted__():
            raise _core.Error("this Identifier is not fitted: call fit() first")
        return self.model_

    def predict(self, X):
        """Force, N, in free run from rest; of a list of recordings a list."""
        model = self._fitted()
        if is_list(X):
            return [model.predict(x, self.sample_time) for x in X]
        return model.predict(X, self.sample_time)

    def score(self, X, y) -> float:
        """R2 over all samples of all recordings; of a constant force 1 or 0."""
        return score(self._fitted(), X, y, self.sample_time)

    def __sklearn_is_fitted__(self) -> bool:
        return hasattr(self, "model_")

    def __sklearn_tags__(self):
        from sklearn.utils import InputTags, RegressorTags, Tags, TargetTags

        return Tags(
            estimator_type="regressor",
            target_tags=TargetTags(required=True),
            regressor_tags=RegressorTags(),
            input_tags=InputTags(),
        )

    def __repr__(self) -> str:
        default = inspect.signature(type(self).__init__).parameters
        said = [f"{name}={value!r}" for name, value in self.get_params().items() if value is not default[name].default]
        return f"Identifier({', '.join(said)})"
