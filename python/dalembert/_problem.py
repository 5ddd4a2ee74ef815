"""Problems: a rod, the ground and the start, in exact numbers."""

from __future__ import annotations

import os
from fractions import Fraction
from importlib.metadata import version as _version
from typing import TYPE_CHECKING, Any, Literal, Union

from . import _core
from ._numbers import Frozen, Maybe, Number, Points

if TYPE_CHECKING:
    from ._history import History

__version__: str = _version("dalembert")

Scene = Union[str, "os.PathLike[str]", "Problem"]

_SCENES = {name: (summary, text) for name, summary, text in _core.scenes()}


def scenes() -> dict[str, str]:
    """List the built-in scenes.

    Returns
    -------
    dict of str to str
        Summary of each scene by its name, which :func:`solve` takes.

    Examples
    --------
    >>> scenes()["paper-strong"]
    'Corollary 1 above the critical speed: contact for one round trip'
    """
    return {name: summary for name, (summary, _) in _SCENES.items()}


def _number(text: str) -> int | float | Fraction:
    """Return the number of a text: an int or a float where that spells it exactly, as :class:`Problem` reads it."""
    whole, _, below = text.partition("/")
    exact = Fraction(whole) / Fraction(below or 1)
    if exact.denominator == 1:
        return exact.numerator
    return float(exact) if Fraction(repr(float(exact))) == exact else exact


def _value(given: _core.Given) -> Any:
    if given["number"] is None:
        return tuple((_number(x), _number(v)) for x, v in given["points"])
    return _number(given["number"])


