"""What is seen without a fit: numbers of models, forces sample by sample, dyno sheets, comparisons, plots."""

import json
import os
from typing import Any, Iterable, Optional, Union

import numpy as np

from . import _core
from ._arrays import as_json
from ._recordings import Recordings, as_recordings


def from_json(text: str) -> _core.DamperModel:
    """What a pickled DamperModel calls."""
    return _core.DamperModel.from_json(text)


def parameters(model: _core.DamperModel) -> dict:
    """What stands behind DamperModel.parameters."""
    rows = json.loads(model._parameters())["parameters"]
    return {row["name"]: {key: row[key] for key in ("value", "unit", "meaning", "low", "high")} for row in rows}


def covariance(model: _core.DamperModel) -> Optional[np.ndarray]:
    """What stands behind DamperModel.covariance."""
    matrix = json.loads(model._parameters())["covariance"]
    return None if matrix is None else np.array(matrix, dtype=float)


def traces(
    model: _core.DamperModel, recordings, *, force_offset: str = "record", threads: int = 0, keep_inertia: bool = False
) -> Recordings:
    """What stands behind DamperModel.traces()."""
    options = {"force_offset": force_offset, "threads": threads, "keep_inertia": bool(keep_inertia)}
    made = Recordings()
    made._core = _core.traces(model, as_recordings(recordings)._core, as_json(options))
    return made


def _asked(speeds: Iterable[float], format: str, command: str) -> str:
    return as_json({"speeds": [float(speed) for speed in speeds], "format": format, "command": command})


def characterise(recordings, *, speeds: Iterable[float] = (), format: str = "json") -> Any:
    """What cyclic recordings say by themselves, as `dashpot characterise` does: a dict, in SI.

    recordings: Recordings, or paths. speeds: m/s, at which forces are stated (none: those that were measured).
    format: "html", "markdown", "text" or "csv" (every cycle) give a text instead.
    """
    text = _core.characterise(as_recordings(recordings)._core, _asked(speeds, format, "dashpot.characterise (Python)"))
    return json.loads(text) if format == "json" else text


def _thing(given) -> Union[_core.DamperModel, _core._Recordings]:
    if isinstance(given, _core.DamperModel):
        return given
    if isinstance(given, (str, os.PathLike)) and os.fspath(given).endswith(".json") and os.path.isfile(given):
        with open(given, encoding="utf-8") as file:
            if '"dashpot-model"' in file.read():
                return _core.DamperModel.load(os.fspath(given))
    return as_recordings(given)._core


def _name(given, place: int) -> str:
    if isinstance(given, (str, os.PathLike)):
        return os.fspath(given)
    return given.name if isinstance(given, _core.DamperModel) else f"recordings {place + 1}"


def compare(*things, names: Iterable[str] = (), speeds: Iterable[float] = (), format: str = "json") -> Any:
    """The first thing beside each of the others, as `dashpot compare` does: a dict, in SI.

    things: two or more DamperModels, Recordings, or paths of model files and recordings; names: of all of them
    (none: paths, and the models' names). speeds, format: as for characterise(), without "csv".
    """
    called = list(names) or [_name(thing, place) for place, thing in enumerate(things)]
    if len(called) != len(things):
        raise _core.Error(f"names: {len(called)} for {len(things)} things; one each")
    named = [(name, _thing(thing)) for name, thing in zip(called, things)]
    text = _core.compare(named, _asked(speeds, format, "dashpot.compare (Python)"))
    return json.loads(text) if format == "json" else text
