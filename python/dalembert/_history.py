"""Histories: events, contacts, and the value of every quantity at any time."""

from __future__ import annotations

from fractions import Fraction
from html import escape
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Iterable, Literal, Mapping, Sequence, get_args

import numpy as np

from . import _core
from ._answers import Centre, Derivatives, Energy, Field, GroundEnd, TopEnd
from ._arrays import READ, Answers, one_side, shaped, short
from ._numbers import Array, MaskedArray, Names, Numbers, Side

if TYPE_CHECKING:
    import matplotlib.axes
    import pandas
    import xarray

    from ._problem import Problem

Slice = Literal["points", "averages", "p1"]
Parameter = Literal[
    "length", "wave_speed", "modulus", "density", "damping", "gravity", "impact_speed", "gap", "stiffness"
]
TableName = Literal["events", "contacts", "flights", "stress_history"]
_TABLES = get_args(TableName)


class History(Answers):
    """The motion of a rod: events, contacts, and the value of every quantity at any time from 0 to `end`.

    Attributes
    ----------
    problem : Problem
        The problem that was solved.
    numbers : {"double", "exact", "digits", "certified"}
        Number system of the answers.
    end : float, Fraction, Decimal or pair of Decimal
        Last time that is known.
    ending : str
        Reason for the end.
    engine : str
        Method of solution.
    scales : mapping of str to float
        Natural scales by name: time, velocity, length, wave_speed, gravity.

    Notes
    -----
    :func:`solve` and :meth:`Problem.solve` make histories. Arrays are in C order. In numbers other than doubles they
    hold objects: ``Fraction``, ``Decimal``, or pairs of ``Decimal``. At a jump `side` chooses the limit from earlier
    ("left") or later ("right") times.

    Tables cannot be written to, and other arrays are copies. A number that a table does not have, such as the release
    of a contact that lasts, is masked, and :meth:`reasons` says why there is none.

    If fractions end before an event at no fraction, `end` is a fraction just below its time, :attr:`events` do not have
    it, and `ending` says its time. A history is pickled as its problem and the numbers asked for, and solved again
    where it is read.

    Examples
    --------
    >>> solve("paper-strong")
    <dalembert.History to t = 8, double, 1 contact
     contact from 0 to 2, impulse 8, peak strain -5
     ends: the impact after the last contact asked for>
    >>> solve("paper-weak", exact=True).ending
    'exactness ends before the impact at t = 3 + √2 ≈ 4.414213562373095, which is no fraction'
    """

    problem: Problem
    numbers: Literal["double", "exact", "digits", "certified"]
    end: Any
    ending: str
    engine: str
    scales: Mapping[str, float]
    _compiled: _core.History
    _question: tuple[Any, ...]
    _in_words: str
    _tables: dict[str, tuple[MaskedArray, dict[tuple[int, str], str]]]

    def __init__(self, compiled: _core.History, problem: Problem, question: tuple[Any, ...]) -> None:
        facts = compiled.facts()
        names = ("time", "velocity", "length", "wave_speed", "gravity")
        self.__dict__.update(
            _compiled=compiled, problem=problem, _question=question, _in_words=facts["question"], _tables={},
            numbers=facts["numbers"], end=READ[facts["numbers"]](facts["end"]), ending=facts["ending"],
            engine=facts["engine"], scales=MappingProxyType(dict(zip(names, facts["scales"]))),
        )  # fmt: skip

    def __reduce__(self) -> tuple[Any, ...]:
        return _solve_again, (self.problem, self._question)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, History):
            return NotImplemented
        return (self.problem, self._question) == (other.problem, other._question)

    def __hash__(self) -> int:
        return hash((self.problem, self._question))

    def _lines(self, most: int) -> tuple[str, list[str]]:
        """Describe the history, and the first contacts in a line each."""
        found = self.contacts
        head = f"to t = {short(self.end)}, {self._in_words}, {len(found)} contact{'s' if len(found) != 1 else ''}"
        keys = [("impact", "from"), ("release", "to"), ("impulse", "impulse"), ("peak_strain", "peak strain")]
        lines = []
        for row in found[:most]:
            start, end, impulse, peak = (f"{word} {short(row[key])}" for key, word in keys)
            lines.append(f"contact {start} {end}, {impulse}, {peak}")
        return head, lines + ([f"… {len(found) - most} more"] if len(found) > most else [])

    def __repr__(self) -> str:
        head, lines = self._lines(4)
        return "\n ".join([f"<dalembert.History {head}", *lines, f"ends: {self.ending}>"])

    def _repr_html_(self) -> str:
        head, _ = self._lines(0)
        names = [name for name in self.contacts.dtype.names or ()]
        rows = ([short(row[name]) for name in names] for row in self.contacts[:10])
        table = _html("th", names) + "".join(_html("td", row) for row in rows)
        notes = [f"ends: {self.ending}", *self.warnings]
        title = f"<b>{escape(self.problem.title)}</b><br>" if self.problem.title else ""
        below = "".join(f"<br>{escape(note)}" for note in notes)
        more = f"<br>… {len(self.contacts) - 10} more contacts" if len(self.contacts) > 10 else ""
        return f"<div>{title}History {escape(head)}<table>{table}</table>{more}{below}<br>{self.to_svg()}</div>"

    @property
    def warnings(self) -> list[str]:
        """Warnings that come with the answers so far."""
        return self._compiled.warnings()

    @property
    def error_estimate(self) -> float:
        """Bound of the error of events and ordinary values, relative to the natural scales; zero where exact."""
        return self._compiled.error_estimate()

    def _table(self, table: str) -> MaskedArray:
        if table not in self._tables:
            columns = self._compiled.table(table)
            others = {}
            if table == "events":
                kinds, errors = self._compiled.kinds()
                others = {"kind": np.array(kinds, "U7"), "t_error": np.array(errors, float)}
            reasons = {(row, column["name"]): why for column in columns for row, why in column["missing"]}
            self._tables[table] = self._structured(columns, "values", others), reasons
        return self._tables[table][0]

    @property
    def events(self) -> MaskedArray:
        """Impacts and releases.

        A structured array of ``t``, ``v_end``, ``h``, ``h_rate``, the ``kind``, and the bound of the error of the time,
        ``t_error``.

        Examples
        --------
        >>> solve("paper-strong").events["kind"].tolist()
        ['impact', 'release']
        """
        return self._table("events")

    @property
    def contacts(self) -> MaskedArray:
        """Contacts with the ground.

        A structured array of ``impact``, ``release``, ``duration``, ``impact_velocity``, ``release_velocity``,
        ``impulse``, and the ``peak_strain``, which is the most compressive ``v_x(0,t)``; with a material also
        ``peak_stress`` and ``peak_force``, all in its units. Without one the impulse is per linear density. Then the
        coefficients ``e_P`` and ``e_E2`` with its factors ``translational_part`` (``E_h/E``) and ``energy_kept``
        (``E/E(0)``), and the energies at the release, ``E_total_after``, ``E_h_after``, ``E_z_after``.

        Examples
        --------
        >>> rod = Problem(length=2, modulus=4, density=1, area=2, impact_speed=1)
        >>> rod.solve(exact=True).contacts[["impulse", "peak_stress", "peak_force"]].tolist()
        [(Fraction(8, 1), Fraction(-2, 1), Fraction(4, 1))]
        """
        return self._table("contacts")

    @property
    def flights(self) -> MaskedArray:
        """Flights between contacts.

        A structured array of ``takeoff``, ``landing``, and ``top_time`` and ``top``: time and height at which the
        centre of mass turns.
        """
        return self._table("flights")

    @property
    def stress_history(self) -> MaskedArray:
        """``v_x(0,·)`` piece by piece.

        A structured array of ``start``, ``end``, and ``strain_start`` and ``strain_end`` then; with a material
        ``stress_start`` and ``stress_end`` as well. Undamped pieces are linear between them; :meth:`strain` gives the
        values of all.
        """
        return self._table("stress_history")

    def reasons(self, table: TableName = "contacts") -> dict[tuple[int, str], str]:
        """Return the reason for each masked number of a table.

        Parameters
        ----------
        table : {"contacts", "events", "flights", "stress_history"}, optional
            The array of that name.

        Returns
        -------
        dict of tuple to str
            The reason by row and column.

        Examples
        --------
        >>> held = solve("paper-strong", to=1)
        >>> held.contacts["release"].tolist(), held.reasons()[0, "release"]
        ([None], 'the contact does not end within this history')
        """
        self._named(table)
        return dict(self._tables[table][1])

    def _named(self, table: TableName) -> MaskedArray:
        if table not in _TABLES:
            raise ValueError(f"found table {table!r}, expected one of {', '.join(_TABLES)}")
        return self._table(table)

    def derivatives(self, by: Parameter | str, table: TableName = "events") -> Derivatives:
        """Return the derivatives of a table by a value of the problem; all other values stay as they are.

        Parameters
        ----------
        by : {"length", "wave_speed", "modulus", "density", "damping", "gravity", "impact_speed", "gap", \
              "stiffness"} or str
            The value; the stiffness is that of a contact that yields; of a start that is not uniform ``"displacement"``, ``"strain"`` or ``"velocity"`` as a whole,
            or at a point: ``"velocity[0]"``.
        table : {"events", "contacts", "flights", "stress_history"}, optional
            The array of that name.

        Returns
        -------
        Derivatives
            From both sides, with bounds. Fractions stay fractions.

        Examples
        --------
        >>> found = solve("doyen-ern-piperno", exact=True).derivatives("impact_speed")
        >>> found.left["t"][2], found.right["t"][2]
        (Fraction(3, 5), Fraction(3, 25))
        """
        return self._derivatives(self._compiled.derivatives(by, table))

    def derivatives_at(self, by: str, t: Numbers, names: Names, x: Numbers = (), side: Side = "right") -> Derivatives:
        """Return the derivatives of quantities at times, or of the field at points; time and point stay where they are.

        Parameters
        ----------
        by : str
            The value, as in `derivatives`.
        t : number or array_like
            Times.
        names : str or sequence of str
            Names as in `columns`; with points some of ``u``, ``v``, ``strain`` and ``stress``.
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
        >>> found = solve("getfem-dynamic-contact", exact=True).derivatives_at("displacement[0]", [0.5, 1.5], "u_end")
        >>> found.left["u_end"].tolist()
        [Fraction(1, 2), Fraction(0, 1)]
        """
        return self._derivatives(self._compiled.derivatives_at(by, self._places(t), names, self._places(x), side))

    def to_svg(self) -> str:
        """Draw the sheet of ``dalembert plot``: field, stress, motion and energy.

        Returns
        -------
        str
            An SVG picture, as notebooks show it.
        """
        return self._compiled.sheet()

    def _attributes(self, kind: str) -> dict[str, Any]:
        """Return the attributes of a frame: title and numbers, and unit and meaning of each column."""
        described = self._compiled.describe(kind)
        return {
            "title": self.problem.title or "",
            "numbers": self._in_words,
            "units": {column["name"]: column["unit"] for column in described},
            "meanings": {column["name"]: column["meaning"] for column in described},
        }

    def to_frame(self, table: TableName = "contacts") -> pandas.DataFrame:
        """Return a table as a DataFrame of pandas.

        Parameters
        ----------
        table : {"contacts", "events", "flights", "stress_history"}, optional
            The array of that name.

        Returns
        -------
        pandas.DataFrame
            A row each; a number that there is not is NaN, or None among objects. The ``attrs`` have the ``units`` and
            ``meanings`` of the columns, and the ``reasons`` for absent numbers by column and row.

        Examples
        --------
        >>> frame = solve("paper-strong").to_frame()
        >>> frame.query("impact < 1")["impulse"].tolist(), frame.attrs["units"]["release"]
        ([8.0], 's')
        """
        from pandas import DataFrame

        found = self._named(table)
        frame = DataFrame({name: np.array(found.data[name]) for name in found.dtype.names or ()})
        reasons: dict[str, dict[int, str]] = {}
        for (row, name), why in self._tables[table][1].items():
            reasons.setdefault(name, {})[row] = why
        frame.attrs = self._attributes(table) | {"reasons": reasons}
        return frame

    def to_xarray(self, x: Numbers, t: Numbers, side: Side = "right") -> xarray.Dataset:
        """Return the field on a grid as a Dataset of xarray.

        Parameters
        ----------
        x, t : sequence of numbers
            Points and times.
        side : {"right", "left"}, optional
            Which limit at a jump.

        Returns
        -------
        xarray.Dataset
            ``u``, ``v`` and ``strain`` over ``t`` and ``x``, each with its ``units`` and ``long_name`` in ``attrs``.
        """
        from xarray import Dataset

        field = self.grid(x, t, side)
        known = {column["name"]: column for kind in ("time", "rod") for column in self._compiled.describe(kind)}
        attrs = {name: {"units": known[name]["unit"], "long_name": known[name]["meaning"]} for name in known}
        values = {name: (("t", "x"), values, attrs[name]) for name, values in field._asdict().items()}
        places = {name: (name, _shown(values), attrs[name]) for name, values in (("t", t), ("x", x))}
        return Dataset(values, places, {"title": self.problem.title or "", "numbers": self._in_words, "side": side})

    def plot(
        self,
        quantities: Literal["xt"] | Sequence[str] = ("u_end", "h", "u_top"),
        ax: matplotlib.axes.Axes | None = None,
        *,
        start: float | None = None,
        end: float | None = None,
    ) -> matplotlib.axes.Axes:
        """Draw the history with matplotlib, in the colours of ``dalembert plot``.

        Parameters
        ----------
        quantities : "xt" or sequence of str, optional
            Quantities over time, by the names of :meth:`columns`; or the strain along the rod over time.
        ax : matplotlib.axes.Axes, optional
            Axes to draw on; by default new ones.
        start, end : float, optional
            The span of time; by default the whole history, and of the strain along the rod the span of its first
            contacts, as in :meth:`to_svg`.

        Returns
        -------
        matplotlib.axes.Axes
            The axes. Times on the ground are grey.
        """
        from ._plot import draw

        return draw(self, quantities, ax, start, end)

    def columns(self, t: Numbers, names: Names, side: Side | None = None) -> dict[str, Array]:
        """Return quantities over time, as ``dalembert reference`` writes them.

        Parameters
        ----------
        t : number or array_like
            Times.
        names : str or sequence of str
            Names out of ``u_end``, ``v_end``, ``strain``, ``stress``, ``force``, ``u_top``, ``v_top``,
            ``force_top``, ``h``, ``h_rate``, ``E_total``, ``E_h``, ``E_z``, ``kinetic``, ``strain_energy``,
            ``gravity``, ``contact``, ``impulse``, ``t`` and ``side``; or of the groups ``end``, ``top``, ``centre`` and ``energy``.
        side : {"left", "right"}, optional
            Which limit at a jump. Without it a time has two rows where they differ, the earlier one first.

        Returns
        -------
        dict of str to ndarray
            The columns by name. That of ``side`` has the words "left", "right", and "both" where the limits agree.

        Examples
        --------
        >>> found = solve("paper-strong").columns([1, 2], ["t", "side", "strain"])
        >>> found["side"].tolist(), found["strain"].tolist()
        (['both', 'left', 'right'], [-4.0, -5.0, 0.0])
        """
        return {name: self._array(name, raw) for name, raw in self._compiled.columns(self._places(t), names, side)}

    def _at(self, t: Numbers, side: Side, *names: str) -> list[Any]:
        return shaped(self.columns(t, names, one_side(side)).values(), np.asarray(t).shape)

    def strain(self, t: Numbers, side: Side = "right") -> Any:
        """Return ``v_x(0,t)``, the strain at the ground; zero in flight.

        Parameters
        ----------
        t : number or array_like
            Times.
        side : {"right", "left"}, optional
            Which limit at a jump.

        Returns
        -------
        number or ndarray
            Values in the shape of `t`. Times the modulus it is the stress.
        """
        return self._at(t, side, "strain")[0]

    def ground_end(self, t: Numbers, side: Side = "right") -> GroundEnd:
        """Return ``v(0,t)`` and ``v_t(0,t)``.

        Parameters
        ----------
        t : number or array_like
            Times.
        side : {"right", "left"}, optional
            Which limit at a jump.

        Returns
        -------
        GroundEnd
            Numbers or arrays of the shape of `t`.
        """
        return GroundEnd(*self._at(t, side, "u_end", "v_end"))

    def top_end(self, t: Numbers, side: Side = "right") -> TopEnd:
        """Return ``v(L,t)`` and ``v_t(L,t)``.

        Parameters
        ----------
        t : number or array_like
            Times.
        side : {"right", "left"}, optional
            Which limit at a jump.

        Returns
        -------
        TopEnd
            Numbers or arrays of the shape of `t`.
        """
        return TopEnd(*self._at(t, side, "u_top", "v_top"))

    def centre(self, t: Numbers) -> Centre:
        """Return ``h(t)`` and ``h′(t)``, the motion of the centre of mass.

        Parameters
        ----------
        t : number or array_like
            Times.

        Returns
        -------
        Centre
            Numbers or arrays of the shape of `t`.
        """
        return Centre(*self._at(t, "right", "h", "h_rate"))

    def h(self, t: Numbers) -> Any:
        """Return ``h(t)``, the height of the centre of mass.

        Parameters
        ----------
        t : number or array_like
            Times.

        Returns
        -------
        number or ndarray
            Values in the shape of `t`.
        """
        return self._at(t, "right", "h")[0]

    def energy(self, t: Numbers) -> Energy:
        """Return ``E``, ``E_h`` and ``E_z``.

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
        """Return ``v``, ``v_t`` and ``v_x`` at points of the rod.

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
            # An outer product: the field at each time is computed once.
            columns = self._field(self._compiled.grid(self._places(x), self._places(t), side, "points"))
            grids = [column.reshape(times.shape + points.shape) for column in columns]
            moved = [_outer(column, times.ndim, points.ndim, len(shape)).reshape(shape) for column in grids]
            return Field(*(column if shape else column[()] for column in moved))
        beside = [self._places(np.broadcast_to(values, shape)) for values in (points, times)]
        return Field(*shaped(self._field(self._compiled.field(beside[0], beside[1], side)), shape))

    def grid(self, x: Numbers, t: Numbers, side: Side = "right", kind: Slice = "points") -> Field:
        """Return ``v``, ``v_t`` and ``v_x`` at every point for every time.

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
        columns = self._field(self._compiled.grid(self._places(x), self._places(t), side, kind))
        points = np.asarray(x)
        width = points.shape if kind != "averages" else (points.size - 1,)
        return Field(*shaped(columns, np.asarray(t).shape + width))

    def _field(self, columns: list[tuple[str, Any]]) -> list[Array]:
        return [self._array(name, raw) for name, raw in columns]


def _outer(column: Array, times: int, points: int, most: int) -> Array:
    """Return values over (times…, points…) with their axes in the order of the broadcast."""
    where = [most - times + k for k in range(times)] + [most - points + k for k in range(points)]
    return column.transpose(np.argsort(where, kind="stable"))


def _solve_again(problem: Problem, question: tuple[Any, ...]) -> History:
    return History(problem._compiled.solve(*question), problem, question)


def _shown(values: Numbers) -> Array:
    """Return times or points as coordinates."""
    array = np.asarray(values)
    return array if array.dtype.kind in "fiu" else np.array([float(Fraction(str(value))) for value in array])


def _html(tag: str, cells: Iterable[str]) -> str:
    return "<tr>" + "".join(f"<{tag}>{escape(cell)}</{tag}>" for cell in cells) + "</tr>"
