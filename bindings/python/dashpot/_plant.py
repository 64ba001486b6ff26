"""Dampers inside a plant: identified there, observed, and followed from day to day."""

import json
import os
import warnings
from typing import Iterable, List, Mapping, Optional, Tuple, Union

from . import _core, _frames
from ._arrays import as_json
from ._identify import Progress, Words, words

Plant = Union[str, "os.PathLike[str]", Mapping]
Dampers = Union[_core.DamperModel, Mapping[str, _core.DamperModel]]


def _rides(given, sample_time: float) -> _core._Rides:
    """Paths, tables of arrays, or DataFrames: one or several."""
    one = isinstance(given, (str, os.PathLike, Mapping)) or _frames.is_frame(given)
    rides = _core._Rides()
    for ride in [given] if one else given:
        if isinstance(ride, (str, os.PathLike)):
            rides.load(os.fspath(ride))
            continue
        names = ride.columns if _frames.is_frame(ride) else ride
        rides.add({str(name): ride[name] for name in names}, sample_time)
    return rides


def _plant(given: Plant) -> str:
    """A file, words, or what such a file holds."""
    return as_json(given) if isinstance(given, Mapping) else os.fspath(given)


def _dampers(given: Dampers):
    """One model for all dampers, or one each by the names of their struts or kinds."""
    for model in given.values() if isinstance(given, Mapping) else [given]:
        if not isinstance(model, _core.DamperModel):
            raise TypeError(f"model: is a {type(model).__name__}, not a DamperModel or a dict of them by strut")
    return dict(given) if isinstance(given, Mapping) else given


class PlantFit:
    """The dampers that were identified in their plant.

    models: a DamperModel of each kind of damper, by the kind's name; where all are alike there is one, "". plant: the
    plant as it was found, which observe() takes; report: all figures, as `dashpot identify --in --json` prints them
    of a law.
    """

    def __init__(self, models: List[_core.DamperModel], report: dict):
        self.plant = report.pop("found")
        kinds = self.plant.get("damper_kinds")
        self.models = dict(zip(kinds if isinstance(kinds, dict) else [""], models))
        self.report = report

    @property
    def model(self) -> _core.DamperModel:
        """The model of all dampers, where they are alike; raises ValueError where they are not."""
        if len(self.models) > 1:
            raise ValueError(f"the dampers are of {len(self.models)} kinds: .models has {', '.join(self.models)}")
        return self.models[""]

    @property
    def dampers(self):
        """What observe() and watch() take: the model of all dampers, or a dict of one for each kind."""
        return self.models.get("", self.models)

    @property
    def parameters(self) -> dict:
        """Numbers of plant and damper by name: value, unit, and low and high of the 95 % interval, SI."""
        return {number["name"]: number for number in self.report["plant"] + self.report["damper"]}

    @property
    def plant_beside_any_force(self) -> dict:
        """The plant's numbers whatever the dampers' forces are, as .parameters; empty where the model's agree."""
        return {number["name"]: number for number in self.report["plant_beside_any_force"]}

    @property
    def advice(self) -> dict:
        """What would let the fit tell more: "sensors", "recordings" (the best first), "profiles"."""
        return self.report["advice"]

    def __repr__(self) -> str:
        return f"<dashpot.PlantFit of {next(iter(self.models.values())).name}>"


