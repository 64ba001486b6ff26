"""DataFrames: columns that tell by their names what they are, as a CSV file's header does."""

import numpy as np

from . import _core
from ._arrays import as_float64


def is_frame(table) -> bool:
    """Whether this is a DataFrame, of pandas or alike."""
    return hasattr(table, "columns") and hasattr(table, "__getitem__")


def columns(frame) -> dict:
    """Channel -> samples in SI. A float64 column that is in SI already is not copied."""
    found = {}
    for name in frame.columns:
        channel, factor, shift = _core.understand_column(str(name))
        if not channel:
            continue
        if channel in found:
            raise _core.Error(f"column {name!r}: another one is {channel} already; drop one of them")
        samples = np.asarray(frame[name])
        if samples.dtype != np.float64:
            samples = as_float64(frame[name], f"column {name!r}")
        found[channel] = samples if (factor, shift) == (1.0, 0.0) else samples * factor + shift
    return found


def drive(found: dict, unit: str):
    """The column that drives a model of this unit, A or V; zeros for one fitted at one constant, unknown drive."""
    if unit == "":
        return np.zeros(len(found["velocity"]))
    name = "voltage" if unit == "V" else "current"
    if name not in found:
        raise _core.Error(f"no column is {name} by its name (there are {', '.join(found) or 'none'} that are known)")
    return found[name]


def predict(model, frame, sample_time, interval):
    """DamperModel.predict of a DataFrame: Series with its index."""
    import pandas

    found = columns(frame)
    if "velocity" not in found:
        raise _core.Error("no column is velocity by its name; derive it first: Recordings does where there is a force")
    result = model.run(
        found["velocity"],
        drive(found, model.drive_unit),
        displacement=found.get("displacement"),
        time=found.get("time") if sample_time is None else None,
        sample_time=sample_time,
        interval=interval,
    )
    if not interval:
        return pandas.Series(result, index=frame.index, name="force [N]", copy=False)
    names = ("force [N]", "half_width [N]")
    return tuple(pandas.Series(part, index=frame.index, name=name, copy=False) for part, name in zip(result, names))
