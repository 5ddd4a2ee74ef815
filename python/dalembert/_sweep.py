"""Sweeps: the same numbers of many problems."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._numbers import MaskedArray, Maybe, Names, objects
from ._problem import Problem, Scene


@dataclass(frozen=True)
class Sweep:
    """Numbers of many problems, in arrays of one shape.

    Parameters
    ----------
    values : dict of str to MaskedArray
        The values of each quantity; a number that there is not is masked.
    errors : dict of str to MaskedArray
        The bounds of their errors.
    notes : dict of tuple of int to str
        Reasons for masked numbers, and warnings, by the index of the point.
    """

    values: dict[str, MaskedArray]
    errors: dict[str, MaskedArray]
    notes: dict[tuple[int, ...], str]

    def __getitem__(self, quantity: str) -> MaskedArray:
        return self.values[quantity]

    def __repr__(self) -> str:
        shape = next((values.shape for values in self.values.values()), ())
        return f"<dalembert.Sweep: {', '.join(self.values)} of shape {shape}, notes on {len(self.notes)}>"


_PROFILES = ("displacement", "strain", "velocity")


def _points(name: str, values: Any) -> NDArray[np.object_]:
    """Return an array of lists of points, from one whose last two axes are the points."""
    try:
        found = objects(values)
    except ValueError:  # Profiles with different numbers of points.
        found = np.empty(len(values), dtype=object)
        found[:] = values
    if found.size and np.ndim(found.flat[0]) == 2:
        return found
    if found.ndim < 2 or found.shape[-1] != 2:
        expected = "points (x, value) in the last two axes, (..., n, 2)"
        raise TypeError(f"found {name} of shape {found.shape}, expected {expected}")
    profiles = np.empty(found.shape[:-2], dtype=object)
    for place in np.ndindex(*profiles.shape):
        profiles[place] = found[place].tolist()
    return profiles


def sweep(
    scene: Scene,
    quantities: Names,
    *,
    time: Maybe = None,
    accuracy: float | None = None,
    **varied: ArrayLike,
) -> Sweep:
    """Ask the same numbers of many problems, on all cores.

    Parameters
    ----------
    scene : str, path or Problem
        The values that the problems share, as :func:`solve` takes it.
    quantities : str or sequence of str
        Names of the command ``dalembert sweep``: ``bounce_time``, ``e_P``, ``e_E2``, quantities over time, ...
    time : number, optional
        Time of quantities over time; by default the end of the first contact.
    accuracy : float, optional
        As in :func:`solve`.
    **varied : array_like
        Values of :class:`Problem` by name, broadcast against each other. The points of a `displacement`, `strain` or
        `velocity` are the last two axes, of shape ``(..., n, 2)``; in a list each profile may have points of its own number.

    Returns
    -------
    Sweep
        Values and bounds, in arrays of the broadcast shape. No lock of the interpreter is held meanwhile.

    Raises
    ------
    ValueError
        For an unknown quantity.
    TypeError
        For an unknown value of a problem.

    Examples
    --------
    >>> found = sweep("paper-strong", ["bounce_time", "e_P"], impact_speed=[1, 2, 4], damping=[[0], ["0.1"]])
    >>> found["bounce_time"].shape
    (2, 3)
    >>> found["bounce_time"][0, 1:].tolist()
    [2.0, 2.0]
    """
    # As in solve, a float stands for the shortest decimal that spells it.
    given = {name: _points(name, values) if name in _PROFILES else objects(values) for name, values in varied.items()}
    shape = np.broadcast_shapes(*(values.shape for values in given.values()))
    columns = [(name, np.broadcast_to(values, shape).ravel().tolist()) for name, values in given.items()]
    names, found, texts = _core.sweep(Problem.from_scene(scene)._compiled, quantities, time, accuracy, columns)
    values, errors = ({name: np.ma.masked_invalid(column[k].reshape(shape)) for name, column in zip(names, found)}
                      for k in (0, 1))
    notes = {tuple(int(i) for i in np.unravel_index(k, shape)) if shape else (): note for k, note in texts}
    return Sweep(values, errors, notes)
