"""Comparisons of other data with the exact history."""

from __future__ import annotations

import json
import os
from numbers import Real
from typing import Any, Literal, Mapping, Sequence

import numpy as np

from . import _core
from ._numbers import Array, Maybe, Names, Number, Numbers, unmasked
from ._problem import Problem, Scene

Limits = Mapping[str, "float | Mapping[str, float]"]


def _bounds(limits: Limits) -> list[str]:
    """Return the limits as texts, such as ``u.l2=0.1``."""
    expected = 'a mapping such as {"u": {"l2": 0.1}}'
    if not isinstance(limits, Mapping):
        raise TypeError(f"found limits = {limits!r}, of type {type(limits).__name__}, expected {expected}")
    bounds: list[tuple[str, Any]] = []
    for name, limit in limits.items():
        norms = limit.items() if isinstance(limit, Mapping) else [("", limit)]
        bounds += [(f"{name}.{norm}" if norm else name, bound) for norm, bound in norms]
    for name, bound in bounds:
        if not isinstance(bound, Real):
            raise TypeError(f"found the limit {name} = {bound!r}, of type {type(bound).__name__}, expected a number")
    return [f"{name}={float(bound)!r}" for name, bound in bounds]


class Comparison:
    """Data beside the exact history, as ``dalembert compare`` reports them.

    Attributes
    ----------
    report : dict
        The whole report, as ``dalembert compare --format json`` gives it.
    files : list
        One entry for each source, with the attributes from `norms` to `step`. With several sources these are there
        only.
    orders : list of dict
        Orders of convergence of several sources.
    norms : dict
        By quantity, as ``norms["u_end"]["l2"]["relative"]``.
    contacts : list of dict
        Each with "ours" and "theirs", or None.
    audit, hints : dict, list
        Laws that the data violate, and likely mistakes.
    t, x : ndarray
        Times of the data and, for a field, the points.
    ours, theirs, difference : dict of str to ndarray
        Values of each quantity there.
    step : float
        Median step of the data.
    warnings : list of str
        Warnings that come with the history.

    Notes
    -----
    A comparison is pickled with its results and with the arrays or the paths that it was given. Where it is read, only
    limits need these, for which the data are compared again.
    """

    report: dict[str, Any]
    orders: list[dict[str, Any]]
    warnings: list[str]

    def __init__(
        self, inputs: tuple[Problem, list[_core.Data], dict[str, Any]], results: _core.Report | None = None
    ) -> None:
        self._inputs, self._compiled = inputs, None if results else _compiled(inputs)
        self._results = results or _compiled(inputs, self._compiled).report()
        self._table, self.warnings = self._results["table"], self._results["warnings"]
        self.report = json.loads(self._results["json"])
        self.orders = self.report.get("orders", [])
        reports = self.report.get("files", [self.report])
        self.files = [_ComparedFile(*source) for source in zip(reports, self._results["samples"])]

    def __reduce__(self) -> tuple[Any, ...]:
        return Comparison, (self._inputs, self._results)

    def _failures(self, above: Limits, below: Limits) -> list[str]:
        texts = _bounds(above), _bounds(below)
        self._compiled = _compiled(self._inputs, self._compiled)
        return self._compiled.failures(*texts)

    def fails_above(self, limits: Limits) -> list[str]:
        """Return a line for each norm above its limit.

        Parameters
        ----------
        limits : mapping
            Limits for each quantity of ``l1``, ``l2``, ``linf``, ``linf_off_jumps``, relative to ours, or absolute
            where ours is zero; or a limit of ``energy``, ``impulse`` (relative), ``momentum``, ``penetration``,
            ``tension``, ``missed`` or ``invented``. With several sources the limits hold for each. Data that end before
            the run of the scene, or before ``to``, fail any limit.

        Returns
        -------
        list of str
            A line for each that is above its limit.

        Raises
        ------
        ValueError
            For a quantity that the data do not have, or an unknown norm.

        Examples
        --------
        >>> c = compare(Problem(length=1, wave_speed=1, impact_speed=1), [0, 2, 4], [0, 0, 2.5], quantity="u")
        >>> c.fails_above({"u": {"l2": 0.3, "linf": 0.1}})
        ['dict: expected u.linf ≤ 1e-1, found 2.500e-1']
        """
        return self._failures(limits, {})

    def assert_above(self, limits: Limits) -> None:
        """Require that no number is below its limit, such as ``{"coverage": 0.99, "order.u": 0.9}``.

        Parameters
        ----------
        limits : mapping
            Limits of ``coverage``, and of ``order.u`` and the like of several sources.

        Raises
        ------
        AssertionError
            With a line for each that is below.
        """
        if failures := self._failures({}, limits):
            raise AssertionError("\n".join(failures))

    def assert_below(self, limits: Limits) -> None:
        """Require that no norm is above its limit: one line for a test.

        Parameters
        ----------
        limits : mapping
            As :meth:`fails_above` takes them.

        Raises
        ------
        AssertionError
            With the lines of :meth:`fails_above`, where there are any.

        Examples
        --------
        >>> compare("paper-strong", reference("paper-strong", [0, 1, 2, 3])).assert_below({"u": {"linf": 1e-12}})
        """
        failures = self.fails_above(limits)
        if failures:
            raise AssertionError("\n".join(failures))

    def table(self) -> str:
        """Return the text that the command prints.

        Returns
        -------
        str
            Norms, contacts, audit and hints.
        """
        return self._table

    __repr__ = table

    def __dir__(self) -> list[str]:
        own = [name for name in super().__dir__() if not name.startswith("_") or name.startswith("__")]
        return own + (list(vars(self.files[0])) if len(self.files) == 1 else [])

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or len(self.files) > 1:
            raise AttributeError(f"found the attribute {name} of several sources, expected it of one of files")
        return getattr(self.files[0], name)


