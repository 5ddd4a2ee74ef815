"""Types of numbers and arrays, conversions between them, and a base of frozen classes."""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction
from typing import Any, Literal, Sequence, Union

import numpy as np

Array = np.ndarray[Any, np.dtype[Any]]
MaskedArray = np.ma.MaskedArray[Any, np.dtype[Any]]
Number = Union[int, float, Fraction, Decimal, str]
Numbers = Union[Number, Sequence[Any], Array]
Names = Union[str, Sequence[str]]
Points = Union[Sequence["tuple[Number, Number]"], Array]
Maybe = Union[Number, None]
Side = Literal["left", "right"]


def objects(values: Any) -> Array:
    """Return the numbers as an array of objects; a float32 is the text of its shortest decimal, and a masked value NaN."""
    values = unmasked(values)
    array = np.asarray(values) if isinstance(values, (np.ndarray, np.generic)) else np.asarray(values, dtype=object)
    return (array.astype(str) if is_short(array) else array).astype(object)


def doubles(array: Array) -> Array:
    """Return an array of ints or floats as contiguous and aligned doubles; a float32 is the double of its shortest decimal."""
    return np.require(array.astype(str) if is_short(array) else array, np.float64, ["C", "A"])


def unmasked(values: Any) -> Any:
    """Return the values with NaN in place of those that are masked."""
    return np.ma.filled(values.astype(float), np.nan) if np.ma.is_masked(values) else values


def is_short(array: Array) -> bool:
    return array.dtype in (np.float16, np.float32)


class Frozen:
    """A base of classes whose attributes cannot be assigned."""

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(self._refusal(name))

    def __delattr__(self, name: str) -> None:
        raise AttributeError(self._refusal(name))

    def _refusal(self, name: str) -> str:
        return f"found an assignment to {name}, expected none: a {type(self).__name__} does not change"
