"""Histories: what happened, and the value of every quantity at any time."""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction
from functools import cached_property
from html import escape
from typing import TYPE_CHECKING, Any, Callable, Iterable, Literal, NamedTuple, Sequence, get_args

import numpy as np

from . import _core
from ._numbers import Array, Numbers, Side

if TYPE_CHECKING:
    import matplotlib.axes
    import pandas
    import xarray

    from ._problem import Problem

Slice = Literal["points", "averages", "p1"]
Parameter = Literal["length", "wave_speed", "modulus", "density", "damping", "gravity", "speed", "gap"]
TableName = Literal["events", "contacts", "flights", "stress_history"]
_TABLES = get_args(TableName)


class Motion(NamedTuple):
    """A displacement and its rate.

    Parameters
    ----------
    displacement : number or ndarray
        ``v``.
    velocity : number or ndarray
        ``v_t``.
    """

    displacement: Any
    velocity: Any


class Energy(NamedTuple):
    """An energy and its parts, ``E = E_h + E_z``.

    Parameters
    ----------
    E_total : number or ndarray
        ``E``.
    E_h : number or ndarray
        That of the centre of mass.
    E_z : number or ndarray
        That of the vibration.
    """

    E_total: Any
    E_h: Any
    E_z: Any


class Derivatives(NamedTuple):
    """Derivatives of a table by a value of the problem, which at a threshold differ from side to side.

    Parameters
    ----------
    left, right : ndarray
        As the value grows towards that of the problem, and as it grows beyond: structured arrays with the names and
        rows of the table. NaN, or None among exact numbers, where there is none: a number that jumps or has an infinite
        derivative, and one that is not settled.
    left_error, right_error : ndarray
        How far each may be off.
    """

    left: Array
    right: Array
    left_error: Array
    right_error: Array


class Field(NamedTuple):
    """The field along the rod.

    Parameters
    ----------
    u : number or ndarray
        The displacement ``v``.
    v : number or ndarray
        The velocity ``v_t``.
    strain : number or ndarray
        ``v_x``.
    """

    u: Any
    v: Any
    strain: Any


def _fraction(text: str) -> Fraction:
    # By way of Decimal: int() refuses texts of more than 4300 digits.
    return Fraction(*(int(Decimal(whole)) for whole in text.split("/")))


_READ: dict[str, Callable[[Any], Any]] = {
    "double": float,
    "exact": _fraction,
    "digits": Decimal,
    "certified": lambda ends: tuple(map(Decimal, ends)),
}


