"""Numbers as float64 arrays."""

import json

import numpy as np

from . import _core


def _plain(samples):
    """pandas' columns that may lack numbers (Int64, Float64) as float64; what lacks is NaN."""
    dtype = getattr(samples, "dtype", None)
    is_nullable = not isinstance(dtype, np.dtype) and getattr(dtype, "kind", "") in tuple("fiub")
    return samples.to_numpy(dtype=np.float64, na_value=np.nan) if is_nullable else samples


def as_float64(values, name: str = "the array") -> np.ndarray:
    """A copy of real numbers as float64. Raises TypeError at anything else, rather than guessing."""
    if np.ma.is_masked(values):
        raise TypeError(f"{name} has masked samples; leave them out or fill them in")
    array = np.asarray(_plain(values))
    if array.dtype.kind not in "fiub":
        right = "; seconds as numbers, as (t - t[0]) / np.timedelta64(1, 's')" if array.dtype.kind in "mM" else ""
        raise TypeError(f"{name} holds {array.dtype}, not real numbers{right}")
    return np.require(array, np.float64, "A") if array.dtype != np.float64 else np.array(array)


def as_json(options) -> str:
    """Options as the C boundary takes them; NumPy's numbers and arrays are numbers and lists.

    Raises Error at a number that is not finite, for which JSON has no word.
    """

    def plain(value):
        if isinstance(value, (np.generic, np.ndarray)):
            return value.tolist()
        raise TypeError(f"{value!r} is no option: a number, a text or a list of these")

    def text(value) -> str:
        return json.dumps(value, default=plain, allow_nan=False)

    for name, value in options.items():
        try:
            text(value)
        except ValueError:
            raise _core.Error(f"{name}: is {value}; finite numbers") from None
    return text(options)