def identify_in_plant(
    rides,
    plant: Plant,
    model: str,
    *,
    sample_time: float = 0,
    form: Words = (),
    fix: Words = (),
    free: Words = (),
    bounds: Words = (),
    starts: int = 12,
    seed: int = 1,
    threads: int = 0,
    grade: str = "car",
    profile: Words = (),
    progress: Progress = None,
) -> PlantFit:
    """What `dashpot identify --in` does, with the same figures: a damper as the unknown part of a plant.

    rides: a path, a dict of arrays or a DataFrame whose names hold channel and unit ("az_body [m/s^2]"; without a
    unit SI), or several of these. plant: a file, words, or a dict of what such a file holds (docs/in-plant.md).
    model: a law, or the file of one, or one of another kind, which learns along tanh_kwok there. sample_time: s, where no column is time.
    form, fix, free, bounds: as the command line has them.
    grade: of the sensors that are tried beside those that are there. profile: numbers whose misfit is followed.

    Raises Error at what cannot be used or told, NotUsable where the plant diverges wherever the fit begins.
    """
    options = {
        "models": [model],
        "form": words(form),
        "fix": words(fix),
        "free": words(free),
        "bounds": words(bounds),
        "starts": starts,
        "seed": seed,
        "threads": threads,
        "grade": grade,
        "profile": words(profile),
        "command": "dashpot.identify_in_plant (Python)",
    }
    found, report = _core.identify_in_plant(
        _rides(rides, sample_time), _plant(plant), as_json(options), progress
    )
    return PlantFit(found, json.loads(report))


class _RideTables:
    """A table per ride, and the report of the command that made them."""

    def __init__(self, core: _core._Recordings, report: dict):
        self.report = report
        self.rides: List[dict] = [core.record(place) for place in range(len(core))]

    def __len__(self) -> int:
        return len(self.rides)

    def __repr__(self) -> str:
        return f"<dashpot.{type(self).__name__} of {len(self)} rides>"

    def frame(self, ride: int = 0):
        """A ride as a DataFrame (pandas), its columns named with their units."""
        import pandas

        return pandas.DataFrame(self.rides[ride]["columns"], copy=False)


