"""Chains of bars and rigid masses, and their histories."""

from __future__ import annotations

import os
from collections.abc import Mapping
from fractions import Fraction
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from . import _core
from ._answers import Derivatives, Field
from ._arrays import READ, Answers, one_side, shaped, short
from ._numbers import Array, Frozen, MaskedArray, Maybe, Names, Number, Numbers, Side
from ._problem import Problem, _number, _text

if TYPE_CHECKING:
    import pandas

ChainTable = Literal["events", "contacts", "touches"]


class Body(NamedTuple):
    """A body of a chain.

    Parameters
    ----------
    name : str or None
        Its name in the scene.
    length : int, float or Fraction
        Length of a bar; zero of a rigid mass.
    mass : int, float, Fraction or None
        Mass of a rigid body; None of a bar.
    """

    name: str | None
    length: int | float | Fraction
    mass: int | float | Fraction | None


class Chain(Frozen):
    """A chain: bars and rigid masses one above the other, which touch or are bonded, between two ends.

    Parameters
    ----------
    scene : str or path
        The name of a built-in scene, a scene file, or a scene as TOML text.

    Attributes
    ----------
    bodies : tuple
        Bodies from the bottom up, each with its ``name``, ``length`` and, if it is rigid, ``mass``.
    values : mapping of str to number
        Values by name: ``body.2.length``, ``joint.1.gap``, ``gravity``, ``time``.
    quantities : mapping of str to str
        Names of the quantities over time with their meanings: ``u_top.2`` of the second body, ``force.1`` of the joint
        above the first body, ``force.bottom``.
    units : mapping of str to str
        Their units.
    title : str or None
        Title of the scene.

    Raises
    ------
    ValueError
        For an invalid scene, with the text of the command.

    Notes
    -----
    Values cannot be assigned: :meth:`replace` returns another chain. :meth:`Problem.bodies` has each bar as a rod.

    Examples
    --------
    >>> chain = Chain("openfoam-7-1-2")
    >>> chain.solve(exact=True).contacts[["node", "release", "peak_force"]].tolist()
    [('joint 1', Fraction(27, 70), Fraction(7, 170))]
    """

    bodies: tuple[Body, ...]
    values: Mapping[str, int | float | Fraction]
    quantities: Mapping[str, str]
    units: Mapping[str, str]
    title: str | None
    _compiled: _core.Chain
    _made: tuple[str, dict[str, Any]]

    def __init__(self, scene: str | os.PathLike[str]) -> None:
        if isinstance(scene, (Problem, Chain)) or not isinstance(scene, (str, os.PathLike)):
            kind = type(scene).__name__
            raise TypeError(f"found a scene of type {kind}, expected a name, a path or TOML text of a chain")
        self._make(_text(scene), {})

    def _make(self, text: str, replaced: dict[str, Any]) -> Chain:
        core = _core.Chain(text, list(replaced.items()))
        facts = core.facts()
        bodies = (
            Body(body["name"], _number(body["length"]), _number(body["mass"]) if body["mass"] is not None else None)
            for body in facts["bodies"]
        )  # fmt: skip
        known = facts["quantities"]
        self.__dict__.update(
            _compiled=core, _made=(text, replaced), title=facts["title"], bodies=tuple(bodies),
            values=MappingProxyType({name: _number(value) for name, value in facts["values"]}),
            quantities=MappingProxyType({column["name"]: column["meaning"] for column in known}),
            units=MappingProxyType({column["name"]: column["unit"] for column in known}),
        )  # fmt: skip
        return self

    def replace(self, values: Mapping[str, Number]) -> Chain:
        """Return a chain with other values in place of some.

        Parameters
        ----------
        values : mapping of str to number
            Numbers by the names of :attr:`values`. A length stretches the points of the start of its body.

        Returns
        -------
        Chain
            Another chain.

        Examples
        --------
        >>> chain = Chain("openfoam-7-1-2").replace({"joint.1.gap": "0.02"})
        >>> chain.solve(exact=True).events["t"][0]
        Fraction(1, 5)
        """
        if not isinstance(values, Mapping) or not all(isinstance(name, str) for name in values):
            raise TypeError(f"found values = {values!r}, expected a mapping of names to numbers")
        return _chain(self._made[0], self._made[1] | dict(values))

    def solve(
        self,
        *,
        to: Maybe = None,
        digits: int | None = None,
        exact: bool = False,
        certified: bool = False,
        accuracy: float | None = None,
    ) -> ChainHistory:
        """Solve the chain.

        Parameters
        ----------
        to : number, optional
            Last time, in place of that of the scene.
        digits : int, optional
            As in :func:`solve`.
        exact, certified : bool, optional
            As in :func:`solve`; fractions hold chains without springs and masses.
        accuracy : float, optional
            As in :func:`solve`.

        Returns
        -------
        ChainHistory
            The motion.
        """
        chain = self if to is None else self.replace({"time": to})
        question = (digits, exact, certified, accuracy)
        return ChainHistory(chain._compiled.solve(*question), chain, question)

    def _scene_text(self) -> str:
        if self._made[1]:
            raise ValueError("found a chain with other values, which no scene file has: expected that of its own file")
        return self._made[0]

    def __repr__(self) -> str:
        bodies = ", ".join("a mass" if body.mass is not None else "a bar" for body in self.bodies)
        title = f"{self.title}: " if self.title else ""
        return f"<dalembert.Chain {title}{bodies}, to t = {short(self.values['time'])}>"

    def __eq__(self, other: object) -> bool:
        return self._made == other._made if isinstance(other, Chain) else NotImplemented

    def __hash__(self) -> int:
        return hash(self._made[0])

    def __reduce__(self) -> tuple[Any, ...]:
        return _chain, self._made

    def _refusal(self, name: str) -> str:
        return f"found an assignment to {name}, expected replace({{name: number}}): a Chain does not change"


