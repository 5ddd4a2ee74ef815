"""Solutions of scenes, and their values at times."""

from __future__ import annotations

import os
import pathlib
import tempfile
from fractions import Fraction
from typing import Any

from . import _core
from ._chain import Chain, ChainHistory
from ._history import History
from ._numbers import Maybe, Names, Numbers, Side, objects
from ._problem import Problem, Scene, _text

#: Columns of a reference of a rod.
_COLUMNS = ("t", "side", "u_end", "v_end", "strain", "force", "h", "h_rate", "E_total")


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
        Last time, in place of that of the scene.
    impacts : int, optional
        Number of contacts, in place of that of the scene.
    digits : int, optional
        Number of digits: all numbers are ``Decimal``, rounded once.
    exact : bool, optional
        Whether all numbers are ``Fraction``, as far as they reach; with `digits`, in digits from there on.
    certified : bool, optional
        Whether all numbers are pairs ``(lo, hi)`` of ``Decimal`` that are proved to enclose the value.
    accuracy : float, optional
        Bound of the error of doubles, relative to the greatest number of an answer; by default 1e-9.
    first_contact : bool, optional
        Whether to end at the bounce, which takes less time.

    Returns
    -------
    History
        The motion. No lock of the interpreter is held meanwhile, and Ctrl-C interrupts it.

    Raises
    ------
    ValueError
        For an invalid scene, with the text of the command.

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
    scene: Scene | Chain,
    t: Numbers,
    names: Names | None = None,
    side: Side | None = None,
    *,
    digits: int | None = None,
    exact: bool = False,
    certified: bool = False,
    accuracy: float | None = None,
) -> Any:
    """Return quantities of a scene at times.

    Parameters
    ----------
    scene : str, path, Problem or Chain
        As :func:`solve` takes it, or a chain of bodies.
    t : number or array_like
        Times; the motion is followed up to the last.
    names : str or sequence of str, optional
        As in :meth:`History.columns` and :meth:`ChainHistory.columns`; by default those of the end, the centre and the
        energy, and of a chain all.
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
        A DataFrame where pandas is installed, with the ``units`` and ``meanings`` of its columns in its ``attrs``.

    See Also
    --------
    write_reference : The same as a golden file.

    Examples
    --------
    >>> list(reference("paper-strong", [0.5, 2], ["t", "strain"])["strain"])
    [-3.5, -5.0, 0.0]
    """
    # As texts: 0.7 is 7/10, and Fraction(0.7) is a little less, so that the last time would be beyond it.
    last = max(map(_time, objects(t).ravel().tolist()), default=Fraction(0))
    to = last if last > 0 else None
    chain = _whole_chain(scene)
    history: History | ChainHistory
    if chain is None:
        assert not isinstance(scene, Chain)
        history = solve(scene, to=to, digits=digits, exact=exact, certified=certified, accuracy=accuracy)
        columns = history.columns(t, _COLUMNS if names is None else names, side)
    else:
        history = chain.solve(to=to, digits=digits, exact=exact, certified=certified, accuracy=accuracy)
        columns = history.columns(t, ["t", "side", *list(chain.quantities)[1:]] if names is None else names, side)
    try:
        from pandas import DataFrame
    except ImportError:
        return columns
    frame = DataFrame(columns)
    frame.attrs = history._attributes("time")
    return frame


def write_reference(
    path: str | os.PathLike[str],
    scene: Scene | Chain,
    t: Numbers | None = None,
    names: Names | None = None,
    side: Side | None = None,
    *,
    x: Numbers | None = None,
    digits: int | None = None,
    exact: bool = False,
    certified: bool = False,
    accuracy: float | None = None,
) -> None:
    """Write a golden file of a scene: the text of ``dalembert reference``, with its header.

    Parameters
    ----------
    path : str or path
        The file; its ending says the format: ``.csv``, ``.json`` or ``.npz``.
    scene : str, path, Problem or Chain
        As :func:`reference` takes it; a chain with the values of its scene file.
    t : number or array_like, optional
        Times; by default the start, every impact and release, and the end.
    names : str or sequence of str, optional
        As in :meth:`History.columns`; by default all.
    side : {"left", "right"}, optional
        Which limit at a jump; without it a time has two rows where they differ.
    x : number or array_like, optional
        Points along the rod: the file has the field there in place of the columns.
    digits : int, optional
        As in :func:`solve`.
    exact, certified : bool, optional
        As in :func:`solve`.
    accuracy : float, optional
        As in :func:`solve`.

    Raises
    ------
    ValueError
        With the text of the command.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> file = pathlib.Path(tempfile.mkdtemp(), "golden.csv")
    >>> write_reference(file, "paper-strong", [0.5, 2], ["t", "strain"])
    >>> file.read_text().splitlines()[-4:]
    ['t,strain', '0.5,-3.5', '2.0,-5.0', '2.0,0.0']
    """
    options = {"points": x, "quantity": names, "side": side, "digits": digits, "accuracy": accuracy}
    listed = {
        f"--{name}": ",".join(map(str, objects(value).ravel().tolist()))
        for name, value in options.items() if value is not None
    }  # fmt: skip
    flags = [flag for flag, is_set in (("--exact", exact), ("--certified", certified)) if is_set]
    if (chain := _whole_chain(scene)) is not None:
        text = chain._scene_text()
    else:
        assert not isinstance(scene, Chain)
        problem = Problem.from_scene(scene)
        text = problem.to_toml()
        if problem._chain is not None:
            listed["--body"] = str(problem._chain[1] + 1)
    with tempfile.TemporaryDirectory() as folder:
        files = {"scene": text}
        if t is not None:
            files["t"] = "".join(f"{time}\n" for time in objects(t).ravel().tolist())
            listed["--times-from"] = os.path.join(folder, "t")
        for name, text in files.items():
            pathlib.Path(folder, name).write_text(text, encoding="utf-8")
        arguments = [f"{option}={value}" for option, value in listed.items()] + flags
        try:
            _core.run_command(
                ["reference", os.path.join(folder, "scene"), "-o", os.path.abspath(path), "--quiet", *arguments]
            )
        except ValueError as error:
            text = str(error).removeprefix("error: ").split("\n\nFor more information")[0]
            raise ValueError(text.replace(folder + os.sep, "").strip()) from None


def _time(time: Any) -> Fraction:
    try:
        return Fraction(str(time))
    except ValueError:
        raise ValueError(f"found time {time}, expected a finite number") from None


def _whole_chain(scene: Scene | Chain) -> Chain | None:
    """Return the chain of a scene with several bodies; None for a rod."""
    if isinstance(scene, Chain):
        return scene
    return None if isinstance(scene, Problem) or len(_core.bars(_text(scene))) < 2 else Chain(scene)
