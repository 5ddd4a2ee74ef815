"""The same numbers of many problems."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._numbers import Maybe
from ._problem import Problem, Scene


@dataclass(frozen=True)
class Sweep:
    """Numbers of many problems, in arrays of one shape.

    Parameters
    ----------
    values : dict of str to ndarray
        Each quantity; NaN where there is none.
    errors : dict of str to ndarray
        How far each value may be off.
    notes : dict of tuple of int to str
        Why a point has no number, or what one should know of it, by its index.
    """

    values: dict[str, NDArray[np.float64]]
    errors: dict[str, NDArray[np.float64]]
    notes: dict[tuple[int, ...], str]

    def __getitem__(self, quantity: str) -> NDArray[np.float64]:
        return self.values[quantity]

    def __repr__(self) -> str:
        shape = next(iter(self.values.values())).shape
        return f"<dalembert.Sweep: {', '.join(self.values)} of shape {shape}, notes on {len(self.notes)}>"


_PROFILES = ("displacement", "velocity")


def _points(name: str, values: Any) -> NDArray[np.object_]:
    """One list of points in each place of an array, whose last two axes are the points."""
    try:
        found = np.asarray(values, dtype=object)
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
    quantities: str | Sequence[str],
    *,
    time: Maybe = None,
    accuracy: float | None = None,
    **varied: ArrayLike,
) -> Sweep:
    """Ask the same numbers of many problems, on all cores.

    Parameters
    ----------
    scene : str, path or Problem
        What all of them have in common, as :func:`solve` takes it.
    quantities : str or sequence of str
        Names as the command ``dalembert sweep`` knows them: ``bounce_time``, ``e_P``, ``e_E2``, columns, ...
    time : number, optional
        When quantities over time are taken; without it at the end of the first contact.
    accuracy : float, optional
        As in :func:`solve`.
    **varied : array_like
        Values of :class:`Problem` by name, broadcast against each other. The points of a `displacement` or `velocity`
        are the last two axes, of shape ``(..., n, 2)``; in a list each profile may have points of its own number.

    Returns
    -------
    Sweep
        Values and bounds, in arrays of the broadcast shape. No lock of the interpreter is held meanwhile.

    Raises
    ------
    ValueError
        For a quantity that is none.
    TypeError
        For a value that a problem does not have.

    Examples
    --------
    >>> found = sweep("paper-strong", ["bounce_time", "e_P"], impact_speed=[1, 2, 4], damping=[[0], ["0.1"]])
    >>> found["bounce_time"].shape
    (2, 3)
    >>> found["bounce_time"][0, 1:]
    array([2., 2.])
    """
    names = [quantities] if isinstance(quantities, str) else list(quantities)
    # As in solve: a float stands for the shortest decimal that spells it, and all else for what it says.
    given = {name: _points(name, values) if name in _PROFILES else np.asarray(values, dtype=object)
             for name, values in varied.items()}
    shape = np.broadcast_shapes(*(values.shape for values in given.values()))
    columns = [(name, np.broadcast_to(values, shape).ravel().tolist()) for name, values in given.items()]
    found, said = _core.sweep(Problem.from_scene(scene)._core, names, time, accuracy, columns)
    values = {name: value.reshape(shape) for name, (value, _) in zip(names, found)}
    errors = {name: bound.reshape(shape) for name, (_, bound) in zip(names, found)}
    notes = {tuple(int(i) for i in np.unravel_index(k, shape)) if shape else (): note for k, note in said}
    return Sweep(values, errors, notes)