class PlantRun(_RideTables):
    """A plant in free run: each sensor and NAME_modelled per ride; the report of `dashpot evaluate --in --json`."""

    def error(self, sensor: str, ride: int = 0) -> float:
        """The rms error of a sensor in a ride, SI, after its offset; infinite where the plant diverges."""
        sensors = self.report["sensors"]
        of_ride = sensors[ride * len(sensors) // len(self) : (ride + 1) * len(sensors) // len(self)]
        for one in of_ride:
            if one["sensor"] == sensor:
                return float(one["error"])
        raise KeyError(f"{sensor!r}; known: {', '.join(one['sensor'] for one in of_ride)}")


def evaluate_in_plant(
    model: Dampers,
    rides,
    plant: Plant,
    *,
    sample_time: float = 0,
    steps: int = 0,
    threads: int = 0,
    progress: Progress = None,
) -> PlantRun:
    """What `dashpot evaluate --in` does: plant and dampers run free over rides that no fit has seen.

    model, rides, plant, sample_time: as of observe(); the road must be measured. Found are the sensors' offsets and,
    unless the plant says "start: rest", where it is at the beginnings; nothing else. steps: of the integrator per
    sample, 0: as many as its error asks for.

    Raises Error at what cannot be used.
    """
    options = {"steps": steps, "threads": threads}
    core, report = _core.evaluate_in_plant(
        _dampers(model), _rides(rides, sample_time), _plant(plant), as_json(options), progress
    )
    return PlantRun(core, json.loads(report))


class Observation(_RideTables):
    """What no sensor showed: a table per ride, and the report of `dashpot observe --json`."""

    def __getitem__(self, name: str):
        """(value, half width of its band) of the first ride, read-only arrays: observation["damper_force"]."""
        return self.of(name)

    def of(self, name: str, ride: int = 0) -> Tuple:
        """The same of any ride."""
        columns = {full.split(" [")[0]: samples for full, samples in self.rides[ride]["columns"].items()}
        if name not in columns or name + "_half_band" not in columns:
            known = [known for known in columns if known + "_half_band" in columns]
            raise KeyError(f"{name!r}; known: {', '.join(known)}")
        return columns[name], columns[name + "_half_band"]


def observe(
    model: Dampers,
    rides,
    plant: Plant,
    *,
    sample_time: float = 0,
    causal: bool = False,
    force_error: Optional[Iterable[Tuple[float, ...]]] = None,
    velocity_shift: Optional[Tuple[float, float]] = None,
    level: float = 0.9,
    steps: int = 0,
    threads: int = 0,
    progress: Progress = None,
) -> Observation:
    """What `dashpot observe` does: a damper's force, its plant's motion and the road, with bands.

    A plant with several dampers has this one in each strut, or one each by a dict ({"front": model, "rear": other}),
    and the forces are "front_damper_force" and so on.
    rides, plant, sample_time: as of identify_in_plant(); of the plant all numbers must be known (PlantFit.plant).
    A sensor whose noise the plant does not state has that which the identification of plant or model found.
    causal: each instant from its past alone. force_error: errors of the model's force as (N, s in which it is
    forgotten), or (N,) of one that stays; None: found. velocity_shift: of the velocity by which the model's force goes, (m/s, s in which it is
    forgotten); None: found where force_error is. level: share of the time that bands are to hold. steps: of the filter per sample, 0: as
    many as its error asks for.

    Raises Error at what cannot be used.
    """
    options = {
        "causal": causal,
        "force_error": [list(one) for one in force_error or ()],
        **({"velocity_shift": list(velocity_shift)} if velocity_shift else {}),
        "level": level,
        "steps": steps,
        "threads": threads,
    }
    core, report = _core.observe(_dampers(model), _rides(rides, sample_time), _plant(plant), as_json(options), progress)
    return Observation(core, json.loads(report))


class Watch:
    """What `dashpot watch --json` prints, as `report`, and the state that the next days go on from."""

    def __init__(self, report: dict):
        self.state = report.pop("state")
        self.report = report

    @property
    def alarm(self) -> Optional[dict]:
        """The chart whose alarm came first: "quantity", "alarm" (the day), "since", "fall"; None where none has."""
        places = {day["name"]: place for place, day in enumerate(self.days)}
        alarms = [chart for chart in self.report["charts"] if "alarm" in chart]
        first = self.report.get("first_alarm")  # of several dampers, on one day that which is furthest
        alarms.sort(key=lambda chart: chart["quantity"] != first)
        return min(alarms, key=lambda chart: places[chart["alarm"]], default=None)

    @property
    def days(self) -> List[dict]:
        """Each day: its name, the amounts by which each damper differs from its model, the plant, a remark."""
        return self.report["days"]

    @property
    def warnings(self) -> List[str]:
        """Names that tell another order of the days, dampers that the sensors hardly tell apart; also warned of."""
        return self.report["warnings"]

    def __repr__(self) -> str:
        return f"<dashpot.Watch of {len(self.days)} days, {'ALARM' if self.report['alarm'] else 'no alarm'}>"


def watch(
    model: Dampers,
    rides,
    plant: Plant,
    *,
    state: Optional[dict] = None,
    sample_time: float = 0,
    tracked: Words = ("force",),
    level: str = "",
    known: Words = (),
    reference: int = 20,
    false_alarms: float = 0.001,
    threads: int = 0,
    progress: Progress = None,
) -> Watch:
    """What `dashpot watch` does: dampers at work, followed from day to day, and an alarm when one fades.

    model: in a plant with several dampers in each strut, or one each by a dict ({"front": model, "rear": other}); each
    is followed, as "front_force".
    rides, plant, sample_time: as of identify_in_plant(), one ride per day in their order. state: Watch.state of an
    earlier call, whose days stand before these and are not looked at again; a dict that json keeps. tracked: "force",
    "rebound", "compression", "viscous" or "stiffness". level: a sensor whose mean is followed, too. known: channels
    whose mean may explain a day. reference: days that only teach. false_alarms: per day, all charts of all dampers
    together.

    Raises Error at what cannot be used, where the sensors cannot tell one damper from another, and where the state is
    of another model, plant or choice.
    """
    options = {
        "tracked": words(tracked),
        "level": level,
        "known": words(known),
        "reference": reference,
        "false_alarms": false_alarms,
        "threads": threads,
        "state": state,
    }
    report = _core.watch(_dampers(model), _rides(rides, sample_time), _plant(plant), as_json(options), progress)
    told = Watch(json.loads(report))
    for sentence in told.warnings:
        warnings.warn(sentence, stacklevel=2)
    return told
