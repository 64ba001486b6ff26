"""Models as files for other programs."""

import json
import os
from typing import List, Union

from . import _core
from ._arrays import as_json
from ._identify import Words, words


def export(
    model: _core.DamperModel,
    to: Words,
    folder: Union[str, "os.PathLike[str]"] = "dashpot-export",
    *,
    name: str = "",
    precision: str = "double",
    sample_time: float = 0,
    compiler: str = "",
    sources_only: bool = False,
) -> List[str]:
    """What stands behind DamperModel.export()."""
    options = {
        "to": words(to),
        "folder": os.fspath(folder),
        "name": name,
        "precision": precision,
        "sample_time": sample_time,
        "compiler": compiler,
        "sources_only": sources_only,
        "command": "DamperModel.export (Python)",
    }
    return json.loads(_core.export(model, as_json(options)))["files"]
