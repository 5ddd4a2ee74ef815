"""The exact reference for the bouncing elastic rod, ``v_tt + 2r v_t - c² v_xx = -g`` on ``0 < x < L`` with
unilateral contact at ``x = 0``.

>>> import dalembert
>>> m = dalembert.solve("getfem-dynamic-contact", to=12)
>>> m.strain([0.5, 1.5])
array([ 0. , -0.5])

Numbers are given as int, float, ``fractions.Fraction``, ``decimal.Decimal`` or str. A float stands for the shortest
decimal that spells it: 0.1 is 1/10. All units are those of the input.
"""

from __future__ import annotations

import json
import os
from collections import namedtuple
from decimal import Decimal
from fractions import Fraction
from functools import cached_property
from importlib.metadata import version as _version
from typing import Any, Iterable, Literal, Mapping, Sequence, Union

import numpy as np

from . import _core

__all__ = ["Comparison", "Energy", "Field", "History", "Motion", "Problem", "compare", "reference", "scenes", "solve"]
__version__ = _version("dalembert")

Number = Union[int, float, Fraction, Decimal, str]
Numbers = Union[Number, Sequence[Any], np.ndarray]
Points = Union[Sequence["tuple[Number, Number]"], np.ndarray]
Side = Literal["left", "right"]
Maybe = Union[Number, None]
Scene = Union[str, "os.PathLike[str]", "Problem"]

Motion = namedtuple("Motion", "displacement velocity")
Motion.__doc__ = "A displacement and its rate, ``v`` and ``v_t``."
Energy = namedtuple("Energy", "total translational vibrational")
Energy.__doc__ = "``E = E_h + E_z``: in all, of the centre of mass, of the vibration."
Field = namedtuple("Field", "displacement velocity strain")
Field.__doc__ = "``v``, ``v_t`` and ``v_x``."


_SCENES = {name: (summary, text) for name, summary, text in _core.scenes()}


def scenes() -> dict[str, str]:
    """Names and summaries of the built-in scenes."""
    return {name: summary for name, (summary, _) in _SCENES.items()}


class Problem:
    """A rod, the ground and the start, in exact numbers, checked.

    ``length`` and ``wave_speed`` (or ``modulus``, ``density`` and ``area``) are the rod; ``damping`` is the ``r`` of
    the equation, ``top`` is "free" or "fixed"; the start is an ``impact_speed`` (with a ``gap`` or without), a
    ``drop_height``, or ``displacement`` and ``velocity`` as points ``(x, value)``. It is followed up to ``time``, or
    through a number of ``impacts``; without either, through the first contact and the flight after it.

    >>> rod = Problem(length=1, wave_speed=1, gravity=1, impact_speed=3)
    >>> rod.round_trip, rod.speed_ratio
    (2.0, 1.5)
    >>> rod.solve(exact=True).strain("1/3")
    Fraction(-10, 3)

    A value that is missing or wrong is a ValueError, one of the wrong type a TypeError.
    """

    def __init__(
        self,
        *,
        length: Number, wave_speed: Maybe = None, modulus: Maybe = None, density: Maybe = None, area: Maybe = None,
        damping: Maybe = None, gravity: Maybe = None, top: Literal["free", "fixed", None] = None,
        impact_speed: Maybe = None, gap: Maybe = None, drop_height: Maybe = None,
        displacement: Points | None = None, velocity: Points | None = None,
        time: Maybe = None, impacts: int | None = None,
    ) -> None:
        self._make({name: value for name, value in locals().items() if name != "self" and value is not None})

    def _make(self, *made: Any) -> Problem:
        """From values by name or the text of a scene, and values that replace others, in order."""
        self._core, self._made = _core.Problem(*made), made
        #: ``c``; ``t₁ = 2L/c``; ``R = r t₁``; ``M = μ/(g t₁)``, infinite without gravity and None without ``μ``.
        self.wave_speed, self.round_trip, self.damping_ratio, self.speed_ratio = self._core.parameters()
        return self

    @classmethod
    def from_scene(cls, scene: Scene) -> Problem:
        """The problem of a built-in scene, of a scene file, or of a scene as TOML text; a problem is its own."""
        return scene if isinstance(scene, Problem) else _problem(_text(scene))

    def replace(self, **values: Any) -> Problem:
        """The same problem with other values: a ``time`` takes the place of ``impacts``, a profile that of an impact.

        >>> Problem(length=1, wave_speed=1, impact_speed=3).replace(damping="0.1").damping_ratio
        0.2
        """
        return _problem(*self._made, values)

    def __reduce__(self) -> tuple[Any, ...]:
        return _problem, self._made

    def solve(
        self,
        *,
        digits: int | None = None,
        exact: bool = False,
        certified: bool = False,
        accuracy: float | None = None,
        first_contact: bool = False,
    ) -> History:
        """The motion, as :func:`solve` gives it; ``first_contact`` ends it at the bounce, which takes less time."""
        return History(self._core.solve(digits, exact, certified, accuracy, first_contact), self)


