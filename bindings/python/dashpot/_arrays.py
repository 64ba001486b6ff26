"""Numbers as float64 arrays."""

import numpy as np


def as_float64(values) -> np.ndarray:
    """A copy of real numbers as float64. Raises TypeError at anything else, rather than guessing."""
    if np.ma.is_masked(values):
        raise TypeError("the array has masked samples; leave them out or fill them in")
    array = np.asarray(values)
    if array.dtype.kind not in "fiub":
        raise TypeError(f"the array holds {array.dtype}, not real numbers")
    return np.require(array, np.float64, "A") if array.dtype != np.float64 else np.array(array)
