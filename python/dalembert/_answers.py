"""Answers of a history that have several parts."""

from __future__ import annotations

from typing import Any, NamedTuple

from ._numbers import MaskedArray


class GroundEnd(NamedTuple):
    """Motion of the end at the ground.

    Parameters
    ----------
    u_end : number or ndarray
        The displacement ``v(0,t)``.
    v_end : number or ndarray
        The velocity ``v_t(0,t)``.
    """

    u_end: Any
    v_end: Any


class TopEnd(NamedTuple):
    """Motion of the upper end.

    Parameters
    ----------
    u_top : number or ndarray
        The displacement ``v(L,t)``.
    v_top : number or ndarray
        The velocity ``v_t(L,t)``.
    """

    u_top: Any
    v_top: Any


class Centre(NamedTuple):
    """Motion of the centre of mass.

    Parameters
    ----------
    h : number or ndarray
        The height over its place in the undeformed rod on the ground.
    h_rate : number or ndarray
        The velocity ``h′``.
    """

    h: Any
    h_rate: Any


class Energy(NamedTuple):
    """An energy and its parts, ``E = E_h + E_z``.

    Parameters
    ----------
    E_total : number or ndarray
        ``E``.
    E_h : number or ndarray
        Energy of the centre of mass.
    E_z : number or ndarray
        Energy of the vibration.
    """

    E_total: Any
    E_h: Any
    E_z: Any


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


class Derivatives(NamedTuple):
    """Derivatives of a table by a value of the problem, which at a threshold differ from side to side.

    Parameters
    ----------
    left, right : MaskedArray
        Limits from smaller and from greater values: structured arrays with the names and the rows of the table. A
        number without a derivative is masked.
    left_error, right_error : MaskedArray
        Errors of these: bounds, or estimates where ``history.warnings`` says so.
    reasons : dict of tuple to str
        Reason for each masked number by its side, row and column: ``reasons["left", 2, "t"]``. It is "infinite",
        "jumps", "not settled" or "there is no number".
    """

    left: MaskedArray
    right: MaskedArray
    left_error: MaskedArray
    right_error: MaskedArray
    reasons: dict[tuple[str, int, str], str]