class History:
    """What happened, and the value of every quantity at any time from 0 to `end`.

    Attributes
    ----------
    problem : Problem
        What was solved.
    numbers : {"double", "exact", "digits", "certified"}
        In which numbers.
    end : float, Fraction, Decimal or pair of Decimal
        The last time that is known.
    ending : str
        Why it is the last.
    engine : str
        How the motion was solved.
    warnings : list of str
        What a user should know of the answer.
    scales : dict of str to float
        The natural scales by name: time, velocity, length, wave_speed, gravity.

    Notes
    -----
    :func:`solve` and :meth:`Problem.solve` make histories. Arrays are in C order. In numbers other than doubles they
    hold objects: ``Fraction``, ``Decimal``, or pairs of ``Decimal``; where there is no number they hold None, and nan
    in doubles. At a jump `side` chooses the limit from earlier ("left") or later ("right") times. Where fractions end
    before an event at no fraction, `end` is a fraction just below its time, :attr:`events` do not have it, and `ending`
    says its time. A history is pickled as its problem and the numbers asked for, and solved again where it is read.

    Examples
    --------
    >>> solve("paper-strong")
    <dalembert.History to t = 8, double, 1 contact
     contact from 0 to 2, impulse 8, peak strain -5
     ends: the impact after the last contact asked for>
    >>> solve("paper-weak", exact=True).ending
    'exactness ends before the impact at t = 3 + √2 ≈ 4.414213562373095, which is no fraction'
    """

    def __init__(self, core: _core.History, problem: Problem, asked: tuple[Any, ...]) -> None:
        self._core, self.problem, self._asked = core, problem, asked
        self.numbers, end, about, self.warnings, scales = core.facts()
        self._read = _READ[self.numbers]
        self.end = self._read(end)
        self.ending, self.engine, self._said = about
        self.scales = dict(zip(("time", "velocity", "length", "wave_speed", "gravity"), scales))

    def __reduce__(self) -> tuple[Any, ...]:
        return _again, (self.problem, self._asked)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, History):
            return NotImplemented
        return (self.problem, self._asked) == (other.problem, other._asked)

    def __hash__(self) -> int:
        return hash((self.problem, self._asked))

    def _lines(self, most: int) -> tuple[str, list[str]]:
        """What it is, and its first contacts."""
        found = self.contacts
        said = f"to t = {_short(self.end)}, {self._said}, {len(found)} contact{'s' if len(found) != 1 else ''}"
        keys = [("impact", "from"), ("release", "to"), ("impulse", "impulse"), ("peak_strain", "peak strain")]
        lines = []
        for row in found[:most]:
            start, end, impulse, peak = (f"{word} {_short(row[key])}" for key, word in keys)
            lines.append(f"contact {start} {end}, {impulse}, {peak}")
        return said, lines + ([f"… {len(found) - most} more"] if len(found) > most else [])

    def __repr__(self) -> str:
        said, lines = self._lines(4)
        return "\n ".join([f"<dalembert.History {said}", *lines, f"ends: {self.ending}>"])

    def _repr_html_(self) -> str:
        said, _ = self._lines(0)
        names = [name for name in self.contacts.dtype.names or ()]
        rows = ([_short(row[name]) for name in names] for row in self.contacts[:10])
        table = _html("th", names) + "".join(_html("td", row) for row in rows)
        notes = [f"ends: {self.ending}", *self.warnings]
        title = f"<b>{escape(self.problem.title)}</b><br>" if self.problem.title else ""
        below = "".join(f"<br>{escape(note)}" for note in notes)
        more = f"<br>… {len(self.contacts) - 10} more contacts" if len(self.contacts) > 10 else ""
        return f"<div>{title}History {escape(said)}<table>{table}</table>{more}{below}<br>{self.to_svg()}</div>"

    def derivatives(self, by: Parameter | str, table: TableName = "events") -> Derivatives:
        """Give the derivatives of a table by a value of the problem; all other values stay as they are.

        Parameters
        ----------
        by : {"length", "wave_speed", "modulus", "density", "damping", "gravity", "speed", "gap"} or str
            The value; of a start that is not uniform ``"displacement"`` and ``"velocity"`` as a whole, or at a point:
            ``"velocity[0]"``.
        table : {"events", "contacts", "flights"}, optional
            The attribute whose numbers are meant.

        Returns
        -------
        Derivatives
            From both sides, with bounds. Fractions stay fractions.

        Examples
        --------
        >>> found = solve("doyen-ern-piperno", exact=True).derivatives("speed")
        >>> found.left["t"][2], found.right["t"][2]
        (Fraction(3, 5), Fraction(3, 25))
        """
        return self._derived(self._core.derivatives(by, table))

    def derivatives_at(
        self, by: str, names: Sequence[str], t: Numbers, x: Numbers = (), side: Side = "right"
    ) -> Derivatives:
        """Give the derivatives of columns at times, or of the field at points; time and point stay where they are.

        Parameters
        ----------
        by : str
            The value, as in `derivatives`.
        names : sequence of str
            Of the names of `columns`; with points of ``u``, ``v``, ``strain`` and ``stress``.
        t : number or array_like
            Times.
        x : number or array_like, optional
            Points of the rod.
        side : {"right", "left"}, optional
            Which limit at a jump.

        Returns
        -------
        Derivatives
            A row for each time, and there for each point.

        Examples
        --------
        >>> found = solve("getfem-dynamic-contact", exact=True).derivatives_at("displacement[0]", ["u_end"], [0.5, 1.5])
        >>> found.left["u_end"].tolist()
        [Fraction(1, 2), Fraction(0, 1)]
        """
        places = [self._places(np.atleast_1d(np.asarray(place, dtype=object))) for place in (t, x)]
        return self._derived(self._core.derivatives_at(by, list(names), places, side))

    def _derived(self, raw: Sequence[tuple[str, Any]]) -> Derivatives:
        found = [(name, sides) for name, sides in raw]

        def side(k: int, part: int) -> Array:
            columns = {name: self._array(sides[k][part]) for name, sides in found}
            return np.fromiter(zip(*columns.values()), [(name, column.dtype) for name, column in columns.items()])

        return Derivatives(side(0, 0), side(1, 0), side(0, 1), side(1, 1))

    def to_svg(self) -> str:
        """Draw the sheet of ``dalembert plot``: field, stress, motion and energy.

        Returns
        -------
        str
            An SVG picture, as notebooks show it.
        """
        return self._core.sheet()

    @property
    def error_estimate(self) -> float:
        """A bound of the error of events and ordinary values, relative to the natural scales; zero where exact."""
        return self._core.error_estimate()

    def _array(self, raw: Any) -> Array:
        if isinstance(raw, np.ndarray):
            return raw
        return np.fromiter((None if value is None else self._read(value) for value in raw), dtype=object)

    def _table(self, part: str, **others: Array) -> Array:
        columns = {name: self._array(raw) for name, raw in self._core.table(part)} | others
        return np.fromiter(zip(*columns.values()), [(name, column.dtype) for name, column in columns.items()])

    @cached_property
    def events(self) -> Array:
        """Impacts and releases.

        A structured array of ``t``, ``v_end``, ``h``, ``h_rate``, the ``kind``, and how far the time may be off,
        ``t_error``.

        Examples
        --------
        >>> solve("paper-strong").events["kind"].tolist()
        ['impact', 'release']
        """
        kinds, errors = self._core.kinds()
        return self._table("events", kind=np.array(kinds, "U7"), t_error=np.array(errors, float))

    @cached_property
    def contacts(self) -> Array:
        """Times on the ground.

        A structured array of ``impact``, ``release``, ``duration``, ``impact_velocity``, ``release_velocity``,
        ``impulse``, and the ``peak_strain``, which is the most compressive ``v_x(0,t)``; with a material ``peak_stress``
        and ``peak_force`` as well, all in its units. Without one the impulse is per linear density. Then the
        coefficients ``e_P`` and ``e_E2`` with its factors ``translational_part`` (``E_h/E``) and ``energy_kept``
        (``E/E(0)``), and the energies at the release, ``E_total_after``, ``E_h_after``, ``E_z_after``.

        Examples
        --------
        >>> rod = Problem(length=2, modulus=4, density=1, area=2, impact_speed=1)
        >>> rod.solve(exact=True).contacts[["impulse", "peak_stress", "peak_force"]].tolist()
        [(Fraction(8, 1), Fraction(-2, 1), Fraction(4, 1))]
        """
        return self._table("contacts")

    @cached_property
    def flights(self) -> Array:
        """Flights.

        A structured array of ``takeoff``, ``landing``, and ``top_time`` and ``top``: when and how high the centre of
        mass turns.
        """
        return self._table("flights")

    @cached_property
    def stress_history(self) -> Array:
        """``v_x(0,·)`` piece by piece.

        A structured array of ``start``, ``end``, and ``strain_start`` and ``strain_end`` then; with a material
        ``stress_start`` and ``stress_end`` as well. Undamped pieces are linear between them; :meth:`strain` gives the
        values of all.
        """
        return self._table("stress")

    def to_frame(self, table: TableName = "contacts") -> pandas.DataFrame:
        """Give a table as a DataFrame of pandas.

        Parameters
        ----------
        table : {"contacts", "events", "flights", "stress_history"}, optional
            Which of the arrays of that name.

        Returns
        -------
        pandas.DataFrame
            A row each.

        Examples
        --------
        >>> solve("paper-strong").to_frame().query("impact < 1")["impulse"].tolist()
        [8.0]
        """
        from pandas import DataFrame

        if table not in _TABLES:
            raise ValueError(f"found table {table!r}, expected one of {', '.join(_TABLES)}")
        found = getattr(self, table)
        return DataFrame({name: found[name] for name in found.dtype.names})

    def to_xarray(self, x: Numbers, t: Numbers, side: Side = "right") -> xarray.Dataset:
        """Give the field on a grid as a Dataset of xarray.

        Parameters
        ----------
        x, t : sequence of numbers
            Points and times.
        side : {"right", "left"}, optional
            Which limit at a jump.

        Returns
        -------
        xarray.Dataset
            ``u``, ``v`` and ``strain`` over ``t`` and ``x``.
        """
        from xarray import Dataset

        field = self.grid(x, t, side)
        values = {name: (("t", "x"), values) for name, values in field._asdict().items()}
        return Dataset(values, coords={"t": self._shown(t), "x": self._shown(x)})

    def _shown(self, values: Numbers) -> Array:
        array = np.asarray(values)
        return array if array.dtype.kind in "fiu" else np.array([float(Fraction(str(value))) for value in array])

    def plot(
        self,
        quantities: Literal["xt"] | Sequence[str] = ("u_end", "h", "u_top"),
        ax: matplotlib.axes.Axes | None = None,
        *,
        start: float | None = None,
        end: float | None = None,
    ) -> matplotlib.axes.Axes:
        """Draw it with matplotlib, in the colours of ``dalembert plot``.

        Parameters
        ----------
        quantities : "xt" or sequence of str, optional
            Columns over time, by the names of :meth:`columns`; or the strain along the rod over time.
        ax : matplotlib.axes.Axes, optional
            Where to; by default on new axes.
        start, end : float, optional
            The span of time; by default the whole history, and of the strain along the rod what shows its first
            contacts, as in :meth:`to_svg`.

        Returns
        -------
        matplotlib.axes.Axes
            The axes. Times on the ground are grey.
        """
        from ._plot import draw

        return draw(self, quantities, ax, start, end)

    def _places(self, values: Numbers) -> Any:
        array = np.asarray(values)
        if self.numbers == "double" and array.dtype.kind in "fiu":
            return np.ascontiguousarray(array.ravel(), dtype=np.float64)
        return np.asarray(values, dtype=object).ravel().tolist()

    def columns(self, names: str | Sequence[str], t: Numbers, side: Side | None = None) -> dict[str, Array]:
        """Give columns as ``dalembert reference`` writes them.

        Parameters
        ----------
        names : str or sequence of str
            Of ``u_end``, ``v_end``, ``strain``, ``stress``, ``force``, ``u_top``, ``v_top``, ``h``, ``h_rate``,
            ``E_total``, ``E_h``, ``E_z``, ``kinetic``, ``strain_energy``, ``gravity``, ``contact``, ``impulse``, ``t``
            and ``side``.
        t : number or array_like
            Times.
        side : {"left", "right"}, optional
            Which limit at a jump. Without it a time has two rows where they differ, the earlier one first.

        Returns
        -------
        dict of str to ndarray
            The columns by name.

        Examples
        --------
        >>> solve("paper-strong").columns(["t", "side", "strain"], [1, 2])["strain"].tolist()
        [-4.0, -5.0, 0.0]
        """
        names = [names] if isinstance(names, str) else list(names)
        return dict(zip(names, map(self._array, self._core.columns(names, self._places(t), side))))

    def _at(self, t: Numbers, side: Side, *names: str) -> list[Any]:
        return _shaped(self.columns(names, t, side).values(), np.asarray(t).shape)

    def strain(self, t: Numbers, side: Side = "right") -> Any:
        """Give ``v_x(0,t)``, the strain at the ground; zero in flight.

        Parameters
        ----------
        t : number or array_like
            Times.
        side : {"right", "left"}, optional
            Which limit at a jump.

        Returns
        -------
        number or ndarray
            Of the shape of `t`. Times the modulus it is the stress.
        """
        return self._at(t, side, "strain")[0]

    def ground_end(self, t: Numbers, side: Side = "right") -> Motion:
        """Give ``v(0,t)`` and ``v_t(0,t)``.

        Parameters
        ----------
        t : number or array_like
            Times.
        side : {"right", "left"}, optional
            Which limit at a jump.

        Returns
        -------
        Motion
            Numbers or arrays of the shape of `t`.
        """
        return Motion(*self._at(t, side, "u_end", "v_end"))

    def top_end(self, t: Numbers, side: Side = "right") -> Motion:
        """Give ``v(L,t)`` and ``v_t(L,t)``.

        Parameters
        ----------
        t : number or array_like
            Times.
        side : {"right", "left"}, optional
            Which limit at a jump.

        Returns
        -------
        Motion
            Numbers or arrays of the shape of `t`.
        """
        return Motion(*self._at(t, side, "u_top", "v_top"))

    def centre(self, t: Numbers) -> Motion:
        """Give ``h(t)`` and ``h′(t)``, the motion of the centre of mass.

        Parameters
        ----------
        t : number or array_like
            Times.

        Returns
        -------
        Motion
            Numbers or arrays of the shape of `t`, relative to the place in the undeformed rod on the ground.
        """
        return Motion(*self._at(t, "right", "h", "h_rate"))

    def h(self, t: Numbers) -> Any:
        """Give ``h(t)``, the place of the centre of mass.

        Parameters
        ----------
        t : number or array_like
            Times.

        Returns
        -------
        number or ndarray
            Of the shape of `t`.
        """
        return self._at(t, "right", "h")[0]

    def energy(self, t: Numbers) -> Energy:
        """Give ``E``, ``E_h`` and ``E_z``.

        Parameters
        ----------
        t : number or array_like
            Times.

        Returns
        -------
        Energy
            Numbers or arrays of the shape of `t`; per linear density where the problem has no material.
        """
        return Energy(*self._at(t, "right", "E_total", "E_h", "E_z"))

    def field(self, x: Numbers, t: Numbers, side: Side = "right") -> Field:
        """Give ``v``, ``v_t`` and ``v_x`` at points of the rod.

        Parameters
        ----------
        x, t : number or array_like
            Points and times, which are broadcast against each other.
        side : {"right", "left"}, optional
            Which limit at a jump.

        Returns
        -------
        Field
            Numbers or arrays of the shape of `x` and `t` together.

        See Also
        --------
        grid : Every point at every time, and means over cells.

        Examples
        --------
        >>> rod = solve("paper-strong")
        >>> rod.field(0.25, 1.5).v
        -0.25
        >>> rod.field(np.array([0.25, 0.5])[:, None], [1, 1.5, 2]).strain.shape
        (2, 3)
        """
        points, times = np.asarray(x), np.asarray(t)
        shape = np.broadcast_shapes(points.shape, times.shape)
        if points.size * times.size == np.prod(shape, dtype=int):
            # An outer product: the field at each time is worked out once.
            columns = map(self._array, self._core.grid(self._places(x), self._places(t), side, "points"))
            shaped = [column.reshape(times.shape + points.shape) for column in columns]
            moved = [_outer(column, times.ndim, points.ndim, len(shape)).reshape(shape) for column in shaped]
            return Field(*(column if shape else column[()] for column in moved))
        beside = [self._places(np.broadcast_to(values, shape)) for values in (points, times)]
        return Field(*_shaped(map(self._array, self._core.field(beside[0], beside[1], side)), shape))

    def grid(self, x: Numbers, t: Numbers, side: Side = "right", kind: Slice = "points") -> Field:
        """Give ``v``, ``v_t`` and ``v_x`` at every point for every time.

        Parameters
        ----------
        x, t : number or array_like
            Points and times.
        side : {"right", "left"}, optional
            Which limit at a jump; means and projections have no sides.
        kind : {"points", "averages", "p1"}, optional
            The values at the points; the means over the cells between them, which are one fewer; or the nodal values of
            the L² projection on the continuous, piecewise linear functions on that grid.

        Returns
        -------
        Field
            Arrays of the shape of `t` followed by that of `x`.

        Examples
        --------
        >>> rod = solve("paper-strong")
        >>> rod.grid([0.25, 0.5], [1, 1.5, 2]).strain.shape
        (3, 2)
        >>> rod.grid([0, 0.5, 1], 0.5, kind="averages").strain.tolist()
        [-3.25, 0.0]
        """
        columns = map(self._array, self._core.grid(self._places(x), self._places(t), side, kind))
        points = np.asarray(x)
        width = points.shape if kind != "averages" else (points.size - 1,)
        return Field(*_shaped(columns, np.asarray(t).shape + width))


def _outer(column: Array, times: int, points: int, most: int) -> Array:
    """Values over (times…, points…) with their axes in the order in which those are broadcast."""
    where = [most - times + k for k in range(times)] + [most - points + k for k in range(points)]
    return column.transpose(np.argsort(where, kind="stable"))


def _again(problem: Problem, asked: tuple[Any, ...]) -> History:
    return History(problem._core.solve(*asked), problem, asked)


def _short(value: Any) -> str:
    """A number in a line: six digits of a double, long ones cut."""
    if isinstance(value, tuple):
        return f"{_short(value[0])} … {_short(value[1])}"
    if isinstance(value, (float, np.floating)):
        return f"{value:.6g}" if np.isfinite(value) else "–"
    text = "–" if value is None else str(value)
    return text if len(text) <= 24 else text[:22] + "…"


def _html(tag: str, cells: Iterable[str]) -> str:
    return "<tr>" + "".join(f"<{tag}>{escape(cell)}</{tag}>" for cell in cells) + "</tr>"


def _shaped(columns: Iterable[Array], shape: tuple[int, ...]) -> list[Any]:
    """Columns in the shape of what they were asked at; numbers where that was one."""
    return [column.reshape(shape) if shape else column[0] for column in columns]
