"""Identification: recordings in, ranked models out."""

import json
import warnings
from typing import Callable, Iterable, Optional, Union

from . import _core
from ._arrays import as_json
from ._recordings import Paths, Recordings, as_recordings

Words = Union[str, Iterable[str]]
Progress = Optional[Callable[[str, float], None]]


def words(given: Words) -> list:
    """"a,b" or ["a", "b"] as a list."""
    return given.split(",") if isinstance(given, str) else list(given)


def fit_options(
    *,
    force_offset: str = "record",
    form: Words = (),
    fix: Words = (),
    free: Words = (),
    bounds: Words = (),
    prior: Words = (),
    allow_active: bool = False,
    asymmetric: bool = False,
    network: Words = (),
    start_from: Words = (),
    starts: int = 4,
    search: int = 0,
    seed: int = 1,
    threads: int = 0,
) -> dict:
    """The options of a fit, as the C boundary takes them."""
    lists = {"form": form, "fix": fix, "free": free, "bounds": bounds, "prior": prior, "network": network}
    lists["from"] = start_from
    numbers = {"starts": starts, "search": search, "seed": seed, "threads": threads}
    plain = {"force_offset": force_offset, "allow_active": bool(allow_active), "asymmetric": bool(asymmetric)}
    return {**plain, **{key: words(given) for key, given in lists.items()}, **numbers}


class Ranking:
    """Models, the best first, each fitted on all training recordings and judged on what it has not seen."""

    def __init__(self, core: _core._Ranking):
        self._core = core

    def __len__(self) -> int:
        return len(self._core)

    def __getitem__(self, place: int) -> _core.DamperModel:
        """The model at a place; raises NotUsable where its fit failed."""
        if not -len(self) <= place < len(self):
            raise IndexError(f"model {place} of {len(self)}")
        return self._core.model(place % len(self))

    @property
    def best(self) -> _core.DamperModel:
        """The first: the least error of those that can be recommended; raises NotUsable where no fit succeeded.

        See `leaders` for those that the data cannot tell from it.
        """
        return self[0]

    @property
    def leaders(self) -> list:
        """Names of the models that may be called best: one is the winner, several cannot be told apart."""
        return self.report["leaders"]

    @property
    def report(self) -> dict:
        """All figures, as `dashpot identify --json` prints them."""
        return json.loads(self._core.report("json"))

    @property
    def untried(self) -> list:
        """What the budget left untried: dicts of "name", "title", "minutes" (estimated, on two cores) and
        "budget_minutes" (the least whole budget that tries it too)."""
        return self.report.get("budget", {}).get("untried", [])

    def frame(self):
        """A line per model (pandas): errors on the recordings left out, and the 90 % interval of how many times
        the first model's ESR its own is, on a typical part of them."""
        import pandas

        lines = []
        for model in self.report["models"]:
            ratio = model["over_first"] or {}
            interval = {f"over_first_{end}": ratio.get(end, float("nan")) for end in ("low", "high")}
            lines.append({"model": model["name"], **model["left_out"]["pooled"], **interval})
        return pandas.DataFrame(lines).set_index("model")

    def save_report(self, path: str) -> None:
        """Writes the report page (.html), or .json, .md or .csv."""
        formats = {"html": "html", "json": "json", "md": "markdown", "csv": "csv"}
        ending = str(path).rsplit(".", 1)[-1]
        if ending not in formats:
            raise _core.Error(f"{path}: unknown ending; known: {', '.join('.' + known for known in formats)}")
        with open(path, "w", encoding="utf-8") as file:
            file.write(self._core.report(formats[ending]))

    def __str__(self) -> str:
        return self._core.report("text")

    def __repr__(self) -> str:
        return f"<dashpot.Ranking of {len(self)} models>"


def identify(
    recordings: Union[Recordings, Paths],
    models: Words = "usual",
    leave_out: Optional[str] = None,
    *,
    budget: Optional[float] = None,
    keep_inertia: bool = False,
    progress: Progress = None,
    **options,
) -> Ranking:
    """What `dashpot identify` does, with the same figures.

    recordings: Recordings, or paths. models: names as `dashpot models` lists them, "usual", "all" or "family".
    leave_out: "condition", "current=0.5", "record", "groups=6", "blocks=5", "fraction=0.3", "each=gap" (None: as the dataset file says,
    else the strictest that the recordings allow). budget: minutes on two cores, by estimated cost, that the models
    of "usual" (None: 2) and "all" (None: no limit) may take, 0: no limit; `Ranking.untried` is what was not tried.
    keep_inertia: leave the force as recorded where errors left out show an inertia between load cell and damper.
    progress: called with (stage, fraction 0 ... 1).
    options: force_offset ("record" or "none"), form, fix, free, bounds, prior, network (lists as the command
    line has them: ["alpha=exponential"]), allow_active (keep models that feed energy in), asymmetric (take rebound and
    compression of laws apart where it pays), start_from (model files of laws: their numbers are the first start),
    starts, search, seed, threads (0: all cores).

    Other Python threads run meanwhile; Ctrl-C stops it. Raises Error on what cannot be used.
    """
    data = as_recordings(recordings)
    asked = {"models": words(models), "command": "dashpot.identify (Python)", **fit_options(**options)}
    if leave_out is not None:
        asked["leave_out"] = leave_out
    if keep_inertia:
        asked["keep_inertia"] = True
    if budget is not None:
        asked["budget"] = budget
    return Ranking(_core.identify(data._core, as_json(asked), progress))


def evaluate(
    model: _core.DamperModel, recordings, *, force_offset: str = "record", threads: int = 0, keep_inertia: bool = False
) -> dict:
    """What stands behind DamperModel.evaluate()."""
    options = {"force_offset": force_offset, "threads": threads, "keep_inertia": bool(keep_inertia)}
    told = json.loads(_core.evaluate(model, as_recordings(recordings)._core, as_json(options)))
    if told["records_seen"] > 0:
        seen = f"{told['records_seen']} of {len(told['records'])} records"
        warnings.warn(f"the fit of the model has seen {seen}: these errors are no judgement", stacklevel=3)
    return told
