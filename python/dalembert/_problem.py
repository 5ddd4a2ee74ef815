"""Problems: a rod, the ground and the start, in exact numbers."""

from __future__ import annotations

import os
from fractions import Fraction
from importlib.metadata import version as _version
from typing import TYPE_CHECKING, Any, Literal, Union

from . import _core
from ._numbers import Maybe, Number, Points

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
        The summary of each scene by its name, which :func:`solve` takes.

    Examples
    --------
    >>> scenes()["paper-strong"]
    'Corollary 1 above the critical speed: contact for one round trip'
    """
    return {name: summary for name, (summary, _) in _SCENES.items()}


def _spelt(text: str) -> int | float | Fraction:
    """The number of a text: int or float where that spells it exactly, in the way :class:`Problem` reads it."""
    whole, _, below = text.partition("/")
    exact = Fraction(whole) / Fraction(below or 1)
    if exact.denominator == 1:
        return exact.numerator
    return float(exact) if Fraction(repr(float(exact))) == exact else exact


class Problem:
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
        How far the rod starts above the ground.
    drop_height : number, optional
        How far it has fallen from rest, undamped, when it touches at ``t = 0``.
    displacement, velocity : points, optional
        In place of an impact: pairs ``(x, value)`` from ``x = 0`` to ``x = length``, linear between them.
    time : number, optional
        How far the motion is followed.
    impacts : int, optional
        Through how many contacts, and the flight after the last; one without a `time`.

    Attributes
    ----------
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
    None where it is absent. Problems with the same physics are equal.

    Examples
    --------
    >>> rod = Problem(length=1, wave_speed=1, gravity=1, impact_speed="10/3")
    >>> rod
    Problem(length=1, wave_speed=1, gravity=1, impact_speed=Fraction(10, 3), impacts=1)
    >>> rod.round_trip, rod.impact_speed
    (2.0, Fraction(10, 3))
    >>> rod.solve(exact=True).strain("1/3")
    Fraction(-11, 3)
    """

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
    displacement: tuple[tuple[int | float | Fraction, int | float | Fraction], ...] | None = None
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
        displacement: Points | None = None, velocity: Points | None = None,
        time: Maybe = None, impacts: int | None = None,
    ) -> None:
        self._make({name: value for name, value in locals().items() if name != "self" and value is not None})

    def _make(self, *made: Any) -> Problem:
        """From values by name or the text of a scene, and values that replace others, in order."""
        self._core, self._made = _core.Problem(*made), made
        numbers, profiles = self._core.values()
        speed, self.round_trip, self.damping_ratio, self.speed_ratio = self._core.parameters()
        fixed, self.title = self._core.about()
        values: dict[str, Any] = {name: _spelt(text) for name, text in numbers}
        values |= {name: tuple((_spelt(x), _spelt(v)) for x, v in points) for name, points in profiles}
        self._values = values | ({"top": "fixed"} if fixed else {})
        self.__dict__.update({"wave_speed": speed} | self._values)
        return self

    @classmethod
    def from_scene(cls, scene: Scene) -> Problem:
        """Read a problem.

        Parameters
        ----------
        scene : str, path or Problem
            The name of a built-in scene, a scene file, a scene as TOML text, or a problem, which is its own.

        Returns
        -------
        Problem
            What the scene says.
        """
        return scene if isinstance(scene, Problem) else _problem(_text(scene))

    def replace(self, **values: Any) -> Problem:
        """Take other values in place of some.

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

    def __repr__(self) -> str:
        return f"Problem({', '.join(f'{name}={value!r}' for name, value in self._values.items())})"

    def __eq__(self, other: object) -> bool:
        return self._values == other._values if isinstance(other, Problem) else NotImplemented

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
        """Solve it.

        Parameters
        ----------
        digits : int, optional
            As in :func:`solve`.
        exact, certified : bool, optional
            As in :func:`solve`.
        accuracy : float, optional
            As in :func:`solve`.
        first_contact : bool, optional
            Whether to end at the bounce, which takes less time.

        Returns
        -------
        History
            The motion.
        """
        from ._history import History

        asked = (digits, exact, certified, accuracy, first_contact)
        return History(self._core.solve(*asked), self, asked)


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
