"""From a scene to its motion."""

from __future__ import annotations

from fractions import Fraction
from typing import Any, Sequence

import numpy as np

from ._history import History
from ._numbers import Maybe, Numbers, Side
from ._problem import Problem, Scene


def solve(
    scene: Scene,
    *,
    to: Maybe = None,
    impacts: int | None = None,
    digits: int | None = None,
    exact: bool = False,
    certified: bool = False,
    accuracy: float | None = None,
    first_contact: bool = False,
) -> History:
    """Solve a scene.

    Parameters
    ----------
    scene : str, path or Problem
        The name of a built-in scene, a scene file, a scene as TOML text, or a problem.
    to : number, optional
        Follow it up to this time, in place of what the scene says.
    impacts : int, optional
        Follow it through so many contacts, in place of what the scene says.
    digits : int, optional
        All numbers are ``Decimal`` of so many digits, rounded once.
    exact : bool, optional
        All numbers are ``Fraction``, as far as they reach; with `digits` it goes on in digits where they end.
    certified : bool, optional
        All numbers are pairs ``(lo, hi)`` of ``Decimal`` that are proved to enclose the value.
    accuracy : float, optional
        Without any of these all numbers are doubles with a bound of 1e-9 of the greatest number of an answer, or this.
    first_contact : bool, optional
        Whether to end at the bounce, which takes less time.

    Returns
    -------
    History
        The motion. No lock of the interpreter is held meanwhile, and Ctrl-C interrupts it.

    Raises
    ------
    ValueError
        For a scene that is none, with the text of the command.

    Examples
    --------
    >>> solve("doyen-ern-piperno", exact=True).contacts["release"][0]
    Fraction(2, 3)
    """
    run: dict[str, Any] = {name: value for name, value in (("time", to), ("impacts", impacts)) if value is not None}
    problem = Problem.from_scene(scene)
    return (problem.replace(**run) if run else problem).solve(
        digits=digits, exact=exact, certified=certified, accuracy=accuracy, first_contact=first_contact
    )


def reference(
    scene: Scene,
    times: Numbers,
    columns: Sequence[str] = ("t", "side", "u_end", "v_end", "strain", "force", "h", "h_rate", "E_total"),
    side: Side | None = None,
    *,
    digits: int | None = None,
    exact: bool = False,
    certified: bool = False,
    accuracy: float | None = None,
) -> Any:
    """Give columns of a scene at times.

    Parameters
    ----------
    scene : str, path or Problem
        As :func:`solve` takes it.
    times : number or array_like
        The times; the motion is followed up to the last.
    columns : sequence of str, optional
        Names of :meth:`History.columns`.
    side : {"left", "right"}, optional
        Which limit at a jump; without it a time has two rows where they differ.
    digits : int, optional
        As in :func:`solve`.
    exact, certified : bool, optional
        As in :func:`solve`.
    accuracy : float, optional
        As in :func:`solve`.

    Returns
    -------
    pandas.DataFrame or dict of str to ndarray
        A DataFrame where pandas is installed.

    Examples
    --------
    >>> list(reference("paper-strong", [0.5, 2], ["t", "strain"])["strain"])
    [-3.5, -5.0, 0.0]
    """
    # By way of text: 0.7 is 7/10 here too, where Fraction(0.7) is a little less, and the last time would be beyond it.
    given = np.asarray(times)
    given = given.astype(float if given.dtype.kind == "f" else object)
    last = max(Fraction(str(time)) for time in given.ravel().tolist())
    history = solve(
        scene, to=last if last > 0 else None, digits=digits, exact=exact, certified=certified, accuracy=accuracy
    )
    table = history.columns(columns, times, side)
    try:
        from pandas import DataFrame
    except ImportError:
        return table
    return DataFrame(table)