class ChainHistory(Answers):
    """The motion of a chain: events, contacts, and the value of every quantity at any time from 0 to `end`.

    Attributes
    ----------
    chain : Chain
        The chain that was solved.
    numbers : {"double", "exact", "digits", "certified"}
        Number system of the answers.
    end : float, Fraction, Decimal or pair of Decimal
        Last time that is known.
    ending : str
        Reason for the end.

    Notes
    -----
    :meth:`Chain.solve` makes histories. Tables cannot be written to, and other arrays are copies. A
    number that a table does not have, such as the release of a contact that lasts, is masked. A history is pickled as
    its chain and the numbers asked for, and solved again where it is read.

    Examples
    --------
    >>> Chain("openfoam-7-1-2").solve()
    <dalembert.ChainHistory to t = 0.5, double, 1 contact
     joint 1 from 0.1 to 0.385714, impulse 0.00885813, peak force 0.0411765
     ends: the time asked for>
    """

    chain: Chain
    numbers: Literal["double", "exact", "digits", "certified"]
    end: Any
    ending: str
    _compiled: _core.ChainHistory
    _question: tuple[Any, ...]
    _in_words: str
    _tables: dict[str, MaskedArray]

    def __init__(self, compiled: _core.ChainHistory, chain: Chain, question: tuple[Any, ...]) -> None:
        facts = compiled.facts()
        self.__dict__.update(
            _compiled=compiled, chain=chain, _question=question, _in_words=facts["question"], _tables={},
            numbers=facts["numbers"], end=READ[facts["numbers"]](facts["end"]), ending=facts["ending"],
        )  # fmt: skip

    def __reduce__(self) -> tuple[Any, ...]:
        return _solve_again, (self.chain, self._question)

    def __repr__(self) -> str:
        found = self.contacts
        head = f"to t = {short(self.end)}, {self._in_words}, {len(found)} contact{'s' if len(found) != 1 else ''}"
        keys = [("impact", "from"), ("release", "to"), ("impulse", "impulse"), ("peak_force", "peak force")]
        lines = []
        for row in found[:4]:
            start, end, impulse, peak = (f"{word} {short(row[key])}" for key, word in keys)
            lines.append(f"{row['node']} {start} {end}, {impulse}, {peak}")
        lines += [f"… {len(found) - 4} more"] if len(found) > 4 else []
        return "\n ".join([f"<dalembert.ChainHistory {head}", *lines, f"ends: {self.ending}>"])

    @property
    def warnings(self) -> list[str]:
        """Warnings that come with the answers so far."""
        return self._compiled.warnings()

    def _table(self, table: ChainTable) -> MaskedArray:
        if table not in self._tables:
            rows = self._compiled.table(table)
            others = {name: np.array(words, "U16") for name, words in rows["words"]}
            if table == "events":
                others["t_error"] = np.asarray(rows["numbers"][0]["bounds"])
            self._tables[table] = self._structured(rows["numbers"], "values", others)
        return self._tables[table]

    @property
    def events(self) -> MaskedArray:
        """Impacts and releases.

        A structured array of ``t``, ``gap_rate_before`` and ``gap_rate_after``, which are the rates of the gap that
        free ends would have, the ``node`` ("bottom", "joint 1", "top"), the ``kind``, and the bound of the error of the
        time, ``t_error``.
        """
        return self._table("events")

    @property
    def contacts(self) -> MaskedArray:
        """Contacts at joints and ends.

        A structured array of ``impact``, ``release``, ``impulse``, ``peak_force``, ``peak_time`` and the ``node``. The
        force of a plateau has no time of its own: there the ``peak_time`` is masked.
        """
        return self._table("contacts")

    @property
    def touches(self) -> MaskedArray:
        """Gaps that reach zero without a contact.

        A structured array of ``t`` and the ``node``.
        """
        return self._table("touches")

    def force_pieces(self, node: int | str) -> tuple[MaskedArray, list[Array]]:
        """Return the compressive force of a node piece by piece.

        Parameters
        ----------
        node : int or {"bottom", "top"}
            The joint above the body of this number, from 1, or an end.

        Returns
        -------
        pieces : MaskedArray
            A structured array of ``start``, ``end``, and ``force_start`` and ``force_end`` then.
        series : list of ndarray
            Chebyshev coefficients of each piece from its start to its end, the first one whole; none of a line.

        Examples
        --------
        >>> pieces, series = Chain("openfoam-7-1-2").solve(exact=True).force_pieces(1)
        >>> pieces[["start", "force_start"]].tolist()[1], len(series[1])
        ((Fraction(1, 10), Fraction(7, 170)), 0)
        """
        found = self._compiled.force_pieces(node)
        return self._structured(found["numbers"], "values"), [self._array("series", raw) for raw in found["series"]]

    def columns(self, t: Numbers, names: Names, side: Side | None = None) -> dict[str, Array]:
        """Return quantities over time, as ``dalembert reference`` writes them.

        Parameters
        ----------
        t : number or array_like
            Times.
        names : str or sequence of str
            Names of :attr:`Chain.quantities`; ``gap`` stands for the gaps of all nodes, ``end``, ``top``, ``centre``
            and ``energy`` for groups of all bodies, and ``end.2`` for a group of one. Also ``t`` and ``side``.
        side : {"left", "right"}, optional
            Which limit at a jump. Without it a time has two rows where they differ, the earlier one first.

        Returns
        -------
        dict of str to ndarray
            The columns by name. That of ``side`` has the words "left", "right", and "both" where the limits agree.

        Examples
        --------
        >>> found = Chain("openfoam-7-1-2").solve(exact=True).columns("1/10", ["t", "side", "force.1"])
        >>> found["side"].tolist(), found["force.1"].tolist()
        (['left', 'right'], [Fraction(0, 1), Fraction(7, 170)])
        """
        listed = [names] if isinstance(names, str) else list(names)
        found = self._compiled.columns(self._places(t), [name for name in listed if name not in ("t", "side")], side)
        keys, others = dict(found[:2]), dict(found[2:])
        columns = {name: keys[name] for name in listed if name in keys} | others
        return {name: self._array(name, raw) for name, raw in columns.items()}

    def value(self, name: str, t: Numbers, side: Side = "right") -> Any:
        """Return a quantity over time.

        Parameters
        ----------
        name : str
            A name of :attr:`Chain.quantities`.
        t : number or array_like
            Times.
        side : {"right", "left"}, optional
            Which limit at a jump.

        Returns
        -------
        number or ndarray
            Values in the shape of `t`.

        Examples
        --------
        >>> Chain("openfoam-7-1-2").solve().value("force.1", [0.05, 0.2]).round(6)
        array([0.      , 0.041176])
        """
        if not isinstance(name, str) or name not in self.chain.quantities:
            raise ValueError(f"found the quantity {name}, expected one of {', '.join(self.chain.quantities)}")
        return shaped([self.columns(t, name, one_side(side))[name]], np.asarray(t).shape)[0]

    def field(self, body: int, x: Numbers, t: Numbers, side: Side = "right") -> Field:
        """Return ``v``, ``v_t`` and ``v_x`` at points of a body.

        Parameters
        ----------
        body : int
            Number of the body, from 1 at the bottom.
        x, t : number or array_like
            Points from the lower end of the body and times, which are broadcast against each other.
        side : {"right", "left"}, optional
            Which limit at a jump.

        Returns
        -------
        Field
            Numbers or arrays of the shape of `x` and `t` together.

        Examples
        --------
        >>> Chain("openfoam-7-1-2").solve(exact=True).field(1, 9, "1/5").strain
        Fraction(-1, 1190)
        """
        shape = np.broadcast_shapes(np.asarray(x).shape, np.asarray(t).shape)
        beside = [self._places(np.broadcast_to(np.asarray(values), shape)) for values in (x, t)]
        columns = self._compiled.field(body, beside[0], beside[1], side)
        return Field(*shaped([self._array(name, raw) for name, raw in columns], shape))

    def derivatives(self, by: str, table: Literal["events", "contacts"] = "events") -> Derivatives:
        """Return the derivatives of a table by a value of the chain; all other values stay as they are.

        Parameters
        ----------
        by : str
            A name of :attr:`Chain.values`: ``joint.1.gap``.
        table : {"events", "contacts"}, optional
            The array of that name.

        Returns
        -------
        Derivatives
            From both sides, with bounds, or estimates where :attr:`warnings` says so. Fractions stay fractions.

        Examples
        --------
        >>> Chain("openfoam-7-1-2").solve(exact=True).derivatives("joint.1.gap").right["t"].tolist()
        [Fraction(10, 1), Fraction(10, 1)]
        """
        return self._derivatives(self._compiled.derivatives(by, table))

    def derivatives_at(self, by: str, t: Numbers, names: Names, side: Side = "right") -> Derivatives:
        """Return the derivatives of quantities at times, which stay where they are.

        Parameters
        ----------
        by : str
            A name of :attr:`Chain.values`.
        t : number or array_like
            Times.
        names : str or sequence of str
            Names as in `columns`.
        side : {"right", "left"}, optional
            Which limit at a jump.

        Returns
        -------
        Derivatives
            A row for each time.
        """
        if not isinstance(names, str) and not list(names):
            raise ValueError("found no names, expected at least one")
        return self._derivatives(self._compiled.derivatives_at(by, self._places(t), names, side))

    def to_frame(self, table: ChainTable = "contacts") -> pandas.DataFrame:
        """Return a table as a DataFrame of pandas.

        Parameters
        ----------
        table : {"contacts", "events", "touches"}, optional
            The array of that name.

        Returns
        -------
        pandas.DataFrame
            A row each; a number that there is not is NaN, or None among objects.
        """
        from pandas import DataFrame

        found = self._table(table)
        frame = DataFrame({name: np.array(found.data[name]) for name in found.dtype.names or ()})
        frame.attrs = {"title": self.chain.title or "", "numbers": self._in_words}
        return frame

    def _attributes(self, kind: str) -> dict[str, Any]:
        """Return the attributes of a frame: title and numbers, and unit and meaning of each column."""
        return {
            "title": self.chain.title or "",
            "numbers": self._in_words,
            "units": dict(self.chain.units),
            "meanings": dict(self.chain.quantities),
        }


def _chain(text: str, replaced: dict[str, Any]) -> Chain:
    return Chain.__new__(Chain)._make(text, replaced)


def _solve_again(chain: Chain, question: tuple[Any, ...]) -> ChainHistory:
    return ChainHistory(chain._compiled.solve(*question), chain, question)