def _problem(*made: Any) -> Problem:
    return Problem.__new__(Problem)._make(*made)


def _text(scene: str | os.PathLike[str]) -> str:
    if isinstance(scene, str):
        if "\n" in scene or "=" in scene:
            return scene
        if scene in _SCENES and not os.path.isfile(scene):
            return _SCENES[scene][1]
        if not os.path.exists(scene):
            expected = "a scene file, or a name that `dalembert.scenes()` lists"
            raise ValueError(f"found no file and no built-in scene called `{scene}`, expected {expected}")
    elif not isinstance(scene, os.PathLike):
        kind = type(scene).__name__
        raise TypeError(f"found a scene of type {kind}, expected a name, a path, TOML text or a Problem")
    with open(scene, encoding="utf-8") as file:
        return file.read()


def solve(scene: Scene, *, to: Maybe = None, impacts: int | None = None, **numbers: Any) -> History:
    """The motion of a built-in scene, a scene file, a scene as TOML text, or a :class:`Problem`.

    It is followed up to the time ``to`` or through so many ``impacts``, in place of what the scene says.

    Without an option of ``numbers`` all values are doubles with a bound of 1e-9 of the greatest number of an answer, or
    ``accuracy``; ``digits=50`` gives ``Decimal`` of 50 digits, rounded once; ``exact=True`` gives ``Fraction``;
    ``certified=True`` gives pairs ``(lo, hi)`` of ``Decimal`` that are proved to enclose the value.
    ``exact=True, digits=50`` goes on in digits where fractions end.

    No lock of the interpreter is held meanwhile, and Ctrl-C interrupts it.

    >>> solve("doyen-ern-piperno", exact=True).contacts["to"][0]
    Fraction(2, 3)
    """
    run = {name: value for name, value in (("time", to), ("impacts", impacts)) if value is not None}
    problem = Problem.from_scene(scene)
    return (problem.replace(**run) if run else problem).solve(**numbers)


def reference(
    scene: Scene,
    times: Numbers,
    columns: Sequence[str] = ("t", "side", "u_end", "v_end", "strain", "force", "h", "h_rate", "E_total"),
    side: Side | None = None,
    **numbers: Any,
) -> Any:
    """Columns at ``times`` by the names of :meth:`History.columns`, as a DataFrame where pandas is there, and as a
    dict of arrays elsewhere; ``numbers`` are the options of :func:`solve`.

    >>> list(reference("paper-strong", [0.5, 2], ["t", "strain"])["strain"])
    [-3.5, -5.0, 0.0]
    """
    # By way of text: 0.7 is 7/10 here too, where Fraction(0.7) is a little less, and the last time would be beyond it.
    given = np.asarray(times)
    given = given.astype(float if given.dtype.kind == "f" else object)
    last = max(Fraction(str(time)) for time in given.ravel().tolist())
    history = solve(scene, to=last if last > 0 else None, **numbers)
    table = history.columns(columns, times, side)
    try:
        from pandas import DataFrame
    except ImportError:
        return table
    return DataFrame(table)


