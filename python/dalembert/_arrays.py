"""Arrays of the numbers that the compiled part returns."""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction
from typing import Any, Callable, Iterable, Literal, Mapping

import numpy as np

from . import _core
from ._answers import Derivatives
from ._numbers import Array, Frozen, MaskedArray, Numbers, Side, doubles, objects, unmasked


def _exact(text: str) -> Fraction | Decimal:
    """Read a fraction, or a number in digits that stands in for one."""
    if "." in text or "e" in text:
        return Decimal(text)
    # int() refuses texts of more than 4300 digits, and Decimal does not.
    return Fraction(*(int(Decimal(whole)) for whole in text.split("/")))


READ: dict[str, Callable[[Any], Any]] = {
    "double": float,
    "exact": _exact,
    "digits": Decimal,
    "certified": lambda ends: tuple(map(Decimal, ends)),
}

_SIDES = np.array(["left", "both", "right"])


def one_side(side: Side) -> Side:
    """Return a side, which ``None`` is not: a single value is the limit from one of them."""
    if side is None:
        raise ValueError("found side = None, expected left or right")
    return side


class Answers(Frozen):
    """A base of histories: arrays of their numbers, in their number system."""

    numbers: Literal["double", "exact", "digits", "certified"]

    def _places(self, values: Numbers) -> Any:
        """Return times or points in one row: doubles for a history in doubles, otherwise a list of numbers."""
        values = unmasked(values)
        array = np.asarray(values)
        if self.numbers == "double" and array.dtype.kind in "fiu":
            return doubles(array.ravel())
        return objects(values).ravel().tolist()

    def _structured(
        self, columns: list[_core.Listed], key: Literal["values", "bounds"], others: Mapping[str, Array] = {}
    ) -> MaskedArray:
        """Return a structured array of columns, which cannot be written to."""
        values = {column["name"]: self._array(column["name"], column[key]) for column in columns} | dict(others)
        rows = len(next(iter(values.values())))
        data = np.empty(rows, [(name, column.dtype) for name, column in values.items()])
        mask = np.zeros(rows, [(name, bool) for name in values])
        for name, column in values.items():
            data[name] = column
        for listed in columns:
            mask[listed["name"]][[row for row, _ in listed["missing"]]] = True
        table = np.ma.MaskedArray(data, mask)
        table.flags.writeable = np.ma.getmask(table).flags.writeable = False
        return table

    def _array(self, name: str, raw: Any) -> Array:
        """Return a column of the compiled part as an array."""
        if name == "side":
            raw = _SIDES[raw.astype(int) + 1]
        elif not isinstance(raw, np.ndarray):
            read = READ[self.numbers]
            raw = np.fromiter((None if value is None else read(value) for value in raw), dtype=object)
        return np.asarray(raw)

    def _derivatives(self, sides: list[list[_core.Listed]]) -> Derivatives:
        left, right = (self._structured(side, "values") for side in sides)
        left_error, right_error = (self._structured(side, "bounds") for side in sides)
        reasons = {
            (name, row, column["name"]): why
            for name, side in zip(("left", "right"), sides) for column in side for row, why in column["missing"]
        }  # fmt: skip
        return Derivatives(left, right, left_error, right_error, reasons)


def shaped(columns: Iterable[Array], shape: tuple[int, ...]) -> list[Any]:
    """Return columns in the shape of their times; a single number for a single time."""
    return [column.reshape(shape) if shape else column[0] for column in columns]


def short(value: Any) -> str:
    """Return a number in a line: six digits of a double, the first of a long one, a dash for none."""
    if isinstance(value, tuple):
        return f"{short(value[0])} … {short(value[1])}"
    if isinstance(value, (float, np.floating)):
        return f"{value:.6g}"
    text = "–" if value is None or value is np.ma.masked else str(value)
    return text if len(text) <= 24 else text[:22] + "…"
