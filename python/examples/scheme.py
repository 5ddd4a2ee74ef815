"""A textbook scheme for contact, to compare with the exact motion: linear elements with lumped masses, central
differences, and a ground whose force stops the end."""

from typing import Any

import numpy as np

Doubles = np.ndarray[Any, np.dtype[Any]]


def leapfrog(
    length: float, c: float, g: float, mu: float, cells: int, end: float, courant: float = 0.8
) -> tuple[Doubles, Doubles]:
    """Return the times of the steps of the scheme, and the contact stress ``v_x(0,t)`` then."""
    dx = length / cells
    dt = courant * dx / c
    mass = np.full(cells + 1, dx)
    mass[[0, -1]] /= 2
    old, now = np.full(cells + 1, mu * dt), np.zeros(cells + 1)
    times, stress = np.arange(1, int(end / dt)) * dt, []
    for _ in times:
        pull = c**2 * np.diff(now) / dx
        force = np.concatenate(([pull[0]], np.diff(pull), [-pull[-1]])) - g * mass
        new = 2 * now - old + dt**2 * force / mass
        press = max(-new[0], 0) * mass[0] / dt**2
        new[0] = max(new[0], 0)
        stress.append(-press / c**2)
        old, now = now, new
    return times, np.array(stress)
