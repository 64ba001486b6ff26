"""Dashpot: recordings of magnetorheological dampers become models, and models become forces.

    import dashpot

    ranking = dashpot.identify("recordings/", models=["bingham", "tanh_kwok"])
    force = ranking.best.predict(X, sample_time=0.001)     # X: displacement m, velocity m/s, current A

Units are SI. Extension is positive; a force is positive when it resists extension.
"""

from . import plot
from ._core import DamperModel, Error, NotUsable, __version__
from ._identify import Ranking, identify
from ._learn import Identifier
from ._looks import characterise, compare
from ._plant import Observation, PlantFit, PlantRun, Watch, evaluate_in_plant, identify_in_plant, observe, watch
from ._recordings import Recordings
from ._simulate import Trace, simulate

load = DamperModel.load
published = DamperModel.published

__all__ = [
    "DamperModel",
    "Error",
    "Identifier",
    "NotUsable",
    "Observation",
    "PlantFit",
    "PlantRun",
    "Ranking",
    "Recordings",
    "Trace",
    "__version__",
    "characterise",
    "compare",
    "evaluate_in_plant",
    "identify",
    "identify_in_plant",
    "load",
    "observe",
    "plot",
    "published",
    "simulate",
    "watch",
]