class Problem(Frozen):
    """A rod, the ground and the start, in exact numbers, checked.

    Parameters
    ----------
    length : number
        ``L``.
    wave_speed : number, optional
        ``c``; or else `modulus` and `density`, with ``c = √(modulus/density)``.
    modulus, density, area : number, optional
        The material; without an area forces and energies are per area.
    damping : number, optional
        The ``r`` of the equation.
    gravity : number, optional
        ``g``.
    top : {"free", "fixed"}, optional
        Whether the upper end is held.
    impact_speed : number, optional
        ``μ``, at the touch or, with a `gap`, at ``t = 0``.
    gap : number, optional
        Height of the start above the ground.
    drop_height : number, optional
        Height of an undamped fall from rest that ends at ``t = 0``, at the touch.
    displacement, strain, velocity : points, optional
        In place of an impact: pairs ``(x, value)`` from ``x = 0`` to ``x = length``, linear between them. A strain is
        given in place of a displacement, and the lower end touches the ground. Strain and velocity may jump: one x
        twice.
    time : number, optional
        Last time of the motion.
    impacts : int, optional
        Number of contacts, each with the flight after it; one without a `time`.

    Attributes
    ----------
    stiffness : number or None
        Stiffness of the spring below a body of a chain, which `replace` and :func:`sweep` change; None on rigid ground.
    round_trip : float
        ``t₁ = 2L/c``.
    damping_ratio : float
        ``R = r t₁``.
    speed_ratio : float or None
        ``M = μ/(g t₁)``; infinite without gravity, None where the start is not uniform.

    Raises
    ------
    ValueError
        For a value that is missing or out of range.
    TypeError
        For a value of the wrong type.

    Notes
    -----
    The parameters are attributes by their names: int or float where that spells the number, a Fraction elsewhere, and
    None where it is absent. They cannot be assigned: :meth:`replace` returns another problem. Problems with the same
    physics are equal. A ``np.float32`` stands for the shortest decimal that spells it, as a float does: ``0.1``.

    Examples
    --------
    >>> rod = Problem(length=1, wave_speed=1, gravity=1, impact_speed="10/3")
    >>> rod
    Problem(length=1, wave_speed=1, impact_speed=Fraction(10, 3), gravity=1, impacts=1)
    >>> rod.round_trip, rod.impact_speed
    (2.0, Fraction(10, 3))
    >>> rod.solve(exact=True).strain("1/3")
    Fraction(-11, 3)
    """

    _compiled: _core.Problem
    _made: tuple[Any, ...]
    _values: dict[str, Any]
    wave_speed: int | float | Fraction
    round_trip: float
    damping_ratio: float
    speed_ratio: float | None
    length: int | float | Fraction
    modulus: int | float | Fraction | None = None
    density: int | float | Fraction | None = None
    area: int | float | Fraction | None = None
    damping: int | float | Fraction = 0
    gravity: int | float | Fraction = 0
    top: Literal["free", "fixed"] = "free"
    impact_speed: int | float | Fraction | None = None
    gap: int | float | Fraction | None = None
    drop_height: int | float | Fraction | None = None
    stiffness: int | float | Fraction | None = None
    displacement: tuple[tuple[int | float | Fraction, int | float | Fraction], ...] | None = None
    strain: tuple[tuple[int | float | Fraction, int | float | Fraction], ...] | None = None
    velocity: tuple[tuple[int | float | Fraction, int | float | Fraction], ...] | None = None
    time: int | float | Fraction | None = None
    impacts: int | None = None
    title: str | None = None

    def __init__(
        self,
        *,
        length: Number, wave_speed: Maybe = None, modulus: Maybe = None, density: Maybe = None, area: Maybe = None,
        damping: Maybe = None, gravity: Maybe = None, top: Literal["free", "fixed", None] = None,
        impact_speed: Maybe = None, gap: Maybe = None, drop_height: Maybe = None,
        displacement: Points | None = None, strain: Points | None = None, velocity: Points | None = None,
        time: Maybe = None, impacts: int | None = None,
    ) -> None:
        self._make({name: value for name, value in locals().items() if name != "self" and value is not None})

    def _make(self, *made: Any) -> Problem:
        """Fill in values by name or the text of a scene, and values that replace others, in order."""
        core = _core.Problem(*made)
        facts = core.facts()
        values: dict[str, Any] = {given["name"]: _value(given) for given in facts["given"]}
        values |= {"top": "fixed"} if facts["has_fixed_top"] else {}
        shown = {name: facts[name] for name in ("wave_speed", "round_trip", "damping_ratio", "speed_ratio", "title")}
        self.__dict__.update({"_compiled": core, "_made": made, "_values": values} | shown | values)
        return self

    def _refusal(self, name: str) -> str:
        if unknown := _core.unknown_parameter(name):
            return unknown if not hasattr(self, name) else f"found an assignment to {name}, which follows from others"
        return f"found an assignment to {name}, expected replace({name}=…): a Problem does not change"

    @classmethod
    def from_scene(cls, scene: Scene) -> Problem:
        """Read a problem.

        Parameters
        ----------
        scene : str, path or Problem
            The name of a built-in scene, a scene file, a scene as TOML text, or a problem.

        Returns
        -------
        Problem
            The problem of the scene.
        """
        if isinstance(scene, Problem):
            return scene
        text = _text(scene)
        # A chain of one body is that body.
        return _problem((text, 0)) if len(_core.bars(text)) == 1 else _problem(text)

    @classmethod
    def bodies(cls, scene: str | os.PathLike[str]) -> tuple[Problem, ...]:
        """Read the bars of a chain, each as a problem: its ground is the body or the stop below it.

        Parameters
        ----------
        scene : str or path
            The name of a built-in scene, a scene file, or a scene as TOML text.

        Returns
        -------
        tuple of Problem
            The bars from the bottom up, without the rigid masses between them; of a single rod the rod.

        Examples
        --------
        >>> striker, target = Problem.bodies("openfoam-7-1-2")
        >>> target.solve(exact=True).contacts["release"][0]
        Fraction(27, 70)
        >>> striker.solve().columns(0.2, "force")["force"]
        array([0.])
        """
        text = _text(scene)
        bars = enumerate(_core.bars(text))
        return tuple(_problem((text, body)) for body, is_bar in bars if is_bar) or (_problem(text),)

    def replace(self, **values: Any) -> Problem:
        """Return a problem with other values in place of some.

        Parameters
        ----------
        **values : number or points
            Parameters of :class:`Problem`. A `time` takes the place of `impacts`, a profile that of an impact.

        Returns
        -------
        Problem
            Another problem.

        Examples
        --------
        >>> Problem(length=1, wave_speed=1, impact_speed=3).replace(damping="0.1").damping_ratio
        0.2
        """
        return _problem(*self._made, values)

    def to_toml(self) -> str:
        """Return a scene file with this problem, for the command and for :meth:`from_scene`.

        Returns
        -------
        str
            TOML text: that of the scene that it was read from, if no value has been replaced; for a body of a chain,
            that of the chain.

        Examples
        --------
        >>> print(Problem(length=1, wave_speed=1, impact_speed="10/3").to_toml())
        [impact]
        speed = "10/3"
        <BLANKLINE>
        [rod]
        length = 1
        wave_speed = 1
        <BLANKLINE>
        [run]
        impacts = 1
        <BLANKLINE>
        """
        if len(self._made) == 1 and isinstance(self._made[0], (str, tuple)):
            return self._made[0] if isinstance(self._made[0], str) else self._made[0][0]
        return self._compiled.to_toml()

    @property
    def _chain(self) -> tuple[str, int] | None:
        """The text of the chain that the problem is a body of, and the index of the body."""
        return self._made[0] if isinstance(self._made[0], tuple) else None

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value!r}" for name, value in self._values.items())
        # The neighbours of a body are no arguments of `Problem`.
        return f"Problem({values})" if self._chain is None else f"<body of a chain: {values}>"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Problem):
            return NotImplemented
        return self._values == other._values and self._chain == other._chain

    def __hash__(self) -> int:
        return hash(tuple(self._values.items()))

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
        """Solve the problem.

        Parameters
        ----------
        digits : int, optional
            As in :func:`solve`.
        exact, certified : bool, optional
            As in :func:`solve`.
        accuracy : float, optional
            As in :func:`solve`.
        first_contact : bool, optional
            As in :func:`solve`.

        Returns
        -------
        History
            The motion.
        """
        from ._history import History

        question = (digits, exact, certified, accuracy, first_contact)
        return History(self._compiled.solve(*question), self, question)


def _problem(*made: Any) -> Problem:
    return Problem.__new__(Problem)._make(*made)


def _text(scene: str | os.PathLike[str]) -> str:
    """Return the text of the scene of this name or file; a TOML text is its own."""
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