def _compiled(
    inputs: tuple[Problem, list[_core.Data], dict[str, Any]], compiled: _core.Comparison | None = None
) -> _core.Comparison:
    problem, sources, options = inputs
    return compiled or _core.Comparison(problem._compiled, sources, options)


class _ComparedFile:
    """One source of a :class:`Comparison`."""

    def __init__(self, report: dict[str, Any], columns: Sequence[tuple[str, Array]]) -> None:
        arrays = dict(columns)
        self.file, self.step, self.window, self.outside = (report[k] for k in ("file", "step", "window", "outside"))
        self.contacts, self.audit, self.hints = report["contacts"], report["audit"], report["hints"]
        self.coverage, self.fit = report["coverage"], report["fit"]
        self.norms = {norms["name"]: norms for norms in report["quantities"]}
        self.t, self.x = arrays["t"], arrays.get("x")
        self.ours = {name: arrays[f"{name}_ours"] for name in self.norms}
        self.theirs = {name: arrays[f"{name}_theirs"] for name in self.norms}
        self.difference = {name: self.theirs[name] - self.ours[name] for name in self.norms}


def compare(
    scene: Scene,
    data: Any,
    values: Any = None,
    *,
    quantity: str | None = None, x: Numbers | None = None,
    map: str | None = None, dt: Maybe = None, t0: Maybe = None, shift: Maybe = None,
    compression: Literal["+", "-", None] = None, u_origin: Literal["ground", "start"] = "ground",
    axis: Literal["up", "down"] = "up", energy_scale: Number = 1,
    window: Maybe = None, widths: Sequence[Number] = (), to: Maybe = None, fit: Names = (),
) -> Comparison:
    """Compare data with the exact history of a scene, as ``dalembert compare`` does.

    Parameters
    ----------
    scene : str, path or Problem
        As :func:`solve` takes it.
    data : array_like, mapping, DataFrame, str or path, or a list of these
        Times; or, without `values`, a DataFrame, a dict or a structured array with a column ``t``, a file, or a folder
        with a ``.npy`` for each quantity. A unit in a name, ``force [kN]``, is brought to that of the scene. A list
        gives the order of convergence.
    values : array_like, mapping or DataFrame, optional
        Values of a `quantity` at the times, or of several by name. With `x`, values of shape ``(len(t), len(x))`` are
        those of a field.
    quantity : str, optional
        Name of single values, as in :meth:`History.columns`; ``u`` and ``v`` for short.
    x : array_like, optional
        Points along the rod.
    map : str, optional
        Column of each quantity, as ``"t=0,u=1"``.
    dt, t0 : number, optional
        Step and first time of data without a column of times.
    shift : number, optional
        Number added to the times of the data.
    compression : {"+", "-"}, optional
        Sign of compression in the data.
    u_origin : {"ground", "start"}, optional
        Place of the lower end where displacements are zero.
    axis : {"up", "down"}, optional
        Direction of the data's axis.
    energy_scale : number, optional
        Factor of the energies of the data.
    window : number, optional
        Distance from a jump, in round trips, within which ``linf_off_jumps`` leaves out samples.
    widths : sequence of number, optional
        Mesh widths of several sources, for the orders of convergence.
    to : number, optional
        Expected last time of the data; by default that of the scene.
    fit : str or sequence of str, optional
        Values of the scene to fit to the data: ``"length"``, ``"damping"`` and others of the command.

    Returns
    -------
    Comparison
        Norms, contacts, an audit and hints.

    Raises
    ------
    ValueError
        For data that cannot be compared, with the text of the command.

    Notes
    -----
    Two rows at one time are the limits at a jump.

    Examples
    --------
    >>> t = [0, 1, 2, 3, 4]     # one contact of two time units, and v = t - 2 after it
    >>> c = compare(Problem(length=1, wave_speed=1, impact_speed=1), t, [0, 0, 0, 1, 2.25], quantity="u_end")
    >>> c.difference["u_end"].tolist(), c.norms["u_end"]["linf"]["t"]
    ([0.0, 0.0, 0.0, 0.0, 0.25], 4.0)
    """
    options = {name: value for name, value in locals().items() if value is not None}
    for name in ("scene", "data", "values", "quantity", "x"):
        options.pop(name, None)
    if values is not None:
        if not hasattr(values, "keys"):
            if quantity is None:
                raise TypeError("found values without a quantity, expected quantity='u_end' or another column's name")
            values = {quantity: values}
        data = {"t": data} if x is None else {"t": data, "x": x}
        values = {name: np.asarray(unmasked(values[name])) for name in values.keys()}
        if x is not None and any(column.ndim == 2 for column in values.values()):
            shape = tuple(np.size(places) for places in data.values())
            for name, column in values.items():
                if column.shape != shape:
                    raise ValueError(f"found {name} of shape {column.shape}, expected {shape}, times by points")
            data = dict(zip("tx", np.meshgrid(*data.values(), indexing="ij")))
            data, values = ({name: np.ravel(array) for name, array in part.items()} for part in (data, values))
        data = data | values
    sources = data if isinstance(data, list) else [data]
    return Comparison((Problem.from_scene(scene), [_source(source) for source in sources], options))