class Comparison:
    """Data beside the exact history: what ``dalembert compare`` reports. With several sources what follows is that of
    each of :attr:`files`, and :attr:`orders` are those of convergence.

    ``norms`` of each quantity by name, as ``norms["u_end"]["l2"]["relative"]``; ``contacts``, each with "ours" and
    "theirs" (or None); ``audit``; ``hints``; the median ``step``; and at the times ``t``, and points ``x`` of a field,
    ``ours``, ``theirs`` and ``difference``, arrays by name. ``warnings`` are what a user should know of the history.
    """

    def __init__(self, core: _core.Comparison) -> None:
        self._core = core
        report, self._table, self.warnings, columns = core.report()
        #: Everything, as ``--format json`` gives it.
        self.report: dict[str, Any] = json.loads(report)
        self.orders: list[dict[str, Any]] = self.report.get("orders", [])
        self.files = [_Compared(*source) for source in zip(self.report.get("files", [self.report]), columns)]

    def fails_above(self, limits: Mapping[str, Mapping[str, float]]) -> list[str]:
        """The norms above ``limits``, as ``--fail-above`` reports them, a line each; an empty list where none is.

        Limits are those of the norms ``l1``, ``l2``, ``linf``, ``linf_off_jumps`` of each quantity, relative to ours,
        or absolute where ours is zero. With several sources all of them have to keep within.

        >>> c = compare(Problem(length=1, wave_speed=1, impact_speed=1), [0, 2, 4], [0, 0, 2.5], quantity="u")
        >>> c.fails_above({"u": {"l2": 0.3, "linf": 0.1}})
        ['dict: expected u.linf ≤ 1e-1, found 2.500e-1']

        A quantity that the data do not have, or a norm of another name, is a ValueError.
        """
        given = ((name, norm, bound) for name, norms in limits.items() for norm, bound in norms.items())
        return self._core.above([f"{name}.{norm}={float(bound)!r}" for name, norm, bound in given])

    def assert_below(self, limits: Mapping[str, Mapping[str, float]]) -> None:
        """Raises an AssertionError with the lines of :meth:`fails_above` where there are any: one line for a test.

        >>> compare("paper-strong", reference("paper-strong", [0, 1, 2, 3])).assert_below({"u": {"linf": 1e-12}})
        """
        failures = self.fails_above(limits)
        if failures:
            raise AssertionError("\n".join(failures))

    def table(self) -> str:
        """The text that the command prints."""
        return self._table

    __repr__ = table

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or len(self.files) > 1:
            raise AttributeError(f"found {name}, expected it of one of files")
        return getattr(self.files[0], name)


class _Compared:
    """One source of a :class:`Comparison`."""

    def __init__(self, report: dict[str, Any], columns: list[tuple[str, np.ndarray]]) -> None:
        arrays = dict(columns)
        self.file, self.step, self.window, self.outside = (report[k] for k in ("file", "step", "window", "outside"))
        self.contacts, self.audit, self.hints = report["contacts"], report["audit"], report["hints"]
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
    window: Maybe = None, widths: Sequence[Number] = (),
) -> Comparison:
    """Holds data against the exact history of a scene or problem, as ``dalembert compare`` does.

    The data are times with the ``values`` of a ``quantity``, or of several as a dict or a DataFrame; with points ``x``
    along the rod, values of shape ``(len(t), len(x))`` are a field. Without values, the data are a DataFrame, a dict or
    a structured array that has a column ``t``, or a file as the command takes it; a list of them gives the order of
    convergence. Quantities are called as in :meth:`History.columns`, ``u`` and ``v`` for short. Two rows at one time
    are the limits at a jump. The options are those of the command.

    >>> t = [0, 1, 2, 3, 4]     # one contact of two time units, and v = t - 2 after it
    >>> c = compare(Problem(length=1, wave_speed=1, impact_speed=1), t, [0, 0, 0, 1, 2.25], quantity="u_end")
    >>> c.difference["u_end"].tolist(), c.norms["u_end"]["linf"]["time"]
    ([0.0, 0.0, 0.0, 0.0, 0.25], 4.0)

    Data that cannot be compared are a ValueError with the text of the command.
    """
    given = {name: value for name, value in locals().items() if value is not None}
    given = {name: given[name] for name in given if name not in ("scene", "data", "values", "quantity", "x")}
    if values is not None:
        if not hasattr(values, "keys"):
            if quantity is None:
                raise TypeError("found values without a quantity, expected quantity='u_end' or another column's name")
            values = {quantity: values}
        data = {"t": data} if x is None else {"t": data, "x": x}
        values = {name: np.asarray(values[name]) for name in values.keys()}
        if x is not None and any(column.ndim == 2 for column in values.values()):
            data = dict(zip("tx", np.meshgrid(*data.values(), indexing="ij")))
            data, values = ({name: np.ravel(array) for name, array in part.items()} for part in (data, values))
        data = data | values
    sources = data if isinstance(data, list) else [data]
    return Comparison(_core.Comparison(Problem.from_scene(scene)._core, [_source(one) for one in sources], given))


def _source(data: Any) -> tuple[str, list[str], list[np.ndarray] | None]:
    """A path; or what it is called, the names of columns where they have some, and the columns."""
    called = type(data).__name__
    if isinstance(data, (str, os.PathLike)):
        called = os.fspath(data)
        if not (os.path.isfile(called) and _is_numpy(called)):
            return called, [], None
        try:
            data = np.load(called)
        except Exception as error:  # of the many that a broken file raises
            raise ValueError(f"{called}: cannot be read: {error}") from None
    names = getattr(getattr(data, "dtype", None), "names", None) or (data.keys() if hasattr(data, "keys") else None)
    if names is None:
        array = np.asarray(data)
        names, columns = [], list(array.T) if array.ndim == 2 else [array]
    else:
        columns = [data[name] for name in names]
    return called, [str(name) for name in names], [_doubles(column) for column in columns]


