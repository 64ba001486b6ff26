"""Vehicles and buildings with dampers in them."""

import json
import tempfile
from pathlib import Path
from typing import Iterable, Union

from . import _core
from ._arrays import as_json
from ._identify import Progress, Words, words

Damper = Union[_core.DamperModel, str]


class Trace:
    """All that moved: columns["body_acceleration [m/s^2]"] is a read-only array; report tells road and warnings."""

    def __init__(self, core: _core._Recordings, report: dict):
        self.report = report
        self.columns = core.record(0)["columns"]

    def __getitem__(self, name: str):
        """A column by its name, with or without its unit."""
        for full, samples in self.columns.items():
            if name in (full, full.split(" [")[0]):
                return samples
        raise KeyError(f"{name!r}; known: {', '.join(self.columns)}")

    @property
    def measures(self) -> dict:
        """Figures of `dashpot simulate` by name, in its units: "body_acceleration" m/s^2, "tyre_load" %, "travel" mm
        ...; report["measures"] has the units. None with an output_step of one's own."""
        return {measure["name"]: measure["value"] for measure in self.report["measures"]}

    def frame(self):
        """As a DataFrame (pandas)."""
        import pandas

        return pandas.DataFrame(self.columns, copy=False)

    def __repr__(self) -> str:
        return f"<dashpot.Trace, {self.report['plant']} on {self.report['road']}>"


def _names(dampers: Union[Damper, Iterable[Damper]], folder: Path) -> list:
    """Words for the dampers; models become files in the folder."""
    listed = list(dampers) if isinstance(dampers, Iterable) and not isinstance(dampers, str) else [dampers]
    names = []
    for k, damper in enumerate(listed):
        if not isinstance(damper, (str, _core.DamperModel)):
            raise TypeError(f"dampers: is a {type(damper).__name__}; a DamperModel or a damper's words")
        if isinstance(damper, _core.DamperModel):
            path = str(folder / f"{k}_{damper.name}.json")
            damper.save(path)
            damper = path
        names.append(damper)
    return names


def _plant_file(plant: Union[str, dict], folder: Path) -> str:
    """Words for the plant; what a file of one holds becomes a file in the folder."""
    if isinstance(plant, str):
        return plant
    path = folder / "plant.json"
    path.write_text(json.dumps(plant))
    return str(path)


def simulate(
    plant: Union[str, dict] = "savaresi_spelta",
    dampers: Union[Damper, Iterable[Damper]] = (),
    *,
    road: str = "iso8608,class=C",
    duration: float = 0,
    controller: str = "",
    inverse: str = "",
    values: Words = (),
    current: float = 0,
    current_max: float = 0,
    lag_rate: float = -1,
    sample_time: float = 1e-3,
    in_car: bool = False,
    delay: float = 0,
    output_step: float = 0,
    seed: int = 1,
    progress: Progress = None,
) -> Trace:
    """A vehicle or building from rest, in the words of `dashpot simulate`; SI units.

    plant: a set, a kind of plant, a file or a dict of what it holds (PlantFit.plant); values: in place of its own: ["sprung_mass=350kg"]. dampers: one for all
    struts or one each: a DamperModel, or words ("viscous,damping=1500", a parameter set, a file); none: the
    plant's own range, ideal. road: with its settings. duration: s, 0: the road's, 20 s at most. controller: with
    its settings; "": the current stays at `current`, A. inverse: a scheme or file, from a wanted force to a
    current. current_max: A, 0: that of the damper's data. lag_rate: of the coil, 1/s, below 0: the damper's own.
    sample_time: of the controller, s. in_car: sensors as in a car, delayed by `delay` s. output_step: s.

    Raises Error at words that nothing is known by, NotUsable where it diverges.
    """
    with tempfile.TemporaryDirectory(prefix="dashpot-") as folder:
        options = {
            "plant": _plant_file(plant, Path(folder)),
            "set": words(values),
            "dampers": _names(dampers, Path(folder)),
            "controller": controller,
            "inverse": inverse,
            "current": current,
            "current_max": current_max,
            "lag_rate": lag_rate,
            "sample_time": sample_time,
            "in_car": in_car,
            "delay": delay,
            "road": road,
            "duration": duration,
            "output_step": output_step,
            "seed": seed,
        }
        trace, report = _core.simulate(as_json(options), progress)
    return Trace(trace, json.loads(report))
