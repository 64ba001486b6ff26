"""Recordings of a damper: from files, arrays or DataFrames."""

import json
import os
import warnings
from typing import Iterable, Mapping, Optional, Union

from . import _core, _frames
from ._arrays import as_json

Paths = Union[str, os.PathLike, Iterable[Union[str, os.PathLike]]]


class Recordings:
    """Recordings to identify models from, or to judge models on.

    Recordings("folder/") reads files as `dashpot inspect` does; Recordings() is empty and takes add().

    paths: a file or folder, or several; dataset: a dataset file that states channels, units and conditions;
    recognise: look among the known published recordings; velocity_cutoff: Hz, of the filter that velocity is
    derived with (None: from the motion).

    A file of a folder that cannot be read is left out, with a warning that says why. What speaks against a recording,
    such as a unit that no damper has, is warned of, too: describe() lists it all.
    """

    def __init__(
        self,
        paths: Optional[Paths] = None,
        *,
        dataset: str = "",
        recognise: bool = True,
        velocity_cutoff: Optional[float] = None,
    ):
        if paths is None:
            self._core = _core._Recordings.empty()
            return
        several = [paths] if isinstance(paths, (str, os.PathLike)) else paths
        options = {"dataset": os.fspath(dataset), "recognise": recognise, "velocity_cutoff": velocity_cutoff or 0}
        self._core = _core._Recordings.load([os.fspath(path) for path in several], as_json(options))
        for file in json.loads(self._core.unread()):
            warnings.warn(f"not read: {file['why']}", stacklevel=2)
        self._warn_of_suspects(0)

    def add(
        self,
        table,
        *,
        name: Optional[str] = None,
        sample_time: Optional[float] = None,
        conditions: Optional[Mapping[str, float]] = None,
    ) -> "Recordings":
        """Copies one recording into these, and returns them.

        table: a DataFrame or a dict of arrays, whose names tell channel and unit: "velocity" (SI), "x [mm]",
        "F_N"; others are left out. It needs a force, velocity or displacement (velocity is then derived), and
        current or voltage, unless none has one (one constant, unknown drive). sample_time: s between samples, where no column is time. conditions: what was
        constant, SI: {"gap": 0.001}. A gap in time (5 median steps) ends one recording and begins the next, ", stretch 1",
        ", stretch 2" behind their names. Raises Error at what cannot be used; nothing is added then.
        """
        names = table.columns if _frames.is_frame(table) else table
        if not isinstance(table, Mapping) and names is table:
            raise TypeError(f"table is a {type(table).__name__}; a DataFrame, or a dict of arrays")
        arrays = {str(name): table[name] for name in names if _core.understand_column(str(name))[0]}
        if not arrays:
            there = ", ".join(str(name) for name in names) or "none"
            raise _core.Error(f"table: no name tells a channel (there are {there}); 'force [N]', 'x [mm]', 'time [s]'")
        stated = None if conditions is None else as_json(dict(conditions))
        before = len(json.loads(self._core.suspects()))
        self._core.add(arrays, name, sample_time, stated)
        self._warn_of_suspects(before)
        return self

    def _warn_of_suspects(self, first: int) -> None:
        """Warns of those from the first on; of many, of some."""
        shown = 3
        suspects = json.loads(self._core.suspects())[first:]
        for suspect in suspects[:shown]:
            warnings.warn(f"suspect: {suspect['record']}: {suspect['why']}", stacklevel=3)
        if len(suspects) > shown:
            warnings.warn(f"suspect: {len(suspects) - shown} more; describe() lists them", stacklevel=3)

    def __len__(self) -> int:
        return len(self._core)

    def __getitem__(self, place: int) -> dict:
        """Name, condition, sample_time (s) and columns: {"velocity [m/s]": array}, read-only views."""
        if not hasattr(place, "__index__"):
            raise TypeError(f"recording {place!r}: they are counted by whole numbers, from 0")
        if not -len(self) <= place < len(self):
            raise IndexError(f"recording {place} of {len(self)}")
        return self._core.record(place % len(self))

    def frame(self, place: int):
        """One recording as a DataFrame (pandas), its columns named with their units."""
        import pandas

        return pandas.DataFrame(self[place]["columns"], copy=False)

    def describe(self) -> str:
        """What was understood of every column, for people."""
        return self._core.describe()

    def __repr__(self) -> str:
        return f"<dashpot.Recordings, {len(self)}>"


def as_recordings(data) -> Recordings:
    """Recordings as they are, or those that paths name."""
    if isinstance(data, Mapping) or _frames.is_frame(data):
        raise TypeError("one table is no path: Recordings().add(table) makes recordings of it")
    if not isinstance(data, (Recordings, str, os.PathLike, Iterable)):
        raise TypeError(f"recordings: is a {type(data).__name__}; Recordings, a path, or a list of paths")
    return data if isinstance(data, Recordings) else Recordings(data)