def _is_numpy(path: str) -> bool:
    with open(path, "rb") as file:
        return file.read(4) in (b"\x93NUM", b"PK\x03\x04")


def _doubles(column: Any) -> np.ndarray:
    """The column as doubles, or as it is where it has others."""
    array, sides = np.asarray(column), {"left": -1, "both": 0, "right": 1}
    try:
        if array.dtype.kind in "OU":
            return np.array([sides.get(value, value) for value in array.tolist()], dtype=float)
        return array.astype(float, copy=False) if array.dtype.kind in "biuf" else array
    except (TypeError, ValueError):
        return array


_READ = {
    "double": float,
    # By way of Decimal: int() refuses texts of more than 4300 digits.
    "exact": lambda text: Fraction(*(int(Decimal(whole)) for whole in text.split("/"))),
    "digits": Decimal,
    "certified": lambda ends: tuple(map(Decimal, ends)),
}


class History:
    """What happened, and the value of every quantity at any time from 0 to :attr:`end`.

    Arrays are in C order. In numbers other than doubles they hold objects: ``Fraction``, ``Decimal``, or pairs of
    ``Decimal``; where there is no number they hold None, and nan in doubles. At a jump ``side`` chooses the limit from
    earlier ("left") or later ("right") times.

    ``numbers`` is "double", "exact", "digits" or "certified"; ``end`` the last time that is known, ``ending`` why it is
    the last; ``engine`` how the motion was solved; ``warnings`` what a user should know of the answer; ``scales`` are
    the natural scales by name. Where fractions end before an event at no fraction, ``end`` is a fraction just below its
    time, :attr:`events` do not have it, and ``ending`` says its time:

    >>> solve("paper-weak", exact=True).ending
    'exactness ends before the impact at t = 3 + √2 ≈ 4.414213562373095, which is no fraction'
    """

    def __init__(self, core: _core.History, problem: Problem) -> None:
        self._core, self.problem = core, problem
        self.numbers, end, about, self.warnings, scales = core.facts()
        self._read = _READ[self.numbers]
        self.end = self._read(end)
        self.ending, self.engine, self._asked = about
        self.scales = dict(zip(("time", "velocity", "length", "wave_speed", "gravity"), scales))

    def __repr__(self) -> str:
        return f"<dalembert.History to t = {self.end}, {self._asked}>"

    @property
    def error_estimate(self) -> float:
        """A bound of the error of events and ordinary values, relative to the natural scales; zero where exact."""
        return self._core.error_estimate()

    def _array(self, raw: Any) -> np.ndarray:
        if isinstance(raw, np.ndarray):
            return raw
        return np.fromiter((None if value is None else self._read(value) for value in raw), dtype=object)

    def _table(self, part: str, **others: np.ndarray) -> np.ndarray:
        columns = {name: self._array(raw) for name, raw in self._core.table(part)} | others
        return np.fromiter(zip(*columns.values()), [(name, column.dtype) for name, column in columns.items()])

    @cached_property
    def events(self) -> np.ndarray:
        """Impacts and releases: ``time``, ``end_velocity``, ``centre``, ``centre_velocity``, the ``kind``, and how far
        the time may be off, ``time_error``.

        >>> solve("paper-strong").events["kind"].tolist()
        ['impact', 'release']
        """
        kinds, errors = self._core.kinds()
        return self._table("events", kind=np.array(kinds, "U7"), time_error=np.array(errors, float))

    @cached_property
    def contacts(self) -> np.ndarray:
        """Times on the ground: ``from``, ``to``, ``impulse``, and the ``peak_strain``, which is the most compressive
        ``v_x(0,t)``; with a material ``peak_stress`` and ``peak_force`` as well, all in its units. Without one the
        impulse is per linear density.

        >>> rod = Problem(length=2, modulus=4, density=1, area=2, impact_speed=1)
        >>> rod.solve(exact=True).contacts[["impulse", "peak_stress", "peak_force"]].tolist()
        [(Fraction(8, 1), Fraction(-2, 1), Fraction(4, 1))]
        """
        return self._table("contacts")

    @cached_property
    def restitution(self) -> np.ndarray:
        """For each contact ``e_P``, ``e_E²`` and its factors ``E_h/E`` and ``E/E(0)`` at its end: ``momentum``,
        ``energy_squared``, ``translational_part``, ``energy_kept``."""
        return self._table("restitution")

    @cached_property
    def flights(self) -> np.ndarray:
        """Flights: ``from``, ``to``, and ``top_time`` and ``top``, when and how high the centre of mass turns."""
        return self._table("flights")

    @cached_property
    def stress_history(self) -> np.ndarray:
        """``v_x(0,·)`` piece by piece: ``from``, ``to``, and ``strain_from`` and ``strain_to`` at its ends. Undamped
        pieces are linear between them; :meth:`strain` gives the values of all."""
        return self._table("stress")

    def _places(self, values: Numbers) -> Any:
        array = np.asarray(values)
        if self.numbers == "double" and array.dtype.kind in "fiu":
            return np.ascontiguousarray(array.ravel(), dtype=np.float64)
        return np.asarray(values, dtype=object).ravel().tolist()

    def columns(self, names: Sequence[str], t: Numbers, side: Side | None = None) -> dict[str, np.ndarray]:
        """Columns by the names of `dalembert reference`: ``u_end``, ``v_end``, ``strain``, ``stress``, ``force``,
        ``u_top``, ``v_top``, ``h``, ``h_rate``, ``E_total``, ``E_h``, ``E_z``, ``kinetic``, ``strain_energy``,
        ``gravity``, ``contact``, ``impulse``, ``t`` and ``side``. Without a side a time has two rows where two limits
        differ, the earlier one first.

        >>> solve("paper-strong").columns(["t", "side", "strain"], [1, 2])["strain"].tolist()
        [-4.0, -5.0, 0.0]
        """
        return dict(zip(names, map(self._array, self._core.columns(list(names), self._places(t), side))))

    def _at(self, t: Numbers, side: Side, *names: str) -> list[Any]:
        return _shaped(self.columns(names, t, side).values(), np.shape(t))

    def strain(self, t: Numbers, side: Side = "right") -> Any:
        """``v_x(0,t)``: the strain at the ground, which is the stress there divided by the modulus; zero in flight."""
        return self._at(t, side, "strain")[0]

    def ground_end(self, t: Numbers, side: Side = "right") -> Motion:
        """``v(0,t)`` and ``v_t(0,t)``."""
        return Motion(*self._at(t, side, "u_end", "v_end"))

    def top_end(self, t: Numbers, side: Side = "right") -> Motion:
        """``v(L,t)`` and ``v_t(L,t)``."""
        return Motion(*self._at(t, side, "u_top", "v_top"))

    def centre(self, t: Numbers) -> Motion:
        """``h(t)`` and ``h′(t)``: the centre of mass, relative to its place in the undeformed rod on the ground."""
        return Motion(*self._at(t, "right", "h", "h_rate"))

    def h(self, t: Numbers) -> Any:
        """``h(t)``."""
        return self._at(t, "right", "h")[0]

    def energy(self, t: Numbers) -> Energy:
        """``E``, ``E_h`` and ``E_z``; per linear density where the problem has no material."""
        return Energy(*self._at(t, "right", "E_total", "E_h", "E_z"))

    def field(
        self, x: Numbers, t: Numbers, side: Side = "right", kind: Literal["points", "averages", "p1"] = "points"
    ) -> Field:
        """``v``, ``v_t`` and ``v_x`` at every point of ``x`` for every time of ``t``: arrays of the shape of ``t``
        followed by that of ``x``. ``kind="averages"`` gives the means over the cells between the points of ``x``, which
        are one fewer, and ``kind="p1"`` the nodal values of the L² projection on the continuous, piecewise linear
        functions on that grid; neither has two sides.

        >>> rod = solve("paper-strong")
        >>> rod.field([0.25, 0.5], [1, 1.5]).strain.shape
        (2, 2)
        >>> rod.field([0, 0.5, 1], 0.5, kind="averages").strain.tolist()
        [-3.25, 0.0]
        """
        columns = map(self._array, self._core.field(self._places(x), self._places(t), side, kind))
        points = np.shape(x) if kind != "averages" else (np.size(x) - 1,)
        return Field(*_shaped(columns, np.shape(t) + points))


def _shaped(columns: Iterable[np.ndarray], shape: tuple[int, ...]) -> list[Any]:
    """Columns in the shape of what they were asked at; numbers where that was one."""
    return [column.reshape(shape) if shape else column[0] for column in columns]