def _source(data: Any) -> _core.Data:
    """Return a path as it is, and columns under the name of their file or type."""
    called = type(data).__name__
    if isinstance(data, (str, os.PathLike)):
        called = os.fspath(data)
        if not (os.path.isfile(called) and _is_numpy(called)):
            return {"name": called, "columns": [], "arrays": None}
        try:
            data = np.load(called)
        except Exception as error:  # A broken file raises one of many types.
            raise ValueError(f"{called}: cannot be read: {error}") from None
    names = getattr(getattr(data, "dtype", None), "names", None) or (data.keys() if hasattr(data, "keys") else None)
    if names is None:
        array = np.asarray(data)
        names, columns = [], list(array.T) if array.ndim == 2 else [array]
    else:
        columns = [data[name] for name in names]
    arrays = [_doubles(column) for column in columns]
    return {"name": called, "columns": [str(name) for name in names], "arrays": arrays}


def _is_numpy(path: str) -> bool:
    with open(path, "rb") as file:
        return file.read(4) in (b"\x93NUM", b"PK\x03\x04")


def _doubles(column: Any) -> Array:
    """Return the column as aligned doubles, or as it is if it has none."""
    array, sides = np.asarray(unmasked(column)), {"left": -1, "both": 0, "right": 1}
    try:
        if array.dtype.kind in "OU":
            return np.array([sides.get(value, value) for value in array.tolist()], dtype=float)
        # An array that another process sent may begin at any byte.
        return np.require(array, float, "A") if array.dtype.kind in "biuf" else array
    except (TypeError, ValueError):
        return array
